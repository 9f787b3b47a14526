// Clips many paths side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_LANE_CLIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_LANE_CLIP_INL
#undef SUREHIT_LANE_CLIP_INL
#else
#define SUREHIT_LANE_CLIP_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/grid_frame.hpp"
#include "support/lane_bits-inl.hpp"
#include "surehit/path.hpp"
#include "walk/grid_traversal.hpp"
#include "walk/walking_paths-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Clips paths to a frame of a grid, one in each lane.
class LaneClip {
 public:
  /// The frame must outlive this.
  explicit LaneClip(const GridFrame& frame) : frame_(frame) {}

  /// The result of `clip`, with a bit for each lane. A path that is in neither mask misses the grid.
  struct Clipped {
    std::uint32_t inside;  ///< These paths can walk.
    std::uint32_t apart;   ///< These paths must be clipped by `ClippedPath`.
  };

  /// Clips `count` paths in float, one in each lane. `GridFrame::has_floats` must be true. A path has six floats: its
  /// start, and its end or direction. `paths` must be readable for all lanes, even if `count` is lower. `first_t` and
  /// `last_t` are the ends of the range: one float for all paths, or a vector.
  ///
  /// A path is `apart` if its start is not within one width of the grid, or if it is too slow or too fast. L8 in
  /// WALK.md bounds the error of the others. `kernel_paths` are set too, because they need the same numbers.
  template <typename Ends, typename KernelPaths>
  HWY_INLINE Clipped clip(const float* paths, bool is_segment, Ends first_t, Ends last_t, std::size_t count,
                          WalkingPaths& clipped, KernelPaths& kernel_paths) const {
    const FloatTag d;
    const BitsTag du;
    // In each half, starts and ends alternate.
    Floats near_half[3];
    Floats far_half[3];
    hn::LoadInterleaved3(d, paths, near_half[0], near_half[1], near_half[2]);
    hn::LoadInterleaved3(d, paths + 3 * hn::Lanes(d), far_half[0], far_half[1], far_half[2]);
    const Floats zero = hn::Zero(d);
    Floats enters = in_all_lanes(first_t);
    Floats leaves = in_all_lanes(last_t);
    Floats fastest = zero;
    Floats start_size = zero;
    Floats way_size = zero;
    Floats reach = zero;
    Floats first_cell = hn::Set(d, static_cast<float>(frame_.first_top));
    Words octant = hn::Zero(du);
    Floats from[3];
    Floats by[3];
    auto is_near = hn::Eq(zero, zero);
    for (std::size_t k = 0; k < 3; ++k) {
      const Floats scale = hn::Set(d, frame_.float_scale[k]);
      const Floats stop = hn::Set(d, frame_.float_stop[k]);
      const Floats start = hn::ConcatEven(d, far_half[k], near_half[k]);
      const Floats toward = hn::ConcatOdd(d, far_half[k], near_half[k]);
      const Floats way = is_segment ? hn::Sub(toward, start) : toward;
      const Floats move = hn::Mul(way, scale);
      const Floats position =
          hn::MulAdd(hn::Sub(start, hn::Set(d, frame_.float_low[k])), scale, hn::Set(d, frame_.margin[k]));
      is_near = hn::And(is_near, hn::And(hn::Ge(position, hn::Neg(stop)), hn::Le(position, hn::Add(stop, stop))));
      kernel_paths.set_axis(k, start, way);
      start_size = hn::Max(start_size, hn::Abs(start));
      way_size = hn::Max(way_size, hn::Abs(way));
      const Floats from_low = hn::Sub(start, hn::Set(d, frame_.float_box_low[k]));
      const Floats from_high = hn::Sub(start, hn::Set(d, frame_.float_box_high[k]));
      Floats reach_here = hn::Max(hn::Abs(from_low), hn::Abs(from_high));
      if (is_segment) reach_here = hn::Min(reach_here, hn::Add(hn::Abs(way), hn::Set(d, frame_.float_cell_size[k])));
      reach = hn::Max(reach, reach_here);
      const auto is_mirrored = hn::Lt(move, zero);
      from[k] = hn::IfThenElse(is_mirrored, hn::Sub(stop, position), position);
      const Floats speed = hn::Abs(move);
      is_near = hn::And(is_near, hn::Le(speed, hn::Set(d, ClippedPath::fast)));
      fastest = hn::Max(fastest, speed);
      // A path that does not move on the axis crosses no plane (L1, L11).
      const auto is_still = hn::Lt(speed, hn::Set(d, ClippedPath::min_rate));
      by[k] = hn::IfThenElse(is_still, zero, speed);
      const Floats inverse =
          hn::IfThenElse(is_still, hn::Set(d, ClippedPath::max_inverse), hn::Div(hn::Set(d, 1.0F), speed));
      enters = hn::Max(enters, hn::Mul(hn::Neg(from[k]), inverse));
      leaves = hn::Min(leaves, hn::Mul(hn::Sub(stop, from[k]), inverse));
      const Floats pitch = hn::Set(d, static_cast<float>(frame_.top_orders[0].pitch[k]));
      const Floats turned = hn::Set(d, static_cast<float>(mirrored_first(k)));
      hn::Store(hn::IfThenElse(is_mirrored, hn::Neg(pitch), pitch), d, clipped.pitch[k].data());
      hn::Store(inverse, d, clipped.inverse_rate[k].data());
      hn::Store(by[k], d, clipped.rate[k].data());
      first_cell = hn::IfThenElse(is_mirrored, hn::Add(first_cell, turned), first_cell);
      octant = hn::Or(octant, hn::IfThenElseZero(hn::RebindMask(du, is_mirrored), hn::Set(du, 1U << k)));
    }
    kernel_paths.set_sizes(start_size, way_size, reach);
    auto is_plain = is_near;
    if (!is_segment) is_plain = hn::And(is_plain, hn::Ge(fastest, hn::Set(d, ClippedPath::slow)));
    const auto taken = hn::FirstN(d, count);
    const auto inside = hn::And(hn::And(is_plain, taken), hn::Le(enters, leaves));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats last = hn::Set(d, frame_.float_stop[axis] * (1 - 0x1p-24F));
      // The position is in the grid for every lane. A path that is not clipped may make it NaN. Then `Max` returns its
      // second operand on x86, which is zero.
      const Floats entered = hn::Min(hn::Max(hn::MulAdd(enters, by[axis], from[axis]), zero), last);
      hn::Store(entered, d, clipped.start[axis].data());
      hn::Store(hn::Floor(entered), d, clipped.finest[axis].data());
    }
    const Floats last = in_all_lanes(last_t);
    const Floats rounding = hn::MulAdd(hn::Add(hn::Abs(last), hn::Abs(enters)), hn::Set(d, 0x1p-22F),
                                       hn::Set(d, std::numeric_limits<float>::min()));
    hn::Store(hn::Add(hn::Sub(last, enters), rounding), d, clipped.end.data());
    hn::Store(enters, d, clipped.enters.data());
    hn::Store(first_cell, d, clipped.first_cell.data());
    hn::Store(octant, du, clipped.octant.data());
    return {static_cast<std::uint32_t>(bits_of(d, inside)),
            static_cast<std::uint32_t>(bits_of(d, hn::AndNot(is_plain, taken)))};
  }

  /// Paths in double, one in each lane, with the ranges that count.
  struct alignas(max_lanes * sizeof(double)) DoublePaths {
    std::array<std::array<double, max_lanes>, 3> start;   ///< The starts.
    std::array<std::array<double, max_lanes>, 3> toward;  ///< The ends or directions.
    std::array<double, max_lanes> first_t;                ///< The begins of the ranges.
    std::array<double, max_lanes> last_t;                 ///< The ends of the ranges.
  };

  /// Clips the paths of some lanes in double. `paths` must be set in all lanes. It sets `enters` to the t where
  /// tau is 0. It takes the steps that `ClippedPath::clip_in_double` takes for paths that are not scaled (L9), so both
  /// have the same numbers. A path that must be scaled, or is not finite, is `apart`.
  HWY_NOINLINE Clipped clip_in_double(const DoublePaths& paths, PathKind kind, std::uint32_t lanes,
                                      WalkingPaths& clipped, std::array<double, max_lanes>& enters) const {
    const std::size_t part = hn::Lanes(DoubleTag());
    Clipped result = {0, 0};
    for (std::size_t from = 0; lanes >> from != 0; from += part) {
      const Clipped some = clip_part_in_double(paths, kind, from, lanes >> from, clipped, enters);
      result.inside |= some.inside << from;
      result.apart |= some.apart << from;
    }
    return result;
  }

 private:
  using DoubleTag = hn::CappedTag<double, 8>;

  /// Does what `clip_in_double` does for the lanes of one vector of doubles. The first one is lane `from`.
  HWY_INLINE Clipped clip_part_in_double(const DoublePaths& paths, PathKind kind, std::size_t from, std::uint32_t lanes,
                                         WalkingPaths& clipped, std::array<double, max_lanes>& enters_at) const {
    const DoubleTag d;
    const hn::Rebind<float, DoubleTag> df;
    const std::uint32_t some = lanes & static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(d)) - 1);
    using Doubles = hn::Vec<DoubleTag>;
    const auto number = [&](double x) { return hn::Set(d, x); };
    const Doubles zero = hn::Zero(d);
    const auto taken = mask_of(df, some);
    const auto keep_floats = [&](LaneFloats& of, hn::Vec<decltype(df)> x) { store_where(taken, x, df, &of[from]); };
    const auto keep = [&](LaneFloats& of, Doubles x) { keep_floats(of, hn::DemoteTo(df, x)); };
    const auto keep_end = [&](LaneFloats& of, Doubles x) {
      // Highway's emulated vectors make infinity the largest finite float.
      const auto is_infinite = hn::DemoteTo(df, hn::IfThenElse(hn::Eq(x, hn::Inf(d)), number(1), zero));
      keep_floats(of, hn::IfThenElse(hn::Gt(is_infinite, hn::Zero(df)), hn::Inf(df), hn::DemoteTo(df, x)));
    };
    const auto scaled = [&](const std::array<double, max_lanes>& x) {
      return hn::Mul(hn::Mul(hn::LoadU(d, &x[from]), number(frame_.unit[0])), number(frame_.unit[1]));
    };
    Doubles position[3];
    Doubles by[3];
    Doubles fastest = zero;
    Doubles distance = zero;
    auto is_near = hn::Eq(zero, zero);
    for (std::size_t k = 0; k < 3; ++k) {
      const Doubles scale = number(frame_.scale[k]);
      const Doubles start = scaled(paths.start[k]);
      const Doubles toward = scaled(paths.toward[k]);
      const Doubles way = kind == PathKind::segment ? hn::Sub(toward, start) : toward;
      position[k] = hn::Mul(hn::Sub(start, number(frame_.origin[k])), scale);
      by[k] = hn::Mul(way, scale);
      const Doubles cells = hn::Abs(position[k]);
      distance = hn::Max(distance, cells);
      fastest = hn::Max(fastest, hn::Abs(by[k]));
      is_near = hn::And(is_near, hn::Le(cells, number(ClippedPath::far_widths * frame_.resolution(k))));
      is_near = hn::And(is_near, hn::Le(hn::Abs(by[k]), number(ClippedPath::too_fast)));
    }
    auto is_plain = is_near;
    if (kind != PathKind::segment) {
      is_plain = hn::And(is_plain, hn::Ge(fastest, number(double{ClippedPath::slow})));
      is_plain = hn::And(is_plain, hn::Le(distance, hn::Mul(number(ClippedPath::max_t_to_grid), fastest)));
    }
    const auto outward = [&](Doubles t) { return hn::Mul(hn::Abs(t), number(0x1p-50)); };
    const Doubles first_t = hn::LoadU(d, &paths.first_t[from]);
    const Doubles last_t = hn::LoadU(d, &paths.last_t[from]);
    Doubles enters = hn::Sub(first_t, outward(first_t));
    Doubles leaves = hn::Add(last_t, outward(last_t));
    Doubles first_cell = number(static_cast<double>(frame_.first_top));
    auto passes = hn::Eq(zero, zero);
    auto moves = hn::Lt(zero, zero);
    std::array<std::uint64_t, 3> mirrored;
    for (std::size_t k = 0; k < 3; ++k) {
      const Doubles stop = number(frame_.resolution(k));
      position[k] = hn::Add(position[k], number(double{frame_.margin[k]}));
      const auto is_mirrored = hn::Lt(by[k], zero);
      position[k] = hn::IfThenElse(is_mirrored, hn::Sub(stop, position[k]), position[k]);
      const Doubles speed = hn::Abs(by[k]);
      const auto is_still = hn::Lt(speed, number(double{ClippedPath::min_rate}));  // L11
      by[k] = hn::IfThenElse(is_still, zero, speed);
      const auto is_inside = hn::And(hn::Le(zero, position[k]), hn::Le(position[k], stop));
      passes = hn::And(passes, hn::Or(hn::Not(is_still), is_inside));
      moves = hn::Or(moves, hn::Not(is_still));
      const Doubles inverse =
          hn::IfThenElse(is_still, number(double{ClippedPath::max_inverse}), hn::Div(number(1), speed));
      const Doubles low = hn::Mul(hn::Neg(position[k]), inverse);
      const Doubles high = hn::Mul(hn::Sub(stop, position[k]), inverse);
      enters = hn::IfThenElse(is_still, enters, hn::Max(enters, low));
      leaves = hn::IfThenElse(is_still, leaves, hn::Min(leaves, high));
      const Doubles pitch = number(static_cast<double>(frame_.top_orders[0].pitch[k]));
      keep(clipped.pitch[k], hn::IfThenElse(is_mirrored, hn::Neg(pitch), pitch));
      first_cell = hn::Add(first_cell, hn::IfThenElseZero(is_mirrored, number(static_cast<double>(mirrored_first(k)))));
      keep(clipped.rate[k], by[k]);
      keep(clipped.inverse_rate[k], inverse);
      mirrored[k] = bits_of(d, is_mirrored);
    }
    const auto inside = hn::And(hn::And(is_plain, passes), hn::Le(enters, leaves));
    enters = hn::IfThenElseZero(moves, enters);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto last = hn::Set(df, static_cast<float>(frame_.resolution(k)) * (1 - 0x1p-24F));
      const auto entered = hn::DemoteTo(df, hn::Add(position[k], hn::Mul(enters, by[k])));
      const auto start = hn::Min(hn::Max(entered, hn::Zero(df)), last);
      keep_floats(clipped.start[k], start);
      keep_floats(clipped.finest[k], hn::Floor(start));
    }
    // As `WalkParameter::beyond` (L12).
    const Doubles exact = hn::Sub(last_t, enters);
    const Doubles rounding = hn::Mul(hn::Add(hn::Abs(last_t), hn::Abs(enters)), number(0x1p-50));
    const Doubles end =
        hn::Add(hn::Add(hn::Add(exact, rounding), hn::Mul(hn::Abs(exact), number(0x1p-22))), number(0x1p-140));
    keep_end(clipped.end, hn::IfThenElseZero(moves, end));
    keep(clipped.enters, enters);
    keep(clipped.first_cell, first_cell);
    hn::StoreU(enters, d, &enters_at[from]);
    for (std::uint32_t left = some; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      std::uint32_t octant = 0;
      for (std::size_t k = 0; k < 3; ++k) octant |= static_cast<std::uint32_t>(mirrored[k] >> lane & 1) << k;
      clipped.octant[from + lane] = octant;
    }
    const auto in_some = [&](hn::Mask<DoubleTag> mask) { return static_cast<std::uint32_t>(bits_of(d, mask)) & some; };
    return {in_some(inside), in_some(hn::Not(is_plain))};
  }

  /// Returns what is added to the index of the first cell if a path is mirrored on an axis.
  [[nodiscard]] std::int32_t mirrored_first(std::size_t axis) const {
    return frame_.top_orders[std::size_t{1} << axis].first - frame_.top_orders[0].first;
  }

  const GridFrame& frame_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
