#include "agents_tick/ticks.hpp"

#include <gtest/gtest.h>

namespace surehit::example::ticks_test {
namespace {

constexpr TickOptions small{.agents = 400, .segments = 4'000, .ticks = 5};

TEST(Ticks, some_look_through_glass) {
  const TickReport report = run_ticks(small);
  EXPECT_EQ(report.instances, 2'000u);
  EXPECT_EQ(report.looks, small.segments * small.ticks);
  EXPECT_GT(report.visible, report.looks / 10);
  EXPECT_LT(report.visible, report.looks);
  EXPECT_GT(report.through_glass, 100u);
  EXPECT_LT(report.through_glass, report.visible);
}

TEST(Ticks, are_the_same_for_any_number_of_threads) {
  const TickReport alone = run_ticks(small);
  for (const unsigned threads : {2u, 8u}) {
    TickOptions options = small;
    options.threads = threads;
    const TickReport report = run_ticks(options);
    EXPECT_EQ(report.hash, alone.hash);
    EXPECT_EQ(report.visible, alone.visible);
    EXPECT_EQ(report.through_glass, alone.through_glass);
  }
}

TEST(Ticks, another_seed_is_another_town) {
  TickOptions options = small;
  options.seed = 2;
  EXPECT_NE(run_ticks(options).hash, run_ticks(small).hash);
}

}  // namespace
}  // namespace surehit::example::ticks_test
