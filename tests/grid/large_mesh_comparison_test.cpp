#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "grid_comparison.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"

namespace surehit::test::large_mesh_comparison_test {
namespace {

/// What the lists of a grid may hold whatever the mesh: 8 entries a triangle, or 2^18, and three times as many for each
/// of two levels of bricks.
std::size_t entry_budget(std::size_t triangles) { return 9 * std::max(std::size_t{1} << 18, 8 * triangles); }

template <typename Scalar>
class LargeMeshComparison : public testing::Test {
 protected:
  /// Returns a million, or the share of it that is asked for.
  static std::size_t million() { return case_count(1'000'000); }

  /// Asking a million triangles takes its time, so paths are few.
  static void compare(const GeneratedMesh<Scalar>& mesh, std::size_t paths,
                      const std::vector<GridOptions>& grids = {{}, {.resolution = {64, 64, 64}}}) {
    GridComparison<Scalar> comparison(mesh.view(), {}, grids);
    for (const Collider<Scalar>& collider : comparison.colliders()) {
      EXPECT_LE(collider.grid_summary().entries, entry_budget(mesh.triangles.size()));
    }
    PathDrawer<Scalar> drawer(mesh.view(), 1);
    for (std::size_t i = 0; i < paths; ++i) {
      comparison.expect_same(drawer.draw());
      comparison.expect_same(drawer.draw_from_afar(1e6F));
    }
    EXPECT_GT(comparison.hit_count(), 0U);
  }

  Random random_{20240229};
};
TYPED_TEST_SUITE(LargeMeshComparison, Scalars, ScalarNames);

TYPED_TEST(LargeMeshComparison, one_huge_triangle_among_a_million) {
  auto mesh =
      placed<TypeParam>(scattered_triangles<TypeParam>(this->million(), 0.01F, this->random_), 0.001F, {0, 0, 0});
  mesh.add({{-1, -1, -1}, {1, -1, 1}, {-1, 1, 1}});
  this->compare(mesh, 4);
  mesh.add({{-1, -1, -1}, {1e30F, -1, 1}, {-1, 1e30F, 1}});
  this->compare(mesh, 1);
}

TYPED_TEST(LargeMeshComparison, a_million_triangles_in_one_cell) {
  auto mesh =
      placed<TypeParam>(scattered_triangles<TypeParam>(this->million(), 0.001F, this->random_), 1e-4F, {0, 0, 0});
  mesh.add({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  mesh.add({{-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}});
  this->compare(mesh, 8, {{.resolution = {3, 3, 3}}});
}

/// A grid as fine as is asked for would list each of them in all of its cells.
TYPED_TEST(LargeMeshComparison, hundred_thousand_triangles_in_every_cell) {
  GeneratedMesh<TypeParam> mesh;
  for (std::size_t i = 0; i < this->million() / 10; ++i) {
    const TypeParam height = this->random_.template symmetric<TypeParam>();
    mesh.add({{-9, -9, height}, {9, -9, -height}, {0, 9, height}});
  }
  this->compare(mesh, 2, {{.resolution = {200, 200, 1}}});
}

TYPED_TEST(LargeMeshComparison, two_million_triangles) {
  const auto mesh = rough_ground<TypeParam>(1000, 0.01F, this->random_);
  ASSERT_EQ(mesh.triangles.size(), 2'000'000U);
  this->compare(mesh, 10, {{}});
}

}  // namespace
}  // namespace surehit::test::large_mesh_comparison_test
