#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "deformations.hpp"
#include "same_answers.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::refused_rebuild_test {
namespace {

using Reason = InvalidMesh::Reason;

/// A collider that has been rebuilt before, and is given vertices that it cannot take.
template <typename Scalar>
class RefusedRebuild : public testing::Test {
 protected:
  using Vertices = std::vector<Vector3<Scalar>>;

  RefusedRebuild() {
    Random random(67);
    // A last vertex that no triangle uses counts as well.
    mesh_ = scattered_triangles<Scalar>(40, Scalar{0.5}, random);
    mesh_.vertices.emplace_back(1, 1, 1);
    for (std::uint32_t id = 0; id < 40; ++id) masks_.push_back(std::uint32_t{1} << id % 2);
    before_ = deformed(mesh_, deformations<Scalar>()[2]);
    expected_ = Collider<Scalar>(before_.view(), with_masks(masks_));
    collider_ = Collider<Scalar>(mesh_.view(), with_masks(masks_));
    collider_.rebuild(view_of(before_.vertices));
    PathDrawer<Scalar> drawer(before_.view(), 71);
    for (int i = 0; i < 40; ++i) paths_.push_back(drawer.draw());
  }

  static VertexView<Scalar> view_of(const Vertices& vertices) { return std::span<const Vector3<Scalar>>(vertices); }

  void expect_as_before() {
    EXPECT_EQ(collider_.triangle_count(), 40U);
    EXPECT_EQ(collider_.box().low, expected_.box().low);
    EXPECT_EQ(collider_.box().high, expected_.box().high);
    for (const std::uint32_t mask : {1U, 3U}) {
      EXPECT_GT(expect_same_answers(collider_, expected_, paths_, {.mask = mask}), 0U);
    }
  }

  /// Refused in both ways alike.
  void expect_refused(const Vertices& vertices, Reason reason, std::size_t element, const std::string& named) {
    const BuildResult returned = collider_.try_rebuild(view_of(vertices));
    ASSERT_FALSE(returned);
    EXPECT_EQ(returned.error().reason, reason);
    EXPECT_EQ(returned.error().element, element);
    const std::string message = returned.error().what();
    EXPECT_NE(message.find(named), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    expect_as_before();
    try {
      collider_.rebuild(view_of(vertices));
      FAIL() << "rebuilt";
    } catch (const InvalidMesh& thrown) {
      EXPECT_EQ(thrown.reason, reason);
      EXPECT_EQ(thrown.element, element);
      EXPECT_EQ(std::string(thrown.what()), message);
    }
    expect_as_before();
  }

  GeneratedMesh<Scalar> mesh_;
  std::vector<std::uint32_t> masks_;
  GeneratedMesh<Scalar> before_;
  Collider<Scalar> expected_;
  Collider<Scalar> collider_;
  std::vector<Path<Scalar>> paths_;
};
TYPED_TEST_SUITE(RefusedRebuild, Scalars, ScalarNames);

TYPED_TEST(RefusedRebuild, of_other_vertices_than_the_mesh_has) {
  for (const std::size_t count : {0U, 1U, 120U, 122U, 1000U}) {
    const std::vector<Vector3<TypeParam>> vertices(count, Vector3<TypeParam>::Zero());
    this->expect_refused(vertices, Reason::vertices_do_not_match, count,
                         std::to_string(count) + " vertices for a mesh of 121");
  }
}

TYPED_TEST(RefusedRebuild, of_an_empty_collider_with_vertices) {
  Collider<TypeParam> empty;
  const std::vector<Vector3<TypeParam>> vertices(3, Vector3<TypeParam>::Zero());
  const BuildResult rebuilt = empty.try_rebuild(this->view_of(vertices));
  ASSERT_FALSE(rebuilt);
  EXPECT_EQ(rebuilt.error().reason, Reason::vertices_do_not_match);
  EXPECT_EQ(rebuilt.error().element, 3U);
  EXPECT_EQ(empty.triangle_count(), 0U);
  EXPECT_TRUE(empty.box().is_empty());
}

TYPED_TEST(RefusedRebuild, of_a_non_finite_vertex_names_the_first) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      auto vertices = this->mesh_.vertices;
      vertices[7][axis] = bad;
      vertices[9][axis] = bad;
      this->expect_refused(vertices, Reason::non_finite_vertex, 7, std::string("vertex 7: ") + "xyz"[axis]);
    }
  }
}

TYPED_TEST(RefusedRebuild, of_a_non_finite_vertex_that_no_triangle_uses) {
  auto vertices = this->mesh_.vertices;
  vertices.back()[2] = std::numeric_limits<TypeParam>::infinity();
  this->expect_refused(vertices, Reason::non_finite_vertex, 120, "vertex 120");
}

TYPED_TEST(RefusedRebuild, of_a_wrong_count_is_named_before_what_the_vertices_are) {
  const std::vector<Vector3<TypeParam>> vertices(
      5, Vector3<TypeParam>::Constant(std::numeric_limits<TypeParam>::quiet_NaN()));
  this->expect_refused(vertices, Reason::vertices_do_not_match, 5, "5 vertices");
}

TYPED_TEST(RefusedRebuild, leaves_the_next_one_to_succeed) {
  auto vertices = this->mesh_.vertices;
  vertices[3][0] = std::numeric_limits<TypeParam>::quiet_NaN();
  ASSERT_FALSE(this->collider_.try_rebuild(this->view_of(vertices)));
  vertices = this->mesh_.vertices;
  ASSERT_TRUE(this->collider_.try_rebuild(this->view_of(vertices)));
  const Collider<TypeParam> expected(this->mesh_.view(), with_masks(this->masks_));
  expect_same_answers(this->collider_, expected, this->paths_);
}

}  // namespace
}  // namespace surehit::test::refused_rebuild_test
