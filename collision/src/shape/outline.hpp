#pragma once

#include <array>
#include <cstddef>

#include "surehit/triangle.hpp"

namespace surehit::detail {

/// The corners and edges of a triangle that count. A triangle without area is a segment: the edge between its two
/// extreme corners. If it has no length either, it is the first corner.
struct Outline {
  bool has_face = true;                              ///< True if the triangle has an area.
  std::array<bool, 3> edges = {true, true, true};    ///< The edges that count.
  std::array<bool, 3> corners = {true, true, true};  ///< The corners that count.
};

/// The corners that come first and last in lexicographic order. Of equal corners, the first one counts.
struct ExtremeCorners {
  template <typename Scalar>
  explicit ExtremeCorners(const Triangle<Scalar>& triangle) {
    const std::array<const Vector3<Scalar>*, 3> corners = {&triangle.a, &triangle.b, &triangle.c};
    const auto before = [](const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
      return x[0] != y[0] ? x[0] < y[0] : x[1] != y[1] ? x[1] < y[1] : x[2] < y[2];
    };
    for (std::size_t k = 1; k < 3; ++k) {
      if (before(*corners[k], *corners[first])) first = k;
      if (before(*corners[last], *corners[k])) last = k;
    }
  }

  std::size_t first = 0;
  std::size_t last = 0;
};

/// Returns the outline of a triangle without area: the edge between its extreme corners, or the first corner. A placed
/// triangle has the outline that it has in the mesh: along a line, the images are in the same order or in the opposite
/// one.
template <typename Scalar>
[[nodiscard]] Outline outline_without_area(const Triangle<Scalar>& triangle) {
  const ExtremeCorners extremes(triangle);
  const std::size_t min = extremes.first;
  const std::size_t max = extremes.last;
  Outline outline;
  outline.has_face = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k == 2 ? 0 : k + 1;
    outline.corners[k] = k == min || k == max;
    outline.edges[k] = min != max && ((k == min && end == max) || (k == max && end == min));
  }
  return outline;
}

}  // namespace surehit::detail
