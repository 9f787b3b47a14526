#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "support/random.hpp"

namespace surehit::test {

/// How a device chooses among the results that Vulkan allows. With `listed`, a list has the choice of each operation.
enum class DeviceRounding : std::uint8_t { nearest, down, up, toward_zero, away_from_zero, any, listed };

inline constexpr DeviceRounding all_device_roundings[] = {
    DeviceRounding::nearest,     DeviceRounding::down,           DeviceRounding::up,
    DeviceRounding::toward_zero, DeviceRounding::away_from_zero, DeviceRounding::any};

/// The choices of one operation after another, from -2 to 2. A sum or a product is the lower neighbour for a negative
/// one, and the upper one for a positive one. A quotient is so many ulps off.
using RoundingList = std::array<std::int8_t, 128>;

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
    std::int64_t steps = 0;
    if (rounding == DeviceRounding::listed) {
      steps = next_choice();
    } else if (rounding != DeviceRounding::nearest) {
      steps = random.between(-2, 2);
    }
    for (; steps > 0; --steps) quotient = std::nextafter(quotient, infinity);
    for (; steps < 0; ++steps) quotient = std::nextafter(quotient, -infinity);
    return of(flushed(quotient));
  }
  DeviceFloat operator-() const { return of(-value_); }
  friend bool operator<(DeviceFloat x, DeviceFloat y) { return read(x) < read(y); }
  friend bool operator>(DeviceFloat x, DeviceFloat y) { return y < x; }
  friend bool operator<=(DeviceFloat x, DeviceFloat y) { return read(x) <= read(y); }
  friend bool operator>=(DeviceFloat x, DeviceFloat y) { return y <= x; }

  static inline DeviceRounding rounding = DeviceRounding::nearest;
  static inline bool flushes = false;
  static inline Random random{1};
  static inline Random random_flushes{2};
  static inline RoundingList list = {};
  static inline std::size_t place = 0;  ///< The number of operations that have taken their choices from the list.

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  /// A device that chooses anything flushes some denormals and not others.
  [[nodiscard]] static float flushed(float x) {
    if (!flushes || std::fabs(x) >= std::numeric_limits<float>::min()) return x;
    return rounding == DeviceRounding::any && random_flushes.one_in(2) ? x : 0;
  }
  [[nodiscard]] static int next_choice() { return list[place++ % list.size()]; }
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
      case DeviceRounding::listed: {
        const int choice = next_choice();
        return of(flushed(choice == 0 ? nearest : choice < 0 ? below : above));
      }
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
  struct bvec3 {
    bool x, y, z;
  };
  struct uvec3 {
    uvec3() = default;
    explicit uvec3(uint all) : x(all), y(all), z(all) {}
    uvec3(uint of_x, uint of_y, uint of_z) : x(of_x), y(of_y), z(of_z) {}
    uint x, y, z;
  };
  struct vec3 {
    vec3() = default;
    vec3(real all) : x(all), y(all), z(all) {}
    vec3(real of_x, real of_y, real of_z) : x(of_x), y(of_y), z(of_z) {}
    [[nodiscard]] vec3 turned() const { return {y, z, x}; }
    [[nodiscard]] vec3 turned_back() const { return {z, x, y}; }
    real x, y, z;
  };
  friend vec3 operator+(const vec3& p, const vec3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
  friend vec3 operator-(const vec3& p, const vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  friend vec3 operator*(const vec3& p, const vec3& q) { return {p.x * q.x, p.y * q.y, p.z * q.z}; }
  friend vec3 operator/(const vec3& p, const vec3& q) { return {p.x / q.x, p.y / q.y, p.z / q.z}; }
  friend vec3 operator-(const vec3& p) { return {-p.x, -p.y, -p.z}; }
  friend uvec3 operator&(const uvec3& p, uint bits) { return {p.x & bits, p.y & bits, p.z & bits}; }

  static int min(int x, int y) { return x < y ? x : y; }
  static int max(int x, int y) { return x < y ? y : x; }
  static void umulExtended(uint x, uint y, uint& high, uint& low) {
    const std::uint64_t product = std::uint64_t{x} * y;
    high = static_cast<uint>(product >> 32U);
    low = static_cast<uint>(product);
  }
  static real abs(real x) { return x < 0 ? -x : x; }
  static real max(real x, real y) { return x < y ? y : x; }
  static real min(real x, real y) { return y < x ? y : x; }
  static vec3 abs(const vec3& p) { return {abs(p.x), abs(p.y), abs(p.z)}; }
  static vec3 max(const vec3& p, const vec3& q) { return {max(p.x, q.x), max(p.y, q.y), max(p.z, q.z)}; }
  static vec3 min(const vec3& p, const vec3& q) { return {min(p.x, q.x), min(p.y, q.y), min(p.z, q.z)}; }
  static uvec3 max(const uvec3& p, const uvec3& q) {
    return {p.x < q.x ? q.x : p.x, p.y < q.y ? q.y : p.y, p.z < q.z ? q.z : p.z};
  }
  template <typename Vector>
  static bvec3 lessThan(const Vector& p, const Vector& q) {
    return {p.x < q.x, p.y < q.y, p.z < q.z};
  }
  template <typename Vector>
  static bvec3 greaterThan(const Vector& p, const Vector& q) {
    return lessThan(q, p);
  }
  static bvec3 greaterThanEqual(const vec3& p, const vec3& q) { return {p.x >= q.x, p.y >= q.y, p.z >= q.z}; }
  static bvec3 equal(const uvec3& p, const uvec3& q) { return {p.x == q.x, p.y == q.y, p.z == q.z}; }
  static bool any(const bvec3& p) { return p.x || p.y || p.z; }
  static vec3 mix(const vec3& p, const vec3& q, const bvec3& takes_q) {
    return {takes_q.x ? q.x : p.x, takes_q.y ? q.y : p.y, takes_q.z ? q.z : p.z};
  }
  static uint floatBitsToUint(real x) { return std::bit_cast<uint>(x.value()); }
  static real uintBitsToFloat(uint bits) { return real::of(std::bit_cast<float>(bits)); }
  static vec3 uintBitsToFloat(const uvec3& bits) {
    return {uintBitsToFloat(bits.x), uintBitsToFloat(bits.y), uintBitsToFloat(bits.z)};
  }

#define precise
#define OUT(type) type&
#define SCENE
#define yzx turned()
#define zxy turned_back()
#include "gpu/hit_rounding.glsl"
#include "gpu/pair_kernel.glsl"
#include "gpu/placed_path.glsl"
#include "gpu/placed_rounding.glsl"
// The next ones need what is above.
#include "gpu/path_kernel.glsl"
#include "gpu/wide_int.glsl"
// So does the last one.
#include "gpu/exact_pair.glsl"
#undef precise
#undef OUT
#undef SCENE
#undef yzx
#undef zxy
};

}  // namespace surehit::test
