#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::collider_mesh_test {
namespace {

/// How a mesh gets into a collider, and what becomes of it there.
template <typename Scalar>
class ColliderMesh : public testing::Test {
 protected:
  static constexpr Scalar quarter{0.25};
  Segment<Scalar> downwards = through_stack<Scalar>(9, -1);

  /// The two triangles of stack_of_triangles(2), whatever they were read from.
  void expect_stack_of_two(const TriangleMeshView<Scalar>& view) {
    const Collider<Scalar> collider(view);
    ASSERT_EQ(collider.triangle_count(), 2u);
    for (std::uint32_t id = 0; id < 2; ++id) {
      const Triangle<Scalar> expected = unit_triangle(static_cast<Scalar>(id));
      EXPECT_EQ(collider.triangle(id).a, expected.a);
      EXPECT_EQ(collider.triangle(id).b, expected.b);
      EXPECT_EQ(collider.triangle(id).c, expected.c);
    }
    std::vector<Hit<Scalar>> hits;
    collider.all_hits(downwards, hits);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_TRUE(same_bits(hits[0], Hit<Scalar>{Scalar(0.8), quarter, quarter, 1, Side::front}));
    EXPECT_TRUE(same_bits(hits[1], Hit<Scalar>{Scalar(0.9), quarter, quarter, 0, Side::front}));
  }

  template <typename Index>
  static Eigen::Matrix<Index, 3, 2> triangle_columns() {
    Eigen::Matrix<Index, 3, 2> triangles;
    triangles << 0, 3, 1, 4, 2, 5;
    return triangles;
  }

  static Eigen::Matrix<Scalar, 3, 6> vertex_columns() {
    Eigen::Matrix<Scalar, 3, 6> vertices;
    vertices << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 1;
    return vertices;
  }
};
TYPED_TEST_SUITE(ColliderMesh, Scalars, ScalarNames);

TYPED_TEST(ColliderMesh, of_no_triangles_is_missed_by_everything) {
  const std::vector<Vector3<TypeParam>> vertices = {{0, 0, 0}, {1, 0, 0}};
  for (const auto& collider : {Collider<TypeParam>(), Collider<TypeParam>(TriangleMeshView<TypeParam>()),
                               Collider<TypeParam>(TriangleMeshView<TypeParam>(vertices, {}))}) {
    EXPECT_EQ(collider.triangle_count(), 0u);
    EXPECT_TRUE(collider.box().is_empty());
    EXPECT_FALSE(collider.first_hit(this->downwards));
    EXPECT_FALSE(collider.any_hit(Line<TypeParam>{{0, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(collider.any_hit(Segment<TypeParam>{{0, 0, 0}, {0, 0, 0}}));
    std::vector<Hit<TypeParam>> hits(1);
    collider.all_hits(this->downwards, hits);
    EXPECT_TRUE(hits.empty());
    EXPECT_EQ(collider.last_free_point(this->downwards, Hit<TypeParam>{.t = 0}), this->downwards.start);
  }
}

TYPED_TEST(ColliderMesh, of_one_triangle_is_hit_by_what_meets_it) {
  const Collider<TypeParam> collider(stack_of_triangles<TypeParam>(1).view());
  EXPECT_EQ(collider.triangle_count(), 1u);
  EXPECT_EQ(collider.box().low, (Vector3<TypeParam>{0, 0, 0}));
  EXPECT_EQ(collider.box().high, (Vector3<TypeParam>{1, 1, 0}));
  EXPECT_GE(collider.grid_summary().cells, 1u);
  EXPECT_TRUE(collider.any_hit(this->downwards));
  EXPECT_TRUE(collider.any_hit(Segment<TypeParam>{{0, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(collider.any_hit(Segment<TypeParam>{{1, 1, 1}, {1, 1, -1}}));
}

TYPED_TEST(ColliderMesh, of_one_point_is_hit_by_what_passes_through) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  const Collider<TypeParam> collider(mesh.view());
  EXPECT_TRUE(collider.any_hit(Segment<TypeParam>{{0, 0, 0}, {2, 4, 6}}));
  EXPECT_FALSE(collider.any_hit(Segment<TypeParam>{{0, 0, 0}, {2, 4, 5}}));
}

TYPED_TEST(ColliderMesh, from_tight_arrays) { this->expect_stack_of_two(stack_of_triangles<TypeParam>(2).view()); }

TYPED_TEST(ColliderMesh, from_sixteen_bit_indices) {
  const auto mesh = stack_of_triangles<TypeParam>(2);
  const std::vector<std::uint16_t> indices = {0, 1, 2, 3, 4, 5};
  this->expect_stack_of_two({mesh.vertices, indices});
}

TYPED_TEST(ColliderMesh, from_interleaved_arrays) {
  struct Vertex {
    TypeParam position[3];
    float color;
    double texture;
  };
  struct Face {
    std::uint32_t material;
    std::uint32_t corners[3];
    std::uint32_t group;
  };
  const auto mesh = stack_of_triangles<TypeParam>(2);
  std::vector<Vertex> vertices;
  for (const auto& at : mesh.vertices) vertices.push_back({{at[0], at[1], at[2]}, 1e9f, -1e9});
  std::vector<Face> faces;
  for (const auto& [a, b, c] : mesh.triangles) faces.push_back({999, {a, b, c}, 999});
  this->expect_stack_of_two({VertexView<TypeParam>::strided(vertices[0].position, vertices.size(), sizeof(Vertex)),
                             TriangleIndexView::strided(faces[0].corners, faces.size(), sizeof(Face))});
}

TYPED_TEST(ColliderMesh, from_matrices_of_signed_and_unsigned_indices) {
  const Eigen::Matrix<TypeParam, 3, Eigen::Dynamic> vertices = this->vertex_columns();
  const Eigen::Matrix<int, 3, Eigen::Dynamic> signed_triangles = this->template triangle_columns<int>();
  const Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic> triangles = this->template triangle_columns<std::uint32_t>();
  this->expect_stack_of_two({vertices, signed_triangles});
  this->expect_stack_of_two({vertices, triangles});
}

TYPED_TEST(ColliderMesh, from_maps_of_foreign_memory) {
  const auto vertices = this->vertex_columns();
  const auto triangles = this->template triangle_columns<std::uint32_t>();
  const Eigen::Map<const Eigen::Matrix<TypeParam, 3, Eigen::Dynamic>> vertex_map(vertices.data(), 3, 6);
  const Eigen::Map<const Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic>> triangle_map(triangles.data(), 3, 2);
  this->expect_stack_of_two({vertex_map, triangle_map});
}

TYPED_TEST(ColliderMesh, from_strided_maps_and_blocks) {
  Eigen::Matrix<TypeParam, 5, 6> padded_vertices = Eigen::Matrix<TypeParam, 5, 6>::Constant(77);
  padded_vertices.template topRows<3>() = this->vertex_columns();
  Eigen::Matrix<int, 4, 2> padded_triangles = Eigen::Matrix<int, 4, 2>::Constant(77);
  padded_triangles.template topRows<3>() = this->template triangle_columns<int>();
  const Eigen::Map<const Eigen::Matrix<TypeParam, 3, 6>, 0, Eigen::OuterStride<>> vertices(padded_vertices.data(),
                                                                                           Eigen::OuterStride<>(5));
  this->expect_stack_of_two({vertices, padded_triangles.template topRows<3>()});
}

TYPED_TEST(ColliderMesh, is_copied_out_of_the_arrays) {
  auto mesh = stack_of_triangles<TypeParam>(2);
  const Collider<TypeParam> collider(mesh.view());
  const auto before = collider.first_hit(this->downwards);
  for (auto& vertex : mesh.vertices) vertex.setConstant(99);
  mesh.triangles.clear();
  const auto after = collider.first_hit(this->downwards);
  ASSERT_TRUE(before && after);
  EXPECT_TRUE(same_bits(*before, *after));
}

TYPED_TEST(ColliderMesh, copy_is_its_own) {
  const std::vector<std::uint32_t> masks = {1, 2, 4};
  Collider<TypeParam> original(stack_of_triangles<TypeParam>(3).view(), with_masks(masks));
  const Collider<TypeParam> copy = original;
  ASSERT_TRUE(original.try_build(TriangleMeshView<TypeParam>()));
  EXPECT_FALSE(original.any_hit(this->downwards));
  EXPECT_EQ(copy.triangle_count(), 3u);
  EXPECT_EQ(copy.first_hit(this->downwards, {.mask = 2})->triangle, 1u);
}

TYPED_TEST(ColliderMesh, is_copied_by_an_assignment_too) {
  const Collider<TypeParam> original(stack_of_triangles<TypeParam>(3).view());
  Collider<TypeParam> copy(stack_of_triangles<TypeParam>(1).view());
  copy = original;
  EXPECT_EQ(copy.triangle_count(), 3u);
  const Collider<TypeParam>& itself = copy;
  copy = itself;
  EXPECT_EQ(copy.triangle_count(), 3u);
  EXPECT_EQ(copy.first_hit(this->downwards)->triangle, original.first_hit(this->downwards)->triangle);
}

TYPED_TEST(ColliderMesh, moves_along_with_its_collider) {
  static_assert(std::is_nothrow_move_constructible_v<Collider<TypeParam>>);
  const std::vector<std::uint32_t> masks = {1, 2, 4};
  Collider<TypeParam> original(stack_of_triangles<TypeParam>(3).view(), with_masks(masks));
  const Collider<TypeParam> moved = std::move(original);
  EXPECT_EQ(moved.first_hit(this->downwards, {.mask = 4})->triangle, 2u);
  Collider<TypeParam> assigned;
  assigned = Collider<TypeParam>(moved);
  EXPECT_EQ(assigned.first_hit(this->downwards, {.mask = 1})->triangle, 0u);
}

TYPED_TEST(ColliderMesh, is_of_no_triangles_where_it_was_moved_from) {
  Collider<TypeParam> original(stack_of_triangles<TypeParam>(3).view());
  const Collider<TypeParam> moved = std::move(original);
  EXPECT_EQ(original.triangle_count(), 0u);  // NOLINT(bugprone-use-after-move): it says what is left
  EXPECT_TRUE(original.box().is_empty());
  EXPECT_EQ(original.grid_summary().cells, 0u);
  EXPECT_EQ(original.memory_bytes(), 0u);
  EXPECT_FALSE(original.any_hit(this->downwards));
  EXPECT_TRUE(original.try_rebuild(VertexView<TypeParam>()));
  const Collider<TypeParam> copy = original;
  EXPECT_FALSE(copy.first_hit(this->downwards));
  ASSERT_TRUE(original.try_build(stack_of_triangles<TypeParam>(2).view()));
  EXPECT_EQ(original.first_hit(this->downwards)->triangle, 1u);
  EXPECT_EQ(moved.first_hit(this->downwards)->triangle, 2u);
}

}  // namespace
}  // namespace surehit::test::collider_mesh_test
