#include "support/float4.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "support/random.hpp"

namespace surehit::detail::float4_test {
namespace {

using test::Random;

Float4 draw(Random& random) {
  return Float4{random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>(),
                random.symmetric<float>()};
}

float max_of(Float4 x) { return std::max({x[0], x[1], x[2], x[3]}); }
float min_of(Float4 x) { return std::min({x[0], x[1], x[2], x[3]}); }

TEST(Float4, greatest_lanes_are_those_of_each_vector) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Float4 a = draw(random);
    const Float4 b = draw(random);
    const Float4 c = draw(random);
    const Float4 d = draw(random);
    const Float4 greatest = max_lanes(a, b, c, d);
    EXPECT_EQ(greatest[0], max_of(a));
    EXPECT_EQ(greatest[1], max_of(b));
    EXPECT_EQ(greatest[2], max_of(c));
    EXPECT_EQ(greatest[3], max_of(d));
  }
}

TEST(Float4, least_and_greatest_lane_are_in_every_lane) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Float4 x = draw(random);
    const Float4 least = min_lane(x);
    const Float4 greatest = max_lane(x);
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(least[lane], min_of(x));
      EXPECT_EQ(greatest[lane], max_of(x));
    }
  }
  const Float4 with_infinity = min_lane(Float4{std::numeric_limits<float>::infinity(), 3, 2, 5});
  for (int lane = 0; lane < 4; ++lane) EXPECT_EQ(with_infinity[lane], 2);
}

TEST(Float4, any_lane_sees_each_one) {
  EXPECT_FALSE(any_lane(Int4{0, 0, 0, 0}));
  for (int lane = 0; lane < 4; ++lane) {
    Int4 mask = {0, 0, 0, 0};
    mask[lane] = -1;
    EXPECT_TRUE(any_lane(mask)) << lane;
  }
  EXPECT_TRUE(any_lane(Float4{1, 2, 3, 4} < Float4{1, 2, 3, 5}));
  EXPECT_FALSE(any_lane(Float4{1, 2, 3, 4} < Float4{1, 2, 3, 4}));
}

TEST(Float4, bits_of_a_mask_are_its_lanes) {
  for (std::uint32_t bits = 0; bits < 16; ++bits) {
    Int4 mask = {0, 0, 0, 0};
    for (std::size_t lane = 0; lane < 4; ++lane) mask[lane] = (bits >> lane & 1) != 0 ? -1 : 0;
    EXPECT_EQ(bits_of_lanes(mask), bits);
    const Float4 kept = masked(mask, Float4{-1, 2, std::numeric_limits<float>::infinity(), -4});
    for (std::size_t lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(kept[lane], mask[lane] != 0 ? (Float4{-1, 2, std::numeric_limits<float>::infinity(), -4})[lane] : 0);
    }
  }
}

TEST(Float4, any_lane_is_compared_with_any) {
  EXPECT_FALSE(any_lane_exceeds_any(Float4{1, 2, 3, 4}, Float4{4, 5, 6, 7}));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Float4 a = {0, 0, 0, 0};
      Float4 b = {3, 3, 3, 3};
      a[i] = 2;
      b[j] = 1;
      EXPECT_TRUE(any_lane_exceeds_any(a, b)) << i << ' ' << j;
    }
  }
}

TEST(Float4, to_int_goes_toward_zero) {
  const Int4 whole = to_int(Float4{0.99F, 1.0F, -0.99F, -1.5F});
  EXPECT_EQ(whole[0], 0);
  EXPECT_EQ(whole[1], 1);
  EXPECT_EQ(whole[2], 0);
  EXPECT_EQ(whole[3], -1);
  // The largest float below the most finest cells, and that number itself.
  const Int4 large = to_int(Float4{32767.998F, 32768, 0, 16777216});
  EXPECT_EQ(large[0], 32767);
  EXPECT_EQ(large[1], 32768);
  EXPECT_EQ(large[3], 16777216);
}

TEST(Float4, lanes_are_compared_and_converted_one_by_one) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Float4 a = draw(random);
    const Float4 b = draw(random);
    const Int4 whole = to_int(100 * a);
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(min(a, b)[lane], std::min(a[lane], b[lane]));
      EXPECT_EQ(max(a, b)[lane], std::max(a[lane], b[lane]));
      EXPECT_EQ(absolute(a)[lane], a[lane] < 0 ? -a[lane] : a[lane]);
      EXPECT_EQ(to_float(whole)[lane], static_cast<float>(whole[lane]));
      EXPECT_EQ(without_fourth(a)[lane], a[std::min(lane, 2)]);
      EXPECT_EQ(with_fourth(a, b[0])[lane], lane == 3 ? b[0] : a[lane]);
    }
    EXPECT_EQ(sum_of(to_float(whole)), static_cast<float>(whole[0] + whole[1] + whole[2] + whole[3]));
    EXPECT_EQ(sum_of_three(to_float(whole)), static_cast<float>(whole[0] + whole[1] + whole[2]));
    EXPECT_EQ(any_lane_exceeds_any(a, b + 1), max_of(a) > min_of(b) + 1);
    const Int4 other = to_int(100 * b);
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(min(whole, other)[lane], std::min<std::int32_t>(whole[lane], other[lane]));
      EXPECT_EQ(max(whole, other)[lane], std::max<std::int32_t>(whole[lane], other[lane]));
    }
  }
}

}  // namespace
}  // namespace surehit::detail::float4_test
