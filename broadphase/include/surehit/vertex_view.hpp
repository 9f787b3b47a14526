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

template <typename T>
concept EigenMatrix = std::is_base_of_v<Eigen::DenseBase<std::remove_cvref_t<T>>, std::remove_cvref_t<T>>;

/// An Eigen matrix that is memory: a map, a block, or a matrix that has a name. A temporary one would dangle.
template <typename Matrix>
concept ViewableMatrix = EigenMatrix<Matrix> &&
    (std::is_lvalue_reference_v<Matrix> ||
     !std::is_base_of_v<Eigen::PlainObjectBase<std::remove_cvref_t<Matrix>>, std::remove_cvref_t<Matrix>>);

/// Elements side by side that outlive a view of them: a span, or a container that has a name. A view of a temporary
/// container would dangle.
template <typename Range>
concept ViewableRange = !EigenMatrix<Range> && std::ranges::contiguous_range<Range> &&
                        std::ranges::sized_range<Range> && std::ranges::borrowed_range<Range>;

template <typename Range>
using RangeElement = std::remove_cvref_t<std::ranges::range_reference_t<Range>>;

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

/// Three numbers that begin an element.
template <typename T, typename Number>
concept TripleOf = std::same_as<T, std::array<Number, 3>> || std::same_as<T, Number[3]> ||
    std::same_as<T, Eigen::Matrix<Number, 3, 1>> || HasAdjacentXyz<T, Number>;

template <typename Range, typename Number>
concept RangeOfTriples = ViewableRange<Range> && TripleOf<RangeElement<Range>, Number>;
template <typename Range, typename Number>
concept RangeOfNumbers = ViewableRange<Range> && std::same_as<RangeElement<Range>, Number>;

template <typename Matrix>
inline constexpr bool is_columns_of_three = int{Matrix::RowsAtCompileTime} == 3 &&
                                            (int{Matrix::Flags} & Eigen::DirectAccessBit) != 0 &&
                                            (int{Matrix::Flags} & Eigen::RowMajorBit) == 0 &&
                                            int{Matrix::InnerStrideAtCompileTime} == 1;

/// Triples of numbers in memory that somebody else owns. `find_invalid` reports what is wrong with it.
struct TripleArray {
  const std::byte* first = nullptr;
  std::size_t count = 0;      ///< whole triples
  std::size_t stride = 0;     ///< in bytes
  std::size_t left_over = 0;  ///< numbers behind the last whole triple: 0, 1 or 2

  template <typename Range>
  [[nodiscard]] static TripleArray of_triples(const Range& triples) {
    return {bytes(std::ranges::data(triples)), std::ranges::size(triples), sizeof(RangeElement<const Range&>)};
  }
  template <typename Range>
  [[nodiscard]] static TripleArray of_numbers(const Range& numbers) {
    const std::size_t size = std::ranges::size(numbers);
    return {bytes(std::ranges::data(numbers)), size / 3, 3 * sizeof(RangeElement<const Range&>), size % 3};
  }
  template <typename Matrix>
  [[nodiscard]] static TripleArray of_columns(const Matrix& matrix) {
    static_assert(is_columns_of_three<Matrix>, "surehit: column-major, in memory, a point or a triangle each column");
    return {bytes(matrix.data()), static_cast<std::size_t>(matrix.cols()),
            static_cast<std::size_t>(matrix.outerStride()) * sizeof(typename Matrix::Scalar)};
  }
  template <typename Number>
  [[nodiscard]] static TripleArray strided(const Number* first, std::size_t count, std::size_t stride_bytes) {
    return {bytes(first), count, stride_bytes != 0 ? stride_bytes : 3 * sizeof(Number)};
  }

  /// Whether all of it can be read: it is there, whole, and no triple overlaps the next one.
  template <typename Number>
  [[nodiscard]] bool is_valid() const {
    return (first != nullptr || count == 0) && left_over == 0 && stride >= 3 * sizeof(Number);
  }
  /// Number `which` of triple `index`, whatever its alignment.
  template <typename Number>
  [[nodiscard]] Number get(std::size_t index, std::size_t which) const {
    Number number;
    std::memcpy(&number, first + index * stride + which * sizeof number, sizeof number);
    return number;
  }

 private:
  static const std::byte* bytes(const void* address) { return static_cast<const std::byte*>(address); }
};

}  // namespace detail

/// Points in memory that somebody else owns, three Scalars each. It copies nothing and must not outlive the points.
///
/// A view is not checked when it is made: `find_invalid` checks it, and so does every build.
template <FloatOrDouble Scalar>
class VertexView {
 public:
  /// No points.
  VertexView() = default;

  /// A range of points that lie side by side: `Vector3<Scalar>`, `std::array<Scalar, 3>`, `Scalar[3]`, or any struct
  /// that begins with the Scalars x, y and z.
  template <detail::RangeOfTriples<Scalar> Points>
  VertexView(Points&& points SUREHIT_LIFETIMEBOUND) noexcept : triples_(detail::TripleArray::of_triples(points)) {}

  /// A range of the numbers x, y, z, x, y, z, …; a build refuses a size that is no multiple of three.
  template <detail::RangeOfNumbers<Scalar> Numbers>
  VertexView(Numbers&& numbers SUREHIT_LIFETIMEBOUND) noexcept : triples_(detail::TripleArray::of_numbers(numbers)) {}

  /// An Eigen matrix or a map of one, 3×N and column-major: a point each column. An expression that is not memory does
  /// not compile.
  template <detail::ViewableMatrix Matrix>
  VertexView(Matrix&& matrix SUREHIT_LIFETIMEBOUND) noexcept : triples_(detail::TripleArray::of_columns(matrix)) {
    static_assert(std::same_as<typename std::remove_cvref_t<Matrix>::Scalar, Scalar>,
                  "surehit: the points must be of the view's Scalar");
  }

  /// Points that lie `stride_bytes` apart, such as the positions in an interleaved vertex buffer; 0 stands for points
  /// side by side. A build refuses a stride that is smaller than a point.
  [[nodiscard]] static VertexView strided(const Scalar* first SUREHIT_LIFETIMEBOUND, std::size_t point_count,
                                          std::size_t stride_bytes) {
    VertexView view;
    view.triples_ = detail::TripleArray::strided(first, point_count, stride_bytes);
    return view;
  }

  [[nodiscard]] std::size_t size() const { return triples_.count; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] Vector3<Scalar> operator[](std::size_t index) const {
    return {triples_.template get<Scalar>(index, 0), triples_.template get<Scalar>(index, 1),
            triples_.template get<Scalar>(index, 2)};
  }
  /// Whether the points can be read, whatever they are. A view that is not valid is refused by every build.
  [[nodiscard]] bool is_valid() const { return triples_.template is_valid<Scalar>(); }
  /// For those who read the memory themselves.
  [[nodiscard]] const detail::TripleArray& triples() const { return triples_; }

 private:
  detail::TripleArray triples_ = {nullptr, 0, 3 * sizeof(Scalar)};
};

using VertexViewf = VertexView<float>;
using VertexViewd = VertexView<double>;

}  // namespace surehit
