#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "collision/rational_determinants.hpp"
#include "device_path.hpp"

namespace surehit::test {

struct DeviceBox {
  Vector3f low, high;
};

/// When an exact path is in a box and in its range.
struct Stay {
  mpq_class in;       ///< It comes there then,
  mpq_class out;      ///< and leaves then. If this is before, it never comes there.
  mpq_class fast_in;  ///< The same by the axes on which the path is fast enough to be cut (G6).
  mpq_class fast_out;
  mpq_class outside;  ///< How far outside of the box it remains on the others.
};

inline Stay stay_of(const RationalVector& start, const RationalVector& way, const DeviceBox& box,
                    const detail::PathRange<float>& range) {
  const mpq_class first(std::max(double{range.first}, -0x1p400));
  const mpq_class last(std::min(double{range.last}, 0x1p400));
  Stay stay{first, last, first, last, 0};
  const RationalVector low = rational(box.low);
  const RationalVector high = rational(box.high);
  const auto cut = [](mpq_class& in, mpq_class& out, const mpq_class& t, const mpq_class& other) {
    in = std::max(in, std::min(t, other));
    out = std::min(out, std::max(t, other));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class to_low = low[i] - start[i];
    const mpq_class to_high = high[i] - start[i];
    const bool is_fast = abs(way[i]) >= mpq_class(0x1p-60);
    if (!is_fast) {
      const mpq_class one = way[i] * first;
      const mpq_class other = way[i] * last;
      stay.outside =
          std::max({stay.outside, mpq_class(to_low - std::max(one, other)), mpq_class(std::min(one, other) - to_high)});
    }
    if (way[i] == 0) continue;
    cut(stay.in, stay.out, to_low / way[i], to_high / way[i]);
    if (is_fast) cut(stay.fast_in, stay.fast_out, to_low / way[i], to_high / way[i]);
  }
  return stay;
}

inline bool is_met(const Stay& stay) { return stay.in <= stay.out && stay.outside <= 0; }

/// Returns where a device enters a box, or nothing if it passes over it.
inline std::optional<mpq_class> entered(DeviceArithmetic& device, const DeviceBox& box) {
  DeviceFloat enters;
  if (device.misses_box(device_vector(box.low), device_vector(box.high), enters)) return std::nullopt;
  return rational(enters);
}

}  // namespace surehit::test
