// The programs that have --gpu.

#include "command_line/gpu_batches.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "command_line/gpu_record.hpp"
#include "examples/surehit_query_run.hpp"
#include "gpu_answers.hpp"
#include "level/level.hpp"
#include "line_of_sight/floor_plan.hpp"
#include "line_of_sight/sight.hpp"
#include "picture/ppm.hpp"
#include "render/id_picture.hpp"
#include "render/shaded_picture.hpp"
#include "support/random.hpp"
#include "visibility_bake/bake.hpp"
#include "visibility_bake/cells.hpp"
#include "visibility_bake/small_level.hpp"
#include "visibility_bake/visible_sets.hpp"

namespace surehit::test::gpu_batches_test {
namespace {

class GpuBatchesTest : public SurehitQueryRun {
 protected:
  void SetUp() override {
    const GpuDevice device = any_gpu();
    SUREHIT_SKIP_WITHOUT(device);
    name = device.name();
    setenv("ASAN_OPTIONS", "detect_leaks=0", 0);  // See driver_leaks.cpp.
  }
  std::string name;
};

TEST_F(GpuBatchesTest, surehit_query_writes_the_same) {
  write_squares();
  Random random(4);
  std::string paths;
  for (int i = 0; i < 6000; ++i) {
    paths += std::to_string(random.between(-8, 12)) + (i % 6 == 5 ? "e-1\n" : "e-1 ");
  }
  write("paths.txt", paths);
  const std::string gpu = " --gpu-name '" + name + "'";
  for (const std::string question : {"first squares.obj paths.txt --points --normals",
                                     "first squares.obj paths.txt --path ray --cull back --min-t 0.25",
                                     "any squares.obj paths.txt --path line --ignore-triangle 1"}) {
    const Outcome on_host = run(question);
    EXPECT_GT(on_host.output.size(), 2000U);
    expect_output(question + gpu, on_host.output);
  }
  write("scene.txt", "squares.obj 1 0 0 0.1 0 1 0 0.2 0 0 1 0.3\nsquares.obj 0 -1 0 0 1 0 0 0 0 0 2 0\n");
  const std::string scene = " --scene scene.txt paths.txt --path line --ignore-instance 1 --ignore-triangle 0";
  for (const std::string& question : {"first" + scene, "any" + scene}) {
    const Outcome on_host = run(question);
    EXPECT_GT(on_host.output.size(), 2000U) << on_host.error;
    expect_output(question + gpu, on_host.output);
  }
  const Outcome counted = run("any squares.obj paths.txt --statistics" + gpu);
  EXPECT_NE(counted.error.find("\ngpu_paths,1000,,\ngpu_left_to_host,"), std::string::npos) << counted.error;
}

TEST_F(GpuBatchesTest, surehit_query_says_what_a_gpu_cannot_do) {
  write_squares();
  write("paths.txt", "0 0 1 0 0 -1\n");
  const auto expect_refused = [&](const std::string& arguments, int status, const std::string& reason) {
    const Outcome outcome = run("first squares.obj paths.txt " + arguments);
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_NE(outcome.error.find(reason), std::string::npos) << outcome.error;
  };
  expect_refused("--gpu --scalar double", 2, "only float has it");
  expect_refused("--gpu --path sphere", 2, "only straight paths have it");
  expect_refused("--gpu-name 'no such device'", 1, "Vulkan has no device with no such device in its name; there is ");
}

TEST(GpuCountsTest, what_the_host_did_and_why_a_device_failed_first_are_told) {
  example::GpuCounts counts;
  GpuBatchResult result;
  add(result, {.paths = 10, .hits = 8, .rounded_by_host = 3, .undecided = 2}, counts);
  EXPECT_EQ(counts.paths, 10U);
  EXPECT_EQ(counts.by_host, 5U);
  testing::internal::CaptureStderr();
  warn_of_failure("program", counts);
  for (const char* failure : {"it was lost", "it is still lost"}) {
    result.error = GpuError(GpuError::Reason::device_lost, failure);
    add(result, {.paths = 5, .undecided = 5}, counts);
  }
  EXPECT_EQ(counts.by_host, 15U);
  warn_of_failure("program", counts);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "program: warning: the host went on without the device: it was lost\n");
}

TEST_F(GpuBatchesTest, line_of_sight_sees_the_same) {
  const example::Level level = example::build_level({0.3F});
  const Colliderf collider(level.mesh.view());
  const Vector3f eye(level.eye[0], level.eye[1], level.eye[2]);
  const example::FloorPlan plan(collider, eye.z(), 40'000, 1);
  const example::GpuBatches gpu(collider, name);
  EXPECT_EQ(gpu.name(), name);
  EXPECT_EQ(look_around(collider, plan, eye, 0.5F, 2, &gpu), look_around(collider, plan, eye, 0.5F, 2));
  const example::GpuCounts counts = gpu.counts();
  EXPECT_GE(counts.paths, 40'000U);
  EXPECT_LT(counts.by_host, counts.paths / 20);
}

TEST_F(GpuBatchesTest, visibility_bake_bakes_the_same) {
  const example::Mesh<float> mesh = level_with_a_door();
  const Colliderf collider(mesh.view());
  const example::PairPlan plan(collider, example::find_floors(collider, {.spacing = 0.5F}),
                               {.range = 6, .samples = 5, .cell_width = 0.5F});
  const example::Checkpoint checkpoint(folder_.at("checkpoint"), 1);
  const example::GpuBatches gpu(collider, name);
  example::Visibility on_host(plan.cell_count());
  example::Visibility on_gpu(plan.cell_count());
  bake(collider, plan, checkpoint, {}, on_host);
  bake(collider, plan, checkpoint, {.threads = 2, .gpu = &gpu}, on_gpu);
  EXPECT_EQ(encode_visible_sets(plan, on_gpu), encode_visible_sets(plan, on_host));
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    EXPECT_EQ(on_gpu.figures(cell), on_host.figures(cell));
  }
  EXPECT_GT(gpu.counts().paths, 1000U);
}

/// The exercise has glass, for which the host has a filter. The level has none.
TEST_F(GpuBatchesTest, render_draws_the_same) {
  for (const example::Stage& stage : {example::exercise_stage(), example::level_stage()}) {
    example::World world(stage.model, Culling::none);
    const example::Camera camera = camera_of(stage, 96, 72);
    example::RayCounts counts;
    const auto draw = [&] {
      const example::Canvas shaded = draw_shaded(world, stage, {.width = 96, .height = 72, .threads = 2}, counts);
      return encode_ppm(shaded) + encode_ppm(draw_ids(world, camera, 2, counts));
    };
    const std::string on_host = draw();
    world.use_gpu(name);
    EXPECT_EQ(draw(), on_host);
    EXPECT_GT(world.gpu()->counts().paths, 10'000U);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_batches_test
