#pragma once

#include <cstddef>
#include <span>

#include "surehit/path.hpp"

namespace surehit::detail {

/// A batch's paths, all of one kind. Segments, rays and lines lie in memory alike, so that what walks them in lanes is
/// compiled once.
template <typename Scalar>
class PathSpan {
 public:
  static constexpr std::size_t numbers_each = 6;  ///< the start or origin, then the end or direction

  PathSpan(std::span<const Segment<Scalar>> paths) : PathSpan(PathKind::segment, paths) {}
  PathSpan(std::span<const Ray<Scalar>> paths) : PathSpan(PathKind::ray, paths) {}
  PathSpan(std::span<const Line<Scalar>> paths) : PathSpan(PathKind::line, paths) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool have_ends() const { return kind_ == PathKind::segment; }
  [[nodiscard]] const Scalar* numbers(std::size_t i) const { return numbers_ + numbers_each * i; }
  [[nodiscard]] Path<Scalar> operator[](std::size_t i) const {
    const Scalar* x = numbers(i);
    Path<Scalar> path = Segment<Scalar>{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
    path.kind = kind_;
    return path;
  }
  [[nodiscard]] PathSpan subspan(std::size_t first, std::size_t count) const {
    PathSpan some = *this;
    some.numbers_ = numbers(first);
    some.size_ = count;
    return some;
  }

 private:
  template <typename AnyPath>
  PathSpan(PathKind kind, std::span<const AnyPath> paths)
      : kind_(kind), numbers_(reinterpret_cast<const Scalar*>(paths.data())), size_(paths.size()) {
    static_assert(sizeof(AnyPath) == numbers_each * sizeof(Scalar));
  }

  PathKind kind_;
  const Scalar* numbers_;
  std::size_t size_;
};

}  // namespace surehit::detail
