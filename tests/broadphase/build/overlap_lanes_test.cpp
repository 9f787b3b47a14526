#include "build/overlap_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

#include "cell_point_draws.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/instruction_sets.hpp"
#include "support/listing_slack.hpp"

namespace surehit::test::overlap_lanes_test {
namespace {

using detail::OverlapLanes;

class OverlapLanesIn : public CellPointDraws, public testing::WithParamInterface<std::uint32_t> {
 protected:
  OverlapLanesIn() : CellPointDraws(GetParam()) {}

  struct Block {
    Corners corners;
    std::array<std::int64_t, 3> first;
    std::array<std::int64_t, 3> count;
    int must = 0;  ///< overlap, a bit for each cell
    int may = 0;
  };

  /// Cells of each size, from where the triangle's padded box begins on an axis, or from anywhere farther in it.
  void add(const Corners& corners) {
    const auto longest = static_cast<std::uint64_t>(std::bit_width(resolution_));
    const auto drawn = static_cast<std::size_t>(random_.below(longest));
    const auto size = static_cast<float>(std::uint32_t{1} << drawn);
    Block block{corners, {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
      const auto first = static_cast<std::int64_t>(std::max(0.0F, std::floor((low - padding_) / size)));
      const auto last = static_cast<std::int64_t>(std::floor((high + padding_) / size));
      block.first[axis] = random_.one_in(2) ? first : random_.between(first, last);
      block.count[axis] = std::min<std::int64_t>(2, last - block.first[axis] + 1);
    }
    judge(block, size);
    auto& blocks = blocks_.at(drawn);
    blocks.push_back(block);
    if (blocks.size() == OverlapLanes::count) {
      for (const std::int64_t target : instruction_sets()) expect_right(blocks, size, target);
      blocks.clear();
    }
  }

  void judge(Block& block, float size) {
    ExactPolygon polygon;
    for (const auto& corner : block.corners) polygon.push_back({corner[0], corner[1], corner[2]});
    const double width = resolution_;
    const double least = padding_ - 8 * 0x1p-24 * width;
    const double most = padding_ + listing_slack(polygon, width);
    for (int cell = 0; cell < 8; ++cell) {
      ExactBox box;
      bool is_asked = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t offset = cell >> axis & 1;
        is_asked &= offset < block.count[axis];
        box.low[axis] = static_cast<double>(block.first[axis] + offset) * double{size};
        box.high[axis] = box.low[axis] + double{size};
      }
      if (!is_asked) continue;
      if (meets_box(polygon, box.grown({least, least, least}))) block.must |= 1 << cell;
      if (meets_box(polygon, box.grown({most, most, most}))) block.may |= 1 << cell;
      missed_ += (block.may >> cell & 1) == 0 ? 1 : 0;
    }
    met_ += block.must != 0 ? 1 : 0;
  }

  void expect_right(const std::vector<Block>& blocks, float size, std::int64_t target) {
    OverlapLanes lanes;
    for (std::size_t lane = 0; lane < blocks.size(); ++lane) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<Eigen::Index>(axis);
        for (std::size_t i = 0; i < 3; ++i) lanes.corners[i][lane][k] = blocks[lane].corners[i][axis];
        lanes.low[lane][k] = static_cast<float>(blocks[lane].first[axis]);
        lanes.more[lane][k] = static_cast<float>(blocks[lane].count[axis] - 1);
      }
    }
    OverlapLanes::Row<std::int32_t> overlaps;
    {
      const ForcedInstructionSet forced(target);
      detail::find_overlaps(lanes, {padding_, padding_, padding_}, size, overlaps);
    }
    for (std::size_t lane = 0; lane < blocks.size(); ++lane) {
      const auto& [corners, first, count, must, may] = blocks[lane];
      std::ostringstream text;
      text << std::hexfloat;
      for (const auto& corner : corners) text << "{" << corner[0] << ", " << corner[1] << ", " << corner[2] << "} ";
      text << "and the cells of " << size << " from " << first[0] << ", " << first[1] << ", " << first[2] << ": "
           << name_of_instruction_set(target);
      EXPECT_EQ(overlaps[lane] & must, must) << "lost: " << text.str();
      EXPECT_EQ(overlaps[lane] & ~may, 0) << "too far off: " << text.str();
    }
  }

  void TearDown() override {
    EXPECT_GT(met_, 0U);
    EXPECT_GT(missed_, 0U);
  }

  std::array<std::vector<Block>, 17> blocks_;  ///< of each size
  std::size_t met_ = 0;
  std::size_t missed_ = 0;
};

TEST_P(OverlapLanesIn, triangles_of_all_sizes) {
  for (std::size_t i = 0; i < case_count(2000); ++i) add(triangle_of_any_size());
}

TEST_P(OverlapLanesIn, triangles_with_corners_on_planes_and_where_padding_ends) {
  for (std::size_t i = 0; i < case_count(1500); ++i) add({point(), point(), point()});
}

TEST_P(OverlapLanesIn, triangles_in_cell_planes) {
  for (std::size_t i = 0; i < case_count(1000); ++i) add(triangle_in_a_cell_plane());
}

TEST_P(OverlapLanesIn, slivers_and_degenerate_triangles) {
  for (std::size_t i = 0; i < case_count(750); ++i) {
    for (const Corners& corners : slivers_and_degenerate_triangles()) add(corners);
  }
}

/// Past the middle of a block of four cells and more, where a triangle is parted from one of them by little.
TEST_P(OverlapLanesIn, triangles_past_cell_corners_at_the_padding) {
  for (std::size_t i = 0; i < case_count(2000); ++i) {
    const auto corner = static_cast<float>(1 + random_.below(resolution_ - 1));
    const float reach = 1 + random_.unit<float>();
    Corners corners;
    const std::size_t axis = random_.below(3);
    const float off = padding_ * (1 + random_.symmetric<float>() * 0x1p-4F);
    const float slope = 0.1F + random_.unit<float>();
    for (auto& drawn : corners) {
      const float along = reach * random_.symmetric<float>();
      drawn[axis] = corner + reach * random_.symmetric<float>();
      drawn[(axis + 1) % 3] = corner + off + along / (1 + slope);
      drawn[(axis + 2) % 3] = corner + off - along * slope / (1 + slope);
      for (float& x : drawn) x = std::clamp(x, 0.0F, static_cast<float>(resolution_));
    }
    add(corners);
  }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, OverlapLanesIn, testing::Values(7, 100, 2048, 32768),
                         [](const auto& resolution) { return std::to_string(resolution.param); });

/// An edge of each triangle passes the corner of the padded cell, but for roundings. If an instruction set rounded
/// otherwise, it would list other triangles.
TEST(OverlapLanes, have_the_same_bits_on_every_instruction_set) {
  Random random(107);
  constexpr float padding = 0x1p-7F;  // As in a grid of 4096 finest cells.
  std::size_t met = 0;
  std::size_t missed = 0;
  for (std::size_t round = 0; round < case_count(2000); ++round) {
    OverlapLanes lanes;
    for (std::size_t lane = 0; lane < OverlapLanes::count; ++lane) {
      const auto between = [&](std::int64_t low, std::int64_t high) {
        return static_cast<float>(random.between(low, high));
      };
      const detail::PaddedPoint low = {between(0, 3), between(0, 3), between(0, 3), 0};  // Where floats are fine.
      const detail::PaddedPoint corner = low + detail::PaddedPoint{1 + padding, 1 + padding, 1 + padding, 0};
      const detail::PaddedPoint along = {between(1, 9999) / 8192, -between(1, 9999) / 8192, between(-9999, 9999) / 8192,
                                         0};
      const detail::PaddedPoint away = {between(1, 9999) / 8192, between(1, 9999) / 8192, between(-9999, 9999) / 8192,
                                        0};
      lanes.corners[0][lane] = corner + along * (between(1, 9999) / 8192);
      lanes.corners[1][lane] = corner - along * (between(1, 9999) / 8192);
      lanes.corners[2][lane] = corner + away;
      lanes.low[lane] = low;
    }
    const auto overlaps_on = [&](std::int64_t target) {
      const ForcedInstructionSet forced(target);
      OverlapLanes::Row<std::int32_t> overlaps;
      detail::find_overlaps(lanes, {padding, padding, padding}, 1, overlaps);
      return overlaps;
    };
    const OverlapLanes::Row<std::int32_t> expected = overlaps_on(instruction_sets().front());
    for (const std::int32_t bits : expected) ++(bits != 0 ? met : missed);
    for (const std::int64_t target : instruction_sets()) {
      ASSERT_EQ(overlaps_on(target), expected) << name_of_instruction_set(target) << ", round " << round;
    }
  }
  EXPECT_GT(met, case_count(1000));
  EXPECT_GT(missed, case_count(1000));
}

}  // namespace
}  // namespace surehit::test::overlap_lanes_test
