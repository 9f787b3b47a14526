#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "faulty_vulkan.hpp"
#include "gpu/device_answers.hpp"
#include "gpu_answers.hpp"
#include "lost_device.hpp"
#include "reused_device.hpp"
#include "small_dispatches.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "surehit/gpu_scene.hpp"

namespace surehit::test::gpu_scene_failures_test {
namespace {

using detail::GpuDeviceState;
using Reason = GpuError::Reason;

/// Two instances of a piece of ground on a device that fails.
class GpuSceneFailuresTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override {
    renew(device, [] { return any_gpu(); });
    SUREHIT_SKIP_WITHOUT(device);
    Random random(1);
    ground = std::make_shared<Colliderf>(rough_ground<float>(20, 0.1F, random).view());
    first = scene.add(ground);
    scene.add(ground, Posef::translated({0.5F, 0.25F, 0.75F}));
    scene.commit();
    draw_paths(2000);
  }
  void draw_paths(std::size_t count) {
    Random random(2);
    while (paths.size() < count) {
      const auto x = random.symmetric<float>();
      const auto y = random.symmetric<float>();
      paths.push_back({{x, y, 1}, {x, y + 0.125F, random.unit<float>() - 0.5F}});
    }
    expected.resize(paths.size());
    scene.first_hits(paths, expected);
  }
  /// Expects that a scene answers nothing until it is updated.
  void expect_refused(const GpuScene& on_gpu) const {
    std::vector<SceneHitf> hits(paths.size());
    const GpuBatchResult result = on_gpu.first_hits(paths, hits);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->reason, Reason::not_updated);
    EXPECT_EQ(result.finished, 0U);
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }

  static constexpr std::array<float, 9> corners = {0, 0, 0.5F, 1, 0, 0.5F, 0, 1, 0.5F};
  static constexpr std::array<unsigned, 3> triangle = {0, 1, 2};

  static inline GpuDevice device;
  std::shared_ptr<Colliderf> ground;
  Scenef scene;
  InstanceId first;
  std::vector<Segmentf> paths;
  std::vector<SceneHitf> expected;
};

TEST_F(GpuSceneFailuresTest, an_upload_without_memory_changes_nothing) {
  GpuScene on_gpu(device, scene.snapshot());
  const std::size_t bytes = on_gpu.memory_bytes();
  allocate = std::exchange(state().vulkan.AllocateMemory, no_memory);
  const auto expect_failure = [&](int calls, const char* what) {
    calls_left = calls;
    const GpuResult updated = on_gpu.try_update(scene.snapshot());
    ASSERT_FALSE(updated) << what;
    EXPECT_EQ(updated.error().reason, Reason::out_of_memory);
    EXPECT_NE(std::string(updated.error().what()).find(what), std::string::npos) << updated.error().what();
  };
  // The mesh is there, so that only the instances are uploaded.
  scene.set_pose(first, Posef::translated({0, 0, 3}));
  scene.commit();
  expect_failure(0, "the nodes of a scene");
  expect_failure(1, "the instances of a scene");
  scene.add(std::make_shared<Colliderf>(*ground));
  scene.add(std::make_shared<Colliderf>(TriangleMeshViewf(std::span(corners), std::span(triangle))));
  scene.commit();
  expect_failure(0, "the nodes of meshes");
  expect_failure(1, "the triangles of meshes");
  state().vulkan.AllocateMemory = allocate;
  EXPECT_EQ(on_gpu.memory_bytes(), bytes);
  std::vector<SceneHitf> hits(paths.size());
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
}

/// Meshes need six buffers for a shader, and scenes eight.
TEST_F(GpuSceneFailuresTest, a_device_with_few_buffers_has_meshes_alone) {
  const auto few = std::make_shared<GpuDeviceState>();
  std::vector<std::pair<VkPhysicalDevice, detail::DeviceReport>> found;
  ASSERT_FALSE(few->start());
  ASSERT_FALSE(few->find(found));
  VkPhysicalDevice chosen = VK_NULL_HANDLE;
  detail::DeviceReport report;
  for (const auto& [one, its_report] : found) {
    if (its_report.properties.deviceName != device.name()) continue;
    chosen = one;
    report = its_report;
  }
  ASSERT_NE(chosen, VkPhysicalDevice{VK_NULL_HANDLE});
  report.properties.limits.maxPerStageDescriptorStorageBuffers = 6;
  ASSERT_FALSE(few->open(chosen, report));
  const GpuDevice with_few = GpuDeviceState::device_of(few);
  expect_same_as_host(GpuCollider(with_few, *ground), *ground, paths);
  GpuScene on_gpu;
  const GpuResult uploaded = on_gpu.try_upload(with_few, scene.snapshot());
  ASSERT_FALSE(uploaded);
  EXPECT_EQ(uploaded.error().reason, Reason::missing_feature);
  EXPECT_NE(std::string(uploaded.error().what()).find("eight buffers"), std::string::npos) << uploaded.error().what();
}

TEST_F(GpuSceneFailuresTest, a_device_that_fails_in_the_middle_leaves_the_rest) {
  draw_paths(17'500);  // Three dispatches.
  const GpuScene on_gpu(device, scene.snapshot());
  SceneHitf unset;
  unset.t = 7;
  submit = std::exchange(state().vulkan.QueueSubmit, no_submit);
  submit_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  calls_left = 2 * submissions_of_dispatch(state());
  std::vector<SceneHitf> hits(paths.size(), unset);
  const GpuBatchResult result = on_gpu.first_hits(paths, hits);
  EXPECT_FALSE(result);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, Reason::out_of_memory);
  EXPECT_EQ(result.finished, paths_in_small_dispatch);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i], i < result.finished ? expected[i] : unset) << i;

  submit_result = VK_ERROR_DEVICE_LOST;
  calls_left = submissions_of_dispatch(state());
  const GpuBatchResult rest = on_gpu.first_hits(paths, hits, {}, {.goes_on_without_device = true});
  EXPECT_TRUE(rest);
  EXPECT_EQ(rest.error->reason, Reason::device_lost);
  EXPECT_EQ(hits, expected);
  GpuScene later;
  const GpuResult uploaded = later.try_upload(device, scene.snapshot());
  ASSERT_FALSE(uploaded);
  EXPECT_EQ(uploaded.error().reason, Reason::device_lost);
}

TEST_F(GpuSceneFailuresTest, a_device_that_is_lost_in_the_middle_leaves_the_rest) {
  draw_paths(17'500);  // Three dispatches.
  const GpuScene on_gpu(device, scene.snapshot());
  for (const LossInBatch& loss : losses_in_batch) {
    expect_lost_in_batch(device, on_gpu, paths, expected, loss);
    ASSERT_FALSE(HasFailure());
  }
}

/// The host answers the paths whose answers no sound device gives.
TEST_F(GpuSceneFailuresTest, faulty_answers_of_a_device_are_left_to_the_host) {
  const GpuScene on_gpu(device, scene.snapshot());
  faulty = &state();
  wait_for = std::exchange(state().vulkan.WaitForFences, faulty_answers);
  std::vector<SceneHitf> hits(paths.size());
  const auto beyond_the_last = static_cast<std::uint32_t>(ground->triangle_count());
  for (const auto& [triangle, side, instance] :
       {std::array{beyond_the_last, 1U, 0U}, std::array{0U, 1U, 2U}, std::array{0U, 2U, no_instance},
        std::array{0U, 7U, 0U}, std::array{0U, 1 + detail::DeviceHit::is_not_rounded, 0U}}) {
    set_faulty_answer(detail::DeviceSceneHit{{0.5F, 0.5F, 0.5F, triangle, side}, instance});
    EXPECT_TRUE(on_gpu.first_hits(paths, hits));
    EXPECT_EQ(hits, expected);
  }
  state().vulkan.WaitForFences = wait_for;
}

/// What was uploaded is what is asked, until it is updated.
TEST_F(GpuSceneFailuresTest, a_scene_answers_as_it_was_uploaded) {
  GpuScene on_gpu;
  std::vector<SceneHitf> hits(paths.size());
  EXPECT_EQ(on_gpu.first_hits(paths, hits).error->reason, Reason::not_updated);
  EXPECT_EQ(on_gpu.try_update(scene.snapshot()).error().reason, Reason::not_updated);
  EXPECT_EQ(on_gpu.try_upload(GpuDevice(), scene.snapshot()).error().reason, Reason::no_device);
  on_gpu = GpuScene(device, scene.snapshot());
  scene.set_pose(first, Posef::translated({0, 0, 3}));
  scene.commit();
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
  on_gpu.update(scene.snapshot());
  expect_same_as_host(on_gpu, scene, paths);

  ground->set_mask(0, 0);
  expect_refused(on_gpu);
  on_gpu.update(scene.snapshot());
  expect_same_as_host(on_gpu, scene, paths);
  ground->rebuild(TriangleMeshViewf(std::span(corners), std::span(triangle)));
  expect_refused(on_gpu);
  EXPECT_EQ(on_gpu.try_update(scene.snapshot()).error().reason, Reason::not_updated);
  on_gpu = GpuScene();
  scene.set_mask(first, 1);
  scene.commit();
  on_gpu = GpuScene(device, scene.snapshot());
  expect_same_as_host(on_gpu, scene, paths);
}

/// The two have the same version until one of them changes. The device has the tree of one.
TEST_F(GpuSceneFailuresTest, a_collider_and_its_copy_are_both_watched) {
  for (const bool changes_copy : {false, true}) {
    const auto copy = std::make_shared<Colliderf>(*ground);
    const InstanceId of_copy = scene.add(copy, Posef::translated({-0.5F, 0.25F, 0.75F}));
    scene.commit();
    GpuScene on_gpu(device, scene.snapshot());
    expect_same_as_host(on_gpu, scene, paths);
    (changes_copy ? copy : ground)->set_mask(0, 0);
    expect_refused(on_gpu);
    on_gpu.update(scene.snapshot());
    expect_same_as_host(on_gpu, scene, paths);
    scene.remove(of_copy);
  }
}

/// An assignment frees what the scene has of the collider, even if the new mesh has the same version.
TEST_F(GpuSceneFailuresTest, an_assigned_collider_has_changed) {
  const Colliderf same = *ground;
  const Colliderf other{TriangleMeshViewf(std::span(corners), std::span(triangle))};
  GpuScene on_gpu(device, scene.snapshot());
  for (const Colliderf* next : {&same, &other}) {
    *ground = *next;
    expect_refused(on_gpu);
    EXPECT_EQ(on_gpu.try_update(scene.snapshot()).error().reason, Reason::not_updated);
  }
  scene.commit();
  on_gpu.update(scene.snapshot());
  expect_same_as_host(on_gpu, scene, paths);
}

TEST_F(GpuSceneFailuresTest, meshes_are_uploaded_once) {
  GpuScene on_gpu(device, scene.snapshot());
  const std::size_t of_two = on_gpu.memory_bytes();
  for (int i = 0; i < 1000; ++i) scene.add(ground, Posef::translated({3 * static_cast<float>(i), 0, 0}));
  scene.commit();
  submit = std::exchange(state().vulkan.QueueSubmit, no_submit);
  calls_left = 1000;
  on_gpu.update(scene.snapshot());
  EXPECT_EQ(calls_left, 998);  // One for the nodes of the scene, and one for its instances.
  state().vulkan.QueueSubmit = submit;
  EXPECT_LT(on_gpu.memory_bytes(), of_two + 1000 * 200);
  expect_same_as_host(on_gpu, scene, paths);
}

}  // namespace
}  // namespace surehit::test::gpu_scene_failures_test
