#include "cell_listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/random.hpp"

namespace surehit::test {
namespace {

using FrameTriangle = std::array<detail::FramePoint, 3>;

/// What listing may lose or add by its roundings: far above them, far below the padding.
constexpr double rounding = 0x1p-45;
constexpr double padding = GridFrame::padding;

std::vector<std::size_t> listed_cells(const GridFrame& frame, const FrameTriangle& triangle) {
  std::vector<std::size_t> cells;
  detail::list_cells(frame, triangle, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    cells.push_back((std::size_t{z} * frame.resolution[1] + y) * frame.resolution[0] + x);
  });
  std::sort(cells.begin(), cells.end());
  return cells;
}

class CellListing : public testing::Test {
 protected:
  /// Each cell once, none that the triangle meets is missing, none that it misses is there.
  void expect_conservative_and_tight(const FrameTriangle& triangle) const {
    ExactPolygon polygon;
    for (const auto& corner : triangle) polygon.push_back({corner[0], corner[1], corner[2]});
    const auto listed = listed_cells(frame_, triangle);
    const auto must = cells_met(frame_, polygon, padding - rounding);
    const auto may = cells_met(frame_, polygon, padding + rounding);
    std::ostringstream text;
    text << std::hexfloat;
    for (const auto& corner : triangle) text << "{" << corner[0] << ", " << corner[1] << ", " << corner[2] << "} ";
    EXPECT_EQ(std::adjacent_find(listed.begin(), listed.end()), listed.end()) << "twice: " << text.str();
    EXPECT_TRUE(std::includes(listed.begin(), listed.end(), must.begin(), must.end())) << "misses: " << text.str();
    EXPECT_TRUE(std::includes(may.begin(), may.end(), listed.begin(), listed.end())) << "too many: " << text.str();
  }

  double on_axis(std::size_t axis) {
    const std::uint32_t cells = frame_.resolution[axis];
    const double plane = frame_.plane(axis, static_cast<std::uint32_t>(random_.between(1, cells - 1)));
    switch (random_.below(8)) {
      case 0:
        return plane;
      case 1:  // where the padding begins and ends, and just beyond
        return plane +
               static_cast<double>(random_.between(-1, 1)) * padding * (1 + random_.symmetric<double>() * 0x1p-8);
      case 2:
        return top * static_cast<double>(random_.below(2));
      case 3:
        return std::nextafter(plane, top * static_cast<double>(random_.below(2)));
      default:
        return top * random_.unit<double>();
    }
  }

  detail::FramePoint point() { return {on_axis(0), on_axis(1), on_axis(2)}; }

  static constexpr double top = 0.96875;
  const Boxd box_ = {{0, 0, 0}, {2 * top, 2 * top, 2 * top}};
  GridFrame frame_ = GridFrame::around(box_, {6, 5, 7});  // halves the box
  Random random_{20240229};
};

TEST_F(CellListing, TrianglesOfAllSizes) {
  for (std::size_t i = 0; i < case_count(1000); ++i) {
    const double size = std::ldexp(1.0, -static_cast<int>(random_.below(40)));
    const detail::FramePoint a = point();
    FrameTriangle triangle = {a, a, a};
    for (std::size_t corner = 1; corner < 3; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        triangle[corner][axis] = std::clamp(a[axis] + size * random_.symmetric<double>(), 0.0, top);
      }
    }
    expect_conservative_and_tight(triangle);
  }
}

TEST_F(CellListing, TrianglesWithCornersOnPlanesAndWherePaddingEnds) {
  for (std::size_t i = 0; i < case_count(1000); ++i) expect_conservative_and_tight({point(), point(), point()});
}

TEST_F(CellListing, TrianglesInCellPlanes) {
  for (std::size_t i = 0; i < case_count(500); ++i) {
    FrameTriangle triangle = {point(), point(), point()};
    const std::size_t axis = random_.below(3);
    triangle[1][axis] = triangle[2][axis] = triangle[0][axis];
    expect_conservative_and_tight(triangle);
  }
}

TEST_F(CellListing, SliversAndDegenerateTriangles) {
  for (std::size_t i = 0; i < case_count(500); ++i) {
    const detail::FramePoint a = point();
    const detail::FramePoint b = point();
    detail::FramePoint between;
    const double weight = random_.unit<double>();
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] = a[axis] + weight * (b[axis] - a[axis]);
    expect_conservative_and_tight({a, b, between});
    expect_conservative_and_tight({a, b, a});
    expect_conservative_and_tight({a, a, a});
  }
}

/// A bounding box would list all cells but those that the diagonal plane is far from.
TEST_F(CellListing, DiagonalTriangleIsInFewerCellsThanItsBox) {
  const auto cells = listed_cells(frame_, {{{0, 0, 0}, {top, 0, top}, {0, top, top}}});
  EXPECT_LT(cells.size(), std::size_t{6 * 5 * 7} / 2);
}

TEST_F(CellListing, OneCellListsEverything) {
  frame_ = GridFrame::around(box_, {1, 1, 1});
  EXPECT_EQ(listed_cells(frame_, {{{0, 0, 0}, {top, 0, top}, {0, top, top}}}), std::vector<std::size_t>{0});
}

TEST_F(CellListing, ClipKeepsWhatLiesBetweenThePlanes) {
  detail::ClippedTriangle triangle = {};
  triangle.count = 3;
  triangle.corners[0] = {0, 0, 0};
  triangle.corners[1] = {1, 0, 0};
  triangle.corners[2] = {0, 1, 0};
  EXPECT_EQ(detail::clip(triangle, 0, -1, 2).count, 3);
  EXPECT_EQ(detail::clip(triangle, 0, 0.25, 0.5).count, 4);
  EXPECT_EQ(detail::clip(triangle, 0, 1, 2).count, 1) << "a corner on the plane is kept";
  EXPECT_EQ(detail::clip(triangle, 0, 1.5, 2).count, 0);
  EXPECT_EQ(detail::clip(triangle, 2, 0, 0).count, 3) << "a triangle in both planes is kept";
}

}  // namespace
}  // namespace surehit::test
