#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "surehit/path.hpp"

namespace surehit {

/// Vertices that lie in memory owned by somebody else, three Scalars each, strided. Copies nothing.
template <typename Scalar>
struct VertexView {
  /// Vertex i is the three Scalars at `data` + i `stride`; the stride is in bytes.
  VertexView(const Scalar* data_given, std::size_t count_given, std::size_t stride_given = 3 * sizeof(Scalar))
      : data(data_given), count(count_given), stride(stride_given) {}

  VertexView(std::span<const Vector3<Scalar>> vertices)
      : VertexView(vertices.empty() ? nullptr : vertices.front().data(), vertices.size()) {}

  VertexView(const std::vector<Vector3<Scalar>>& vertices) : VertexView(std::span<const Vector3<Scalar>>(vertices)) {}

  /// From an Eigen matrix or a map of one: a column a vertex (3×N, column-major).
  template <typename Vertices>
  VertexView(const Eigen::DenseBase<Vertices>& vertices)
      : VertexView(vertices.derived().data(), static_cast<std::size_t>(vertices.cols()),
                   static_cast<std::size_t>(vertices.derived().outerStride()) * sizeof(Scalar)) {
    static_assert(std::is_same_v<typename Vertices::Scalar, Scalar>, "the vertices must be of the view's Scalar");
    static_assert(int{Vertices::RowsAtCompileTime} == 3 && (int{Vertices::Flags} & Eigen::RowMajorBit) == 0 &&
                      int{Vertices::InnerStrideAtCompileTime} == 1,
                  "a vertex is a column of three, side by side");
  }

  const Scalar* data;
  std::size_t count;
  std::size_t stride;
};

using VertexViewf = VertexView<float>;
using VertexViewd = VertexView<double>;

}  // namespace surehit
