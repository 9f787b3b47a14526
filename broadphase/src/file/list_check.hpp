#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "grid/grid.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::detail {

/// The first fault in the lists of a grid.
struct ListFault {
  /// What is wrong.
  enum class Kind : std::uint8_t {
    no_list,      ///< The triangle meets a cell that counts as empty.
    missing,      ///< The triangle meets the cell of the list, but it is not the next one that is listed.
    outside_box,  ///< The box of the list does not hold the parts of the cell that the triangles take up.
    too_many,     ///< The list has the triangle, which does not meet its cell.
    inner_box,    ///< The box of the inner grid is not that of its triangles.
    inner_share,  ///< The inner grids have too many triangles.
  };
  Kind kind = Kind::no_list;
  std::size_t entry = 0;       ///< The index of the entry where the triangle should be, or should not be.
  std::size_t inner_grid = 0;  ///< The index of the inner grid whose box is wrong.
  std::uint32_t triangle = 0;  ///< The triangle.
};

/// Returns the first fault in a grid's lists, or nothing. The lists are then those that a build makes: each cell lists
/// the triangles that meet it (premise 3 of WALK.md), and no others. Each box of a list holds what L3 of WALK.md needs,
/// and so does the box of each inner grid.
///
/// The grid's frame must be around the mesh's box. The lists may have any entries. It finds all cells
/// of all triangles anew, because no less proves that none is missing. It takes time linear in the entries and cells,
/// for any grid, as it ends with the first fault. Allocates a part of the memory of the grid.
template <typename Scalar>
[[nodiscard]] std::optional<ListFault> find_list_fault(const TriangleMeshView<Scalar>& mesh, const Grid& grid);

}  // namespace surehit::detail
