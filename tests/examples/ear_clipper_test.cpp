#include "mesh_io/ear_clipper.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/scalars.hpp"

namespace surehit::test::ear_clipper_test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

template <typename Scalar>
class EarClipper : public testing::Test {
 protected:
  using Outline = std::vector<std::array<Scalar, 3>>;
  using Clipped = std::optional<Triangles>;

  /// As seen from above.
  static Clipped clip(const Outline& outline, int turn) {
    const example::AxisView<Scalar> view(2);
    return example::EarClipper<Scalar>(view, outline, turn).clip();
  }

  static Scalar doubled_area(const Outline& outline, const std::array<std::uint32_t, 3>& triangle) {
    const auto& a = outline[triangle[0]];
    const auto& b = outline[triangle[1]];
    const auto& c = outline[triangle[2]];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  /// Cuts the outline, which winds to the left, and the other way round. The area is doubled.
  static void expect_area(Outline outline, Scalar area) {
    for (const int turn : {1, -1}) {
      const Clipped triangles = clip(outline, turn);
      ASSERT_TRUE(triangles) << "turn " << turn;
      EXPECT_EQ(triangles->size(), outline.size() - 2);
      Scalar sum = 0;
      for (const auto& triangle : *triangles) {
        EXPECT_GE(static_cast<Scalar>(turn) * doubled_area(outline, triangle), 0);
        sum += doubled_area(outline, triangle);
      }
      EXPECT_EQ(sum, static_cast<Scalar>(turn) * area);
      std::reverse(outline.begin(), outline.end());
    }
  }
};

TYPED_TEST_SUITE(EarClipper, Scalars, ScalarNames);

TYPED_TEST(EarClipper, cuts_ears_until_a_triangle_is_left) {
  const auto triangles = this->clip({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 1);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(*triangles, (Triangles{{3, 0, 1}, {3, 1, 2}}));
}

TYPED_TEST(EarClipper, cuts_no_ear_that_a_corner_is_in) {
  this->expect_area({{-4, 4, 0}, {0, 0, 0}, {4, 4, 0}, {0, 2, 0}}, 16);
  this->expect_area({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {5, 2, 0}, {0, 9, 0}}, 99);
}

TYPED_TEST(EarClipper, finds_no_ears_in_the_wrong_turn) {
  EXPECT_FALSE(this->clip({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, -1));
  EXPECT_FALSE(this->clip({{-4, 4, 0}, {0, 0, 0}, {4, 4, 0}, {0, 2, 0}}, -1));
  EXPECT_FALSE(this->clip({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, -1)) << "not even a triangle's";
}

TYPED_TEST(EarClipper, looks_along_its_axis) {
  const example::AxisView<TypeParam> view(0);
  const std::vector<std::array<TypeParam, 3>> outline = {{7, 0, 0}, {-7, 4, 0}, {5, 4, 4}, {0, 0, 4}};
  EXPECT_TRUE(example::EarClipper<TypeParam>(view, outline, 1).clip());
  EXPECT_FALSE(example::EarClipper<TypeParam>(view, outline, -1).clip());
}

TYPED_TEST(EarClipper, cuts_folds_first) {
  // A square with a slit, an antenna and a corner that is there twice, although its first corner is an ear.
  const std::vector<std::array<TypeParam, 3>> outline = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0},
                                                         {4, 0, 0}, {4, 4, 0}, {4, 4, 0}, {0, 4, 0},
                                                         {2, 2, 0}, {0, 4, 0}, {0, 2, 0}};
  const auto triangles = this->clip(outline, 1);
  ASSERT_TRUE(triangles);
  ASSERT_EQ(triangles->size(), 9u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(this->doubled_area(outline, (*triangles)[i]), 0) << i;
  for (std::size_t i = 5; i < 9; ++i) EXPECT_GT(this->doubled_area(outline, (*triangles)[i]), 0) << i;
  this->expect_area(outline, 32);
}

TYPED_TEST(EarClipper, cuts_corners_on_a_line_last) {
  // So that no triangle is without area.
  const std::vector<std::array<TypeParam, 3>> outline = {{2, 0, 0}, {4, 0, 0}, {4, 3, 0},
                                                         {2, 3, 0}, {0, 3, 0}, {0, 0, 0}};
  const auto triangles = this->clip(outline, 1);
  ASSERT_TRUE(triangles);
  for (const auto& triangle : *triangles) EXPECT_GT(this->doubled_area(outline, triangle), 0);
  this->expect_area(outline, 24);
}

TYPED_TEST(EarClipper, cuts_ears_that_the_outline_touches) {
  // A wall, its window, and a bridge between both.
  this->expect_area(
      {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, {0, 0, 0}, {2, 1, 0}, {2, 3, 0}, {4, 3, 0}, {4, 1, 0}, {2, 1, 0}},
      40);
  // Two triangles that touch in a corner: each has the other one's corner on it.
  this->expect_area({{0, 0, 0}, {2, 2, 0}, {4, 0, 0}, {4, 4, 0}, {2, 2, 0}, {0, 4, 0}}, 16);
  // A window that touches the edge from which the outline comes to it.
  this->expect_area({{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {3, 2, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 28);
}

TYPED_TEST(EarClipper, cuts_no_bend_of_a_bridge_outside) {
  this->expect_area(
      {{0, 0, 0}, {2, 0, 0}, {3, -1, 0}, {3, 1, 0}, {2, 0, 0}, {0, 0, 0}, {0, 2, 0}, {1, 3, 0}, {-1, 3, 0}, {0, 2, 0}},
      4);
}

TYPED_TEST(EarClipper, runs_out_of_ears_where_the_outline_crosses_itself) {
  for (const int turn : {1, -1}) {
    EXPECT_FALSE(this->clip({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}, turn)) << "a bow tie";
    EXPECT_FALSE(this->clip({{0, 10, 0}, {6, -8, 0}, {-10, 3, 0}, {10, 3, 0}, {-6, -8, 0}}, turn)) << "a pentagram";
  }
}

}  // namespace
}  // namespace surehit::test::ear_clipper_test
