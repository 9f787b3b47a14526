// How many paths a dispatch has, by the time that dispatches take.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>

#include "gpu/dispatch_size.hpp"

namespace surehit::test::gpu_dispatch_size_test {
namespace {

using detail::DispatchSize;
using std::chrono::milliseconds;

TEST(GpuDispatchSizeTest, short_dispatches_become_larger_and_long_ones_smaller) {
  DispatchSize size;
  EXPECT_EQ(size.paths(), DispatchSize::initial);
  const auto note = [&](int milliseconds_taken) {
    size.note(size.paths(), milliseconds(milliseconds_taken));
    return size.paths();
  };
  EXPECT_EQ(note(7), 2 * DispatchSize::initial);
  EXPECT_EQ(note(8), 2 * DispatchSize::initial);
  EXPECT_EQ(note(50), 2 * DispatchSize::initial);
  EXPECT_EQ(note(51), DispatchSize::initial);
  for (int i = 0; i < 20; ++i) note(0);
  EXPECT_EQ(size.paths(), DispatchSize::largest);
  for (int i = 0; i < 20; ++i) note(1000);
  EXPECT_EQ(size.paths(), DispatchSize::smallest);
}

/// The rest of a batch is short because it has few paths, and a dispatch that is still under way may have more.
TEST(GpuDispatchSizeTest, other_dispatches_say_nothing) {
  DispatchSize size;
  size.note(size.paths() - 1, milliseconds(0));
  EXPECT_EQ(size.paths(), DispatchSize::initial);
  size.note(size.paths() - 1, milliseconds(1000));
  EXPECT_EQ(size.paths(), DispatchSize::initial);
  size.note(2 * size.paths(), milliseconds(1000));
  EXPECT_EQ(size.paths(), DispatchSize::initial);
}

TEST(GpuDispatchSizeTest, dispatches_for_which_there_is_no_memory_become_smaller) {
  DispatchSize size;
  EXPECT_TRUE(size.shrink_below(DispatchSize::initial));
  EXPECT_EQ(size.paths(), DispatchSize::initial / 2);
  EXPECT_TRUE(size.shrink_below(DispatchSize::initial));  // Another batch found too little before.
  EXPECT_EQ(size.paths(), DispatchSize::initial / 2);
  EXPECT_TRUE(size.shrink_below(5000));
  EXPECT_EQ(size.paths(), DispatchSize::smallest);
  EXPECT_FALSE(size.shrink_below(DispatchSize::smallest));
  DispatchSize fixed;
  fixed.fix(8192);
  EXPECT_FALSE(fixed.shrink_below(8192));
}

TEST(GpuDispatchSizeTest, there_is_room_for_it) {
  for (const std::uint64_t room :
       {std::uint64_t{0}, std::uint64_t{5000}, std::uint64_t{200'000}, std::uint64_t{1} << 40}) {
    DispatchSize size;
    size.set_limit(room);
    for (int i = 0; i < 20; ++i) size.note(size.paths(), milliseconds(0));
    EXPECT_EQ(size.paths(), room < 8192 ? DispatchSize::smallest : room < 1'000'000 ? 131'072U : DispatchSize::largest);
  }
}

TEST(GpuDispatchSizeTest, a_fixed_number_stays) {
  DispatchSize size;
  size.fix(8192);
  size.note(8192, milliseconds(0));
  size.note(8192, milliseconds(1000));
  EXPECT_EQ(size.paths(), 8192U);
}

}  // namespace
}  // namespace surehit::test::gpu_dispatch_size_test
