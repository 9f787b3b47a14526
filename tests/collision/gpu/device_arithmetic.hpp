#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "support/random.hpp"

namespace surehit::test {

/// How a device chooses among the results that Vulkan allows.
enum class DeviceRounding : std::uint8_t { nearest, down, up, toward_zero, away_from_zero, any };

inline constexpr DeviceRounding all_device_roundings[] = {
    DeviceRounding::nearest,     DeviceRounding::down,           DeviceRounding::up,
    DeviceRounding::toward_zero, DeviceRounding::away_from_zero, DeviceRounding::any};

/// A float of a device. A sum, a difference or a product is either neighbour of the exact result, as the device
/// chooses. A quotient is within 2.5 ulp. Denormals may be lost.
class DeviceFloat {
 public:
  DeviceFloat() = default;
  DeviceFloat(double x) : value_(static_cast<float>(x)) {}
  [[nodiscard]] static DeviceFloat of(float x) {
    DeviceFloat result;
    result.value_ = x;
    return result;
  }
  [[nodiscard]] float value() const { return value_; }

  friend DeviceFloat operator+(DeviceFloat x, DeviceFloat y) {
    const double a = read(x);
    const double b = read(y);
    const double sum = a + b;
    const double part = sum - a;
    return chosen(sum, (a - (sum - part)) + (b - part));
  }
  friend DeviceFloat operator-(DeviceFloat x, DeviceFloat y) { return x + -y; }
  friend DeviceFloat operator*(DeviceFloat x, DeviceFloat y) { return chosen(double{read(x)} * double{read(y)}, 0); }
  friend DeviceFloat operator/(DeviceFloat x, DeviceFloat y) {
    float quotient = static_cast<float>(double{read(x)} / double{read(y)});
    std::int64_t steps = rounding == DeviceRounding::nearest ? 0 : random.between(-2, 2);
    for (; steps > 0; --steps) quotient = std::nextafter(quotient, infinity);
    for (; steps < 0; ++steps) quotient = std::nextafter(quotient, -infinity);
    return of(quotient);
  }
  DeviceFloat operator-() const { return of(-value_); }
  friend bool operator<(DeviceFloat x, DeviceFloat y) { return read(x) < read(y); }
  friend bool operator>(DeviceFloat x, DeviceFloat y) { return y < x; }
  friend bool operator<=(DeviceFloat x, DeviceFloat y) { return read(x) <= read(y); }
  friend bool operator>=(DeviceFloat x, DeviceFloat y) { return y <= x; }

  static inline DeviceRounding rounding = DeviceRounding::nearest;
  static inline bool flushes = false;
  static inline Random random{1};

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  [[nodiscard]] static float flushed(float x) {
    return flushes && std::fabs(x) < std::numeric_limits<float>::min() ? 0 : x;
  }
  [[nodiscard]] static float read(DeviceFloat x) { return flushed(x.value_); }
  /// Returns a neighbour of high + low, of which `low` is less than an ulp.
  [[nodiscard]] static DeviceFloat chosen(double high, double low) {
    const auto nearest = static_cast<float>(high);
    const double rest = high != double{nearest} ? high - double{nearest} : low;
    const float below = rest < 0 ? std::nextafter(nearest, -infinity) : nearest;
    const float above = rest > 0 ? std::nextafter(nearest, infinity) : nearest;
    switch (rounding) {
      case DeviceRounding::nearest:
        return of(flushed(nearest));
      case DeviceRounding::down:
        return of(flushed(below));
      case DeviceRounding::up:
        return of(flushed(above));
      case DeviceRounding::toward_zero:
        return of(flushed(high < 0 ? above : below));
      case DeviceRounding::away_from_zero:
        return of(flushed(high < 0 ? below : above));
      default:
        return of(flushed(random.one_in(2) ? below : above));
    }
  }

  float value_ = 0;
};

/// Calls `work` for each way to round, with and without denormals.
template <typename Work>
void on_every_device(const Work& work) {
  for (const bool flushes : {false, true}) {
    for (const DeviceRounding rounding : all_device_roundings) {
      SCOPED_TRACE(std::to_string(static_cast<int>(rounding)) + (flushes ? " with flushes" : ""));
      DeviceFloat::rounding = rounding;
      DeviceFloat::flushes = flushes;
      work();
    }
  }
  DeviceFloat::rounding = DeviceRounding::nearest;
  DeviceFloat::flushes = false;
}

/// The arithmetic of the shaders, as far as it is C++ too, on a device that rounds as `DeviceFloat` says.
struct DeviceArithmetic {
  using real = DeviceFloat;
  using uint = std::uint32_t;
  struct vec3 {
    real x, y, z;
  };
  static real abs(real x) { return x < 0 ? -x : x; }
  static real max(real x, real y) { return x < y ? y : x; }
  static uint floatBitsToUint(real x) { return std::bit_cast<uint>(x.value()); }
  static real uintBitsToFloat(uint bits) { return real::of(std::bit_cast<float>(bits)); }

#define precise
#include "gpu/hit_rounding.glsl"
#include "gpu/pair_kernel.glsl"
#include "gpu/placed_path.glsl"
#include "gpu/placed_rounding.glsl"
#undef precise
};

}  // namespace surehit::test
