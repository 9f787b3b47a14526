#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "c/arguments.hpp"
#include "c/task_run.hpp"
#include "c/values.hpp"
#include "surehit/build_result.hpp"
#include "surehit/collider.hpp"
#include "surehit/invalid_mesh.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::c {

/// Fails if an array of points of a mesh would not fit into memory, or lies at no address of a Scalar. What else is
/// wrong with a mesh, its build says.
template <typename Scalar>
[[nodiscard]] VertexView<Scalar> vertices_of(Arguments& arguments, const Scalar* first, std::size_t count,
                                             std::size_t stride) {
  if (stride == 0) stride = 3 * sizeof(Scalar);
  arguments.check_optional(first, "vertices");
  arguments.check_extent(reinterpret_cast<std::uintptr_t>(first), count, stride, "vertices");
  return VertexView<Scalar>::strided(first, count, stride);
}

/// Returns a view of a mesh of C, which has passed the same checks.
template <typename Scalar>
[[nodiscard]] TriangleMeshView<Scalar> mesh_of(Arguments& arguments, const typename Structs<Scalar>::Mesh* mesh) {
  arguments.check_pointer(mesh, "mesh");
  if (!arguments.are_valid()) return {};
  const auto vertices = vertices_of<Scalar>(arguments, mesh->vertices, mesh->vertex_count, mesh->vertex_stride);
  const auto triangles_as = [&]<typename Index>(const Index* first) {
    const std::size_t stride = mesh->triangle_stride != 0 ? mesh->triangle_stride : 3 * sizeof(Index);
    arguments.check_optional(first, "triangles");
    arguments.check_extent(reinterpret_cast<std::uintptr_t>(first), mesh->triangle_count, stride, "triangles");
    return TriangleIndexView::strided(first, mesh->triangle_count, stride);
  };
  switch (mesh->index_size) {
    case 2:
      return {vertices, triangles_as(static_cast<const std::uint16_t*>(mesh->triangles))};
    case 0:
    case 4:
      return {vertices, triangles_as(static_cast<const std::uint32_t*>(mesh->triangles))};
    default:
      arguments.refuse(SUREHIT_INVALID_VALUE, 0, "mesh.index_size is %u, and must be 2 or 4", mesh->index_size);
      return {};
  }
}

/// The options of a build of C.
class AskedBuild {
 public:
  /// Checks the options.
  AskedBuild(Arguments& arguments, const surehit_build_options* given)
      : given_(arguments.read_sized(given, "options")) {
    if (!arguments.are_valid()) return;
    arguments.check_array(given_.masks, given_.mask_count, sizeof *given_.masks, "options.masks");
    check_executor(arguments, given_.executor);
    if (!(given_.cells_per_triangle >= 0 && given_.cells_per_triangle <= 1e300)) {
      arguments.refuse(SUREHIT_INVALID_VALUE, 0, "options.cells_per_triangle is %g", given_.cells_per_triangle);
    }
  }

  /// Returns the options, which must be valid. They refer to this.
  [[nodiscard]] BuildOptions get() const {
    BuildOptions options;
    options.grid.resolution = {given_.resolution_x, given_.resolution_y, given_.resolution_z};
    if (given_.cells_per_triangle != 0) options.grid.cells_per_triangle = given_.cells_per_triangle;
    if (given_.crowded != 0) options.grid.crowded = given_.crowded;
    options.masks = {given_.masks, given_.mask_count};
    options.executor = executor_of(given_.executor);
    return options;
  }

 private:
  surehit_build_options given_;
};

/// Fails if a mesh or its masks were refused.
inline void tell(Arguments& arguments, const InvalidMesh& error) {
  const int status = SUREHIT_TOO_MANY_TRIANGLES + static_cast<int>(error.reason);
  arguments.refuse(static_cast<surehit_status>(status), error.element, "%s", error.what());
}
/// Fails if a build has failed.
inline void tell(Arguments& arguments, const BuildResult& result) {
  if (!result) tell(arguments, result.error());
}

}  // namespace surehit::c
