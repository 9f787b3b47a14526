#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "build/triangle_overlap.hpp"
#include "grid/grid.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"

namespace surehit::test {

using Corners = std::array<detail::CellPoint, 3>;

/// Points in a grid of `resolution_` finest cells on each axis.
class CellPointDraws : public testing::Test {
 protected:
  explicit CellPointDraws(std::uint32_t resolution) : resolution_(resolution) {}

  float on_axis() {
    const auto plane = static_cast<float>(random_.below(resolution_ + 1));
    const auto clamped = [&](float x) { return std::clamp(x, 0.0F, static_cast<float>(resolution_)); };
    switch (random_.below(6)) {
      case 0:
        return plane;
      case 1:  // where the padding begins and ends, and just beyond
        return clamped(plane + static_cast<float>(random_.between(-1, 1)) * padding_ *
                                   (1 + random_.symmetric<float>() * 0x1p-6F));
      case 2:
        return clamped(neighbour(plane, static_cast<int>(random_.between(-2, 2))));
      default:
        return static_cast<float>(resolution_) * random_.unit<float>();
    }
  }
  detail::CellPoint point() { return {on_axis(), on_axis(), on_axis()}; }

  detail::CellPoint near(const detail::CellPoint& other, float size) {
    detail::CellPoint drawn;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      drawn[axis] = std::clamp(other[axis] + size * random_.symmetric<float>(), 0.0F, static_cast<float>(resolution_));
    }
    return drawn;
  }

  /// With corners anywhere, from as wide as the grid to far within a finest cell.
  Corners triangle_of_any_size() {
    const float size = std::ldexp(static_cast<float>(resolution_), -static_cast<int>(random_.below(24)));
    const detail::CellPoint a = point();
    return {a, near(a, size), near(a, size)};
  }

  Corners triangle_in_a_cell_plane() {
    Corners corners = {point(), point(), point()};
    const std::size_t axis = random_.below(3);
    corners[1][axis] = corners[2][axis] = corners[0][axis];
    return corners;
  }

  /// Two slivers, a segment and a point.
  std::array<Corners, 4> slivers_and_degenerate_triangles() {
    const detail::CellPoint a = point();
    const detail::CellPoint b = point();
    detail::CellPoint between;
    const float weight = random_.unit<float>();
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] = a[axis] + weight * (b[axis] - a[axis]);
    const detail::CellPoint beside = near(between, std::ldexp(static_cast<float>(resolution_), -10));
    return {Corners{a, b, between}, Corners{a, b, beside}, Corners{a, b, a}, Corners{a, a, a}};
  }

  const std::uint32_t resolution_;
  const float padding_ = GridFrame::padding_share * static_cast<float>(resolution_);
  Random random_{20240229};
};

}  // namespace surehit::test
