#include "surehit/box.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/scalars.hpp"

namespace surehit::test::box_test {
namespace {

template <typename Scalar>
class BoxTest : public testing::Test {};
TYPED_TEST_SUITE(BoxTest, Scalars, ScalarNames);

TYPED_TEST(BoxTest, by_default_holds_nothing) {
  const Box<TypeParam> box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_FALSE(box.contains({0, 0, 0}));
}

TYPED_TEST(BoxTest, of_a_mesh_without_triangles_is_empty) {
  const std::array<TypeParam, 3> vertex = {1, 2, 3};
  EXPECT_TRUE(box_of(TriangleMeshView<TypeParam>(vertex, {})).is_empty());
}

TYPED_TEST(BoxTest, of_one_point_holds_that_point_alone) {
  Box<TypeParam> box;
  box.extend({1, -2, 3});
  EXPECT_FALSE(box.is_empty());
  EXPECT_TRUE(box.contains({1, -2, 3}));
  EXPECT_FALSE(box.contains({1, -2, std::nextafter(TypeParam{3}, TypeParam{4})}));
  EXPECT_FALSE(box.contains({std::nextafter(TypeParam{1}, TypeParam{0}), -2, 3}));
}

TYPED_TEST(BoxTest, holds_both_its_ends) {
  Box<TypeParam> box;
  box.extend({1, 5, -1});
  box.extend({-1, 4, 2});
  EXPECT_EQ(box.low, (Vector3<TypeParam>{-1, 4, -1}));
  EXPECT_EQ(box.high, (Vector3<TypeParam>{1, 5, 2}));
  EXPECT_TRUE(box.contains(box.low));
  EXPECT_TRUE(box.contains(box.high));
}

TYPED_TEST(BoxTest, is_empty_if_it_is_on_one_axis) {
  Box<TypeParam> box;
  box.low = {0, 1, 0};
  box.high = {2, 0, 2};
  EXPECT_TRUE(box.is_empty());
}

TYPED_TEST(BoxTest, of_a_mesh_counts_vertices_that_a_triangle_uses) {
  const std::vector<Vector3<TypeParam>> vertices = {{-100, 0, 0}, {1, 2, 3}, {-4, 5, -6}, {7, -8, 9}, {0, 0, 100}};
  const std::array<std::uint32_t, 3> triangle = {1, 2, 3};
  const auto box = box_of(TriangleMeshView<TypeParam>(vertices, triangle));
  EXPECT_EQ(box.low, (Vector3<TypeParam>{-4, -8, -6}));
  EXPECT_EQ(box.high, (Vector3<TypeParam>{7, 5, 9}));
}

TYPED_TEST(BoxTest, spans_the_whole_of_the_numbers) {
  constexpr TypeParam largest = std::numeric_limits<TypeParam>::max();
  Box<TypeParam> box;
  box.extend({-largest, -largest, -largest});
  box.extend({largest, largest, largest});
  EXPECT_TRUE(box.contains({0, largest, -largest}));
}

}  // namespace
}  // namespace surehit::test::box_test
