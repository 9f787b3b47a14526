#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "build/cell_lister.hpp"
#include "build/vertex_lanes.hpp"
#include "grid/grid_frame.hpp"
#include "support/in_parts.hpp"
#include "surehit/box.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::detail {

/// The triangles of a mesh, as a grid lists them. `GridBuild` lists whatever has these functions, and a lister that
/// tests its shapes against cells.
template <typename Scalar>
class ListedTriangles {
 public:
  /// The number of vertices in a task of an executor.
  static constexpr std::size_t vertices_in_a_part = std::size_t{1} << 13;

  /// `points` is memory for the positions of the vertices. All arguments must outlive this.
  ListedTriangles(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, UnsetVector<PaddedPoint>& points)
      : mesh_(mesh), box_(box), points_(points) {}

  [[nodiscard]] std::size_t count() const { return mesh_.triangle_count(); }
  /// Returns the frame of a grid around all of them.
  [[nodiscard]] GridFrame frame(const std::array<double, 3>& cells, std::uint32_t division) const {
    return GridFrame::around(box_, cells, division);
  }
  /// Returns the edges of the box around all of them, in the scaled frame.
  [[nodiscard]] std::array<double, 3> width(const GridFrame& frame) const {
    std::array<double, 3> width;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      width[axis] = frame.scaled(box_.high[static_cast<Eigen::Index>(axis)]) - frame.origin[axis];
    }
    return width;
  }
  /// Returns the edges of the box of one of them, in the scaled frame.
  [[nodiscard]] std::array<double, 3> extent(const GridFrame& frame, std::size_t triangle) const {
    const Vector3<Scalar> a = mesh_.vertex(mesh_.corner(triangle, 0));
    const Vector3<Scalar> b = mesh_.vertex(mesh_.corner(triangle, 1));
    const Vector3<Scalar> c = mesh_.vertex(mesh_.corner(triangle, 2));
    const Vector3<Scalar> low = a.cwiseMin(b).cwiseMin(c);
    const Vector3<Scalar> high = a.cwiseMax(b).cwiseMax(c);
    std::array<double, 3> extent;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      extent[axis] = frame.scaled(high[at]) - frame.scaled(low[at]);
    }
    return extent;
  }

  /// Computes the positions of all vertices in finest cells. The functions below need them.
  void compute_points(const GridFrame& frame, const Executor* executor) {
    points_.resize(mesh_.vertex_count());
    const VertexLanes<Scalar> vertices(mesh_);
    Float4 margin = frame.float_margin;
    margin[3] = 0;
    const auto to_cells = [&](std::size_t i) -> PaddedPoint {
      if constexpr (std::is_same_v<Scalar, float>) {
        if (frame.has_floats) {
          Float4 vertex;
          vertices.load(i, vertex);
          return (vertex - frame.float_low) * frame.float_scale + margin;
        }
      }
      const Vector3<Scalar> vertex = mesh_.vertex(i);
      const auto coordinate = [&](std::size_t axis) {
        return static_cast<float>(frame.to_cells(axis, frame.scaled(vertex[static_cast<Eigen::Index>(axis)])));
      };
      return PaddedPoint{coordinate(0), coordinate(1), coordinate(2), 0};
    };
    in_parts(executor, points_.size(), vertices_in_a_part, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) points_[i] = to_cells(i);
    });
  }

  /// Finds the cells that shapes meet.
  using Lister = CellLister;
  /// What the overlap test needs of a triangle, in finest cells.
  using Shape = CellLister::Corners;
  [[nodiscard]] Shape shape(std::uint32_t triangle) const {
    const auto point = [&](std::size_t corner) { return points_[mesh_.corner(triangle, corner)]; };
    return {point(0), point(1), point(2)};
  }
  [[nodiscard]] static PaddedBox box_of(const Shape& shape) {
    const auto& [a, b, c] = shape;
    return {min(min(a, b), c), max(max(a, b), c)};
  }

 private:
  const TriangleMeshView<Scalar>& mesh_;
  const Box<Scalar>& box_;
  UnsetVector<PaddedPoint>& points_;
};

}  // namespace surehit::detail
