// What stands in for a GPU in programs that are built without one.

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/tables.hpp"
#include "command_line/gpu_batches.hpp"

namespace surehit::test::gpu_absent_test {
namespace {

/// Asks all that a program may ask. So it is linked only if all of this is there.
template <typename Asked>
std::string said_of(const Asked& asked) {
  try {
    const example::GpuBatchesOf<Asked> batches(asked, "");
    const std::vector<Segmentf> paths(1);
    std::vector<typename example::BatchTypes<Asked>::Hit> hits(1);
    std::vector<std::uint8_t> blocked(1);
    batches.first_hits(paths, hits, {});
    batches.any_hits(paths, blocked, {});
    return batches.name() + " has answered " + std::to_string(batches.counts().paths);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(GpuAbsentTest, batches_say_that_the_program_has_none) {
  EXPECT_EQ(said_of(Colliderf()), "this program was built without surehit::gpu");
  EXPECT_EQ(said_of(Scenef()), "this program was built without surehit::gpu");
}

TEST(GpuAbsentTest, tables_say_that_they_are_left_out) {
  const benchmark::Request request;
  benchmark::Report report("of no matter");
  testing::internal::CaptureStdout();
  benchmark::measure_gpu(request, report);
  benchmark::measure_gpu_scenes(request, report);
  const std::string said = testing::internal::GetCapturedStdout();
  for (const char* table : {"\ngpu: left out, because", "\ngpu_scene: left out, because"}) {
    EXPECT_NE(said.find(table), std::string::npos) << said;
  }
  EXPECT_TRUE(report.records().empty());
}

}  // namespace
}  // namespace surehit::test::gpu_absent_test
