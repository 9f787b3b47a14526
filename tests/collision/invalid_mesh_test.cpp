#include "surehit/invalid_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::invalid_mesh_test {
namespace {

using Reason = InvalidMesh::Reason;

template <typename Scalar>
class InvalidMeshOf : public testing::Test {
 protected:
  /// Two triangles that share an edge.
  GeneratedMesh<Scalar> mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                             .triangles = {{0, 1, 2}, {1, 3, 2}}};

  /// Building fails in both ways alike, and each names the element.
  void expect_invalid(const TriangleMeshView<Scalar>& view, Reason reason, std::size_t element,
                      const std::string& named, const BuildOptions& options = {}) {
    Collider<Scalar> collider;
    const BuildResult returned = collider.try_build(view, options);
    ASSERT_FALSE(returned);
    EXPECT_EQ(returned.error().reason, reason);
    EXPECT_EQ(returned.error().element, element);
    const std::string message = returned.error().what();
    EXPECT_NE(message.find(named), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    try {
      Collider<Scalar> thrower(view, options);
      FAIL() << "built";
    } catch (const InvalidMesh& thrown) {
      EXPECT_EQ(thrown.reason, reason);
      EXPECT_EQ(thrown.element, element);
      EXPECT_EQ(std::string(thrown.what()), message);
    }
  }
};
TYPED_TEST_SUITE(InvalidMeshOf, Scalars, ScalarNames);

TYPED_TEST(InvalidMeshOf, index_out_of_range_names_the_first_triangle) {
  this->mesh.triangles = {{0, 1, 2}, {1, 4, 2}, {9, 9, 9}};
  this->expect_invalid(this->mesh.view(), Reason::index_out_of_range, 1, "triangle 1");
}

TYPED_TEST(InvalidMeshOf, index_out_of_range_in_any_corner) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    this->mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
    this->mesh.triangles[1][corner] = std::numeric_limits<std::uint32_t>::max();
    this->expect_invalid(this->mesh.view(), Reason::index_out_of_range, 1, "4294967295");
  }
}

TYPED_TEST(InvalidMeshOf, negative_index_is_out_of_range) {
  Eigen::Matrix<TypeParam, 3, 3> vertices = Eigen::Matrix<TypeParam, 3, 3>::Identity();
  Eigen::Matrix<int, 3, 2> triangles;
  triangles << 0, 0, 1, -1, 2, 2;
  this->expect_invalid({vertices, triangles}, Reason::index_out_of_range, 1, "triangle 1");
}

TYPED_TEST(InvalidMeshOf, non_finite_vertex_names_the_first_vertex) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      auto mesh = this->mesh;
      mesh.vertices[2][axis] = bad;
      mesh.vertices[3][axis] = bad;
      this->expect_invalid(mesh.view(), Reason::non_finite_vertex, 2, "vertex 2");
    }
  }
}

TYPED_TEST(InvalidMeshOf, non_finite_vertex_counts_though_no_triangle_uses_it) {
  this->mesh.vertices.push_back({0, std::numeric_limits<TypeParam>::infinity(), 0});
  this->expect_invalid(this->mesh.view(), Reason::non_finite_vertex, 4, "vertex 4");
}

TYPED_TEST(InvalidMeshOf, more_triangles_than_ids) {
  // Refused by its size before anything is read: nothing of this size need exist.
  constexpr std::size_t count = std::numeric_limits<std::uint32_t>::max();
  const std::array<std::uint32_t, 3> triangle = {0, 1, 2};
  const auto many = [&](std::size_t triangles) {
    return TriangleMeshView<TypeParam>(this->mesh.vertices, TriangleIndexView::strided(triangle.data(), triangles, 0));
  };
  this->expect_invalid(many(count + 1), Reason::too_many_triangles, count + 1, std::to_string(count + 1));
}

TYPED_TEST(InvalidMeshOf, masks_that_are_not_one_a_triangle) {
  const std::vector<std::uint32_t> masks(3, 1);
  this->expect_invalid(this->mesh.view(), Reason::masks_do_not_match, 3, "3 masks for 2 triangles", with_masks(masks));
  const std::vector<std::uint32_t> one(1, 1);
  this->expect_invalid(this->mesh.view(), Reason::masks_do_not_match, 1, "1 masks for 2 triangles", with_masks(one));
}

TYPED_TEST(InvalidMeshOf, good_mesh_is_none) {
  Collider<TypeParam> collider;
  EXPECT_TRUE(collider.try_build(this->mesh.view()));
  EXPECT_EQ(collider.triangle_count(), 2u);
}

TYPED_TEST(InvalidMeshOf, failed_rebuild_keeps_the_mesh_its_masks_and_its_answers) {
  const std::vector<std::uint32_t> masks = {2, 4};
  Collider<TypeParam> collider;
  ASSERT_TRUE(collider.try_build(this->mesh.view(), with_masks(masks)));
  const auto segment = through_stack<TypeParam>(1, -1);
  const auto before = collider.first_hit(segment);
  ASSERT_TRUE(before);

  auto bad = stack_of_triangles<TypeParam>(5);
  bad.vertices[7][1] = std::numeric_limits<TypeParam>::quiet_NaN();
  const std::vector<std::uint32_t> too_few = {1};
  EXPECT_FALSE(collider.try_build(bad.view()));
  const auto five = stack_of_triangles<TypeParam>(5);
  EXPECT_FALSE(collider.try_build(five.view(), with_masks(too_few)));

  EXPECT_EQ(collider.triangle_count(), 2u);
  const auto after = collider.first_hit(segment);
  ASSERT_TRUE(after);
  EXPECT_TRUE(same_bits(*before, *after));
  EXPECT_TRUE(collider.any_hit(segment, {.mask = 2}));
  EXPECT_FALSE(collider.any_hit(segment, {.mask = 4}));
}

TYPED_TEST(InvalidMeshOf, successful_rebuild_replaces_all) {
  const std::vector<std::uint32_t> masks = {2, 4};
  Collider<TypeParam> collider(this->mesh.view(), with_masks(masks));
  ASSERT_TRUE(collider.try_build(stack_of_triangles<TypeParam>(3).view()));
  EXPECT_EQ(collider.triangle_count(), 3u);
  EXPECT_EQ(collider.box().high[2], 2);
  EXPECT_TRUE(collider.any_hit(through_stack<TypeParam>(3, TypeParam{1.5}), {.mask = 1}));
}

}  // namespace
}  // namespace surehit::test::invalid_mesh_test
