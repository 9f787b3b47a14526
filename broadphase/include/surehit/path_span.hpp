#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <ranges>
#include <type_traits>

#include "surehit/path.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
/// A segment, a ray or a line.
template <typename T, typename Scalar>
concept PathOf = std::same_as<T, Segment<Scalar>> || std::same_as<T, Ray<Scalar>> || std::same_as<T, Line<Scalar>>;
/// A range of paths of one kind that does not dangle in a view.
template <typename Range, typename Scalar>
concept RangeOfPaths = ViewableRange<Range> && PathOf<RangeElement<Range>, Scalar>;
/// A container of paths.
template <typename Range, typename Scalar>
concept PathContainer = RangeOfPaths<Range, Scalar> && !RefersToMemory<Range>;
/// A view of paths, such as a span.
template <typename Range, typename Scalar>
concept PathReference = RangeOfPaths<Range, Scalar> && RefersToMemory<Range>;
}  // namespace detail

/// A view of paths of one kind in memory that the user owns. It copies nothing, and must not outlive the paths.
///
/// Packed paths are read fastest, see `is_packed`.
template <FloatOrDouble Scalar>
class PathSpan {
 public:
  /// Makes a view of no paths.
  PathSpan() = default;

  /// Makes a view of a container of segments, of rays or of lines side by side. A temporary container does not compile.
  template <detail::PathContainer<Scalar> Paths>
  PathSpan(Paths&& paths SUREHIT_LIFETIMEBOUND) noexcept
      : PathSpan(kind_of<detail::RangeElement<Paths>>, std::ranges::data(paths), std::ranges::size(paths)) {}
  /// Does the same for a `std::span` or another view. It may be a temporary one.
  template <detail::PathReference<Scalar> Paths>
  PathSpan(Paths&& paths) noexcept
      : PathSpan(kind_of<detail::RangeElement<Paths>>, std::ranges::data(paths), std::ranges::size(paths)) {}

  /// Returns a view of segments from starts[i] to ends[i]. It has as many paths as the shorter view has points. It has
  /// none if `VertexView::is_valid` is false for one of the views.
  [[nodiscard]] static PathSpan segments(const VertexView<Scalar>& starts, const VertexView<Scalar>& ends) {
    return {PathKind::segment, starts, ends};
  }
  /// Returns a view of rays from origins[i] along directions[i]. Its size is as in `segments`.
  [[nodiscard]] static PathSpan rays(const VertexView<Scalar>& origins, const VertexView<Scalar>& directions) {
    return {PathKind::ray, origins, directions};
  }
  /// Returns a view of lines through origins[i] along directions[i]. Its size is as in `segments`.
  [[nodiscard]] static PathSpan lines(const VertexView<Scalar>& origins, const VertexView<Scalar>& directions) {
    return {PathKind::line, origins, directions};
  }

  /// Returns the kind of all paths. It is `segment` for a default view.
  [[nodiscard]] PathKind kind() const { return kind_; }
  /// Returns the number of paths.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Returns true if there are no paths.
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Returns a copy of path i, which must be below `size()`.
  [[nodiscard]] Path<Scalar> operator[](std::size_t i) const {
    Scalar x[6];
    copy(i, x);
    return {kind_, {x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }
  /// Returns a view of `count` paths, from path `first` on. All of them must be in this view.
  [[nodiscard]] PathSpan subspan(std::size_t first, std::size_t count) const {
    PathSpan some = *this;
    some.start_ = start_at(first);
    some.toward_ = toward_at(first);
    some.size_ = count;
    return some;
  }

  /// Returns true if each path is six Scalars side by side, as in a `Segment`, and the paths lie side by side.
  [[nodiscard]] bool is_packed() const {
    return size_ == 0 ||
           (start_stride_ == path_bytes && toward_stride_ == path_bytes && toward_ == start_ + path_bytes / 2);
  }
  /// Returns the six Scalars of path i. The paths must be packed, and i must be below `size()`.
  [[nodiscard]] const Scalar* packed(std::size_t i) const { return reinterpret_cast<const Scalar*>(start_at(i)); }
  /// Copies the six Scalars of path i to `numbers`: first the start or origin, then the end or direction. i must be
  /// below `size()`.
  void copy(std::size_t i, Scalar* numbers) const {
    std::memcpy(numbers, start_at(i), path_bytes / 2);
    std::memcpy(numbers + 3, toward_at(i), path_bytes / 2);
  }

 private:
  static constexpr std::size_t path_bytes = 6 * sizeof(Scalar);  ///< The size of a packed path.
  template <typename AnyPath>
  static constexpr PathKind kind_of = std::same_as<AnyPath, Segment<Scalar>> ? PathKind::segment
                                      : std::same_as<AnyPath, Ray<Scalar>>   ? PathKind::ray
                                                                             : PathKind::line;

  template <typename AnyPath>
  PathSpan(PathKind kind, const AnyPath* paths, std::size_t size) : kind_(kind), size_(size) {
    static_assert(sizeof(AnyPath) == path_bytes);
    if (size == 0) return;
    start_ = reinterpret_cast<const std::byte*>(paths);
    toward_ = start_ + path_bytes / 2;
  }

  PathSpan(PathKind kind, const VertexView<Scalar>& starts, const VertexView<Scalar>& towards)
      : kind_(kind),
        size_(starts.is_valid() && towards.is_valid() ? std::min(starts.size(), towards.size()) : 0),
        start_(detail::ViewMemory::of(starts).first),
        toward_(detail::ViewMemory::of(towards).first),
        start_stride_(starts.stride_bytes()),
        toward_stride_(towards.stride_bytes()) {}

  [[nodiscard]] const std::byte* start_at(std::size_t i) const { return start_ + i * start_stride_; }
  [[nodiscard]] const std::byte* toward_at(std::size_t i) const { return toward_ + i * toward_stride_; }

  PathKind kind_ = PathKind::segment;
  std::size_t size_ = 0;
  const std::byte* start_ = nullptr;        ///< The first start or origin.
  const std::byte* toward_ = nullptr;       ///< The first end or direction.
  std::size_t start_stride_ = path_bytes;   ///< The bytes from one start or origin to the next.
  std::size_t toward_stride_ = path_bytes;  ///< The bytes from one end or direction to the next.
};

using PathSpanf = PathSpan<float>;   ///< Paths in float.
using PathSpand = PathSpan<double>;  ///< Paths in double.

}  // namespace surehit
