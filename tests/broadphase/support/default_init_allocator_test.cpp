#include "support/default_init_allocator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surehit::detail::default_init_allocator_test {
namespace {

TEST(DefaultInitAllocator, keeps_what_a_vector_holds_where_it_grows) {
  UnsetVector<std::uint32_t> all;
  RoomyVector<std::uint32_t> same;
  for (std::uint32_t i = 0; i < 2'000'000; ++i) {
    all.push_back(i);
    same.push_back(i);
  }
  for (std::uint32_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i);
  EXPECT_TRUE(std::ranges::equal(all, same));
}

TEST(DefaultInitAllocator, sets_what_it_is_given_a_value_for) {
  UnsetVector<std::uint32_t> numbers(300'000, 5U);
  numbers.assign(200'000, 7U);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 7U), 200'000);
}

/// The memory has any size, and begins and ends anywhere in a page.
TEST(DefaultInitAllocator, faults_in_without_changing_what_memory_holds) {
  fault_in(nullptr, 0);
  const std::size_t size = 3'000'000;
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 37 >> 3);
  const std::vector<std::uint8_t> before = bytes;
  for (const std::size_t first : {0U, 1U, 4095U, 4096U, 70'001U}) {
    for (const std::size_t count : {0U, 1U, 65'535U, 65'536U, 65'537U, 2'097'152U, 2'900'000U}) {
      fault_in(bytes.data() + first, count);
      prefer_large_pages(bytes.data() + first, count);
    }
  }
  EXPECT_EQ(bytes, before);
}

}  // namespace
}  // namespace surehit::detail::default_init_allocator_test
