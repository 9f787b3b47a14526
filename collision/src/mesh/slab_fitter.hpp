#pragma once

#include <array>
#include <cstddef>

#include "grid/grid.hpp"
#include "query/list_cells.hpp"

namespace surehit::detail {

/// Fits slabs to a grid's lists of triangles, whose coordinates are floats. The grid's frame must be one of floats.
class SlabFitter {
 public:
  explicit SlabFitter(const GridFrame& frame);

  /// Of the triangles that a cell lists, which are as `MeshBlocks::corners` has them. What may be read beyond them
  /// changes nothing.
  [[nodiscard]] CellSlab fit(const ListCell& cell, const float* corners, std::size_t count) const;

  /// In finest cells, a coordinate is at (x - low) scale + margin.
  struct Axis {
    float low;
    float scale;
    float margin;
    float slack;  ///< by which a slab is wider than its triangles, for each unit of the normal's component
  };
  std::array<Axis, 3> axes;
};

}  // namespace surehit::detail
