// Walks paths through the grids of many meshes. Highway compiles this file for each instruction set.

#if defined(SUREHIT_MESH_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_MESH_LANES_INL
#undef SUREHIT_MESH_LANES_INL
#else
#define SUREHIT_MESH_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "grid/grid.hpp"
#include "support/lane_bits-inl.hpp"
#include "walk/lane_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Paths that walk, one in each lane, where each lane has a grid of its own. It takes the steps of `LaneWalk`.
class MeshLanes {
 public:
  /// Puts a path that was clipped to the outermost frame of a grid into one lane. It begins at tau `enters`. `slabs` is
  /// as in `LaneWalk`. Both must outlive the walk.
  HWY_INLINE void put(std::size_t lane, const Grid& grid, const CellSlab* slabs, const ClippedPath& path,
                      float enters) {
    const GridFrame& frame = grid.frame();
    LaneWalk::put(lane, frame, path, paths_);
    LaneWalk::set_stop(lane, frame, paths_);
    if (enters > 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float position = path.start[axis] + enters * path.rate[axis];
        paths_.finest[axis][lane] = std::floor(std::min(position, frame.float_stop[axis] * (1 - 0x1p-24F)));
      }
    }
    top_[lane] = reinterpret_cast<const std::uint32_t*>(grid.all_top().data());
    bricks_[lane] = reinterpret_cast<const std::uint32_t*>(grid.bricks().data());
    static_assert(sizeof(CellList) == 2 * sizeof(std::uint32_t));  // The box is the first half.
    boxes_[lane] = reinterpret_cast<const std::uint32_t*>(grid.lists().data());
    slabs_[lane] = reinterpret_cast<const std::uint32_t*>(slabs);
    top_shift_[lane] = 2 * grid.levels();
    top_size_[lane] = static_cast<float>(frame.division);
    max_levels_ = std::max(max_levels_, grid.levels());
  }
  /// Ends the walk of a lane at parameter t, because nothing beyond it counts. Tau must be t - `enters`.
  void shorten(std::size_t lane, double t, double enters) {
    paths_.end[lane] = std::min(paths_.end[lane], ClippedPath::beyond(t, enters));
  }

  /// Returns the cells of the walking lanes.
  HWY_INLINE LaneWalk::Cells look(std::uint32_t walking) const {
    return max_levels_ > 0 ? look_in_levels(walking) : look_in<false>(walking);
  }

  /// Does what `LaneWalk::meet_lists` does.
  HWY_INLINE std::uint32_t meet_lists(const LaneWalk::Cells& cells, std::uint32_t in_lists) const {
    if (in_lists == 0) return 0;
    const Words list = hn::ShiftRight<CellWord::list_shift>(cells.word);
    Floats enters, leaves;
    const Words box = words_at(boxes_, hn::ShiftLeft<1>(list), in_lists);
    const std::uint32_t meeting = LaneWalk::meet_boxes(cells, box, in_lists, paths_, enters, leaves);
    std::uint32_t with_slabs = 0;
    for (std::uint32_t left = meeting; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      with_slabs |= std::uint32_t{slabs_[lane] != nullptr} << lane;
    }
    if (with_slabs == 0) return meeting;
    const Ints slab = hn::BitCast(IntTag(), words_at(slabs_, list, with_slabs));
    return meeting & ~(with_slabs & LaneWalk::miss_slabs(cells, slab, enters, leaves, paths_));
  }

  /// Moves the walking lanes on. Returns the lanes that still walk.
  HWY_INLINE std::uint32_t advance(const LaneWalk::Cells& cells, std::uint32_t walking) {
    return LaneWalk::advance(cells, walking, paths_);
  }

 private:
  using Tables = std::array<const std::uint32_t*, max_lanes>;

  /// Returns one word of the table of each of some lanes. The others are 0.
  static HWY_INLINE Words words_at(const Tables& tables, Words index, std::uint32_t lanes) {
    const BitsTag du;
    alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> at;
    alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> words = {};
    hn::Store(index, du, at.data());
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      words[lane] = tables[lane][at[lane]];
    }
    return hn::Load(du, words.data());
  }

  HWY_NOINLINE LaneWalk::Cells look_in_levels(std::uint32_t walking) const { return look_in<true>(walking); }

  /// Does what `LaneWalk::look` does.
  template <bool has_levels>
  HWY_INLINE LaneWalk::Cells look_in(std::uint32_t walking) const {
    const FloatTag d;
    const IntTag di;
    const BitsTag du;
    LaneWalk::Cells cells;
    Ints finest[3];
    Floats index = hn::Load(d, paths_.first_cell.data());
    const Words top_shift = hn::Load(du, top_shift_.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells.low[axis] = hn::Load(d, paths_.finest[axis].data());
      Floats top = cells.low[axis];
      if constexpr (has_levels) {
        finest[axis] = to_ints(cells.low[axis]);
        top = hn::ConvertTo(d, hn::BitCast(di, hn::Shr(hn::BitCast(du, finest[axis]), top_shift)));
      }
      index = hn::MulAdd(top, hn::Load(d, paths_.pitch[axis].data()), index);
    }
    cells.word = words_at(top_, hn::BitCast(du, to_ints(index)), walking);
    cells.size = hn::Load(d, top_size_.data());
    if constexpr (has_levels) {
      const auto walks = mask_of(du, walking);
      const Words octant = hn::Load(du, paths_.octant.data());
      for (std::uint32_t level = max_levels_; level-- > 0;) {
        const auto has_level = hn::And(walks, hn::Gt(top_shift, hn::Set(du, 2 * level)));
        const auto divided =
            hn::And(has_level, hn::Eq(hn::And(cells.word, hn::Set(du, CellWord::divided_bits)), hn::Zero(du)));
        if (hn::AllFalse(du, divided)) continue;
        Words cell = hn::ShiftLeft<6>(hn::ShiftRight<CellWord::brick_shift>(cells.word));
        for (int axis = 0; axis < 3; ++axis) {
          const Words position = hn::BitCast(du, hn::ShiftRightSame(finest[axis], static_cast<int>(2 * level)));
          const Words flips = hn::Sub(hn::Zero(du), hn::And(hn::ShiftRightSame(octant, axis), hn::Set(du, 1U)));
          cell = hn::Add(cell, hn::ShiftLeftSame(hn::And(hn::Xor(position, flips), hn::Set(du, 3U)), 2 * axis));
        }
        const Words inner = words_at(bricks_, cell, static_cast<std::uint32_t>(bits_of(du, divided)));
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

  WalkingPaths paths_ = {};
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> top_shift_ = {};  ///< 2 Grid::levels().
  alignas(max_lanes * sizeof(float)) LaneFloats top_size_ = {};  ///< The edges of top cells, in finest cells.
  Tables top_ = {};                                              ///< The words of the top cells of each lane's grid.
  Tables bricks_ = {};                                           ///< The words of the other cells.
  Tables boxes_ = {};                                            ///< The boxes of the lists.
  Tables slabs_ = {};                                            ///< The slabs of the lists, or null.
  std::uint32_t max_levels_ = 0;                                 ///< No grid so far had more levels.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
