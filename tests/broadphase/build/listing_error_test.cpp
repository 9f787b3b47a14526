#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "build/overlap_lanes.hpp"
#include "cell_point_draws.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/neighbour.hpp"

namespace surehit::test::listing_error_test {
namespace {

using detail::OverlapLanes;

/// Measures the worst rounding errors of listing: how much more a cell must grow than it truly takes until it lists a
/// triangle. By triangle_overlap.cpp and overlap_lanes.cpp, this stays within 8 eps R.
class ListingError : public CellPointDraws, public testing::WithParamInterface<std::uint32_t> {
 protected:
  ListingError() : CellPointDraws(GetParam()) {}

  struct Case {
    Corners corners;
    detail::CellPoint cell;  ///< of finest size
  };
  using IsListed = bool (*)(const Case&, float padding);

  static bool is_listed_in_lanes(const Case& drawn, float padding) {
    OverlapLanes lanes;
    const auto padded = [](const detail::CellPoint& point) {
      return detail::PaddedPoint{point[0], point[1], point[2], 0};
    };
    for (std::size_t i = 0; i < 3; ++i) lanes.corners[i].fill(padded(drawn.corners[i]));
    lanes.low.fill(padded(drawn.cell));
    OverlapLanes::Row<std::int32_t> overlaps;
    detail::find_overlaps(lanes, {padding, padding, padding}, 1, overlaps);
    return overlaps.front() != 0;
  }

  static bool is_listed_alone(const Case& drawn, float padding) {
    const auto& [x, y, z] = drawn.cell;
    return detail::TriangleOverlap(drawn.corners, {padding, padding, padding}).meets({x, y, z}, {x + 1, y + 1, z + 1});
  }

  static bool is_listed_exactly(const Case& drawn, double growth) {
    ExactPolygon polygon;
    for (const auto& corner : drawn.corners) polygon.push_back({corner[0], corner[1], corner[2]});
    ExactBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = drawn.cell[axis];
      box.high[axis] = box.low[axis] + 1;
    }
    return meets_box(polygon, box.grown({growth, growth, growth}));
  }

  /// Growths are counted in parts of eps R.
  static constexpr int parts = 64;
  [[nodiscard]] double growth_of(int count) const { return count * (0x1p-24 * resolution_ / parts); }

  /// The smallest growth that lists the triangle, between those of `low` and `high` parts.
  template <typename IsListedFrom>
  static int min_parts(int low, int high, const IsListedFrom& is_listed) {
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (is_listed(middle) ? high : low) = middle;
    }
    return high;
  }

  /// 0 where the triangle is not just beside the cell.
  [[nodiscard]] double share_of(const Case& drawn, IsListed is_listed) const {
    constexpr int most = 64 * parts;
    const auto exactly = [&](int count) { return is_listed_exactly(drawn, growth_of(count)); };
    const auto rounded = [&](int count) { return is_listed(drawn, static_cast<float>(growth_of(count))); };
    if (exactly(0) || !exactly(most)) return 0;
    const int truth = min_parts(0, most, exactly);
    if (!rounded(most)) return 1;
    if (rounded(truth)) return 0;
    return (min_parts(truth, most, rounded) - truth) / (8.0 * parts);
  }

  /// Past an edge of a cell at about the padding, as wide as the grid or as a cell.
  Case draw() {
    Case drawn;
    for (float& x : drawn.cell) x = static_cast<float>(random_.below(resolution_));
    const std::size_t axis = random_.below(3);
    const float width = random_.one_in(2) ? 2 : static_cast<float>(resolution_);
    const float slope = 0.1F + random_.unit<float>();
    const auto clamped = [&](float x) { return std::clamp(x, 0.0F, static_cast<float>(resolution_)); };
    for (auto& corner : drawn.corners) {
      const float along = width * random_.symmetric<float>();
      const float off = padding_ * random_.unit<float>();
      corner[axis] = clamped(drawn.cell[axis] + width * random_.symmetric<float>());
      corner[(axis + 1) % 3] = clamped(drawn.cell[(axis + 1) % 3] + 1 + off + along);
      corner[(axis + 2) % 3] = clamped(drawn.cell[(axis + 2) % 3] + 1 + off - along * slope);
    }
    return drawn;
  }

  Case changed(Case drawn) {
    float& x = drawn.corners[random_.below(3)][random_.below(3)];
    const float moved = random_.one_in(2) ? neighbour(x, static_cast<int>(random_.between(-4, 4)))
                                          : x + padding_ * random_.symmetric<float>();
    x = std::clamp(moved, 0.0F, static_cast<float>(resolution_));
    return drawn;
  }

  /// The worst share of all starts, each one made worse step by step.
  double climb(IsListed is_listed) {
    double worst = 0;
    for (int start = 0; start < 6; ++start) {
      Case best = draw();
      double best_share = 0;
      for (std::size_t step = case_count(400); step > 0; --step) {
        const Case next = best_share == 0 ? draw() : changed(best);
        if (const double share = share_of(next, is_listed); share > best_share) {
          best = next;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
    testing::Test::RecordProperty("worst_share", std::to_string(worst));
    return worst;
  }
};

/// The error stays far below its bound, which is that of one triangle. Lanes count from the cell, so distances are
/// rounded and not positions.
TEST_P(ListingError, of_lanes_stays_below_its_bound) { EXPECT_LT(climb(is_listed_in_lanes), 1); }

TEST_P(ListingError, of_one_triangle_stays_below_its_bound) {
  const double worst = climb(is_listed_alone);
  EXPECT_LT(worst, 1);
  if (runs_all_cases()) {
    EXPECT_GT(worst, 0.1) << "room to waste";
  }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, ListingError, testing::Values(7, 100, 2048),
                         [](const auto& resolution) { return std::to_string(resolution.param); });

}  // namespace
}  // namespace surehit::test::listing_error_test
