// Walks many paths side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_LANE_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_LANE_WALK_INL
#undef SUREHIT_LANE_WALK_INL
#else
#define SUREHIT_LANE_WALK_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/lane_bits-inl.hpp"
#include "walk/grid_traversal.hpp"
#include "walk/walking_paths-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Walks paths of one grid, one in each lane. `LaneClip` clips them.
class LaneWalk {
 public:
  /// The paths are clipped to a frame of the grid. `slabs` has the slabs of the grid's lists, or is null. The grid, the
  /// frame and the slabs must outlive this.
  LaneWalk(const Grid& grid, const GridFrame& frame, const CellSlab* slabs)
      : grid_(grid), frame_(frame), slabs_(slabs) {}
  /// The paths are clipped to the outermost frame.
  LaneWalk(const Grid& grid, const CellSlab* slabs) : LaneWalk(grid, grid.frame(), slabs) {}

  /// Sets `stop` of all lanes to that of the frame.
  HWY_INLINE void set_stops(WalkingPaths& paths) const {
    const FloatTag d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hn::Store(hn::Set(d, frame_.float_stop[axis]), d, paths.stop[axis].data());
    }
  }
  /// Sets `stop` of one lane to that of a frame.
  static void set_stop(std::size_t lane, const GridFrame& frame, WalkingPaths& paths) {
    for (std::size_t axis = 0; axis < 3; ++axis) paths.stop[axis][lane] = frame.float_stop[axis];
  }

  /// Puts a path that walks through a frame into one lane. It does not set `stop`.
  static void put(std::size_t lane, const GridFrame& frame, const WalkingPath& path, WalkingPaths& paths) {
    const GridFrame::TopOrder& order = frame.top_orders[path.octant];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      paths.start[axis][lane] = path.start[axis];
      paths.rate[axis][lane] = path.rate[axis];
      paths.inverse_rate[axis][lane] = path.inverse_rate[axis];
      paths.finest[axis][lane] = path.finest[axis];
      paths.pitch[axis][lane] = static_cast<float>(order.pitch[axis]);
    }
    paths.first_cell[lane] = static_cast<float>(order.first);
    paths.enters[lane] = path.enters;
    paths.end[lane] = path.end;
    paths.octant[lane] = path.octant;
  }
  /// Returns what the float nearest to `enters` leaves out of it.
  static float rest_of_enters(double enters) { return static_cast<float>(enters - double{static_cast<float>(enters)}); }
  /// Puts a path that `ClippedPath` has clipped to a frame into one lane. `enters` becomes the float nearest to the t
  /// where tau is 0, if tau is t less some number.
  static void put(std::size_t lane, const GridFrame& frame, const ClippedPath& path, WalkingPaths& paths) {
    WalkingPath begins;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      begins.start[axis] = path.start[axis];
      begins.rate[axis] = path.rate[axis];
      begins.inverse_rate[axis] = path.inverse_rate[axis];
      begins.finest[axis] = std::floor(path.start[axis]);
    }
    begins.enters = static_cast<float>(path.tau.origin[2]);
    begins.end = path.end;
    begins.octant = path.octant;
    put(lane, frame, begins, paths);
  }

  /// Cuts a path into pieces of equal length, one for each lane. The first one begins at tau `enters`. A piece may
  /// begin at any tau, because its position is rounded as in any other step.
  HWY_INLINE void cut(const ClippedPath& path, float enters, WalkingPaths& pieces) const {
    const FloatTag d;
    const std::size_t last_lane = hn::Lanes(d) - 1;
    const Floats from = hn::Set(d, enters);
    const Floats length = hn::Set(d, (std::min(path.end, path.exit) - enters) / static_cast<float>(last_lane + 1));
    const Floats whole = hn::Set(d, path.end);
    const Floats begin = hn::MulAdd(hn::Iota(d, 0.0F), length, from);
    const Floats end = hn::MulAdd(hn::Iota(d, 1.0F), length, from);  // The next piece begins here.
    hn::Store(hn::IfThenElse(hn::FirstN(d, last_lane), hn::Min(end, whole), whole), d, pieces.end.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats last = hn::Set(d, frame_.float_stop[axis] * (1 - 0x1p-24F));
      const Floats position = hn::MulAdd(begin, hn::Set(d, path.rate[axis]), hn::Set(d, path.start[axis]));
      hn::Store(hn::Floor(hn::Min(position, last)), d, pieces.finest[axis].data());
    }
    repeat(path, pieces);
  }

  /// True if `enter_crossings` can be used. With fewer lanes, a walk is as fast. L5 requires that a position is rounded
  /// once, so there must be fused operations.
  static constexpr bool can_enter_crossings = HWY_NATIVE_FMA != 0 && max_lanes >= 8;

  /// The planes that a path crosses from tau `enters` on. They are numbered from 1: first those on x, then those on y,
  /// and then those on z. Number 0 is the tau where the path begins.
  struct Crossings {
    HWY_INLINE Crossings(const ClippedPath& any_path, float begins) : path(any_path), enters(begins) {
      const Float4 first = to_float(to_int(path.start + enters * path.rate));
      const Float4 end = to_float(to_int(path.start + std::min(path.end, path.exit) * path.rate));
      const Float4 planes = end - first;
      last_on_x = planes[0];
      last_on_y = planes[0] + planes[1];
      last = last_on_y + planes[2];
      number_zero = first - Float4{0, last_on_x, last_on_y, 0};
      rate = path.rate * (1 + 0x1p-22F);
    }
    const ClippedPath& path;  ///< The path.
    float enters;             ///< The tau where the path begins.
    Float4 rate;              ///< No plane that is crossed by some tau lies beyond the cell at that tau (L5).
    Float4 number_zero;       ///< On each axis, number n is plane number_zero + n.
    float last_on_x;          ///< The number of the last plane on x.
    float last_on_y;          ///< The number of the last plane on y.
    float last;               ///< The number of the last plane.
  };

  /// Prepares all lanes for `enter_crossings`.
  HWY_INLINE void begin_crossings(const ClippedPath& path, WalkingPaths& cells) const {
    const FloatTag d;
    hn::Store(hn::Set(d, path.end), d, cells.end.data());
    repeat(path, cells);
  }

  /// Puts each lane into the cell after one crossing. The first lane has crossing number `from`. The grid must have no
  /// levels. Returns the lanes that it uses. Together, the cells of all numbers leave no part of the path out (L5).
  HWY_INLINE std::uint32_t enter_crossings(const Crossings& crossings, float from, WalkingPaths& cells) const {
    const FloatTag d;
    const ClippedPath& path = crossings.path;
    const Floats number = hn::Add(hn::Iota(d, 0.0F), hn::Set(d, from));
    Floats crossed[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats plane = hn::Add(number, hn::Set(d, crossings.number_zero[axis]));
      crossed[axis] = hn::Mul(hn::Sub(plane, hn::Set(d, path.start[axis])), hn::Set(d, path.inverse_rate[axis]));
    }
    const auto is_beyond_x = hn::Gt(number, hn::Set(d, crossings.last_on_x));
    const auto is_beyond_y = hn::Gt(number, hn::Set(d, crossings.last_on_y));
    const Floats crossing =
        hn::IfThenElse(is_beyond_y, crossed[2], hn::IfThenElse(is_beyond_x, crossed[1], crossed[0]));
    const Floats tau = hn::IfThenElse(hn::Eq(number, hn::Zero(d)), hn::Set(d, crossings.enters), crossing);
    auto inside = hn::Le(number, hn::Set(d, crossings.last));
    Floats cell[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = hn::Floor(hn::MulAdd(tau, hn::Set(d, crossings.rate[axis]), hn::Set(d, path.start[axis])));
      inside = hn::And(inside, hn::Lt(cell[axis], hn::Set(d, frame_.float_stop[axis])));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hn::Store(hn::IfThenElseZero(inside, cell[axis]), d, cells.finest[axis].data());
    }
    return static_cast<std::uint32_t>(bits_of(d, inside));
  }

  /// The undivided cells that the lanes are in.
  struct Cells {
    Words word;     ///< The words of the cells.
    Floats low[3];  ///< The low corners of the cells, in finest cells.
    Floats size;    ///< The edges of the cells, in finest cells.
  };
  /// Returns the cells of the walking lanes.
  HWY_INLINE Cells look(const WalkingPaths& paths, std::uint32_t walking) const {
    return grid_.levels() > 0 ? look_in<true>(paths, walking) : look_in<false>(paths, walking);
  }
  /// Does the same for a grid that has levels, or for one that has none.
  template <bool has_levels>
  HWY_INLINE Cells look_in(const WalkingPaths& paths, std::uint32_t walking) const {
    const FloatTag d;
    const IntTag di;
    const BitsTag du;
    Cells cells;
    const std::uint32_t levels = grid_.levels();
    Ints finest[3];
    Floats index = hn::Load(d, paths.first_cell.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells.low[axis] = hn::Load(d, paths.finest[axis].data());
      Floats top = cells.low[axis];
      if constexpr (has_levels) {
        finest[axis] = to_ints(cells.low[axis]);
        top = hn::ConvertTo(d, hn::ShiftRightSame(finest[axis], static_cast<int>(2 * levels)));
      }
      index = hn::MulAdd(top, hn::Load(d, paths.pitch[axis].data()), index);
    }
    // Idle lanes are in the grid too: where they ended, or in cell (0, 0, 0).
    const auto* top = reinterpret_cast<const std::uint32_t*>(grid_.all_top().data());
    cells.word = hn::GatherIndex(du, top, to_ints(index));
    cells.size = hn::Set(d, static_cast<float>(frame_.division));
    if constexpr (has_levels) {
      const auto walks = mask_of(du, walking);
      const Words octant = hn::Load(du, paths.octant.data());
      for (std::uint32_t level = levels; level-- > 0;) {
        const auto divided =
            hn::And(walks, hn::Eq(hn::And(cells.word, hn::Set(du, CellWord::divided_bits)), hn::Zero(du)));
        if (hn::AllFalse(du, divided)) break;
        Words cell = hn::ShiftLeft<6>(hn::ShiftRight<CellWord::brick_shift>(cells.word));
        for (int axis = 0; axis < 3; ++axis) {
          const Words position = hn::BitCast(du, hn::ShiftRightSame(finest[axis], static_cast<int>(2 * level)));
          const Words flips = hn::Sub(hn::Zero(du), hn::And(hn::ShiftRightSame(octant, axis), hn::Set(du, 1U)));
          cell = hn::Add(cell, hn::ShiftLeftSame(hn::And(hn::Xor(position, flips), hn::Set(du, 3U)), 2 * axis));
        }
        const auto* bricks = reinterpret_cast<const std::uint32_t*>(grid_.bricks().data());
        const Words inner = hn::GatherIndex(du, bricks, hn::BitCast(di, hn::IfThenElseZero(divided, cell)));
        cells.word = hn::IfThenElse(divided, inner, cells.word);
        cells.size =
            hn::IfThenElse(hn::RebindMask(d, divided), hn::Set(d, static_cast<float>(1U << 2 * level)), cells.size);
      }
      const Ints within = hn::Sub(to_ints(cells.size), hn::Set(di, 1));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cells.low[axis] = hn::ConvertTo(d, hn::AndNot(within, finest[axis]));
      }
    }
    return cells;
  }

  /// Returns the lanes of `walking` whose cells have lists.
  HWY_INLINE static std::uint32_t in_lists(const Cells& cells, std::uint32_t walking) {
    const BitsTag du;
    const auto lists = hn::Eq(hn::And(cells.word, hn::Set(du, 15U)), hn::Zero(du));
    return static_cast<std::uint32_t>(bits_of(du, lists)) & walking;
  }

  /// Returns the lanes of `in_lists` whose path may meet a triangle of their list. It tests the box of the list, as
  /// `GridTraversal::meets_box` does (L3). If there are slabs, it tests the slab, as `GridTraversal::meets` does (L4).
  HWY_INLINE std::uint32_t meet_lists(const Cells& cells, std::uint32_t in_lists, const WalkingPaths& paths) const {
    const IntTag di;
    const BitsTag du;
    const auto has_list = mask_of(du, in_lists);
    static_assert(sizeof(CellList) == 2 * sizeof(std::uint32_t));  // The box is the first half.
    const auto* lists = reinterpret_cast<const std::uint32_t*>(grid_.lists().data());
    const Words list = hn::IfThenElseZero(has_list, hn::ShiftRight<CellWord::list_shift>(cells.word));
    const Words box = hn::GatherIndex(du, lists, hn::BitCast(di, hn::ShiftLeft<1>(list)));
    Floats enters, leaves;
    const std::uint32_t meeting = meet_boxes(cells, box, in_lists, paths, enters, leaves);
    if (slabs_ == nullptr || meeting == 0) return meeting;
    const Ints slab = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(slabs_), hn::BitCast(di, list));
    return meeting & ~miss_slabs(cells, slab, enters, leaves, paths);
  }
  /// Returns the lanes of `in_lists` whose path meets the box of their list. Sets the tau at which it enters and leaves
  /// the box, somewhat enlarged.
  static HWY_INLINE std::uint32_t meet_boxes(const Cells& cells, Words box, std::uint32_t in_lists,
                                             const WalkingPaths& paths, Floats& enters, Floats& leaves) {
    const FloatTag d;
    const IntTag di;
    const BitsTag du;
    const Words octant = hn::Load(du, paths.octant.data());
    const Words last_part = hn::Set(du, CellBox::parts - 1);
    const Floats part = hn::Mul(cells.size, hn::Set(d, 1.0F / CellBox::parts));
    enters = hn::Zero(d);
    leaves = hn::Load(d, paths.end.data());
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const auto is_mirrored = hn::Ne(hn::And(octant, hn::Set(du, 1U << axis)), hn::Zero(du));
      const Words low = hn::And(hn::ShiftRightSame(box, 10 * axis), last_part);
      const Words high = hn::And(hn::ShiftRightSame(box, 10 * axis + 5), last_part);
      const Words first = hn::IfThenElse(is_mirrored, hn::Xor(high, last_part), low);
      const Words last = hn::IfThenElse(is_mirrored, hn::Xor(low, last_part), high);
      const auto side = [&](Words sides, Floats from) {
        return hn::MulAdd(hn::ConvertTo(d, hn::BitCast(di, sides)), part, from);
      };
      const Floats padding = hn::Mul(hn::Set(d, GridFrame::padding_share), hn::Load(d, paths.stop[k].data()));
      const Floats start = hn::Load(d, paths.start[k].data());
      const Floats inverse = hn::Load(d, paths.inverse_rate[k].data());
      const Floats near = side(first, hn::Sub(cells.low[k], padding));
      const Floats far = side(last, hn::Add(cells.low[k], hn::Add(part, padding)));
      enters = hn::Max(enters, hn::Mul(hn::Sub(near, start), inverse));
      leaves = hn::Min(leaves, hn::Mul(hn::Sub(far, start), inverse));
    }
    return static_cast<std::uint32_t>(bits_of(d, hn::Le(enters, leaves))) & in_lists;
  }
  /// Returns the lanes whose path misses the slab of the list (L4). The path is in the larger box of the list between
  /// tau `enters` and tau `leaves`.
  static HWY_INLINE std::uint32_t miss_slabs(const Cells& cells, Ints slab, Floats enters, Floats leaves,
                                             const WalkingPaths& paths) {
    const FloatTag d;
    const IntTag di;
    const BitsTag du;
    const Words octant = hn::Load(du, paths.octant.data());
    const Floats half = hn::Mul(cells.size, hn::Set(d, 0.5F));
    Floats at_entry = hn::Zero(d);
    Floats at_exit = hn::Zero(d);
    Floats slack = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const Floats component = hn::ConvertTo(d, hn::ShiftRight<27>(hn::ShiftLeftSame(slab, 27 - 5 * axis)));
      // The sign changes where the path is mirrored.
      const Floats sign = hn::BitCast(d, hn::ShiftLeftSame(hn::And(octant, hn::Set(du, 1U << axis)), 31 - axis));
      const Floats normal = hn::Xor(component, sign);
      const Floats to_start = hn::Sub(hn::Load(d, paths.start[k].data()), hn::Add(cells.low[k], half));
      const Floats rate = hn::Load(d, paths.rate[k].data());
      at_entry = hn::MulAdd(hn::MulAdd(enters, rate, to_start), normal, at_entry);
      at_exit = hn::MulAdd(hn::MulAdd(leaves, rate, to_start), normal, at_exit);
      const Floats padding = hn::Mul(hn::Set(d, GridFrame::padding_share), hn::Load(d, paths.stop[k].data()));
      slack = hn::MulAdd(hn::Abs(component), padding, slack);
    }
    const Floats step = hn::Mul(cells.size, hn::Set(d, CellSlab::step));
    const Floats first = hn::ConvertTo(d, hn::ShiftRight<24>(hn::ShiftLeft<8>(slab)));
    const Floats last = hn::ConvertTo(d, hn::Add(hn::ShiftRight<24>(slab), hn::Set(di, 1)));
    const Floats low = hn::Sub(hn::Mul(first, step), slack);
    const Floats high = hn::MulAdd(last, step, slack);
    const auto below = hn::Lt(hn::Max(at_entry, at_exit), low);
    const auto above = hn::Gt(hn::Min(at_entry, at_exit), high);
    return static_cast<std::uint32_t>(bits_of(d, hn::Or(below, above)));
  }

  /// Moves the walking lanes beyond their cells, or beyond the cubes of empty cells that begin with them (L2). Returns
  /// the lanes that still walk.
  static HWY_INLINE std::uint32_t advance(const Cells& cells, std::uint32_t walking, WalkingPaths& paths) {
    const FloatTag d;
    const BitsTag du;
    const Words nibble = hn::Set(du, 15U);
    const Words shift = hn::ShiftLeft<2>(hn::Load(du, paths.octant.data()));
    const auto is_empty = hn::Ne(hn::And(cells.word, nibble), hn::Zero(du));
    const Words distance = hn::IfThenElse(is_empty, hn::And(hn::Shr(cells.word, shift), nibble), hn::Set(du, 1U));
    const Floats leap = hn::Mul(hn::ConvertTo(d, hn::BitCast(IntTag(), distance)), cells.size);
    Floats plane[3];
    Floats crossing[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      plane[axis] = hn::Add(cells.low[axis], leap);
      crossing[axis] = hn::Mul(hn::Sub(plane[axis], hn::Load(d, paths.start[axis].data())),
                               hn::Load(d, paths.inverse_rate[axis].data()));
    }
    const Floats tau = hn::Min(hn::Min(crossing[0], crossing[1]), crossing[2]);
    auto inside = hn::Lt(tau, hn::Load(d, paths.end.data()));
    const auto walks = mask_of(d, walking);
    Floats finest[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats position =
          hn::Floor(hn::MulAdd(tau, hn::Load(d, paths.rate[axis].data()), hn::Load(d, paths.start[axis].data())));
      const Floats current = hn::Load(d, paths.finest[axis].data());
      finest[axis] = hn::IfThenElse(hn::Eq(crossing[axis], tau), plane[axis], hn::Max(position, current));
      inside = hn::And(inside, hn::Lt(finest[axis], hn::Load(d, paths.stop[axis].data())));
    }
    inside = hn::And(inside, walks);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats current = hn::Load(d, paths.finest[axis].data());
      hn::Store(hn::IfThenElse(inside, finest[axis], current), d, paths.finest[axis].data());
    }
    return static_cast<std::uint32_t>(bits_of(d, inside));
  }

 private:
  /// Puts one path into all lanes. It does not set `finest`, `enters` and `end`.
  HWY_INLINE void repeat(const ClippedPath& path, WalkingPaths& paths) const {
    const FloatTag d;
    const GridFrame::TopOrder& order = frame_.top_orders[path.octant];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hn::Store(hn::Set(d, path.start[axis]), d, paths.start[axis].data());
      hn::Store(hn::Set(d, path.rate[axis]), d, paths.rate[axis].data());
      hn::Store(hn::Set(d, path.inverse_rate[axis]), d, paths.inverse_rate[axis].data());
      hn::Store(hn::Set(d, static_cast<float>(order.pitch[axis])), d, paths.pitch[axis].data());
    }
    hn::Store(hn::Set(d, static_cast<float>(order.first)), d, paths.first_cell.data());
    hn::Store(hn::Set(BitsTag(), path.octant), BitsTag(), paths.octant.data());
    set_stops(paths);
  }

  const Grid& grid_;
  const GridFrame& frame_;
  const CellSlab* slabs_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
