#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
/// 32-bit integers, signed ones too: a negative index is out of range. Or unsigned 16-bit ones.
template <typename T>
concept VertexIndex = std::same_as<T, std::uint16_t> ||
    (std::integral<T> && sizeof(T) == sizeof(std::uint32_t) && !std::same_as<T, bool>);

template <typename T>
struct IndexOfTriple {};
template <typename Index>
struct IndexOfTriple<std::array<Index, 3>> {
  using type = Index;
};
template <typename Index>
struct IndexOfTriple<Index[3]> {
  using type = Index;
};
template <typename Index>
struct IndexOfTriple<Eigen::Matrix<Index, 3, 1>> {
  using type = Index;
};
template <typename T>
using IndexOfTripleT = typename IndexOfTriple<T>::type;
template <typename Range>
concept RangeOfTriangles = ViewableRange<Range> && VertexIndex<IndexOfTripleT<RangeElement<Range>>>;
template <typename Range>
concept RangeOfIndices = ViewableRange<Range> && VertexIndex<RangeElement<Range>>;
}  // namespace detail

/// Triangles in memory that somebody else owns: three indices of vertices each, of 32 bits, or of 16 without sign. It
/// copies nothing and must not outlive the indices.
///
/// A view is not checked when it is made: `find_invalid` checks it, and so does every build.
class TriangleIndexView {
 public:
  /// No triangles.
  TriangleIndexView() = default;

  /// A range of triangles that lie side by side: `std::array<Index, 3>`, `Index[3]` or `Eigen::Matrix<Index, 3, 1>`.
  template <detail::RangeOfTriangles Triangles>
  TriangleIndexView(Triangles&& triangles SUREHIT_LIFETIMEBOUND) noexcept
      : triples_(detail::TripleArray::of_triples(triangles)),
        index_size_(sizeof(detail::IndexOfTripleT<detail::RangeElement<Triangles>>)) {}

  /// A range of the indices a, b, c, a, b, c, …; a build refuses a size that is no multiple of three.
  template <detail::RangeOfIndices Indices>
  TriangleIndexView(Indices&& indices SUREHIT_LIFETIMEBOUND) noexcept
      : triples_(detail::TripleArray::of_numbers(indices)), index_size_(sizeof(detail::RangeElement<Indices>)) {}

  /// An Eigen matrix or a map of one, 3×N and column-major: a triangle each column. An expression that is not memory
  /// does not compile.
  template <detail::ViewableMatrix Matrix>
  TriangleIndexView(Matrix&& matrix SUREHIT_LIFETIMEBOUND) noexcept
      : triples_(detail::TripleArray::of_columns(matrix)),
        index_size_(sizeof(typename std::remove_cvref_t<Matrix>::Scalar)) {
    static_assert(detail::VertexIndex<typename std::remove_cvref_t<Matrix>::Scalar>,
                  "surehit: indices are 32-bit integers, or unsigned 16-bit ones");
  }

  /// Triangles that lie `stride_bytes` apart; 0 stands for triangles side by side. A build refuses a stride that is
  /// smaller than a triangle.
  template <detail::VertexIndex Index>
  [[nodiscard]] static TriangleIndexView strided(const Index* first SUREHIT_LIFETIMEBOUND, std::size_t triangle_count,
                                                 std::size_t stride_bytes) {
    TriangleIndexView view;
    view.triples_ = detail::TripleArray::strided(first, triangle_count, stride_bytes);
    view.index_size_ = sizeof(Index);
    return view;
  }

  [[nodiscard]] std::size_t size() const { return triples_.count; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// The index of corner 0, 1 or 2 (a, b, c) of a triangle.
  [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t which) const {
    if (index_size_ == sizeof(std::uint16_t)) return triples_.get<std::uint16_t>(triangle, which);
    return triples_.get<std::uint32_t>(triangle, which);
  }
  /// For those who read the memory themselves.
  [[nodiscard]] const detail::TripleArray& triples() const { return triples_; }
  /// 2 or 4 bytes.
  [[nodiscard]] std::size_t index_size() const { return index_size_; }

 private:
  detail::TripleArray triples_ = {nullptr, 0, 3 * sizeof(std::uint32_t)};
  std::size_t index_size_ = sizeof(std::uint32_t);
};

}  // namespace surehit
