#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
/// A 32-bit integer, or an unsigned 16-bit integer. The 32 bits may have a sign. A negative index is out of range.
template <typename T>
concept VertexIndex = std::same_as<T, std::uint16_t> ||
    (std::integral<T> && sizeof(T) == sizeof(std::uint32_t) && !std::same_as<T, bool>);

/// The index type of a triple. It has no `type` if T is not a triple.
template <typename T>
struct IndexOfTriple {};
/// The index type of a `std::array<Index, 3>`.
template <typename Index>
struct IndexOfTriple<std::array<Index, 3>> {
  using type = Index;  ///< The index type.
};
/// The index type of a `Index[3]`.
template <typename Index>
struct IndexOfTriple<Index[3]> {
  using type = Index;  ///< The index type.
};
/// The index type of a `Eigen::Matrix<Index, 3, 1>`.
template <typename Index>
struct IndexOfTriple<Eigen::Matrix<Index, 3, 1>> {
  using type = Index;  ///< The index type.
};
/// The same as a type.
template <typename T>
using IndexOfTripleT = typename IndexOfTriple<T>::type;
/// A range of triples of indices that does not dangle in a view.
template <typename Range>
concept RangeOfTriangles = ViewableRange<Range> && VertexIndex<IndexOfTripleT<RangeElement<Range>>>;
/// A range of indices that does not dangle in a view.
template <typename Range>
concept RangeOfIndices = ViewableRange<Range> && VertexIndex<RangeElement<Range>>;
/// What a view of triangles is made of.
template <typename T>
concept TriangleSource = RangeOfTriangles<T> || RangeOfIndices<T> || ViewableMatrix<T>;
/// A container of triangles.
template <typename T>
concept TriangleContainer = TriangleSource<T> && !RefersToMemory<T>;
/// A view of triangles, such as a span.
template <typename T>
concept TriangleReference = TriangleSource<T> && RefersToMemory<T>;
}  // namespace detail

/// A view of triangles in memory that the user owns. A triangle is three indices of vertices, of 32 bits or of 16 bits
/// without sign. The view copies nothing, and must not outlive the indices.
///
/// A view is not checked when it is made. `find_invalid` checks it, and so does every build.
class TriangleIndexView {
 public:
  /// Makes a view of no triangles.
  TriangleIndexView() = default;

  /// Makes a view of a container of triangles, which must have a name: a temporary one does not compile. It may be:
  ///
  /// - A range of triangles side by side. A triangle is a `std::array<Index, 3>`, an `Index[3]` or an
  ///   `Eigen::Matrix<Index, 3, 1>`.
  /// - A range of the indices a, b, c, a, b, c, and so on. A build refuses a size that is not a multiple of three.
  /// - A column-major 3×N Eigen matrix. A column is a triangle. An expression that is not memory does not compile.
  template <detail::TriangleContainer Triangles>
  TriangleIndexView(Triangles&& triangles SUREHIT_LIFETIMEBOUND) noexcept
      : triples_(detail::TripleArray::of(triangles)), index_size_(index_size_of(triangles)) {}
  /// Does the same for a `std::span`, an `Eigen::Map`, a block of a matrix, or another view. It may be a temporary one,
  /// but not a block of a temporary matrix, which would dangle.
  template <detail::TriangleReference Triangles>
  TriangleIndexView(Triangles&& triangles) noexcept
      : triples_(detail::TripleArray::of(triangles)), index_size_(index_size_of(triangles)) {}

  /// Returns a view of triangles from `first` on that begin `stride_bytes` apart. 0 means that they lie side by side. A
  /// build refuses a stride that is smaller than a triangle.
  template <detail::VertexIndex Index>
  [[nodiscard]] static TriangleIndexView strided(const Index* first SUREHIT_LIFETIMEBOUND, std::size_t triangle_count,
                                                 std::size_t stride_bytes) {
    TriangleIndexView view;
    view.triples_ = detail::TripleArray::strided(first, triangle_count, stride_bytes);
    view.index_size_ = sizeof(Index);
    return view;
  }

  /// Returns the number of whole triangles.
  [[nodiscard]] std::size_t size() const { return triples_.count; }
  /// Returns true if there are no whole triangles.
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Returns the index of the vertex at a corner. `which` is 0, 1 or 2 for a, b or c. `triangle` must be below
  /// `size()`.
  [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t which) const {
    if (index_size_ == sizeof(std::uint16_t)) return triples_.get<std::uint16_t>(triangle, which);
    return triples_.get<std::uint32_t>(triangle, which);
  }
  /// Returns the address of the first triangle, or null.
  [[nodiscard]] const void* data() const { return triples_.first; }
  /// Returns the bytes from the beginning of one triangle to that of the next.
  [[nodiscard]] std::size_t stride_bytes() const { return triples_.stride; }
  /// Returns the size of an index in bytes: 2 or 4.
  [[nodiscard]] std::size_t index_size() const { return index_size_; }

 private:
  friend struct detail::ViewMemory;

  template <typename Triangles>
  static constexpr std::size_t index_size_of(const Triangles&) {
    if constexpr (detail::EigenMatrix<Triangles>) {
      static_assert(detail::VertexIndex<typename Triangles::Scalar>,
                    "surehit: indices are 32-bit integers, or unsigned 16-bit ones");
      return sizeof(typename Triangles::Scalar);
    } else if constexpr (detail::RangeOfIndices<const Triangles&>) {
      return sizeof(detail::RangeElement<const Triangles&>);
    } else {
      return sizeof(detail::IndexOfTripleT<detail::RangeElement<const Triangles&>>);
    }
  }

  detail::TripleArray triples_ = {nullptr, 0, 3 * sizeof(std::uint32_t)};
  std::size_t index_size_ = sizeof(std::uint32_t);
};

}  // namespace surehit
