#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <ranges>
#include <span>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/path.hpp"

namespace surehit {

namespace detail {

/// Any Eigen expression.
template <typename T>
concept EigenMatrix = std::is_base_of_v<Eigen::DenseBase<std::remove_cvref_t<T>>, std::remove_cvref_t<T>>;

/// True for an `Eigen::Ref` to a constant matrix, which may own a copy of it.
template <typename T>
inline constexpr bool may_own_copy = false;
template <typename Matrix, int options, typename Stride>
inline constexpr bool may_own_copy<Eigen::Ref<const Matrix, options, Stride>> = true;

/// An Eigen matrix that is memory: a map, a block, or a matrix that has a name. A temporary matrix would dangle. So
/// would a temporary block of one, but its type does not tell.
template <typename Matrix>
concept ViewableMatrix = EigenMatrix<Matrix> &&
    (std::is_lvalue_reference_v<Matrix> ||
     !(std::is_base_of_v<Eigen::PlainObjectBase<std::remove_cvref_t<Matrix>>, std::remove_cvref_t<Matrix>> ||
       may_own_copy<std::remove_cvref_t<Matrix>>));

/// A range of elements that lie side by side and outlive a view: a span, or a container that has a name. A view of a
/// temporary container would dangle.
template <typename Range>
concept ViewableRange = !EigenMatrix<Range> && std::ranges::contiguous_range<Range> &&
                        std::ranges::sized_range<Range> && std::ranges::borrowed_range<Range>;

/// A span, an Eigen map or the like. It may end before a view of the memory that it refers to. A container may not.
template <typename T>
concept RefersToMemory = std::ranges::enable_borrowed_range<std::remove_cvref_t<T>> ||
    (EigenMatrix<T> && !std::is_base_of_v<Eigen::PlainObjectBase<std::remove_cvref_t<T>>, std::remove_cvref_t<T>>);

/// The type of a range's elements.
template <typename Range>
using RangeElement = std::remove_cvref_t<std::ranges::range_reference_t<Range>>;

/// A struct that begins with the numbers x, y and z, side by side.
template <typename T, typename Number>
concept HasAdjacentXyz = std::is_standard_layout_v<T> && requires(T point) {
  requires std::same_as<decltype(point.x), Number>;
  requires std::same_as<decltype(point.y), Number>;
  requires std::same_as<decltype(point.z), Number>;
  requires offsetof(T, x)
  == 0;
  requires offsetof(T, y)
  == sizeof(Number);
  requires offsetof(T, z)
  == 2 * sizeof(Number);
};

/// An element that begins with three numbers.
template <typename T, typename Number>
concept TripleOf = std::same_as<T, std::array<Number, 3>> || std::same_as<T, Number[3]> ||
    std::same_as<T, Eigen::Matrix<Number, 3, 1>> || HasAdjacentXyz<T, Number>;

/// A range of triples of numbers that does not dangle in a view.
template <typename Range, typename Number>
concept RangeOfTriples = ViewableRange<Range> && TripleOf<RangeElement<Range>, Number>;
/// A range of numbers that does not dangle in a view.
template <typename Range, typename Number>
concept RangeOfNumbers = ViewableRange<Range> && std::same_as<RangeElement<Range>, Number>;

/// What a view of points is made of.
template <typename T, typename Number>
concept PointSource = RangeOfTriples<T, Number> || RangeOfNumbers<T, Number> || ViewableMatrix<T>;
/// A container of points.
template <typename T, typename Number>
concept PointContainer = PointSource<T, Number> && !RefersToMemory<T>;
/// A view of points, such as a span.
template <typename T, typename Number>
concept PointReference = PointSource<T, Number> && RefersToMemory<T>;

/// True if the matrix is column-major memory of three rows. Columns may lie apart.
template <typename Matrix>
inline constexpr bool is_columns_of_three = int{Matrix::RowsAtCompileTime} == 3 &&
                                            (int{Matrix::Flags} & Eigen::DirectAccessBit) != 0 &&
                                            (int{Matrix::Flags} & Eigen::RowMajorBit) == 0 &&
                                            int{Matrix::InnerStrideAtCompileTime} == 1;

/// Triples of numbers in memory that the user owns. `find_invalid` reports what is wrong with it.
struct TripleArray {
  const std::byte* first = nullptr;  ///< The first triple, or null.
  std::size_t count = 0;             ///< The number of whole triples.
  std::size_t stride = 0;            ///< The bytes from the beginning of one triple to that of the next.
  std::size_t left_over = 0;         ///< The number of numbers after the last whole triple: 0, 1 or 2.

  /// Returns the triples of a range of triples, of a range of numbers, or of a matrix.
  template <typename Source>
  [[nodiscard]] static TripleArray of(const Source& source) {
    if constexpr (EigenMatrix<Source>) {
      return of_columns(source);
    } else if constexpr (std::is_arithmetic_v<RangeElement<const Source&>>) {
      return of_numbers(source);
    } else {
      return of_triples(source);
    }
  }
  /// Returns the triples of a range of triples.
  template <typename Range>
  [[nodiscard]] static TripleArray of_triples(const Range& triples) {
    return {bytes(std::ranges::data(triples)), std::ranges::size(triples), sizeof(RangeElement<const Range&>)};
  }
  /// Returns the triples of a range of numbers.
  template <typename Range>
  [[nodiscard]] static TripleArray of_numbers(const Range& numbers) {
    const std::size_t size = std::ranges::size(numbers);
    return {bytes(std::ranges::data(numbers)), size / 3, 3 * sizeof(RangeElement<const Range&>), size % 3};
  }
  /// Returns the columns of a matrix.
  template <typename Matrix>
  [[nodiscard]] static TripleArray of_columns(const Matrix& matrix) {
    static_assert(is_columns_of_three<Matrix>, "surehit: column-major, in memory, a point or a triangle each column");
    return {bytes(matrix.data()), static_cast<std::size_t>(matrix.cols()),
            static_cast<std::size_t>(matrix.outerStride()) * sizeof(typename Matrix::Scalar)};
  }
  /// Returns triples that begin `stride_bytes` apart, or side by side if that is 0.
  template <typename Number>
  [[nodiscard]] static TripleArray strided(const Number* first, std::size_t count, std::size_t stride_bytes) {
    return {bytes(first), count, stride_bytes != 0 ? stride_bytes : 3 * sizeof(Number)};
  }

  /// Returns true if all of it can be read. The array is not null, all triples are whole, and none overlaps the next.
  template <typename Number>
  [[nodiscard]] bool is_valid() const {
    return (first != nullptr || count == 0) && left_over == 0 && stride >= 3 * sizeof(Number);
  }
  /// Returns number `which` of triple `index`. The number may have any alignment.
  template <typename Number>
  [[nodiscard]] Number get(std::size_t index, std::size_t which) const {
    Number number;
    std::memcpy(&number, first + index * stride + which * sizeof number, sizeof number);
    return number;
  }

 private:
  /// Returns the address of a byte.
  static const std::byte* bytes(const void* address) { return static_cast<const std::byte*>(address); }
};

/// Shows the library how the memory of a view is laid out.
struct ViewMemory {
  /// Returns the triples of a view.
  template <typename View>
  [[nodiscard]] static const TripleArray& of(const View& view) {
    return view.triples_;
  }
};

}  // namespace detail

/// A view of points in memory that the user owns, three Scalars each. It copies nothing, and must not outlive the
/// points.
///
/// A view is not checked when it is made. `find_invalid` checks it, and so does every build.
template <FloatOrDouble Scalar>
class VertexView {
 public:
  /// Makes a view of no points.
  VertexView() = default;

  /// Makes a view of a container of points, which must have a name: a temporary one does not compile. It may be:
  ///
  /// - A range of points side by side. A point is a `Vector3<Scalar>`, a `std::array<Scalar, 3>` or a `Scalar[3]`.
  ///   It may also be a standard-layout struct that begins with the Scalars x, y and z, side by side.
  /// - A range of the numbers x, y, z, x, y, z, and so on. A build refuses a size that is not a multiple of three.
  /// - A column-major 3×N Eigen matrix. A column is a point. An expression that is not memory does not compile.
  template <detail::PointContainer<Scalar> Points>
  VertexView(Points&& points SUREHIT_LIFETIMEBOUND) noexcept : triples_(triples_of(points)) {}
  /// Does the same for a `std::span`, an `Eigen::Map`, a block of a matrix, or another view. It may be a temporary one,
  /// but not a block of a temporary matrix, which would dangle.
  template <detail::PointReference<Scalar> Points>
  VertexView(Points&& points) noexcept : triples_(triples_of(points)) {}

  /// Returns a view of points from `first` on that begin `stride_bytes` apart, as in an interleaved vertex buffer. 0
  /// means that they lie side by side. A build refuses a stride that is smaller than a point.
  [[nodiscard]] static VertexView strided(const Scalar* first SUREHIT_LIFETIMEBOUND, std::size_t point_count,
                                          std::size_t stride_bytes) {
    VertexView view;
    view.triples_ = detail::TripleArray::strided(first, point_count, stride_bytes);
    return view;
  }

  /// Returns the number of whole points.
  [[nodiscard]] std::size_t size() const { return triples_.count; }
  /// Returns true if there are no whole points.
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Returns a copy of a point. `index` must be below `size()`.
  [[nodiscard]] Vector3<Scalar> operator[](std::size_t index) const {
    return {triples_.template get<Scalar>(index, 0), triples_.template get<Scalar>(index, 1),
            triples_.template get<Scalar>(index, 2)};
  }
  /// Returns true if the points can be read: the array is not null, the points are whole, and none overlaps the next.
  /// Their coordinates are not read, so they may be NaN or infinite. A build refuses a view that is not valid.
  [[nodiscard]] bool is_valid() const { return triples_.template is_valid<Scalar>(); }
  /// Returns the address of the first point, or null.
  [[nodiscard]] const void* data() const { return triples_.first; }
  /// Returns the bytes from the beginning of one point to that of the next.
  [[nodiscard]] std::size_t stride_bytes() const { return triples_.stride; }

 private:
  friend struct detail::ViewMemory;

  template <typename Points>
  static detail::TripleArray triples_of(const Points& points) {
    if constexpr (detail::EigenMatrix<Points>) {
      static_assert(std::same_as<typename Points::Scalar, Scalar>, "surehit: the points must be of the view's Scalar");
    }
    return detail::TripleArray::of(points);
  }

  detail::TripleArray triples_ = {nullptr, 0, 3 * sizeof(Scalar)};
};

using VertexViewf = VertexView<float>;   ///< Points in float.
using VertexViewd = VertexView<double>;  ///< Points in double.

}  // namespace surehit
