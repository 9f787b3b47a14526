#include <gtest/gtest.h>

#include <cstddef>

#include "pair_cases.hpp"
#include "pair_judge.hpp"

namespace surehit::test::pair_crosscheck_test {
namespace {

/// Returns whether they meet.
template <typename Scalar>
bool check(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options) {
  const auto [meets, difference] = judge_pair(path, triangle, options);
  EXPECT_EQ(difference, "");
  return meets;
}

/// A family that turned into hits or misses alone would test little, and nobody would notice.
void expect_hits_and_misses(PairFamily family, std::size_t hits, std::size_t pairs) {
  if (pairs < 1000) return;
  if (family == PairFamily::disjoint_in_plane) {
    EXPECT_EQ(hits, 0u);
  } else {
    EXPECT_GE(hits, pairs / 20);
  }
  if (family == PairFamily::overlapping_in_plane) {
    EXPECT_EQ(hits, pairs);
  } else {
    EXPECT_GE(pairs - hits, pairs / 20);
  }
}

class PairCrosscheck : public testing::TestWithParam<PairFamily> {};

template <typename Scalar>
void check_segments(PairFamily family) {
  std::size_t pairs = 0;
  std::size_t hits = 0;
  visit_segments<Scalar>(family, [&](const auto&... pair) {
    hits += check(pair...);
    ++pairs;
  });
  expect_hits_and_misses(family, hits, pairs);
}

template <typename Scalar>
void check_rays_and_lines(PairFamily family) {
  visit_rays_and_lines<Scalar>(family, [](const auto&... pair) { check(pair...); });
}

template <typename Scalar>
void check_options(PairFamily family) {
  visit_options<Scalar>(family, [](const auto&... pair) { check(pair...); });
}

TEST_P(PairCrosscheck, float_segments) { check_segments<float>(GetParam()); }
TEST_P(PairCrosscheck, double_segments) { check_segments<double>(GetParam()); }
TEST_P(PairCrosscheck, float_rays_and_lines) { check_rays_and_lines<float>(GetParam()); }
TEST_P(PairCrosscheck, double_rays_and_lines) { check_rays_and_lines<double>(GetParam()); }
TEST_P(PairCrosscheck, float_options) { check_options<float>(GetParam()); }
TEST_P(PairCrosscheck, double_options) { check_options<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Families, PairCrosscheck, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::pair_crosscheck_test
