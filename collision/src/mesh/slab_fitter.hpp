#pragma once

#include <array>
#include <cstddef>

#include "grid/grid.hpp"
#include "grid/list_cells.hpp"

namespace surehit::detail {

/// Fits slabs to the lists of a grid. Coordinates are floats, and floats must hold the grid's frame.
class SlabFitter {
 public:
  explicit SlabFitter(const GridFrame& frame);

  /// Returns a slab around the triangles of a cell's list, which have the layout of `MeshBlocks::corners`. Numbers
  /// beyond them may be read, but have no effect.
  [[nodiscard]] CellSlab fit(const ListCell& cell, const float* corners, std::size_t count) const;

  /// Places coordinates in units of finest cells. A coordinate x is at (x - low) scale + margin.
  struct Axis {
    float low;     ///< The low side of the mesh's box.
    float scale;   ///< The number of finest cells in a unit of length.
    float margin;  ///< The distance of the grid's first plane from the box.
    float slack;   ///< The extra width of a slab, for each unit of the normal's component.
  };
  std::array<Axis, 3> axes;
};

}  // namespace surehit::detail
