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
template <typename T, typename Scalar>
concept PathOf = std::same_as<T, Segment<Scalar>> || std::same_as<T, Ray<Scalar>> || std::same_as<T, Line<Scalar>>;
template <typename Range, typename Scalar>
concept RangeOfPaths = ViewableRange<Range> && PathOf<RangeElement<Range>, Scalar>;
}  // namespace detail

/// Paths of one kind in memory that somebody else owns. It copies nothing and must not outlive the paths.
///
/// Paths are read fastest where each is six Scalars side by side, as in a `Segment`, and where they lie side by side.
template <FloatOrDouble Scalar>
class PathSpan {
 public:
  /// No paths.
  PathSpan() = default;

  /// A range of segments, of rays or of lines that lie side by side.
  template <detail::RangeOfPaths<Scalar> Paths>
  PathSpan(Paths&& paths SUREHIT_LIFETIMEBOUND) noexcept
      : kind_(kind_of<detail::RangeElement<Paths>>), size_(std::ranges::size(paths)) {
    static_assert(sizeof(detail::RangeElement<Paths>) == path_bytes);
    if (size_ == 0) return;
    start_ = reinterpret_cast<const std::byte*>(std::ranges::data(paths));
    toward_ = start_ + path_bytes / 2;
  }

  /// Path i goes from starts[i] to ends[i], or from origins[i] along directions[i]. Where one view is longer, the rest
  /// of it is not read. A view that `find_invalid` would refuse counts as no paths.
  [[nodiscard]] static PathSpan segments(const VertexView<Scalar>& starts, const VertexView<Scalar>& ends) {
    return {PathKind::segment, starts, ends};
  }
  [[nodiscard]] static PathSpan rays(const VertexView<Scalar>& origins, const VertexView<Scalar>& directions) {
    return {PathKind::ray, origins, directions};
  }
  [[nodiscard]] static PathSpan lines(const VertexView<Scalar>& origins, const VertexView<Scalar>& directions) {
    return {PathKind::line, origins, directions};
  }

  [[nodiscard]] PathKind kind() const { return kind_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] Path<Scalar> operator[](std::size_t i) const {
    Scalar x[6];
    copy(i, x);
    return {kind_, {x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }
  [[nodiscard]] PathSpan subspan(std::size_t first, std::size_t count) const {
    PathSpan some = *this;
    some.start_ = start_at(first);
    some.toward_ = toward_at(first);
    some.size_ = count;
    return some;
  }

  /// Whether each path is six Scalars side by side, and the paths lie side by side.
  [[nodiscard]] bool is_packed() const {
    return start_stride_ == path_bytes && toward_stride_ == path_bytes && toward_ == start_ + path_bytes / 2;
  }
  /// The six Scalars of path i. Valid only if the paths are packed.
  [[nodiscard]] const Scalar* packed(std::size_t i) const { return reinterpret_cast<const Scalar*>(start_at(i)); }
  /// Copies the six Scalars of path i.
  void copy(std::size_t i, Scalar* numbers) const {
    std::memcpy(numbers, start_at(i), path_bytes / 2);
    std::memcpy(numbers + 3, toward_at(i), path_bytes / 2);
  }

 private:
  static constexpr std::size_t path_bytes = 6 * sizeof(Scalar);
  template <typename AnyPath>
  static constexpr PathKind kind_of = std::same_as<AnyPath, Segment<Scalar>> ? PathKind::segment
                                      : std::same_as<AnyPath, Ray<Scalar>>   ? PathKind::ray
                                                                             : PathKind::line;

  PathSpan(PathKind kind, const VertexView<Scalar>& starts, const VertexView<Scalar>& towards)
      : kind_(kind),
        size_(starts.is_valid() && towards.is_valid() ? std::min(starts.size(), towards.size()) : 0),
        start_(starts.triples().first),
        toward_(towards.triples().first),
        start_stride_(starts.triples().stride),
        toward_stride_(towards.triples().stride) {}

  [[nodiscard]] const std::byte* start_at(std::size_t i) const { return start_ + i * start_stride_; }
  [[nodiscard]] const std::byte* toward_at(std::size_t i) const { return toward_ + i * toward_stride_; }

  PathKind kind_ = PathKind::segment;
  std::size_t size_ = 0;
  const std::byte* start_ = nullptr;   ///< the first start or origin
  const std::byte* toward_ = nullptr;  ///< the first end or direction
  std::size_t start_stride_ = path_bytes;
  std::size_t toward_stride_ = path_bytes;
};

using PathSpanf = PathSpan<float>;
using PathSpand = PathSpan<double>;

}  // namespace surehit
