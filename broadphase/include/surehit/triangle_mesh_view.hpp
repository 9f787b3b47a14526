#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "surehit/invalid_mesh.hpp"
#include "surehit/triangle.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

/// The id that no triangle has: a miss, or nothing to ignore.
inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// A mesh that lies in memory owned by somebody else: vertices of three Scalars, triangles of three indices, of 32 bits
/// or 16.
///
/// Both arrays are strided, so that interleaved vertex buffers are read in place. The view copies nothing and must not
/// outlive the arrays. It is not checked when made: `find_invalid` does that, and every build calls it.
template <typename Scalar>
class TriangleMeshView {
 public:
  /// No vertices, no triangles.
  TriangleMeshView() = default;

  /// Vertex i is the three Scalars at `vertices` + i `vertex_stride`; strides are in bytes.
  TriangleMeshView(const Scalar* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                   std::size_t triangle_count, std::size_t vertex_stride = 3 * sizeof(Scalar),
                   std::size_t triangle_stride = 3 * sizeof(std::uint32_t))
      : TriangleMeshView(vertices, vertex_count, vertex_stride, triangles, triangle_count, triangle_stride) {}
  template <std::same_as<std::uint16_t> Index>
  TriangleMeshView(const Scalar* vertices, std::size_t vertex_count, const Index* triangles, std::size_t triangle_count,
                   std::size_t vertex_stride = 3 * sizeof(Scalar), std::size_t triangle_stride = 3 * sizeof(Index))
      : TriangleMeshView(vertices, vertex_count, vertex_stride, triangles, triangle_count, triangle_stride) {}

  /// From Eigen matrices or maps of them: a column a vertex (3×N) and a column a triangle (3×M, signed or unsigned
  /// 32-bit, a negative index is out of range; or unsigned 16-bit). Expressions that are not memory do not compile, so
  /// nothing is copied unseen.
  template <typename Vertices, typename Triangles>
  TriangleMeshView(const Eigen::DenseBase<Vertices>& vertices, const Eigen::DenseBase<Triangles>& triangles)
      : TriangleMeshView(
            vertices.derived().data(), static_cast<std::size_t>(vertices.cols()),
            static_cast<std::size_t>(vertices.derived().outerStride()) * sizeof(Scalar), triangles.derived().data(),
            static_cast<std::size_t>(triangles.cols()),
            static_cast<std::size_t>(triangles.derived().outerStride()) * sizeof(typename Triangles::Scalar)) {
    using Index = typename Triangles::Scalar;
    static_assert(std::is_same_v<typename Vertices::Scalar, Scalar>, "the vertices must be of the view's Scalar");
    static_assert(
        std::is_same_v<Index, std::uint16_t> || (std::is_integral_v<Index> && sizeof(Index) == sizeof(std::uint32_t)),
        "indices are 32-bit integers, or unsigned 16-bit ones");
    static_assert(int{Vertices::RowsAtCompileTime} == 3 && int{Triangles::RowsAtCompileTime} == 3,
                  "a vertex and a triangle are columns of three");
    static_assert(is_columns_in_memory<Vertices> && is_columns_in_memory<Triangles>,
                  "column-major storage with three adjacent coefficients a column");
  }

  [[nodiscard]] VertexView<Scalar> vertices() const {
    return {reinterpret_cast<const Scalar*>(vertices_), vertex_count_, vertex_stride_};
  }
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  [[nodiscard]] std::size_t triangle_count() const { return triangle_count_; }

  [[nodiscard]] Vector3<Scalar> vertex(std::size_t index) const {
    const std::byte* const address = vertices_ + index * vertex_stride_;
    const auto coordinate = [&](std::size_t axis) {
      Scalar x;  // copied, since a stride may leave it unaligned
      std::memcpy(&x, address + axis * sizeof x, sizeof x);
      return x;
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }

  /// Index of corner 0, 1 or 2 (a, b, c) of a triangle.
  [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t which) const {
    const std::byte* const address = triangles_ + triangle * triangle_stride_ + which * index_size_;
    if (index_size_ == sizeof(std::uint16_t)) return index_at<std::uint16_t>(address);
    return index_at<std::uint32_t>(address);
  }

  [[nodiscard]] Triangle<Scalar> triangle(std::size_t index) const {
    return {vertex(corner(index, 0)), vertex(corner(index, 1)), vertex(corner(index, 2))};
  }

 private:
  template <typename Index>
  TriangleMeshView(const Scalar* vertices, std::size_t vertex_count, std::size_t vertex_stride, const Index* triangles,
                   std::size_t triangle_count, std::size_t triangle_stride)
      : vertices_(reinterpret_cast<const std::byte*>(vertices)),
        triangles_(reinterpret_cast<const std::byte*>(triangles)),
        vertex_count_(vertex_count),
        triangle_count_(triangle_count),
        vertex_stride_(vertex_stride),
        triangle_stride_(triangle_stride),
        index_size_(sizeof(Index)) {}

  template <typename Index>
  static Index index_at(const std::byte* address) {
    Index index;
    std::memcpy(&index, address, sizeof index);
    return index;
  }

  template <typename Matrix>
  static constexpr bool is_columns_in_memory = (int{Matrix::Flags} & Eigen::DirectAccessBit) != 0 &&
                                               (int{Matrix::Flags} & Eigen::RowMajorBit) == 0 &&
                                               int{Matrix::InnerStrideAtCompileTime} == 1;

  const std::byte* vertices_ = nullptr;
  const std::byte* triangles_ = nullptr;
  std::size_t vertex_count_ = 0;
  std::size_t triangle_count_ = 0;
  std::size_t vertex_stride_ = 3 * sizeof(Scalar);
  std::size_t triangle_stride_ = 3 * sizeof(std::uint32_t);
  std::size_t index_size_ = sizeof(std::uint32_t);
};

/// The first thing that keeps the mesh from being built: too many triangles, else the first triangle with an index out
/// of range, else the first vertex, used or not, that is NaN or infinite. Nothing if the mesh is good. Linear time.
template <typename Scalar>
[[nodiscard]] std::optional<InvalidMesh> find_invalid(const TriangleMeshView<Scalar>& mesh);

using TriangleMeshViewf = TriangleMeshView<float>;
using TriangleMeshViewd = TriangleMeshView<double>;

}  // namespace surehit
