#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "cgal_box_oracle.hpp"
#include "support/box_families.hpp"
#include "support/case_count.hpp"
#include "support/shape_text.hpp"
#include "support/wrong_answers.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::box_crosscheck_test {
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
TEST_P(BoxCrosscheck, refuses_wrong_answers) {
  Random random(32);
  for (std::size_t i = case_count(20); i > 0; --i) {
    const auto [box, triangle] = draw_box_pair<double>(GetParam(), random);
    for (const auto& wrong : wrong_answers(intersect(box, triangle))) {
      EXPECT_NE(cgal_error(box, triangle, wrong), std::nullopt) << hex_text(box) << '\n'
                                                                << hex_text(triangle) << '\n'
                                                                << (wrong ? hex_text(*wrong) : "a miss");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, BoxCrosscheck, testing::ValuesIn(all_box_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::box_crosscheck_test
