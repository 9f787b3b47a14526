// Rounds hits of placed paths. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PLACED_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PLACED_ROUNDING_INL
#undef SUREHIT_PLACED_ROUNDING_INL
#else
#define SUREHIT_PLACED_ROUNDING_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "filter/double_kernel-inl.hpp"
#include "scene/placed_path.hpp"
#include "support/lane_bits-inl.hpp"
#include "surehit/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Hits of placed paths in the frames of their meshes, one in each lane. The kernel is certain of each.
template <class D>
class PlacedHits {
 public:
  static constexpr std::size_t max_lanes = hn::MaxLanes(D());

  /// The rounded hits. They are floats.
  struct Rounded {
    std::array<float, max_lanes> t, u, v;  ///< The rounded numbers.
    std::uint64_t rounded;                 ///< The mask of the lanes in which they are right.
    std::uint64_t positive;                ///< The mask of the lanes whose determinant is positive.
  };

  /// Sets the hit of a lane.
  template <typename Scalar>
  HWY_INLINE void set(std::size_t lane, const CertainPath& path, const Triangle<Scalar>& triangle) {
    std::size_t row = 0;
    const auto add = [&](double x) { numbers_[row++][lane] = x; };
    for (const double number : path.start) add(number);
    for (const double number : path.direction) add(number);
    for (const auto* const corner : {&triangle.a, &triangle.b, &triangle.c}) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) add(double{(*corner)[axis]});
    }
    add(path.start_error);
    add(path.direction_error);
    add(path.moved_t);
  }

  /// Rounds all hits, as `placed_contact` and `try_round` do for one (I15).
  HWY_INLINE Rounded round() const {
    const D d;
    const hn::Rebind<float, D> df;
    constexpr double eps = 0x1p-53;
    std::size_t row = 0;
    const auto next = [&] { return hn::LoadU(d, numbers_[row++].data()); };
    const auto next_vector = [&]() -> Vectors<D> {
      const auto x = next();
      const auto y = next();
      return {x, y, next()};
    };
    const Vectors<D> start = next_vector();
    const Vectors<D> direction = next_vector();
    const Vectors<D> a = next_vector();
    const Vectors<D> b = next_vector();
    const Vectors<D> c = next_vector();
    const auto start_slack = hn::Mul(next(), hn::Set(d, 1 / (8 * eps)));  // I8
    const auto direction_slack = hn::Mul(next(), hn::Set(d, 1 / (8 * eps)));
    const auto moved_t = next();
    const DoubleDeterminants<D> of(d, start, direction, a, b, c, PathSlack<D>{start_slack, direction_slack});
    const auto det_radius = of.radius(of.det_size);
    const auto by_det = Quotients<D>::by(d, of.det, det_radius);
    auto is_right = hn::Gt(hn::Abs(of.det), det_radius);
    Rounded result;
    const auto round = [&](auto lower, auto upper, std::array<float, max_lanes>& to) {
      // Highway's emulated vectors make infinity the largest finite float.
      is_right = hn::And(is_right, hn::Le(hn::Abs(upper), hn::Set(d, 0x1p127)));
      const auto number = hn::Add(hn::DemoteTo(df, upper), hn::Zero(df));  // This turns -0 into +0.
      is_right = hn::And(
          is_right, hn::RebindMask(d, hn::Eq(hn::PromoteTo(d, hn::DemoteTo(df, lower)), hn::PromoteTo(d, number))));
      hn::StoreU(number, df, to.data());
    };
    const auto t = by_det.of(of.height, of.radius(of.height_size));
    const auto rounding = [&](auto x) { return hn::Mul(hn::Add(hn::Abs(x), hn::Abs(moved_t)), hn::Set(d, 0x1p-51)); };
    round(hn::Sub(hn::Add(t.lower, moved_t), rounding(t.lower)), hn::Add(hn::Add(t.upper, moved_t), rounding(t.upper)),
          result.t);
    const auto u = by_det.of(of.u, of.radius(of.u_size));
    round(u.lower, u.upper, result.u);
    const auto v = by_det.of(of.v, of.radius(of.v_size));
    round(v.lower, v.upper, result.v);
    result.rounded = bits_of(d, is_right);
    result.positive = bits_of(d, hn::Gt(of.det, hn::Zero(d)));
    return result;
  }

 private:
  static constexpr std::size_t rows = 18;  ///< The number of numbers of a hit.

  alignas(64) std::array<std::array<double, max_lanes>, rows> numbers_ = {};
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
