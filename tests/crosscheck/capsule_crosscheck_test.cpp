#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "cgal_capsule_oracle.hpp"
#include "support/capsule_families.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/shape_text.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::capsule_crosscheck_test {
namespace {

class CapsuleCrosscheck : public testing::TestWithParam<CapsuleFamily> {};

/// Compares each answer with CGAL's numbers.
template <typename Scalar>
void check(CapsuleFamily family, std::size_t pairs) {
  Random random(31);
  std::size_t hits = 0;
  const std::size_t count = case_count(pairs);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [capsule, triangle] = draw_capsule_pair<Scalar>(family, random);
    const auto answer = intersect(capsule, triangle);
    hits += answer.has_value();
    ASSERT_EQ(cgal_error(capsule, triangle, answer), std::nullopt) << hex_text(capsule) << '\n' << hex_text(triangle);
  }
  // A family that turned into hits or misses alone would test little, and nobody would notice.
  if (count < 100) return;
  EXPECT_GE(hits, count / 20);
}

TEST_P(CapsuleCrosscheck, of_floats) { check<float>(GetParam(), 100); }
TEST_P(CapsuleCrosscheck, of_doubles) { check<double>(GetParam(), 100); }

/// A judge that accepts everything would find nothing.
TEST(CgalCapsuleOracle, tells_of_wrong_answers) {
  Random random(32);
  for (std::size_t hits = 0; hits < case_count(30);) {
    const auto [capsule, triangle] = draw_capsule_pair<double>(CapsuleFamily::general, random);
    const auto right = intersect(capsule, triangle);
    if (!right) {
      EXPECT_TRUE(cgal_error<double>(capsule, triangle, ShapeHit<double>{.triangle = 0}));
      continue;
    }
    ++hits;
    EXPECT_TRUE(cgal_error<double>(capsule, triangle, std::nullopt));
    for (double ShapeHit<double>::*field : {&ShapeHit<double>::t, &ShapeHit<double>::u, &ShapeHit<double>::v}) {
      for (const int steps : {-1, 1}) {
        ShapeHit<double> wrong = *right;
        wrong.*field = neighbour(wrong.*field, steps);
        EXPECT_TRUE(cgal_error<double>(capsule, triangle, wrong));
      }
    }
    ShapeHit<double> wrong = *right;
    wrong.started_touching = !wrong.started_touching;
    EXPECT_TRUE(cgal_error<double>(capsule, triangle, wrong));
    wrong = *right;
    wrong.feature = wrong.feature == Feature::face ? Feature::corner_a : Feature::face;
    EXPECT_TRUE(cgal_error<double>(capsule, triangle, wrong));
  }
}

INSTANTIATE_TEST_SUITE_P(Families, CapsuleCrosscheck, testing::ValuesIn(all_capsule_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::capsule_crosscheck_test
