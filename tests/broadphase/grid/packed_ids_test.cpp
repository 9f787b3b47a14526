#include "grid/packed_ids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "support/random.hpp"

namespace surehit::test::packed_ids_test {
namespace {

static_assert(std::random_access_iterator<detail::PackedIdIterator>);

/// An end, and the number of bytes that the ids below it need.
struct Ids {
  std::uint64_t end;
  std::size_t width;
};

class PackedIdsTest : public testing::TestWithParam<Ids> {
 protected:
  /// Draws ids below the end. The first ones are the largest and the smallest.
  static std::vector<std::uint32_t> draw(std::size_t count, Random& random) {
    std::vector<std::uint32_t> ids = {static_cast<std::uint32_t>(GetParam().end - 1), 0};
    while (ids.size() < count) ids.push_back(static_cast<std::uint32_t>(random.below(GetParam().end)));
    ids.resize(count);
    return ids;
  }
};

TEST_P(PackedIdsTest, are_read_as_they_were_appended) {
  Random random(61);
  detail::PackedIds packed;
  for (const std::size_t count : {1U, 5U, 1000U, 3U}) {
    const std::vector<std::uint32_t> ids = draw(count, random);
    packed.clear(GetParam().end);
    EXPECT_TRUE(packed.empty());
    EXPECT_EQ(packed.width(), GetParam().width);
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    const auto id = [&](std::uint32_t number) { return ids[number]; };
    const std::size_t half = count / 2;
    packed.append({numbers.data(), half}, id);
    packed.append({}, id);
    packed.append({numbers.data() + half, count - half}, id);
    ASSERT_EQ(packed.size(), count);
    EXPECT_TRUE(std::ranges::equal(packed, ids));
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(packed[i], ids[i]) << i;
    const auto part = packed.between(half, count);
    ASSERT_EQ(part.size(), count - half);
    EXPECT_TRUE(std::ranges::equal(part, std::vector(ids.begin() + static_cast<std::ptrdiff_t>(half), ids.end())));
    ASSERT_FALSE(part.empty());
    EXPECT_EQ(part.front(), ids[half]);
    EXPECT_EQ(*(packed.end() - 1), ids.back());
    EXPECT_EQ(packed.begin()[static_cast<std::ptrdiff_t>(half)], ids[half]);
  }
}

TEST_P(PackedIdsTest, take_as_few_bytes_as_the_largest_needs) {
  Random random(62);
  const std::vector<std::uint32_t> ids = draw(100, random);
  detail::PackedIds packed;
  packed.clear(GetParam().end);
  packed.reserve(1000);
  EXPECT_GE(packed.capacity(), 1000U);
  packed.append(ids, [](std::uint32_t id) { return id; });
  EXPECT_GE(packed.memory_bytes(), 1000 * GetParam().width);
  packed.shrink_to_fit();
  EXPECT_TRUE(std::ranges::equal(packed, ids));
  EXPECT_GE(packed.memory_bytes(), 100 * GetParam().width);
  EXPECT_LE(packed.memory_bytes(), 100 * GetParam().width + 4);
  EXPECT_EQ(packed.address(99) - packed.address(0), static_cast<std::ptrdiff_t>(99 * GetParam().width));
}

INSTANTIATE_TEST_SUITE_P(Ends, PackedIdsTest,
                         testing::Values(Ids{1, 2}, Ids{std::uint64_t{1} << 16, 2},
                                         Ids{(std::uint64_t{1} << 16) + 1, 3}, Ids{std::uint64_t{1} << 24, 3},
                                         Ids{(std::uint64_t{1} << 24) + 1, 4}, Ids{std::uint64_t{1} << 32, 4}));

}  // namespace
}  // namespace surehit::test::packed_ids_test
