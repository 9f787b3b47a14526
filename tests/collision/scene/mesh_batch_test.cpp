#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "collider_state.hpp"
#include "collision/filter/on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::mesh_batch_test {
namespace {

/// A mesh, and how its grid divides it.
struct GriddedMesh {
  std::string name;
  std::uint32_t levels;
  GeneratedMesh<float> mesh;
  GridOptions grid = {};

  [[nodiscard]] std::shared_ptr<const Colliderf> collider() const {
    return std::make_shared<Colliderf>(mesh.view(), BuildOptions{grid, {}});
  }
};

/// Meshes of about the same size with grids of all kinds: with slabs and without, with 0 to 2 levels, with inner grids
/// in top cells, in bricks and in each other, and one list alone.
std::vector<GriddedMesh> gridded_meshes() {
  Random random(5);
  const auto prop = [&](float size, const Vector3f& place) {
    return placed<float>(scattered_triangles<float>(150, 0.4F, random), size, place);
  };
  const Vector3f place(0.31F, 0.27F, 0.1F);
  const auto ground = rough_ground<float>(16, 0.3F, random);
  const auto scattered = scattered_triangles<float>(600, 0.05F, random);
  const auto few = rough_ground<float>(6, 0.3F, random);
  const auto bowl = smooth_bowl<float>(24);
  const auto with_prop = joined<float>(few, prop(1e-3F, place));
  std::vector<GriddedMesh> all;
  all.push_back({"one list", 0, rough_ground<float>(3, 0.3F, random)});
  all.push_back({"cells", 0, ground});
  all.push_back({"one level", 1, scattered, {{1, 2, 1}, 1, 100}});
  all.push_back({"two levels", 2, scattered, {{2, 1, 1}, 1, 4}});
  all.push_back({"slabs", 0, bowl});
  all.push_back({"slabs, a level and inner grids", 1, smooth_bowl<float>(40), {{3, 3, 3}, 1, 120}});
  all.push_back({"inner grid", 2, with_prop, {.crowded = 2}});
  all.push_back({"inner grid in bricks", 2, with_prop, {{2, 3, 1}, 1, 30}});
  all.push_back({"inner grids in each other", 2, joined<float>(with_prop, prop(1e-6F, place)), {{1, 1, 1}, 1, 20}});
  const auto small_bowl = placed<float>(bowl, 1e-3F, bowl.vertices[200]);
  all.push_back({"inner grid and slabs", 0, joined<float>(bowl, small_bowl), {.crowded = 30}});
  return all;
}

/// Two instances of each mesh, turned and mirrored. They overlap, so paths meet many grids.
class MeshBatchScene {
 public:
  /// The meshes must outlive the scene.
  explicit MeshBatchScene(std::span<const GriddedMesh> meshes) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const auto collider = meshes[i].collider();
      for (int copy = 0; copy < 2; ++copy) {
        Posef pose;
        const Vector3f axis(random_.symmetric<float>(), random_.symmetric<float>(), 1);
        pose.linear = Eigen::AngleAxisf(3 * random_.symmetric<float>(), axis.normalized()).toRotationMatrix();
        if (random_.one_in(2)) pose.linear.col(1) *= -1;
        pose.translation = {2 * static_cast<float>(i % 4) + random_.unit<float>(), 2 * static_cast<float>(i / 4), 0};
        const InstanceId id = scene_.add(collider, pose);
        if (copy == 1) scene_.set_motion(id, {0.125F, 0.25F, -0.125F});
        drawers_.emplace_back(meshes[i].mesh.view(), i);
        poses_.push_back(pose);
      }
    }
    scene_.commit();
  }

  [[nodiscard]] const Scenef& scene() const { return scene_; }

  /// Draws a segment that is hard for one of the meshes.
  [[nodiscard]] Segmentf draw() {
    const std::size_t i = random_.below(poses_.size());
    const Pathf local = random_.one_in(4) ? drawers_[i].draw_axis_parallel() : drawers_[i].draw();
    const Vector3f end = local.has_end() ? local.toward : Vector3f(local.start + local.toward);
    const auto placed = [&](const Vector3f& point) {
      return Vector3f(poses_[i].linear * point + poses_[i].translation);
    };
    return {placed(local.start), placed(end)};
  }

 private:
  Random random_{6};
  Scenef scene_;
  std::vector<PathDrawer<float>> drawers_;
  std::vector<Posef> poses_;
};

/// Batches walk in lanes, and single queries do not.
template <typename AnyPath>
std::size_t expect_answers_of_single_queries(const Scenef& scene, const std::vector<AnyPath>& paths) {
  std::vector<SceneHitf> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size(), 2);
  scene.first_hits(paths, hits);
  scene.any_hits(paths, blocked);
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto expected = scene.first_hit(paths[i]);
    EXPECT_TRUE(same_bits(hits[i], expected.value_or(SceneHitf{}))) << hex_text(Pathf(paths[i]));
    EXPECT_EQ(blocked[i], expected ? 1 : 0) << hex_text(Pathf(paths[i]));
    EXPECT_EQ(scene.any_hit(paths[i]), expected.has_value()) << hex_text(Pathf(paths[i]));
    hit_count += expected ? 1 : 0;
  }
  return hit_count;
}

/// The meshes have the grids that their names say.
TEST(MeshBatch, IsAskedOfGridsOfAllKinds) {
  for (const GriddedMesh& mesh : gridded_meshes()) {
    SCOPED_TRACE(mesh.name);
    const auto has = [&](const char* part) { return mesh.name.find(part) != std::string::npos; };
    const auto collider = mesh.collider();
    const auto& state = detail::ColliderState<float>::of(*collider);
    EXPECT_EQ(state.grid.is_one_list(), has("one list"));
    EXPECT_EQ(state.mesh.has_slabs(), has("slabs"));
    EXPECT_EQ(!state.grid.inner_frames().empty(), has("inner grid"));
    EXPECT_EQ(state.grid.levels(), mesh.levels);
    EXPECT_TRUE(state.grid.inner_frames().size() > 1 || !has("inner grids"));
  }
}

TEST(MeshBatch, AnswersAsSingleQueriesDo) {
  const auto meshes = gridded_meshes();
  on_every_instruction_set([&] {
    MeshBatchScene world(meshes);
    std::vector<Segmentf> segments;
    std::vector<Rayf> rays;
    std::vector<Linef> lines;
    for (std::size_t i = case_count(4000); i > 0; --i) {
      const Segmentf segment = world.draw();
      segments.push_back(segment);
      rays.push_back({segment.start, segment.end - segment.start});
      lines.push_back({segment.start, segment.end - segment.start});
    }
    EXPECT_GT(expect_answers_of_single_queries(world.scene(), segments), segments.size() / 4);
    EXPECT_GT(expect_answers_of_single_queries(world.scene(), rays), rays.size() / 4);
    EXPECT_GT(expect_answers_of_single_queries(world.scene(), lines), lines.size() / 4);
  });
}

/// Each mesh alone: a lane has no levels that it takes from a lane beside it.
TEST(MeshBatch, AnswersAsSingleQueriesDoForEachGridAlone) {
  for (const GriddedMesh& mesh : gridded_meshes()) {
    SCOPED_TRACE(mesh.name);
    MeshBatchScene world({&mesh, 1});
    std::vector<Segmentf> segments;
    for (std::size_t i = case_count(1000); i > 0; --i) segments.push_back(world.draw());
    EXPECT_GT(expect_answers_of_single_queries(world.scene(), segments), segments.size() / 4);
  }
}

}  // namespace
}  // namespace surehit::test::mesh_batch_test
