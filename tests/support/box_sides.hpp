#pragma once

#include <cstddef>

#include "grid/grid.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "surehit/box.hpp"

namespace surehit::test {

/// Small triangles whose corners are on the sides that the boxes of lists may have, as near as a Scalar comes. The
/// sides are counted as in a grid with these options.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> triangles_on_box_sides(std::size_t count, const GridOptions& options,
                                                           Random& random) {
  GeneratedMesh<Scalar> mesh;
  for (const Scalar x : {Scalar{0}, Scalar{1}}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  const GridFrame frame = Grid(mesh.view(), box_of(mesh.view()), options).frame();
  for (; count > 0; --count) {
    Triangle<Scalar> triangle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = frame.division;
      const auto low = static_cast<double>(random.below(frame.cells[axis]));
      for (Vector3<Scalar>* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        const double place = (low + static_cast<double>(random.between(2, 12)) / CellBox::parts) * cell;
        (*corner)[static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(out_of_frame(frame, axis, place));
      }
    }
    mesh.add(triangle);
  }
  return mesh;
}

}  // namespace surehit::test
