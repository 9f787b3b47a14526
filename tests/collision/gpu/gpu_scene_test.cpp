#include "surehit/gpu_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "collision/scene/unit_scenes.hpp"
#include "determinism/hard_scene.hpp"
#include "drawn_scene_paths.hpp"
#include "from_two_threads.hpp"
#include "gpu_answers.hpp"
#include "shared_gpu.hpp"
#include "small_dispatches.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"

namespace surehit::test::gpu_scene_test {
namespace {

using Reason = GpuError::Reason;

class GpuSceneTest : public SharedGpu {};

/// Asks about drawn scenes, whose paths and options are hard for them.
class GpuSceneFamilies : public GpuSceneTest, public testing::WithParamInterface<SceneFamily> {};

TEST_P(GpuSceneFamilies, have_the_answers_of_the_host) {
  Random random(20261126 + static_cast<std::uint64_t>(GetParam()));
  GpuScene on_gpu;
  std::size_t hits = 0;
  for (std::size_t i = case_count(40); i > 0; --i) {
    const DrawnScene<float> drawn = draw_scene<float>(GetParam(), random);
    const JudgedScene<float> judged(drawn);
    const auto paths = draw_scene_paths(drawn, judged, random);
    ASSERT_TRUE(on_gpu.try_upload(device, judged.scene.snapshot()));
    hits += paths.expect_same_as_host(on_gpu, judged.scene, &statistics);
    ASSERT_FALSE(HasFailure()) << "scene " << i;
  }
  EXPECT_GT(hits, statistics.paths / 20);
  RecordProperty("undecided",
                 std::to_string(static_cast<double>(statistics.undecided) / static_cast<double>(statistics.paths)));
  RecordProperty("rounded", std::to_string(static_cast<double>(statistics.rounded) /
                                           static_cast<double>(statistics.rounded + statistics.rounded_by_host)));
}

INSTANTIATE_TEST_SUITE_P(Families, GpuSceneFamilies, testing::ValuesIn(all_scene_families),
                         [](const auto& family) { return name_of(family.param); });

TEST_F(GpuSceneTest, answers_are_the_published_ones) {
  const HardScene<float> hard;
  const Scenef scene = hard.scene();
  const GpuScene on_gpu(device, scene.snapshot());
  EXPECT_EQ(SceneAnswers<float>(scene, on_gpu, hard.paths).hash(), published_scene_hash<float>);
}

/// The image is near the path, and both are near the origin. But in the frame of the mesh, the path is far away, so it
/// is off by much more than the kernel's own roundings. Paths go through edges.
TEST_F(GpuSceneTest, meshes_far_from_their_own_origins) {
  Random random(5);
  GpuScene on_gpu;
  for (const float distance : {3e2F, 3e3F, 3e4F}) {
    SCOPED_TRACE(distance);
    const Vector3f offset(distance, -distance, distance / 2);
    const auto far = std::make_shared<Colliderf>(placed(rough_ground<float>(6, 0.3F, random), 1.0F, offset).view());
    Scenef scene;
    for (int i = 0; i < 4; ++i) {
      Posef pose = draw_pose<float>(SceneFamily::rotations, random);
      pose.translation = -(pose.linear * offset);
      scene.add(far, pose);
    }
    scene.commit();
    const std::vector<InstanceId> ids = scene.instances();
    std::vector<Segmentf> segments;
    for (std::size_t i = case_count(4000); i > 0; --i) {
      const auto triangle = static_cast<std::uint32_t>(random.below(far->triangle_count()));
      const Trianglef placed_triangle = scene.triangle(ids[random.below(ids.size())], triangle);
      const auto weight = random.unit<float>();
      const Vector3f target = placed_triangle.a * weight + placed_triangle.b * (1 - weight);
      const Vector3f way(random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>());
      segments.push_back({target - 0.1F * way, target + 0.1F * way});
    }
    ASSERT_TRUE(on_gpu.try_upload(device, scene.snapshot()));
    EXPECT_GT(expect_same_as_host(on_gpu, scene, segments, {}, &statistics), segments.size() / 3);
  }
}

/// A field of turned, scaled and moving pieces of ground, which share two meshes, and segments in general position.
class GpuFieldTest : public GpuSceneTest {
 protected:
  void SetUp() override {
    SUREHIT_SKIP_WITHOUT(device);
    for (int i = 0; i < 2; ++i) {
      const GeneratedMesh<float> mesh = ground();
      const std::vector<std::uint32_t> masks = drawn_masks(mesh.triangles.size());
      meshes.push_back(std::make_shared<Colliderf>(mesh.view(), with_masks(masks)));
    }
    for (int i = 0; i < 100; ++i) {
      const InstanceId id = scene.add(meshes[random.below(2)], drawn_pose(), {.mask = 1U << random.below(3)});
      if (i % 3 == 0) scene.set_motion(id, drawn_point() * 0.25F);
      ids.push_back(id);
    }
    scene.commit();
    for (std::size_t i = 0; i < 2000; ++i) segments.push_back({drawn_point(), drawn_point()});
  }

  GeneratedMesh<float> ground() { return rough_ground<float>(12, 0.3F, random); }
  std::vector<std::uint32_t> drawn_masks(std::size_t count) {
    std::vector<std::uint32_t> masks(count);
    for (std::uint32_t& mask : masks) mask = 1U << random.below(4);
    return masks;
  }
  Vector3f drawn_point() {
    return 5 * Vector3f(random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>());
  }
  Posef drawn_pose() {
    const Vector3f axis = drawn_point();
    const float scale = 1 / std::sqrt(axis.squaredNorm() + 1);
    Posef pose = Posef::rigid({axis[0] * scale, axis[1] * scale, axis[2] * scale, scale}, drawn_point());
    pose.linear *= 0.5F + random.unit<float>();
    if (random.one_in(4)) pose.linear.row(0) *= -1;
    return pose;
  }

  Random random{17};
  std::vector<std::shared_ptr<Colliderf>> meshes;
  Scenef scene;
  std::vector<InstanceId> ids;
  std::vector<Segmentf> segments;
};

TEST_F(GpuFieldTest, most_of_it_is_decided_on_the_device) {
  const GpuScene on_gpu(device, scene.snapshot());
  const std::size_t hits = expect_same_as_host(on_gpu, scene, segments, {}, &statistics);
  EXPECT_GT(hits, segments.size() / 3);
  EXPECT_EQ(statistics.paths, 2 * segments.size());
  EXPECT_EQ(statistics.paths, statistics.misses + statistics.hits + statistics.undecided);
  EXPECT_LT(statistics.undecided, statistics.paths / 100) << statistics.undecided;
  EXPECT_LT(statistics.rounded_by_host, statistics.rounded / 20) << statistics.rounded_by_host;
}

TEST_F(GpuFieldTest, options_of_each_path) {
  const GpuScene on_gpu(device, scene.snapshot());
  PathsOfKinds<SceneQueryOptionsf> paths;
  for (std::size_t i = 0; i < case_count(3000); ++i) {
    const Vector3f start = drawn_point();
    const Vector3f toward = drawn_point();
    const auto kind = static_cast<PathKind>(i % 3);
    const Pathf path(kind, start, kind == PathKind::segment ? toward : Vector3f(toward - start));
    SceneQueryOptionsf options;
    const auto hit = scene.first_hit(path);
    if (hit && i % 2 == 0) options = draw_scene_options(*hit, random);
    if (i % 5 == 0) options.mask = 1U << random.below(4);
    if (i % 7 == 0) options.instance_mask = 1U << random.below(3);
    if (i % 11 == 0) options.culling = random.one_in(2) ? Culling::back : Culling::front;
    if (hit && i % 3 == 0) {
      options.ignored_instance = hit->instance;
      if (random.one_in(2)) options.ignored_triangle = hit->triangle;
      if (random.one_in(4)) ++options.ignored_instance.generation;  // It ignores nothing.
    }
    paths.add(path, options);
  }
  EXPECT_GT(paths.expect_same_as_host(on_gpu, scene, &statistics), case_count(3000) / 4);
  EXPECT_LT(statistics.undecided, statistics.paths / 5);
}

/// All is far from the origin, so paths and instances have few digits to spare.
TEST_F(GpuFieldTest, far_away) {
  for (const float distance : {1e4F, 1e6F, 1e8F}) {
    SCOPED_TRACE(distance);
    const Vector3f far(distance, -distance, distance / 2);
    for (const InstanceId id : ids) {
      Posef pose = scene.pose(id);
      pose.translation = drawn_point() + far;
      scene.set_pose(id, pose);
    }
    scene.commit();
    std::vector<Segmentf> there;
    for (const Segmentf& segment : segments) there.push_back({segment.start + far, segment.end + far});
    expect_same_as_host(GpuScene(device, scene.snapshot()), scene, there, {}, &statistics);
  }
  EXPECT_GT(statistics.hits, statistics.paths / 20);
}

TEST_F(GpuFieldTest, what_the_host_must_answer) {
  // The device has neither a matrix of this size nor a mesh of that one. Paths that miss their boxes do not care.
  const auto large = std::make_shared<Colliderf>(placed(ground(), 1e11F, Vector3f(0, 0, 0)).view());
  Posef tiny;
  tiny.linear *= 1e-11F;
  tiny.translation = {1, 0, 0};
  scene.add(large, tiny);
  tiny.translation = {-1, 0, 0};
  tiny.linear *= 0.1F;
  scene.add(std::make_shared<Colliderf>(placed(ground(), 1e8F, Vector3f(0, 0, 0)).view()), tiny);
  scene.add(std::make_shared<Colliderf>());
  scene.remove(ids[3]);
  scene.set_mask(ids[4], 0);
  scene.commit();
  expect_same_as_host(GpuScene(device, scene.snapshot()), scene, segments, {}, &statistics);
  EXPECT_GT(statistics.undecided, statistics.paths / 100);
  EXPECT_LT(statistics.undecided, statistics.paths / 2);
  // An instance beyond all bounds leaves everything to the host.
  scene.add(meshes[0], Posef::translated({1e10F, 0, 0}));
  scene.commit();
  GpuStatistics of_all;
  expect_same_as_host(GpuScene(device, scene.snapshot()), scene, segments, {}, &of_all);
  EXPECT_EQ(of_all.undecided, of_all.paths);
  EXPECT_EQ(of_all.dispatches, 0U);
  // So do filters, and empty scenes.
  const auto second = [](const SceneHitf& hit) { return hit.triangle % 2 == 1; };
  expect_same_as_host(GpuScene(device, scene.snapshot()), scene, segments, {.filter = second});
  Scenef empty;
  EXPECT_EQ(expect_same_as_host(GpuScene(device, empty.snapshot()), empty, segments), 0U);
}

/// Several dispatches, of which two are under way at a time, from several threads.
TEST_F(GpuFieldTest, large_batches_of_several_threads) {
  const GpuScene on_gpu(with_small_dispatches(device), scene.snapshot());
  std::vector<Segmentf> many;
  for (std::size_t i = 0; i < 75'000; ++i) {
    const Vector3f start = drawn_point();
    many.push_back({start, start + 0.1F * drawn_point()});
  }
  expect_same_from_two_threads(on_gpu, scene, many, 10);
}

}  // namespace
}  // namespace surehit::test::gpu_scene_test
