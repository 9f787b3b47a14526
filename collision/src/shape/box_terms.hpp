#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shape/sphere_terms.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// The corners of a triangle that come first and last on each axis of coordinates.
struct AxisExtremes {
  AxisExtremes() = default;
  template <typename Scalar>
  explicit AxisExtremes(const Triangle<Scalar>& triangle) {
    const std::array<const Vector3<Scalar>*, 3> corners = {&triangle.a, &triangle.b, &triangle.c};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      for (std::size_t k = 1; k < 3; ++k) {
        if ((*corners[k])[axis] < (*corners[lowest[i]])[axis]) lowest[i] = k;
        if ((*corners[k])[axis] > (*corners[highest[i]])[axis]) highest[i] = k;
      }
    }
  }

  /// Returns the same from the signs of the edges: `sign(k, i)` is that of edge k on axis i.
  template <typename Sign>
  [[nodiscard]] static AxisExtremes from_edges(const Sign& sign) {
    AxisExtremes extremes;
    for (std::size_t i = 0; i < 3; ++i) {
      if (sign(0, i) < 0) extremes.lowest[i] = 1;
      if (sign(0, i) > 0) extremes.highest[i] = 1;
      if (extremes.lowest[i] == 0 ? sign(2, i) > 0 : sign(1, i) < 0) extremes.lowest[i] = 2;
      if (extremes.highest[i] == 0 ? sign(2, i) < 0 : sign(1, i) > 0) extremes.highest[i] = 2;
    }
    return extremes;
  }

  std::array<std::size_t, 3> lowest = {0, 0, 0};   ///< The first of the lowest corners on each axis.
  std::array<std::size_t, 3> highest = {0, 0, 0};  ///< The first of the highest corners on each axis.
};

/// A moving box and a triangle, in differences. Edge k goes from corner k to the next one.
template <typename Difference, typename Extent>
struct BoxTerms {
  std::array<Vector<Difference>, 3> from_corner;  ///< The start less each corner.
  std::array<Vector<Difference>, 3> edge;         ///< The edges.
  Vector<Difference> step;                        ///< The end less the start.
  Vector<Extent> half_extents;                    ///< The half extents. None is negative.
  AxisExtremes extremes;                          ///< The extreme corners on each axis of coordinates.
};

/// The axes of the faces of K (B1). The first three are those of coordinates. The fourth is the triangle's normal. Then
/// come the products of each edge with each axis of coordinates.
inline constexpr std::size_t normal_axis = 3;
inline constexpr std::size_t axis_count = 13;
[[nodiscard]] constexpr std::size_t axis_of(std::size_t edge, std::size_t coordinate) {
  return normal_axis + 1 + 3 * edge + coordinate;
}
[[nodiscard]] constexpr std::size_t edge_of(std::size_t axis) { return (axis - normal_axis - 1) / 3; }
[[nodiscard]] constexpr std::size_t coordinate_of(std::size_t axis) { return (axis - normal_axis - 1) % 3; }
[[nodiscard]] constexpr std::size_t next(std::size_t index) { return index == 2 ? 0 : index + 1; }

[[nodiscard]] inline Bounded magnitude(const Bounded& x) { return {std::fabs(x.value), x.radius}; }
[[nodiscard]] inline Sized magnitude(const Sized& x) { return {std::fabs(x.value), x.size}; }
template <int Bits>
[[nodiscard]] WideInt<Bits> magnitude(const WideInt<Bits>& x) {
  return x.sign() < 0 ? negated(x) : x;
}

/// Returns the sign of a number if it is certain.
template <typename Number>
[[nodiscard]] std::optional<int> certain_sign(const Number& x) {
  return x.sign();
}

/// Calls `take` for both sides of one axis: take(axis, is_above, gap, approach). The centre is outside of this side at
/// t if gap - t approach > 0 (B1). `is_above` tells the side beyond the upper bound from that below the lower bound.
template <typename Terms, typename Take>
void take_coordinate(const Terms& terms, std::size_t i, const Take& take) {
  const auto& h = terms.half_extents[i];
  const auto& step = terms.step[i];
  take(i, true, terms.from_corner[terms.extremes.highest[i]][i] - h, negated(step));
  take(i, false, negated(terms.from_corner[terms.extremes.lowest[i]][i]) - h, step);
}
/// Does the same for the normal n.
template <typename Terms, typename Normal, typename Take>
void take_normal(const Terms& terms, const Normal& n, const Take& take) {
  const auto height = dot(n, terms.from_corner[0]);
  const auto rate = dot(n, terms.step);
  const Normal sizes = {magnitude(n[0]), magnitude(n[1]), magnitude(n[2])};
  const auto reach = dot(sizes, terms.half_extents);
  take(normal_axis, true, height - reach, negated(rate));
  take(normal_axis, false, negated(height) - reach, rate);
}
/// Does the same for the product of edge k and an axis of coordinates. If the third corner is certainly below the edge,
/// `below` is 1. If it is above, -1. Only the side of the edge counts then (B2).
template <typename Terms, typename Take>
void take_edge(const Terms& terms, std::size_t k, std::size_t coordinate, int below, const Take& take) {
  const std::size_t i = next(coordinate);
  const std::size_t j = next(i);
  const auto& e = terms.edge[k];
  if (certain_sign(e[i]) == 0 || certain_sign(e[j]) == 0) return;  // B3
  const auto& w = terms.from_corner[k];
  const auto& d = terms.step;
  const auto& h = terms.half_extents;
  const auto height = e[j] * w[i] - e[i] * w[j];
  const auto rate = e[j] * d[i] - e[i] * d[j];
  const auto reach = magnitude(e[j]) * h[i] + magnitude(e[i]) * h[j];
  if (below >= 0) take(axis_of(k, coordinate), true, height - reach, negated(rate));
  if (below <= 0) take(axis_of(k, coordinate), false, negated(height) - reach, rate);
}

}  // namespace surehit::detail
