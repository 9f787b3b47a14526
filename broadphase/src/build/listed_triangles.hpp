#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "build/cell_lister.hpp"
#include "build/vertex_lanes.hpp"
#include "grid/grid_frame.hpp"
#include "support/in_parts.hpp"
#include "surehit/box.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::detail {

/// Computes the positions of a mesh's vertices in finest cells. The arguments must outlive this.
template <typename Scalar>
class VertexPoints {
 public:
  VertexPoints(const TriangleMeshView<Scalar>& mesh, const GridFrame& frame)
      : mesh_(mesh), frame_(frame), vertices_(mesh), margin_(frame.float_margin) {
    margin_[3] = 0;
  }

  [[nodiscard]] PaddedPoint operator[](std::size_t i) const {
    if constexpr (std::is_same_v<Scalar, float>) {
      if (frame_.has_floats) {
        Float4 vertex;
        vertices_.load(i, vertex);
        return (vertex - frame_.float_low) * frame_.float_scale + margin_;
      }
    }
    const Vector3<Scalar> vertex = mesh_.vertex(i);
    const auto coordinate = [&](std::size_t axis) {
      return static_cast<float>(frame_.to_cells(axis, frame_.scaled(vertex[static_cast<Eigen::Index>(axis)])));
    };
    return PaddedPoint{coordinate(0), coordinate(1), coordinate(2), 0};
  }

 private:
  const TriangleMeshView<Scalar>& mesh_;
  const GridFrame& frame_;
  VertexLanes<Scalar> vertices_;
  Float4 margin_;
};

/// Returns the edges of a box in the scaled frame.
template <typename Scalar>
std::array<double, 3> scaled_extent(const GridFrame& frame, const Vector3<Scalar>& low, const Vector3<Scalar>& high) {
  std::array<double, 3> extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    extent[axis] = frame.scaled(high[at]) - frame.scaled(low[at]);
  }
  return extent;
}

/// Returns the box of a triangle of a mesh.
template <typename Scalar>
Box<Scalar> box_of_triangle(const TriangleMeshView<Scalar>& mesh, std::size_t triangle) {
  const Vector3<Scalar> a = mesh.vertex(mesh.corner(triangle, 0));
  const Vector3<Scalar> b = mesh.vertex(mesh.corner(triangle, 1));
  const Vector3<Scalar> c = mesh.vertex(mesh.corner(triangle, 2));
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// The triangles of a mesh, as a grid lists them. `GridBuild` lists whatever has these functions, and a lister that
/// tests its shapes against cells. What is listed has numbers from 0 to below `count`.
template <typename Scalar>
class ListedTriangles {
 public:
  /// The number of vertices in a task of an executor.
  static constexpr std::size_t vertices_in_a_part = std::size_t{1} << 13;

  /// `points` is memory for the positions of the vertices. All arguments must outlive this.
  ListedTriangles(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, ScratchVector<PaddedPoint>& points)
      : mesh_(mesh), box_(box), points_(points) {}

  [[nodiscard]] std::size_t count() const { return mesh_.triangle_count(); }
  /// Returns the id of triangle number i.
  [[nodiscard]] std::uint32_t id(std::uint32_t i) const { return i; }
  /// Returns the box around all of them.
  [[nodiscard]] const Box<Scalar>& box() const { return box_; }
  /// Returns the edges of the box of one of them, in the scaled frame.
  [[nodiscard]] std::array<double, 3> extent(const GridFrame& frame, std::size_t triangle) const {
    const Box<Scalar> box = box_of_triangle(mesh_, triangle);
    return scaled_extent(frame, box.low, box.high);
  }

  /// Computes the positions of all vertices in finest cells. The functions below need them.
  void compute_points(const GridFrame& frame, const Executor* executor) {
    points_.resize(mesh_.vertex_count());
    const VertexPoints<Scalar> points(mesh_, frame);
    in_parts(executor, points_.size(), vertices_in_a_part, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) points_[i] = points[i];
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
  ScratchVector<PaddedPoint>& points_;
};

/// Some triangles of a mesh, as an inner grid lists them. The functions do the same as those of `ListedTriangles`.
template <typename Scalar>
class InnerTriangles {
 public:
  /// `ids` has the triangles in ascending order, at least one. The mesh and the ids must outlive this.
  InnerTriangles(const TriangleMeshView<Scalar>& mesh, std::span<const std::uint32_t> ids)
      : mesh_(mesh), ids_(ids), box_(box_of_triangle(mesh, ids.front())) {
    for (const std::uint32_t id : ids.subspan(1)) {
      const Box<Scalar> box = box_of_triangle(mesh, id);
      box_ = {box_.low.cwiseMin(box.low), box_.high.cwiseMax(box.high)};
    }
  }

  [[nodiscard]] std::size_t count() const { return ids_.size(); }
  [[nodiscard]] std::uint32_t id(std::uint32_t i) const { return ids_[i]; }
  [[nodiscard]] const Box<Scalar>& box() const { return box_; }
  [[nodiscard]] std::array<double, 3> extent(const GridFrame& frame, std::size_t i) const {
    const Box<Scalar> box = box_of_triangle(mesh_, ids_[i]);
    return scaled_extent(frame, box.low, box.high);
  }

  /// Keeps the frame, which must outlive the calls of `shape`.
  void compute_points(const GridFrame& frame, const Executor* /*executor*/) { points_.emplace(mesh_, frame); }

  using Lister = CellLister;
  using Shape = CellLister::Corners;
  [[nodiscard]] Shape shape(std::uint32_t i) const {
    const auto point = [&](std::size_t corner) { return (*points_)[mesh_.corner(ids_[i], corner)]; };
    return {point(0), point(1), point(2)};
  }
  [[nodiscard]] static PaddedBox box_of(const Shape& shape) { return ListedTriangles<Scalar>::box_of(shape); }

 private:
  const TriangleMeshView<Scalar>& mesh_;
  std::span<const std::uint32_t> ids_;
  Box<Scalar> box_;
  std::optional<VertexPoints<Scalar>> points_;
};

}  // namespace surehit::detail
