#include "support/scratch_vector.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

namespace surehit::detail::scratch_vector_test {
namespace {

TEST(ScratchVector, keeps_what_it_holds_where_it_grows) {
  ScratchVector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < 2'000'000; ++i) numbers.push_back(i);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
}

/// Each size is written to its last byte, so that a sanitizer sees what is not there.
TEST(ScratchVector, has_all_that_it_was_asked_for) {
  for (const std::size_t half : {std::size_t{1}, large_page / 2, large_page, 3 * large_page / 2}) {
    for (const std::size_t bytes : {half - 1, half, half + 1}) {
      ScratchVector<std::uint8_t> memory(bytes, 7);
      EXPECT_EQ(memory.size(), bytes);
      if (bytes == 0) continue;
      EXPECT_EQ(memory.back(), 7);
      const bool is_large = ScratchAllocator<std::uint8_t>::is_large(memory.capacity());
      EXPECT_FALSE(is_large && bytes < large_page / 2);
      EXPECT_GE(ScratchAllocator<std::uint8_t>::bytes_of(bytes), bytes);
      if (is_large) {
        EXPECT_EQ(ScratchAllocator<std::uint8_t>::bytes_of(bytes) % large_page, 0u);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.data()) % large_page, 0u);
      }
    }
  }
}

TEST(ScratchVector, of_more_than_any_memory_is_an_error) {
  constexpr std::size_t too_many = std::numeric_limits<std::size_t>::max() / 2 / sizeof(std::uint64_t) + 1;
  EXPECT_THROW(static_cast<void>(ScratchAllocator<std::uint64_t>().allocate(too_many)), std::bad_alloc);
  EXPECT_THROW(static_cast<void>(ScratchAllocator<std::uint64_t>().allocate(2 * too_many)), std::bad_alloc);
}

}  // namespace
}  // namespace surehit::detail::scratch_vector_test
