#pragma once

#include <array>
#include <cstdint>

#include "grid/grid.hpp"

namespace surehit {

/// A box that moves in a straight line during t in [0, 1], in the mesh's unit of length. A moving shape gives the box
/// around it.
struct SweptExtents {
  std::array<double, 3> start;         ///< The centre at t = 0.
  std::array<double, 3> end;           ///< The centre at t = 1.
  std::array<double, 3> half_extents;  ///< How far the box reaches from its centre on each axis. None is negative.
};

/// Takes the lists that a walk comes to.
class SweptVisitor {
 public:
  /// Takes the list of a cell. Returns the t beyond which nothing counts from now on, or a negative number to end the
  /// walk.
  virtual double visit_list(CellWord word) = 0;

 protected:
  ~SweptVisitor() = default;
};

/// Visits all cells of a grid that a moving box comes to and that list triangles. It visits at least each cell that
/// has a point which the box meets before the limit. SWEPT_WALK.md has the proof (W1 to W5).
struct SweptWalk {
  const Grid& grid;
  const SweptExtents& swept;
  const CellSlab* slabs;  ///< The slab of each list, or null.
  double limit;           ///< Nothing counts beyond this t, until a list is visited.
  SweptVisitor& visitor;
  std::uint64_t& cells;  ///< Grows by the number of cells that are looked at.

  /// Walks through the outermost grid, and through inner grids where the box comes to their cells. Returns false if the
  /// numbers are too large to be counted in cells. Then nothing was visited.
  [[nodiscard]] bool walk() const;
  /// Walks through one cell of the outermost grid. `walk` must be able to walk the box.
  void walk_top_cell(const std::array<std::uint32_t, 3>& cell, CellWord word) const;
};

}  // namespace surehit
