#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "surehit/grid.hpp"
#include "triangle_overlap.hpp"

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

  const std::uint32_t resolution_;
  const float padding_ = GridFrame::padding_share * static_cast<float>(resolution_);
  Random random_{20240229};
};

}  // namespace surehit::test
