#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

#include "grid_comparison.hpp"
#include "level/level.hpp"
#include "mesh_io/read_mesh.hpp"
#include "support/case_count.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"

namespace surehit::test::real_mesh_comparison_test {
namespace {

template <typename Scalar>
class RealMeshComparison : public testing::Test {
 protected:
  /// Asks twenty million triangles in all, so that large meshes are asked fewer paths. Half of the paths are as short
  /// as those of game physics.
  static void compare(const TriangleMeshView<Scalar>& mesh) {
    GridComparison<Scalar> comparison(mesh);
    PathDrawer<Scalar> drawer(mesh, 1);
    const std::size_t paths = case_count(std::min<std::size_t>(5'000, 20'000'000 / mesh.triangle_count()));
    const Box<Scalar>& box = comparison.colliders().front().box();
    const Scalar step = (box.high - box.low).maxCoeff() / 100;
    for (std::size_t i = 0; i < paths; ++i) {
      if (drawer.random().one_in(2)) {
        comparison.expect_same(drawer.draw());
        continue;
      }
      Segment<Scalar> segment = {drawer.point_on_mesh(), {}};
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        segment.start[axis] += step * drawer.random().template symmetric<Scalar>();
        segment.end[axis] = segment.start[axis] + 2 * step * drawer.random().template symmetric<Scalar>();
      }
      comparison.expect_same(segment);
    }
    EXPECT_GT(comparison.hit_count(), paths / 10);
  }

  static void compare_file(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(SUREHIT_MESH_FOLDER) / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path.string() << " is not at hand";
    compare(example::read_mesh<Scalar>(path.string()).view());
  }
};
TYPED_TEST_SUITE(RealMeshComparison, Scalars, ScalarNames);

TYPED_TEST(RealMeshComparison, bunny) { this->compare_file("stanford-bunny.obj"); }
TYPED_TEST(RealMeshComparison, ogre) { this->compare_file("ogre.obj"); }
TYPED_TEST(RealMeshComparison, dungeon) { this->compare_file("dungeon.obj"); }
TYPED_TEST(RealMeshComparison, navigation_test) { this->compare_file("nav_test.obj"); }

TYPED_TEST(RealMeshComparison, pul1ctf) { this->compare_file("pul1ctf.obj"); }
TYPED_TEST(RealMeshComparison, czest2ctf) { this->compare_file("czest2ctf.obj"); }
TYPED_TEST(RealMeshComparison, am_galmevish2) { this->compare_file("am_galmevish2.obj"); }

TYPED_TEST(RealMeshComparison, built_in_level) {
  const auto level = example::build_level();
  example::Mesh<TypeParam> mesh;
  mesh.triangles = level.mesh.triangles;
  for (const auto& [x, y, z] : level.mesh.vertices) mesh.vertices.push_back({x, y, z});
  this->compare(mesh.view());
}

}  // namespace
}  // namespace surehit::test::real_mesh_comparison_test
