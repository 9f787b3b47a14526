#include "exact/placed_point.hpp"

#include <cstddef>
#include <limits>

#include "exact/exact_scale.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The numbers of bits of the terms of a placed point. Let the coordinates be below 2^max, and let the smallest
/// denormal be 2^min. A weight is at most 1, and so is t, so they have the bits of a share.
template <typename Scalar>
struct PlacedPointBits {
  static constexpr int share = 1 - Decomposed<Scalar>::min_exponent;
  static constexpr int entry = 128 + std::numeric_limits<Scalar>::digits;
  /// a + u (b - a) + v (c - a) is below 5 · 2^max, in units of at least 2^(2 min).
  static constexpr int local = share + AnySize<Scalar>::coordinate + 2;
  /// An entry is at most 2^64, and a whole number of 2^(-63 - digits). So three products, the translation and the
  /// motion have a sum below 2^(max + 68), in units of at least 2^(2 min - 63 - digits).
  static constexpr int point = entry + local;
};

/// Sets x to a + u (b - a) + v (c - a) on one axis, in units of a corner and a weight.
template <typename Scalar>
SUREHIT_NOINLINE void set_weighted(WideInt<PlacedPointBits<Scalar>::local>& x, const Triangle<Scalar>& local,
                                   Eigen::Index axis, Scalar u, Scalar v, const BinaryUnit& corners,
                                   const BinaryUnit& weights) {
  using Factor = PlacedFactor<WideInt<PlacedPointBits<Scalar>::local>, Scalar>;
  const auto add = [&](Scalar weight, Scalar to, Scalar from) {
    add_product(x, Factor::share(weight, weights), Factor::coordinate(to, from, corners), 0, false);
  };
  const Scalar a = local.a[axis];
  add(1, a, 0);
  add(u, local.b[axis], a);
  add(v, local.c[axis], a);
}

}  // namespace

template <typename Scalar>
Vector3<Scalar> exact_placed_point(const PlacedTriangle<Scalar>& triangle, Scalar t, Scalar u, Scalar v) {
  using Bits = PlacedPointBits<Scalar>;
  using Int = WideInt<Bits::point>;
  using Factor = PlacedFactor<Int, Scalar>;
  const auto& [pose, motion, moves] = triangle.placement;
  const PlacedUnits<Scalar> units(triangle);
  BinaryUnit weights;
  weights.include<Scalar>({u, v, 1});
  BinaryUnit local;
  local.include_products(units.corners, weights, 1);
  BinaryUnit time;
  time.include<Scalar>({t, 0, 0});
  BinaryUnit unit;
  unit.include(pose.translation);
  unit.include_products(units.linear, local, 1);
  unit.include_products(units.motion, time, 1);

  IntVector<Int> point;
  for (std::size_t i = 0; i < 3; ++i) set_integer(point[i], pose.translation[static_cast<Eigen::Index>(i)], unit);
  if (!local.is_empty()) {
    const int exponent = units.linear.exponent + local.exponent - unit.exponent;
    for (Eigen::Index column = 0; column < 3; ++column) {
      WideInt<Bits::local> x;
      set_weighted(x, triangle.local, column, u, v, units.corners, weights);
      for (std::size_t row = 0; row < 3; ++row) {
        const Scalar entry = pose.linear(static_cast<Eigen::Index>(row), column);
        if (entry != 0) add_product(point[row], Factor::entry(entry, units.linear), x, exponent, false);
      }
    }
  }
  if (moves && t != 0) {
    const int exponent = units.motion.exponent + time.exponent - unit.exponent;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto way = Factor::coordinate(motion[static_cast<Eigen::Index>(i)], 0, units.motion);
      add_product(point[i], Factor::share(t, time), way, exponent, false);
    }
  }
  const auto one = WideInt<1>::power_of_two(0);
  return {rounded_quotient<Scalar>(point[0], one, unit.exponent),
          rounded_quotient<Scalar>(point[1], one, unit.exponent),
          rounded_quotient<Scalar>(point[2], one, unit.exponent)};
}

template Vector3<float> exact_placed_point(const PlacedTriangle<float>&, float, float, float);
template Vector3<double> exact_placed_point(const PlacedTriangle<double>&, double, double, double);

}  // namespace surehit::detail
