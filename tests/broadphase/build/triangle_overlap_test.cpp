#include "build/triangle_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>

#include "cell_point_draws.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/listing_slack.hpp"

namespace surehit::test::triangle_overlap_test {
namespace {

class TriangleOverlapIn : public CellPointDraws, public testing::WithParamInterface<std::uint32_t> {
 protected:
  TriangleOverlapIn() : CellPointDraws(GetParam()) {}

  void expect_right(const Corners& corners, const detail::CellPoint& low, const detail::CellPoint& high) {
    ExactPolygon polygon;
    for (const auto& corner : corners) polygon.push_back({corner[0], corner[1], corner[2]});
    const ExactBox box = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    const double size = resolution_;
    const double least = padding_ - 8 * 0x1p-24 * size;
    const double most = padding_ + listing_slack(polygon, size);
    for (std::size_t axis = 0; axis < 3; ++axis) {  // else it may not be asked
      const auto [lowest, highest] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
      if (lowest > high[axis] + padding_ || highest < low[axis] - padding_) return;
    }
    const bool meets = detail::TriangleOverlap(corners, {padding_, padding_, padding_}).meets(low, high);
    std::ostringstream text;
    text << std::hexfloat;
    for (const auto& corner : corners) text << "{" << corner[0] << ", " << corner[1] << ", " << corner[2] << "} ";
    text << "and the box from {" << low[0] << ", " << low[1] << ", " << low[2] << "} to {" << high[0] << ", " << high[1]
         << ", " << high[2] << "} among " << resolution_;
    if (meets) {
      EXPECT_TRUE(meets_box(polygon, box.grown({most, most, most}))) << "too far off: " << text.str();
    } else {
      EXPECT_FALSE(meets_box(polygon, box.grown({least, least, least}))) << "lost: " << text.str();
    }
    ++(meets ? met_ : missed_);
  }

  /// Boxes of cells of any size, where the triangle is or beside it.
  void expect_right(const Corners& corners) {
    for (int i = 0; i < 4; ++i) {
      const auto longest = static_cast<std::uint64_t>(std::bit_width(resolution_));
      const std::uint32_t size = std::uint32_t{1} << random_.below(longest);
      detail::CellPoint low;
      detail::CellPoint high;
      const std::array<float, 3> weight = {random_.unit<float>(), random_.unit<float>(), random_.unit<float>()};
      const float sum = weight[0] + weight[1] + weight[2];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float inside = 0;
        for (std::size_t k = 0; k < 3; ++k) inside += corners[k][axis] * weight[k] / std::max(sum, 0.1F);
        const double beside = static_cast<double>(random_.between(-2, 1)) * 0.5 * size;
        const double cell = std::floor((double{inside} + beside) / size);
        low[axis] = static_cast<float>(std::clamp(cell, 0.0, std::floor((resolution_ - 1.0) / size)) * size);
        high[axis] = low[axis] + static_cast<float>(size);
      }
      expect_right(corners, low, high);
    }
  }

  void TearDown() override {
    EXPECT_GT(met_, 0U);
    EXPECT_GT(missed_, 0U);
  }

  std::size_t met_ = 0;
  std::size_t missed_ = 0;
};

TEST_P(TriangleOverlapIn, boxes_of_triangles_of_all_sizes) {
  for (std::size_t i = 0; i < case_count(1500); ++i) expect_right(triangle_of_any_size());
}

TEST_P(TriangleOverlapIn, boxes_of_triangles_with_corners_on_planes_and_where_padding_ends) {
  for (std::size_t i = 0; i < case_count(1500); ++i) expect_right({point(), point(), point()});
}

TEST_P(TriangleOverlapIn, boxes_of_triangles_in_cell_planes) {
  for (std::size_t i = 0; i < case_count(750); ++i) expect_right(triangle_in_a_cell_plane());
}

TEST_P(TriangleOverlapIn, boxes_of_slivers_and_degenerate_triangles) {
  for (std::size_t i = 0; i < case_count(750); ++i) {
    for (const Corners& corners : slivers_and_degenerate_triangles()) expect_right(corners);
  }
}

/// A triangle is moved towards a box until it meets it, to the last place: along an axis, and along its own normal.
TEST_P(TriangleOverlapIn, boxes_that_it_just_touches) {
  const auto middle = static_cast<float>(resolution_ / 2);
  const detail::CellPoint low = {middle, middle, middle};
  const detail::CellPoint high = {middle + 1, middle + 1, middle + 1};
  for (std::size_t i = 0; i < case_count(750); ++i) {
    const detail::CellPoint centre = near({middle + 0.5F, middle + 0.5F, middle + 0.5F}, 1);
    Corners corners = {near(centre, 3), near(centre, 3), near(centre, 3)};
    const std::size_t axis = random_.below(3);
    for (int step = 0; step < 30; ++step) {
      expect_right(corners, low, high);
      const float move = std::ldexp(random_.symmetric<float>(), -static_cast<int>(random_.below(16)));
      for (auto& corner : corners) {
        corner[axis] = std::clamp(corner[axis] + move, 0.0F, static_cast<float>(resolution_));
      }
    }
  }
}

/// Across the edge of a box in every direction, at a distance of about the padding.
TEST_P(TriangleOverlapIn, boxes_whose_edges_it_passes_at_the_padding) {
  const auto middle = static_cast<float>(resolution_ / 2);
  const detail::CellPoint low = {middle, middle, middle};
  const detail::CellPoint high = {middle + 1, middle + 1, middle + 1};
  const auto reach = static_cast<float>(resolution_) / 4;
  for (std::size_t i = 0; i < case_count(3000); ++i) {
    // A line through a point just off the box's upper edge that runs along `k`, tangent to it.
    const std::size_t k = random_.below(3);
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    const float off = padding_ * (1 + random_.symmetric<float>());
    const float slope = 0.1F + random_.unit<float>();
    Corners corners;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float along = reach * random_.symmetric<float>();
      corners[corner][k] = middle + reach * random_.symmetric<float>();
      corners[corner][l] = high[l] + off + along / (1 + slope);
      corners[corner][m] = high[m] + off - along * slope / (1 + slope);
    }
    expect_right(corners, low, high);
  }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, TriangleOverlapIn, testing::Values(7, 100, 2048, 32768),
                         [](const auto& resolution) { return std::to_string(resolution.param); });

}  // namespace
}  // namespace surehit::test::triangle_overlap_test
