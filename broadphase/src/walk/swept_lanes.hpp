#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/grid.hpp"

namespace surehit {

/// Small moving boxes that walk through the outermost grid side by side, one in each lane. They visit at least each
/// cell that `SweptWalk` has to visit. SWEPT_WALK.md has the proof (W6, W7).
///
/// All numbers of the walk are floats. They are counted in top cells and mirrored, so that no box falls on an axis.
class SweptLanes {
 public:
  static constexpr std::size_t count = 8;  ///< The number of lanes.
  template <typename Number>
  using Row = std::array<Number, count>;
  template <typename Number>
  using Points = std::array<Row<Number>, 3>;

  /// New boxes, with their centres at t = 0 and t = 1, in the mesh's unit of length.
  struct Entering {
    Points<double> start;
    Points<double> end;
    Points<double> half_extents;
  };

  /// The number of cells that a box comes to at once, at most.
  static constexpr std::size_t max_cells = 4;

  /// What the boxes come to with one step.
  struct Arrivals {
    std::uint32_t ended = 0;                      ///< The lanes whose walk has ended.
    std::array<std::uint32_t, max_cells> lists;   ///< The lanes whose box may meet a triangle of a list.
    std::array<std::uint32_t, max_cells> bricks;  ///< The lanes that come to a brick, or to a cell with an inner grid.
    std::array<Row<std::uint32_t>, max_cells> words;  ///< The words of these cells.
    std::array<Points<float>, max_cells> cells;       ///< The cells, mirrored, where there are bricks.
    std::uint32_t all = 0;                            ///< The lanes that come to anything.
  };

  /// `slabs` has the slab of each list, or is null.
  SweptLanes(const Grid& grid, const CellSlab* slabs) : grid(grid), slabs(slabs) {
    const GridFrame& frame = grid.frame();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      largest_[axis] = largest_reach * frame.division / (frame.scale[axis] * frame.unit[0] * frame.unit[1]);
    }
  }

  /// Returns false for boxes that are too large to walk in lanes. `enter` says so too, but has to place them first.
  [[nodiscard]] bool may_enter(const std::array<double, 3>& half_extents) const {
    return half_extents[0] <= largest_[0] && half_extents[1] <= largest_[1] && half_extents[2] <= largest_[2];
  }

  /// Puts boxes into some lanes, whose `end` is set. Returns those of the lanes that have something to walk. `apart`
  /// gets those that `SweptWalk` has to walk, because they are too large or too far away.
  [[nodiscard]] std::uint32_t enter(const Entering& boxes, std::uint32_t entering, std::uint32_t& apart);
  /// Makes a step. `walking` must have all lanes that still walk: it spoils the others.
  void step(std::uint32_t walking, Arrivals& arrivals);
  /// Returns a float that is at least t, for `end`.
  [[nodiscard]] static float beyond(double t) { return static_cast<float>(t) * (1 + 0x1p-22F) + 0x1p-100F; }
  /// Returns the cell number k of a lane that came to a brick there.
  [[nodiscard]] std::array<std::uint32_t, 3> cell(const Arrivals& arrivals, std::size_t k, std::size_t lane) const {
    std::array<std::uint32_t, 3> cell = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto mirrored = static_cast<std::uint32_t>(arrivals.cells[k][axis][lane]);
      cell[axis] = (octant[lane] >> axis & 1) != 0 ? grid.frame().cells[axis] - 1 - mirrored : mirrored;
    }
    return cell;
  }

  /// The maximum reach in top cells (W6).
  static constexpr double largest_reach = 0.45;

  // What the functions for each instruction set need.
  const Grid& grid;
  const CellSlab* slabs;
  alignas(64) Points<float> start;  ///< The centre at t = 0.
  Points<float> rate;               ///< The centre at t = 1 less that at t = 0.
  Points<float> inverse_rate;       ///< 1 / rate, or `ClippedPath::max_inverse` where the rate is 0.
  Points<float> reach;              ///< The half extents, and the allowance of W6.
  Points<float> pitch;              ///< The index of a top cell grows by this to the next one.
  Points<float> horizon;            ///< The box has seen all its cells whose numbers are below these (W7).
  Row<float> first;                 ///< The index of mirrored top cell (0, 0, 0).
  Row<float> t;                     ///< The time of the last step.
  Row<float> end;                   ///< Nothing counts beyond this t.
  Row<std::uint32_t> octant;        ///< Bit k is set if the box is mirrored on axis k.
  std::uint32_t leaped = 0;         ///< The lanes whose last step leapt over empty cells.
  std::uint32_t begins = 0;         ///< The lanes that have not seen all cells of their first box.

 private:
  std::array<double, 3> largest_;  ///< The half extents of the largest boxes that can walk.
};

}  // namespace surehit
