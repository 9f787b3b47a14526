// Places many paths side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PLACE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PLACE_LANES_INL
#undef SUREHIT_PLACE_LANES_INL
#else
#define SUREHIT_PLACE_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "scene/instance_frame.hpp"
#include "scene/placed_lanes.hpp"
#include "scene/placed_path.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Pairs of a path and an instance, one in each lane. It takes the steps of `PlacedPath::place` for all of them at
/// once.
class PlaceLanes {
 public:
  static constexpr std::size_t max_lanes = PlacedLanes::max_lanes;

  /// Sets the pair of a lane.
  template <typename Scalar>
  HWY_INLINE void set(std::size_t lane, const ScenePath<Scalar>& path, const InstanceFrame& frame) {
    Rows to{*this, lane};
    to.add(path.start);
    to.add(path.direction);
    to.add(path.size);
    to.add(path.inverse_square);
    to.add(double{path.range.first});
    to.add(double{path.range.last});
    set_frame(lane, frame, path.path.has_end());
  }
  /// Sets the instance of a lane.
  HWY_INLINE void set_frame(std::size_t lane, const InstanceFrame& frame, bool has_end) {
    Rows to{*this, lane, path_rows};
    to.add(frame.placed_anchor);
    for (const float rest : frame.near_rest) to.add(double{rest});
    to.add(frame.radius);
    to.add(frame.near_slack);
    for (const Double4& column : frame.inverse) to.add(column);
    to.add(frame.anchor);
    to.add(frame.row_size);
    to.add(frame.largest_row_size);
    to.add(frame.inverse_error);
    to.add(frame.anchor_size);
    to.add(frame.largest_half_size);
    to.add(frame.half_size);
    // A path that moves against the instance, or that is not usable, is placed alone.
    const bool is_plain = frame.is_usable && !(frame.moves && has_end);
    plain_ = (plain_ & ~(std::uint32_t{1} << lane)) | std::uint32_t{is_plain} << lane;
  }
  /// Sets the segments of all lanes, for t from 0 to 1. There are six arrays of floats: the coordinates of the starts,
  /// and those of the ends. Each has a float for each lane.
  HWY_INLINE void set_segments(const float* const (&numbers)[6]) {
    const Tag d;
    for (std::size_t from = 0; from < max_lanes; from += hn::Lanes(d)) {
      const auto load = [&](std::size_t i) {
        return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, Tag>(), numbers[i] + from));
      };
      std::size_t row = 0;
      const auto add = [&](V x) { hn::StoreU(x, d, &numbers_[row++][from]); };
      V way[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const V start = load(k);
        add(start);
        way[k] = hn::Sub(load(k + 3), start);
      }
      for (const V& component : way) add(component);
      add(largest(way));
      const V square = dot(way, way);
      const auto moves = hn::Gt(square, hn::Zero(d));
      add(hn::IfThenElseZero(moves, hn::Div(all(1), hn::IfThenElse(moves, square, all(1)))));
      add(hn::Zero(d));
      add(all(1));
    }
  }

  /// Places the pairs of the first `count` lanes. `has_end` tells whether all of their paths are segments.
  HWY_NOINLINE void place(std::size_t count, bool has_end, PlacedLanes& placed) const {
    placed.near = placed.beside = 0;
    const std::size_t lanes = hn::Lanes(Tag());
    for (std::size_t from = 0; from < count; from += lanes) place_part(from, has_end, placed);
    const std::uint32_t all = plain_ & ((std::uint32_t{1} << count) - 1);
    placed.near &= all;
    placed.beside &= all;
  }

 private:
  using Tag = hn::CappedTag<double, max_lanes>;
  using V = hn::Vec<Tag>;
  static constexpr std::size_t rows = 40;       ///< The number of numbers of a pair.
  static constexpr std::size_t path_rows = 10;  ///< The number of those of the path. They come first.

  /// Sets one number of a lane after the other.
  struct Rows {
    PlaceLanes& of;
    std::size_t lane;
    std::size_t row = 0;

    HWY_INLINE void add(double x) { of.numbers_[row++][lane] = x; }
    HWY_INLINE void add(const Double4& x) {
      for (std::size_t axis = 0; axis < 3; ++axis) add(x[axis]);
    }
  };

  static HWY_INLINE V all(double x) { return hn::Set(Tag(), x); }
  static HWY_INLINE V dot(const V (&x)[3], const V (&y)[3]) {
    return hn::Add(hn::Add(hn::Mul(x[0], y[0]), hn::Mul(x[1], y[1])), hn::Mul(x[2], y[2]));
  }
  static HWY_INLINE V largest(const V (&x)[3]) { return hn::Max(hn::Max(hn::Abs(x[0]), hn::Abs(x[1])), hn::Abs(x[2])); }

  /// Places the pairs of one vector. The first one is that of lane `from`.
  HWY_INLINE void place_part(std::size_t from, bool has_end, PlacedLanes& placed) const {
    const Tag d;
    std::size_t row = 0;
    const auto next = [&] { return hn::LoadU(d, &numbers_[row++][from]); };
    V path_start[3], way[3], placed_anchor[3], rest[3], column[3][3], anchor[3], row_size[3];
    const auto next_vector = [&](V(&x)[3]) {
      for (V& number : x) number = next();
    };
    next_vector(path_start);
    next_vector(way);
    const V path_size = next();
    const V inverse_square = next();
    const V first = next();
    const V last = next();
    next_vector(placed_anchor);
    next_vector(rest);
    const V radius = next();
    const V near_slack = next();
    for (auto& each : column) next_vector(each);
    next_vector(anchor);
    next_vector(row_size);
    const V largest_row_size = next();
    const V inverse_error = next();
    const V anchor_size = next();
    const V largest_half_size = next();
    V half_size[3];
    next_vector(half_size);

    V offset_from[3];
    for (std::size_t k = 0; k < 3; ++k) offset_from[k] = hn::Sub(hn::Sub(path_start[k], placed_anchor[k]), rest[k]);
    const V distance = hn::Add(hn::Add(hn::Abs(offset_from[0]), hn::Abs(offset_from[1])), hn::Abs(offset_from[2]));
    const V best_t = hn::Min(hn::Max(hn::Neg(hn::Mul(dot(offset_from, way), inverse_square)), first), last);
    const V t = rounded(best_t, has_end);
    auto is_moderate = hn::And(hn::Ge(path_size, all(0x1p-400)), hn::Le(path_size, all(0x1p499)));
    is_moderate = hn::And(is_moderate, hn::Le(hn::Abs(t), all(0x1p500)));
    is_moderate = hn::And(is_moderate, hn::Le(distance, all(0x1p500)));
    // I5
    V middle[3];
    for (std::size_t k = 0; k < 3; ++k) middle[k] = hn::Add(offset_from[k], hn::Mul(t, way[k]));
    V margin = hn::Add(hn::Add(hn::Mul(radius, all(1 + 0x1p-20)), near_slack), all(0x1p-500));
    margin = hn::Add(margin, hn::Mul(distance, all(0x1p-44)));
    margin = hn::Add(margin, hn::Mul(hn::Mul(all(2), hn::Abs(hn::Sub(t, best_t))), path_size));
    auto is_beside = hn::And(is_moderate, hn::Gt(dot(middle, middle), hn::Mul(margin, margin)));
    // I6
    const V middle_size = largest(middle);
    const V middle_error = hn::Add(near_slack, hn::Mul(hn::Add(distance, middle_size), all(0x1p-51)));
    auto is_near = hn::Le(middle_error, hn::Mul(all(0x1p-36), radius));
    // I7
    V offset[3], direction[3], start[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row_times = [&](const V(&x)[3]) {
        return hn::Add(hn::Add(hn::Mul(column[0][k], x[0]), hn::Mul(column[1][k], x[1])), hn::Mul(column[2][k], x[2]));
      };
      offset[k] = row_times(middle);
      direction[k] = row_times(way);
      start[k] = hn::Add(anchor[k], offset[k]);
    }
    const V offset_size = largest(offset);
    const V direction_size = largest(direction);
    const V start_size = hn::Add(anchor_size, offset_size);
    const V share = hn::Add(inverse_error, all(8 * 0x1p-53));
    const V start_share = hn::Add(hn::Mul(share, middle_size), hn::Mul(all(2), middle_error));
    const V direction_share = hn::Mul(share, largest(way));
    const V rounding = hn::Add(hn::Mul(all(0x1p-53), hn::Add(start_size, hn::Mul(all(2), offset_size))), all(0x1p-900));
    const V start_error = hn::Add(hn::Mul(largest_row_size, start_share), rounding);
    const V direction_error = hn::Add(hn::Mul(largest_row_size, direction_share), all(0x1p-900));
    const V reach = hn::Add(hn::Mul(hn::Add(offset_size, largest_half_size), all(1 + 0x1p-40)), start_error);
    const V speed = hn::Sub(direction_size, direction_error);
    const V way_in_box = hn::Add(hn::Add(offset_size, start_error), hn::Mul(all(2), largest_half_size));
    const V time = hn::Div(way_in_box, speed);
    is_near = hn::And(is_near, hn::And(is_moderate, hn::Le(reach, hn::Mul(all(16), largest_half_size))));
    is_near = hn::And(is_near, hn::Gt(speed, hn::Zero(d)));
    const V position_share = hn::Add(start_share, hn::Mul(time, direction_share));
    const V position_rounding = hn::Add(rounding, hn::Mul(time, all(0x1p-900)));

    // I10
    V enters = outward(hn::Sub(first, t), hn::Neg(all(0x1p-50)));
    V leaves = outward(hn::Sub(last, t), all(0x1p-50));
    const auto keep = [&](PlacedLanes::Lanes& lanes, V x) { hn::StoreU(x, d, &lanes[from]); };
    for (std::size_t k = 0; k < 3; ++k) {
      const V position_error = hn::Add(hn::Mul(row_size[k], position_share), position_rounding);
      const V grown =
          hn::Add(hn::Add(half_size[k], position_error), hn::Mul(hn::Add(offset_size, half_size[k]), all(0x1p-45)));
      const auto moves = hn::Ge(hn::Abs(direction[k]), all(0x1p-500));
      const V inverse = hn::Div(all(1), hn::IfThenElse(moves, direction[k], all(1)));
      const V middle_time = hn::Mul(hn::Neg(offset[k]), inverse);
      const V half_time = hn::Mul(grown, hn::Abs(inverse));
      enters = hn::IfThenElse(moves, hn::Max(enters, hn::Sub(middle_time, half_time)), enters);
      leaves = hn::IfThenElse(moves, hn::Min(leaves, hn::Add(middle_time, half_time)), leaves);
      keep(placed.start[k], start[k]);
      keep(placed.direction[k], direction[k]);
      keep(placed.position_error[k], position_error);
    }
    is_beside = hn::Or(is_beside, hn::And(is_near, hn::Gt(enters, leaves)));
    keep(placed.moved_t, t);
    keep(placed.start_error, start_error);
    keep(placed.direction_error, direction_error);
    keep(placed.direction_size, direction_size);
    keep(placed.start_size, start_size);
    keep(placed.reach, reach);
    placed.beside |= static_cast<std::uint32_t>(bits_of(d, is_beside)) << from;
    placed.near |= static_cast<std::uint32_t>(bits_of(d, hn::AndNot(is_beside, is_near))) << from;
  }

  /// Adds a share of its size to t.
  static HWY_INLINE V outward(V t, V share) { return hn::Add(t, hn::Mul(hn::Abs(t), share)); }
  /// Does what `PlacedPath::rounded` does.
  static HWY_INLINE V rounded(V t, bool has_end) {
    const V unit = all(0x1.8p32);
    if (has_end) return hn::Sub(hn::Add(t, unit), unit);
    const Tag d;
    const V as_float = hn::PromoteTo(d, hn::DemoteTo(hn::Rebind<float, Tag>(), t));
    return hn::IfThenElse(hn::Lt(hn::Abs(t), all(0x1p100)), as_float, t);
  }

  alignas(64) std::array<PlacedLanes::Lanes, rows> numbers_ = {};  ///< The numbers of all pairs.
  std::uint32_t plain_ = 0;                                        ///< The lanes that can be placed here.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
