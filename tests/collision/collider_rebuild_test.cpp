#include <gtest/gtest.h>

#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "deformations.hpp"
#include "same_answers.hpp"
#include "support/case_count.hpp"
#include "support/floating_point_mode.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::collider_rebuild_test {
namespace {

template <typename Scalar>
std::vector<Path<Scalar>> paths_around(const GeneratedMesh<Scalar>& mesh, std::size_t count, std::uint64_t seed) {
  PathDrawer<Scalar> drawer(mesh.view(), seed);
  std::vector<Path<Scalar>> paths;
  for (std::size_t i = 0; i < count; ++i) {
    paths.push_back(drawer.draw());
    paths.push_back(drawer.draw_from_afar(Scalar{1e6F}));
  }
  return paths;
}

template <typename Scalar>
void expect_same_mesh(const Collider<Scalar>& left, const Collider<Scalar>& right) {
  ASSERT_EQ(left.triangle_count(), right.triangle_count());
  EXPECT_EQ(left.box().low, right.box().low);
  EXPECT_EQ(left.box().high, right.box().high);
  for (std::uint32_t id = 0; id < left.triangle_count(); ++id) {
    EXPECT_EQ(left.triangle(id).a, right.triangle(id).a);
    EXPECT_EQ(left.triangle(id).b, right.triangle(id).b);
    EXPECT_EQ(left.triangle(id).c, right.triangle(id).c);
  }
  EXPECT_EQ(left.grid_summary().resolution, right.grid_summary().resolution);
  EXPECT_EQ(left.grid_summary().levels, right.grid_summary().levels);
  EXPECT_EQ(left.grid_summary().cells, right.grid_summary().cells);
  EXPECT_EQ(left.grid_summary().entries, right.grid_summary().entries);
}

/// A collider whose vertices move, beside new ones of the meshes that it becomes.
template <typename Scalar>
class ColliderRebuild : public testing::Test {
 protected:
  using Vertices = std::vector<Vector3<Scalar>>;

  GeneratedMesh<Scalar> scattered(std::size_t count, Scalar size) {
    Random random(31);
    return scattered_triangles<Scalar>(count, size, random);
  }
  static VertexView<Scalar> view_of(const Vertices& vertices) { return std::span<const Vector3<Scalar>>(vertices); }

  /// Deforms the mesh over and over, each time from anything else to anything else.
  void expect_deforms(const GeneratedMesh<Scalar>& mesh, const GridOptions& grid = {}) {
    const auto& all = deformations<Scalar>();
    Collider<Scalar> collider(mesh.view(), BuildOptions{grid, {}});
    Random random(37);
    std::size_t hits = 0;
    for (std::size_t step = 0; step < all.size() + case_count(50); ++step) {
      const Deformation<Scalar>& deformation = all[step < all.size() ? step : random.below(all.size())];
      SCOPED_TRACE("step " + std::to_string(step) + ": " + deformation.name);
      const GeneratedMesh<Scalar> moved = deformed(mesh, deformation);
      collider.rebuild(view_of(moved.vertices));
      const Collider<Scalar> expected(moved.view(), BuildOptions{grid, {}});
      expect_same_mesh(collider, expected);
      hits += expect_same_answers(collider, expected, paths_around(moved, 8, step));
      if (this->HasFailure()) return;
    }
    EXPECT_GT(hits, 0U);
  }
};
TYPED_TEST_SUITE(ColliderRebuild, Scalars, ScalarNames);

TYPED_TEST(ColliderRebuild, answers_as_new_of_scattered_triangles) {
  this->expect_deforms(this->scattered(200, TypeParam{0.25}));
}

TYPED_TEST(ColliderRebuild, answers_as_new_of_large_triangles) {
  this->expect_deforms(this->scattered(80, TypeParam{2}));
}

TYPED_TEST(ColliderRebuild, answers_as_new_of_a_surface) {
  Random random(41);
  this->expect_deforms(rough_ground<TypeParam>(9, TypeParam{0.5}, random));
}

/// Which has slabs until it moves.
TYPED_TEST(ColliderRebuild, answers_as_new_of_a_smooth_surface) {
  this->expect_deforms(placed<TypeParam>(smooth_bowl<TypeParam>(12), TypeParam{0.5}, {0, 0, -1}));
}

TYPED_TEST(ColliderRebuild, answers_as_new_of_a_lattice) { this->expect_deforms(lattice_cube<TypeParam>(3)); }

TYPED_TEST(ColliderRebuild, answers_as_new_in_nested_grids) {
  const GridOptions divided{.resolution = {2, 2, 2}, .crowded = 3};
  const auto mesh = this->scattered(200, TypeParam{0.25});
  ASSERT_GT(Collider<TypeParam>(mesh.view(), BuildOptions{divided, {}}).grid_summary().levels, 0U);
  this->expect_deforms(mesh, divided);
}

/// The new collider is rebuilt too. Without this it might have slabs.
TYPED_TEST(ColliderRebuild, visits_what_a_new_one_visits) {
  const auto mesh = this->scattered(300, TypeParam{0.25});
  const auto moved = deformed(mesh, deformations<TypeParam>().back());
  Collider<TypeParam> collider(mesh.view());
  collider.rebuild(this->view_of(moved.vertices));
  Collider<TypeParam> expected(moved.view());
  expected.rebuild(this->view_of(moved.vertices));
  QueryStatistics statistics;
  QueryStatistics expected_statistics;
  for (const Path<TypeParam>& path : paths_around(moved, 200, 43)) {
    static_cast<void>(collider.first_hit(path, {}, &statistics));
    static_cast<void>(expected.first_hit(path, {}, &expected_statistics));
  }
  expect_same(statistics, expected_statistics);
}

TYPED_TEST(ColliderRebuild, keeps_masks_and_grid_options) {
  const auto mesh = this->scattered(200, TypeParam{0.5});
  std::vector<std::uint32_t> masks;
  for (std::uint32_t id = 0; id < 200; ++id) masks.push_back(std::uint32_t{1} << id % 3);
  const BuildOptions options{GridOptions{.resolution = {5, 3, 2}, .crowded = 8}, masks};
  Collider<TypeParam> collider(mesh.view(), options);
  for (const Deformation<TypeParam>& deformation : deformations<TypeParam>()) {
    SCOPED_TRACE(deformation.name);
    const auto moved = deformed(mesh, deformation);
    collider.rebuild(this->view_of(moved.vertices));
    const Collider<TypeParam> expected(moved.view(), options);
    expect_same_mesh(collider, expected);
    for (const std::uint32_t mask : {1U, 2U, 4U, 5U, 8U}) {
      expect_same_answers(collider, expected, paths_around(moved, case_count(10), mask), {.mask = mask});
    }
  }
}

TYPED_TEST(ColliderRebuild, moves_the_mesh_of_the_last_build) {
  const std::vector<std::uint32_t> masks(5, 1);
  Collider<TypeParam> collider(stack_of_triangles<TypeParam>(5).view(), with_masks(masks));
  collider.rebuild(this->view_of(stack_of_triangles<TypeParam>(5).vertices));
  ASSERT_TRUE(collider.try_build(stack_of_triangles<TypeParam>(2).view()));
  auto moved = stack_of_triangles<TypeParam>(2);
  for (auto& vertex : moved.vertices) vertex[2] += 10;
  collider.rebuild(this->view_of(moved.vertices));
  EXPECT_EQ(collider.triangle_count(), 2U);
  EXPECT_FALSE(collider.any_hit(through_stack<TypeParam>(9, -1)));
  EXPECT_EQ(collider.first_hit(through_stack<TypeParam>(20, -1), {.mask = 8})->triangle, 1U);
}

TYPED_TEST(ColliderRebuild, reads_strided_vertices) {
  struct Vertex {
    float color;
    TypeParam position[3];
    double texture;
  };
  const auto mesh = this->scattered(50, TypeParam{0.5});
  const auto moved = deformed(mesh, deformations<TypeParam>().back());
  std::vector<Vertex> vertices;
  for (const auto& x : moved.vertices) vertices.push_back({1e9F, {x[0], x[1], x[2]}, -1e9});
  Collider<TypeParam> collider(mesh.view());
  collider.rebuild(VertexView<TypeParam>::strided(vertices[0].position, vertices.size(), sizeof(Vertex)));
  vertices.clear();
  const Collider<TypeParam> expected(moved.view());
  expect_same_mesh(collider, expected);
  expect_same_answers(collider, expected, paths_around(moved, 50, 47));
}

TYPED_TEST(ColliderRebuild, reads_matrices_maps_and_blocks) {
  using Columns = Eigen::Matrix<TypeParam, 3, Eigen::Dynamic>;
  const auto mesh = this->scattered(50, TypeParam{0.5});
  const auto moved = deformed(mesh, deformations<TypeParam>().back());
  const auto count = static_cast<Eigen::Index>(moved.vertices.size());
  const Eigen::Map<const Columns> map(moved.vertices.front().data(), 3, count);
  const Columns matrix = map;
  Eigen::Matrix<TypeParam, 5, Eigen::Dynamic> padded =
      Eigen::Matrix<TypeParam, 5, Eigen::Dynamic>::Constant(5, count, 77);
  padded.template topRows<3>() = map;
  const Collider<TypeParam> expected(moved.view());
  for (const VertexView<TypeParam>& view : {VertexView<TypeParam>(map), VertexView<TypeParam>(matrix),
                                            VertexView<TypeParam>(padded.template topRows<3>())}) {
    Collider<TypeParam> collider(mesh.view());
    collider.rebuild(view);
    expect_same_mesh(collider, expected);
  }
  Collider<TypeParam> collider(mesh.view());
  collider.rebuild(map);
  expect_same_mesh(collider, expected);
}

TYPED_TEST(ColliderRebuild, of_no_triangles_is_missed_by_everything) {
  Collider<TypeParam> empty;
  EXPECT_NO_THROW(empty.rebuild(this->view_of({})));
  EXPECT_EQ(empty.triangle_count(), 0U);
  std::vector<Vector3<TypeParam>> vertices = {{0, 0, 0}, {1, 0, 0}};
  Collider<TypeParam> points({vertices, {}});
  for (int i = 0; i < 3; ++i) {
    vertices.front()[0] -= 1;
    EXPECT_NO_THROW(points.rebuild(this->view_of(vertices)));
    EXPECT_FALSE(points.any_hit(Line<TypeParam>{{0, 0, 0}, {1, 0, 0}}));
    expect_same_mesh(points, Collider<TypeParam>({vertices, {}}));
  }
}

TYPED_TEST(ColliderRebuild, copies_and_moves_of_it_are_their_own) {
  const auto mesh = this->scattered(100, TypeParam{0.5});
  const auto first = deformed(mesh, deformations<TypeParam>()[2]);
  const auto second = deformed(mesh, deformations<TypeParam>()[13]);
  const Collider<TypeParam> expected_first(first.view());
  const Collider<TypeParam> expected_second(second.view());
  const auto around_first = paths_around(first, 30, 53);
  const auto around_second = paths_around(second, 30, 59);

  Collider<TypeParam> original(mesh.view());
  original.rebuild(this->view_of(first.vertices));
  Collider<TypeParam> copy = original;
  original.rebuild(this->view_of(second.vertices));
  expect_same_answers(copy, expected_first, around_first);
  expect_same_answers(original, expected_second, around_second);
  copy.rebuild(this->view_of(second.vertices));
  expect_same_answers(copy, expected_second, around_second);
  Collider<TypeParam> moved = std::move(copy);
  expect_same_answers(moved, expected_second, around_second);
  moved.rebuild(this->view_of(first.vertices));
  expect_same_answers(moved, expected_first, around_first);
  expect_same_answers(original, expected_second, around_second);
}

TYPED_TEST(ColliderRebuild, does_the_same_in_any_floating_point_mode) {
  const auto mesh = this->scattered(100, TypeParam{0.5});
  for (const Deformation<TypeParam>& deformation : deformations<TypeParam>()) {
    SCOPED_TRACE(deformation.name);
    const auto moved = deformed(mesh, deformation);
    Collider<TypeParam> collider(mesh.view());
    {
      const FloatingPointModeScope scope({"upward_and_flush", FE_UPWARD, true});
      const std::uint64_t before = control_word();
      collider.rebuild(this->view_of(moved.vertices));
      EXPECT_EQ(control_word(), before);
    }
    const Collider<TypeParam> expected(moved.view());
    expect_same_mesh(collider, expected);
    expect_same_answers(collider, expected, paths_around(moved, 20, 61));
  }
}

TYPED_TEST(ColliderRebuild, counts_its_memory) {
  const auto mesh = this->scattered(1000, TypeParam{0.1F});
  const std::size_t of_triangles = 1000 * sizeof(Triangle<TypeParam>);
  Collider<TypeParam> collider(mesh.view());
  const std::size_t built = collider.memory_bytes();
  EXPECT_GE(built, of_triangles);
  collider.rebuild(this->view_of(mesh.vertices));
  const std::size_t rebuilt = collider.memory_bytes();
  EXPECT_GE(rebuilt, built + of_triangles);
  for (int i = 0; i < 3; ++i) collider.rebuild(this->view_of(mesh.vertices));
  EXPECT_EQ(collider.memory_bytes(), rebuilt);
}

}  // namespace
}  // namespace surehit::test::collider_rebuild_test
