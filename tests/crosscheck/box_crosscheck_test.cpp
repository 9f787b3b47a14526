#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "cgal_box_oracle.hpp"
#include "support/box_families.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/shape_text.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

class BoxCrosscheck : public testing::TestWithParam<BoxFamily> {};

/// Compares each answer with CGAL's numbers.
template <typename Scalar>
void check(BoxFamily family, std::size_t pairs) {
  Random random(31);
  std::size_t hits = 0;
  const std::size_t count = case_count(pairs);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
    const auto answer = intersect(box, triangle);
    hits += answer.has_value();
    ASSERT_EQ(cgal_error(box, triangle, answer), std::nullopt) << hex_text(box) << '\n' << hex_text(triangle);
  }
  // A family that turned into hits or misses alone would test little, and nobody would notice.
  if (count < 200) return;
  EXPECT_GE(hits, count / 20);
}

TEST_P(BoxCrosscheck, of_floats) { check<float>(GetParam(), 300); }
TEST_P(BoxCrosscheck, of_doubles) { check<double>(GetParam(), 300); }

/// A judge that accepts everything would find nothing.
TEST(CgalBoxOracle, tells_of_wrong_answers) {
  Random random(32);
  for (std::size_t hits = 0; hits < case_count(30);) {
    const auto [box, triangle] = draw_box_pair<double>(BoxFamily::general, random);
    const auto right = intersect(box, triangle);
    if (!right) {
      EXPECT_TRUE(cgal_error<double>(box, triangle, ShapeHit<double>{.triangle = 0}));
      continue;
    }
    ++hits;
    EXPECT_TRUE(cgal_error<double>(box, triangle, std::nullopt));
    for (double ShapeHit<double>::*field : {&ShapeHit<double>::t, &ShapeHit<double>::u, &ShapeHit<double>::v}) {
      for (const int steps : {-1, 1}) {
        ShapeHit<double> wrong = *right;
        wrong.*field = neighbour(wrong.*field, steps);
        EXPECT_TRUE(cgal_error<double>(box, triangle, wrong));
      }
    }
    ShapeHit<double> wrong = *right;
    wrong.started_touching = !wrong.started_touching;
    EXPECT_TRUE(cgal_error<double>(box, triangle, wrong));
    wrong = *right;
    wrong.feature = wrong.feature == Feature::face ? Feature::corner_a : Feature::face;
    EXPECT_TRUE(cgal_error<double>(box, triangle, wrong));
  }
}

INSTANTIATE_TEST_SUITE_P(Families, BoxCrosscheck, testing::ValuesIn(all_box_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test
