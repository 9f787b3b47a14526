#include "build/triangle_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::detail {

// The roundings, with u = 2^-24, R the resolution and E the edges' greatest component, both in finest cells.
//
// A shadow's axis has the components of an edge e, rounded once. Its ends p = x_y z - x_z y, and the box's centre s
// alike, are products and a difference of numbers up to R: each is off by 3 u R (|y| + |z|), as are the half lengths of
// the box in it by 3 u of themselves, and the edge's own rounding counts as u R (|y| + |z|) once more: it turns the
// axis, and any axis whatever separates truly if it separates by more than that. In all less than 8 u R (|y| + |z|),
// which is what a padding greater by 8 u R covers.
//
// The normal has two roundings of the edges and two of their products: each component is off by 6 u E^2. An axis may be
// any; but the triangle must be flat along it to be one height, and is so but for 6 u E^2 times its size, 3 E. A height
// along it is three products of up to R |n|. For a sliver, |n| is far less than E^2; so that is counted apart: `slack`.
TriangleOverlap::TriangleOverlap(const std::array<CellPoint, 3>& corners, const CellPoint& padding)
    : padding_(padding) {
  constexpr float u = 0x1p-24F;
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
  height_slack_ = 64 * u * longest * longest * longest + 16 * u * size * (far + longest);
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
