#include "build/triangle_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "support/rounding_flags.hpp"

namespace surehit::detail {

// The roundings. eps is the unit roundoff 2^-24. R is the resolution, and E the maximum component of the edges, both in
// finest cells.
//
// A shadow's axis (l, m) has the components of an edge, rounded once. It needs no bound: if triangle and box meet,
// their shadows overlap on any axis. Let L be |l| + |m|. A corner's position on the axis is a sum of two products of
// numbers up to R, so it is off by 2 eps R L. The position of the box's centre is off by as much. The half length of
// the box's shadow is at most R L / 2, and has 3 roundings: 1.5 eps R L. The difference of both has one rounding of at
// most 0.5 eps R L. In sum that is 6 eps R L. A box that is grown by less than 8 eps R covers it.
//
// Each component of the normal is off by 8 eps E^2. Each of its two products has 3 roundings, and their difference has
// one. On the exact normal all corners have the same height. So on the computed one their heights differ by up to
// 3 E 8 eps E^2. For a thin triangle, |normal| is much less than E^2. So a term of its own covers this: 64 eps E^3.
//
// A height along the normal is three products of up to |normal| times a coordinate, and their sum. The second term of
// the slack covers these roundings for the triangle's coordinates. The padding covers them for the box's half lengths.
TriangleOverlap::TriangleOverlap(const std::array<CellPoint, 3>& corners, const CellPoint& padding)
    : padding_(padding) {
  constexpr float eps = 0x1p-24F;
  std::array<CellPoint, 3> edges;
  float longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      edges[i][axis] = corners[(i + 1) % 3][axis] - corners[i][axis];
      longest = std::max(longest, std::fabs(edges[i][axis]));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
      Shadow& shadow = shadows_[3 * k + i];
      shadow.l = edges[i][m];
      shadow.m = -edges[i][l];
      const auto along = [&](const CellPoint& point) { return point[l] * shadow.l + point[m] * shadow.m; };
      const float a = along(corners[0]);
      const float b = along(corners[1]);
      const float c = along(corners[2]);
      shadow.low = std::min(std::min(a, b), c);
      shadow.high = std::max(std::max(a, b), c);
    }
  }
  float far = 0;
  height_ = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    normal_[k] = edges[0][l] * edges[1][m] - edges[0][m] * edges[1][l];
    height_ += normal_[k] * corners[0][k];
    far = std::max(far, std::fabs(corners[0][k]));
  }
  const float size = std::fabs(normal_[0]) + std::fabs(normal_[1]) + std::fabs(normal_[2]);
  height_slack_ = 64 * eps * longest * longest * longest + 16 * eps * size * (far + longest);
}

bool TriangleOverlap::meets(const CellPoint& low, const CellPoint& high) const {
  CellPoint centre;
  CellPoint half;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis] = (low[axis] + high[axis]) / 2;
    half[axis] = (high[axis] - low[axis]) / 2 + padding_[axis];
  }
  float height = height_;
  float reach = height_slack_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    height -= normal_[axis] * centre[axis];
    reach += std::fabs(normal_[axis]) * half[axis];
  }
  if (std::fabs(height) > reach) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const Shadow& shadow = shadows_[3 * k + i];
      const float middle = centre[l] * shadow.l + centre[m] * shadow.m;
      const float half_shadow = half[l] * std::fabs(shadow.l) + half[m] * std::fabs(shadow.m);
      if (shadow.low - middle > half_shadow || middle - shadow.high > half_shadow) return false;
    }
  }
  return true;
}

}  // namespace surehit::detail
