// Clips many paths from far away side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_FAR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_FAR_LANES_INL
#undef SUREHIT_FAR_LANES_INL
#else
#define SUREHIT_FAR_LANES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/grid_frame.hpp"
#include "grid/main_grid.hpp"
#include "support/lane_bits-inl.hpp"
#include "walk/grid_traversal.hpp"
#include "walk/walking_paths-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Paths, one in each lane, with the ranges that count.
template <typename AnyTag>
struct PathVectors {
  using Tag = AnyTag;
  using Numbers = hn::Vec<Tag>;

  Numbers start[3];   ///< The starts.
  Numbers toward[3];  ///< The ends or directions.
  Numbers first_t;    ///< The begins of the ranges.
  Numbers last_t;     ///< The ends of the ranges.
  bool is_segment;    ///< True if all paths are segments.

  /// Returns the computed directions on an axis.
  [[nodiscard]] HWY_INLINE Numbers way(std::size_t axis) const {
    return is_segment ? hn::Sub(toward[axis], start[axis]) : toward[axis];
  }
};

/// Paths of floats.
struct PathLanes : PathVectors<FloatTag> {
  /// Loads paths of six floats, which must be readable for all lanes. An end of the range is one float for all paths,
  /// or a vector.
  template <typename Ends>
  HWY_INLINE PathLanes(const float* paths, bool are_segments, Ends first, Ends last) {
    const FloatTag d;
    first_t = in_all_lanes(first);
    last_t = in_all_lanes(last);
    is_segment = are_segments;
    // In each half, starts and ends alternate.
    Floats near_half[3];
    Floats far_half[3];
    hn::LoadInterleaved3(d, paths, near_half[0], near_half[1], near_half[2]);
    hn::LoadInterleaved3(d, paths + 3 * hn::Lanes(d), far_half[0], far_half[1], far_half[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      start[k] = hn::ConcatEven(d, far_half[k], near_half[k]);
      toward[k] = hn::ConcatOdd(d, far_half[k], near_half[k]);
    }
  }
};

/// Paths of doubles.
struct DoublePathLanes : PathVectors<hn::CappedTag<double, 8>> {
  /// Loads paths of `LaneClip::DoublePaths` from lane `from` on.
  template <typename DoublePaths>
  HWY_INLINE DoublePathLanes(const DoublePaths& paths, bool are_segments, std::size_t from) {
    const Tag d;
    first_t = hn::LoadU(d, &paths.first_t[from]);
    last_t = hn::LoadU(d, &paths.last_t[from]);
    is_segment = are_segments;
    for (std::size_t k = 0; k < 3; ++k) {
      start[k] = hn::LoadU(d, &paths.start[k][from]);
      toward[k] = hn::LoadU(d, &paths.toward[k][from]);
    }
  }
};

/// Returns x + |x| share, rounded. It is infinite if x is.
template <typename Tag>
HWY_INLINE hn::Vec<Tag> scaled(Tag d, hn::Vec<Tag> x, float share) {
  const auto is_positive = hn::Gt(x, hn::Zero(d));
  const auto factor = [&](float y) { return hn::Set(d, hn::TFromD<Tag>{y}); };
  return hn::Mul(x, hn::IfThenElse(is_positive, factor(1 + share), factor(1 - share)));
}

/// The parts of paths that may be in a box whose corners are floats (L17). `Paths` is `PathLanes` or `DoublePathLanes`.
template <typename Paths>
struct BoxLanes {
  using Tag = typename Paths::Tag;
  using Numbers = hn::Vec<Tag>;

  Numbers enters;        ///< Where each part begins, as computed. It is not before the range.
  Numbers leaves;        ///< Where it ends.
  hn::Mask<Tag> misses;  ///< The paths that miss the box.

  HWY_INLINE BoxLanes(const Paths& paths, const Float4& low, const Float4& high)
      : enters(paths.first_t), leaves(paths.last_t), misses(hn::Gt(paths.first_t, paths.last_t)) {
    const Tag d;
    const auto number = [&](float x) { return hn::Set(d, hn::TFromD<Tag>{x}); };
    const Numbers infinity = hn::Inf(d);
    for (std::size_t k = 0; k < 3; ++k) {
      const Numbers way = paths.way(k);
      const Numbers to_low = hn::Sub(number(low[k]), paths.start[k]);
      const Numbers to_high = hn::Sub(number(high[k]), paths.start[k]);
      const auto is_beside = hn::Or(hn::Gt(to_low, hn::Zero(d)), hn::Lt(to_high, hn::Zero(d)));
      misses = hn::Or(misses, hn::And(hn::Eq(way, hn::Zero(d)), is_beside));
      const Numbers size = hn::Abs(way);
      const auto is_usual = hn::And(hn::Ge(size, number(min_way)), hn::Le(size, number(max_way)));
      const Numbers max_distance = hn::Max(hn::Abs(to_low), hn::Abs(to_high));
      const auto counts = hn::And(is_usual, hn::Lt(max_distance, infinity));
      const Numbers inverse = hn::Div(number(1), way);
      const Numbers at_low = hn::Mul(to_low, inverse);
      const Numbers at_high = hn::Mul(to_high, inverse);
      enters = hn::Max(enters, hn::IfThenElse(counts, hn::Min(at_low, at_high), hn::Neg(infinity)));
      leaves = hn::Min(leaves, hn::IfThenElse(counts, hn::Max(at_low, at_high), infinity));
    }
    const Numbers first = scaled(d, enters, -slack);
    const Numbers last = hn::Add(scaled(d, leaves, slack), number(std::numeric_limits<float>::min()));
    misses = hn::Or(misses, hn::Gt(first, last));
  }

 private:
  // An axis does not count whose differences overflow.
  static constexpr float min_way = 0x1p-100F;  ///< An axis with less motion does not count, but for none at all.
  static constexpr float max_way = 0x1p100F;   ///< Nor does an axis with more motion.
  static constexpr float slack = 0x1p-20F;     ///< The share of itself by which each end is moved outward.
};

/// Returns the lanes whose path may meet what is not in the main grid (L18).
template <typename Paths>
HWY_INLINE std::uint32_t lanes_beside(const MainGrid& main, const Paths& paths) {
  const typename Paths::Tag d;
  std::uint32_t lanes = 0;
  for (const MainGrid::OtherBox& box : main.boxes()) {
    lanes |= static_cast<std::uint32_t>(bits_of(d, hn::Not(BoxLanes(paths, box.low, box.high).misses)));
  }
  return lanes;
}

/// Clips paths of floats that do not begin near a frame, one in each lane. Their starts are moved along them to points
/// near the frame, in double, so that the rest can be done in float (L16). What looks at triangles may begin there too.
/// `FarClip` does the same for a single path.
class alignas(max_lanes * sizeof(double)) FarLanes {
 public:
  std::array<double, max_lanes> moved_t;  ///< The t by which each start is moved.
  LaneFloats enters_rest;                 ///< What `WalkingPaths::enters` leaves out of the t where tau is 0.
  /// The lanes whose path meets no triangle of the frame where its range begins or before. The same holds for the end
  /// of the range, except for the lanes of `ends`.
  std::uint32_t free = 0;
  std::uint32_t ends = 0;  ///< The lanes whose path is a segment that counts up to its end. It is moved there.

  /// Clips the paths of some lanes, which `LaneClip::clip` has left apart. `has_floats` of the frame must be true. The
  /// lanes of `free` begin at the moved start in `kernel_paths`. A path is apart again if it is too far away, or too
  /// slow or too fast.
  template <typename Clipped, typename KernelPaths>
  HWY_INLINE Clipped clip(const GridFrame& frame, const PathLanes& paths, std::uint32_t lanes, WalkingPaths& clipped,
                          KernelPaths& kernel_paths) {
    const FloatTag d;
    const BitsTag du;
    free = ends = 0;
    const BoxLanes box(paths, frame.float_box_low, frame.float_box_high);
    const auto may_meet = hn::AndNot(box.misses, mask_of(d, lanes));
    if (hn::AllFalse(d, may_meet)) return {0, 0};
    move(frame, paths, box);
    const Words octant = hn::Load(du, clipped.octant.data());
    Floats from[3];
    Floats fastest = hn::Zero(d);
    Floats enters_grid = hn::Neg(hn::Inf(d));
    Floats leaves_grid = hn::Inf(d);
    auto is_known = hn::Eq(fastest, fastest);
    for (std::size_t k = 0; k < 3; ++k) {
      const Floats stop = hn::Set(d, frame.float_stop[k]);
      const Floats far = hn::MulAdd(hn::Sub(paths.start[k], hn::Set(d, frame.float_low[k])),
                                    hn::Set(d, frame.float_scale[k]), hn::Set(d, frame.margin[k]));
      const Floats rate = hn::Load(d, clipped.rate[k].data());
      const Floats inverse = hn::Load(d, clipped.inverse_rate[k].data());
      const Floats at = hn::Load(d, position_[k].data());
      is_known = hn::And(is_known, hn::Le(hn::Abs(far), hn::Mul(hn::Set(d, max_widths), stop)));
      is_known = hn::And(is_known, hn::Le(rate, hn::Set(d, max_rate)));
      is_known = hn::And(is_known, hn::And(hn::Ge(at, hn::Neg(stop)), hn::Le(at, hn::Add(stop, stop))));
      fastest = hn::Max(fastest, rate);
      const auto is_mirrored = hn::Ne(hn::And(octant, hn::Set(du, std::uint32_t{1} << k)), hn::Zero(du));
      from[k] = hn::IfThenElse(hn::RebindMask(d, is_mirrored), hn::Sub(stop, at), at);
      enters_grid = hn::Max(enters_grid, hn::Mul(hn::Neg(from[k]), inverse));
      leaves_grid = hn::Min(leaves_grid, hn::Mul(hn::Sub(stop, from[k]), inverse));
    }
    if (!paths.is_segment) is_known = hn::And(is_known, hn::Ge(fastest, hn::Set(d, ClippedPath::slow)));
    // From here on, the parameter is t - moved_t. Both ends of the range were rounded outward.
    const Floats first = hn::Load(d, first_.data());
    const Floats last = hn::Load(d, last_.data());
    const Floats enters = hn::Max(enters_grid, first);
    const Floats leaves = hn::Min(leaves_grid, last);
    const auto inside = hn::And(hn::And(may_meet, is_known), hn::Le(enters, leaves));
    const auto enters_later = hn::Le(scaled(d, first, inward), scaled(d, enters_grid, -inward));
    const auto leaves_before = hn::Le(scaled(d, leaves_grid, inward), scaled(d, last, -inward));
    const auto is_end = mask_of(d, ends);
    const auto is_free = hn::And(inside, hn::And(enters_later, hn::Or(is_end, leaves_before)));
    for (std::size_t k = 0; k < 3; ++k) {
      const Floats highest = hn::Set(d, frame.float_stop[k] * (1 - 0x1p-24F));
      const Floats rate = hn::Load(d, clipped.rate[k].data());
      const Floats entered = hn::Min(hn::Max(hn::MulAdd(enters, rate, from[k]), hn::Zero(d)), highest);
      store_where(inside, entered, d, clipped.start[k].data());
      store_where(inside, hn::Floor(entered), d, clipped.finest[k].data());
    }
    set_parameters(paths, enters, inside, clipped);
    free = static_cast<std::uint32_t>(bits_of(d, is_free));
    if (free != 0) kernel_paths.move_starts(frame, point_, is_end, is_free);
    ends &= free;
    return {static_cast<std::uint32_t>(bits_of(d, inside)),
            static_cast<std::uint32_t>(bits_of(d, hn::AndNot(is_known, may_meet)))};
  }

 private:
  using DoubleTag = hn::CappedTag<double, 8>;
  using Doubles = hn::Vec<DoubleTag>;
  using HalfTag = hn::Rebind<float, DoubleTag>;  ///< As many floats as a vector has doubles.

  static constexpr float max_widths = 0x1p20F;
  static constexpr float max_rate = 0x1p60F;
  static constexpr float inward = 0x1p-21F;

  /// Moves the starts, and counts the ranges from there. Sets `ends`.
  HWY_INLINE void move(const GridFrame& frame, const PathLanes& paths, const BoxLanes<PathLanes>& box) {
    const DoubleTag d;
    const HalfTag df;
    alignas(max_lanes * sizeof(float)) std::array<LaneFloats, 3> start;
    alignas(max_lanes * sizeof(float)) std::array<LaneFloats, 3> toward;
    alignas(max_lanes * sizeof(float)) std::array<LaneFloats, 4> ts;
    for (std::size_t k = 0; k < 3; ++k) {
      hn::Store(paths.start[k], FloatTag(), start[k].data());
      hn::Store(paths.toward[k], FloatTag(), toward[k].data());
    }
    const Floats all[4] = {box.enters, box.leaves, paths.first_t, paths.last_t};
    for (std::size_t i = 0; i < 4; ++i) hn::Store(all[i], FloatTag(), ts[i].data());
    const auto number = [&](double x) { return hn::Set(d, x); };
    for (std::size_t part = 0; part < hn::Lanes(FloatTag()); part += hn::Lanes(d)) {
      const auto doubles = [&](const LaneFloats& of) { return hn::PromoteTo(d, hn::Load(df, &of[part])); };
      const auto position_of = [&](std::size_t k, Doubles from_low) {
        return hn::MulAdd(from_low, number(double{frame.float_scale[k]}), number(double{frame.margin[k]}));
      };
      const Doubles last_t = doubles(ts[3]);
      // No branch depends on where a path ends, because a processor could not predict it.
      auto is_end = hn::Eq(last_t, number(1));
      if (!paths.is_segment) is_end = hn::Ne(last_t, last_t);
      Doubles to_end[3];
      for (std::size_t k = 0; k < 3; ++k) {
        to_end[k] = hn::Sub(doubles(toward[k]), number(double{frame.float_low[k]}));
        const Doubles end = position_of(k, to_end[k]);
        const double stop = double{frame.float_stop[k]};
        is_end = hn::And(is_end, hn::And(hn::Ge(end, number(-stop)), hn::Le(end, number(2 * stop))));
      }
      const Doubles middle = hn::Mul(number(0.5), hn::Add(doubles(ts[0]), doubles(ts[1])));
      const Doubles t = hn::IfThenElse(is_end, number(1), middle);
      for (std::size_t k = 0; k < 3; ++k) {
        const Doubles from = doubles(start[k]);
        const Doubles ahead = doubles(toward[k]);
        const Doubles low = number(double{frame.float_low[k]});
        const Doubles way = paths.is_segment ? hn::Sub(ahead, from) : ahead;
        const Doubles to_point = hn::IfThenElse(is_end, to_end[k], hn::MulAdd(t, way, hn::Sub(from, low)));
        const Doubles point = hn::IfThenElse(is_end, ahead, hn::Add(low, to_point));
        hn::Store(hn::DemoteTo(df, point), df, &point_[k][part]);
        hn::Store(hn::DemoteTo(df, position_of(k, to_point)), df, &position_[k][part]);
      }
      const Doubles first = hn::Sub(doubles(ts[2]), t);
      const Doubles last = hn::Sub(last_t, t);
      const auto outward = [&](Doubles x) { return hn::Mul(hn::Abs(x), number(0x1p-23)); };
      hn::Store(hn::DemoteTo(df, hn::Sub(first, outward(first))), df, &first_[part]);
      hn::Store(hn::DemoteTo(df, hn::Add(last, outward(last))), df, &last_[part]);
      hn::Store(t, d, &moved_t[part]);
      ends |= static_cast<std::uint32_t>(bits_of(d, is_end)) << part;
    }
  }

  /// Sets the parameters of the walks of some lanes. `enters` is t - moved_t where tau is 0.
  HWY_INLINE void set_parameters(const PathLanes& paths, Floats enters, hn::Mask<FloatTag> lanes,
                                 WalkingPaths& clipped) {
    const DoubleTag d;
    const HalfTag df;
    alignas(max_lanes * sizeof(float)) LaneFloats entered;
    alignas(max_lanes * sizeof(float)) LaneFloats last;
    alignas(max_lanes * sizeof(float)) LaneFloats rest;
    alignas(max_lanes * sizeof(float)) LaneFloats end;
    hn::Store(enters, FloatTag(), entered.data());
    hn::Store(paths.last_t, FloatTag(), last.data());
    for (std::size_t part = 0; part < hn::Lanes(FloatTag()); part += hn::Lanes(d)) {
      const auto doubles = [&](const LaneFloats& of) { return hn::PromoteTo(d, hn::Load(df, &of[part])); };
      const Doubles origin = hn::Add(hn::Load(d, &moved_t[part]), doubles(entered));
      const auto nearest = hn::DemoteTo(df, origin);
      hn::Store(nearest, df, &entered[part]);
      hn::Store(hn::DemoteTo(df, hn::Sub(origin, hn::PromoteTo(d, nearest))), df, &rest[part]);
      // As `ClippedPath::beyond` (L12).
      const Doubles last_t = doubles(last);
      const Doubles exact = hn::Sub(last_t, origin);
      const Doubles sizes = hn::Mul(hn::Add(hn::Abs(last_t), hn::Abs(origin)), hn::Set(d, 0x1p-50));
      const Doubles rounding =
          hn::Add(hn::Add(sizes, hn::Mul(hn::Abs(exact), hn::Set(d, 0x1p-22))), hn::Set(d, 0x1p-140));
      hn::Store(hn::DemoteTo(df, hn::Add(exact, rounding)), df, &end[part]);
    }
    const FloatTag all;
    // Highway's emulated vectors make infinity the largest finite float when they demote it.
    const auto is_endless = hn::Eq(paths.last_t, hn::Inf(all));
    const Floats ends_at = hn::IfThenElse(is_endless, hn::Inf(all), hn::Load(all, end.data()));
    store_where(lanes, ends_at, all, clipped.end.data());
    store_where(lanes, hn::Load(all, entered.data()), all, clipped.enters.data());
    hn::Store(hn::IfThenElseZero(lanes, hn::Load(all, rest.data())), all, enters_rest.data());
  }

  alignas(max_lanes *
          sizeof(float)) std::array<LaneFloats, 3> position_;  ///< The positions of the moved starts in the frame.
  std::array<LaneFloats, 3> point_;                            ///< The moved starts, in mesh units.
  LaneFloats first_;                                           ///< The begins of the ranges, less `moved_t`.
  LaneFloats last_;                                            ///< The ends of the ranges, less `moved_t`.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
