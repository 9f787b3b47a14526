#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "cgal_sphere_oracle.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/shape_text.hpp"
#include "support/sphere_families.hpp"
#include "support/swept_truth.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::sphere_crosscheck_test {
namespace {

class SphereCrosscheck : public testing::TestWithParam<SphereFamily> {};

/// Compares each answer with CGAL's numbers and with exact roots in integers.
template <typename Scalar>
void check(SphereFamily family, std::size_t pairs) {
  Random random(31);
  std::size_t hits = 0;
  const std::size_t count = case_count(pairs);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [sphere, triangle] = draw_sphere_pair<Scalar>(family, random);
    const auto answer = intersect(sphere, triangle);
    hits += answer.has_value();
    ASSERT_EQ(cgal_error(sphere, triangle, answer), std::nullopt) << hex_text(sphere) << '\n' << hex_text(triangle);
    ASSERT_EQ(find_error(truth_of(sphere, triangle), answer), std::nullopt) << hex_text(sphere) << '\n'
                                                                            << hex_text(triangle);
  }
  // A family that turned into hits or misses alone would test little, and nobody would notice.
  if (count < 200) return;
  EXPECT_GE(hits, count / 20);
}

TEST_P(SphereCrosscheck, of_floats) { check<float>(GetParam(), 400); }
TEST_P(SphereCrosscheck, of_doubles) { check<double>(GetParam(), 400); }

/// A judge that accepts everything would find nothing.
TEST(CgalSphereOracle, tells_of_wrong_answers) {
  Random random(32);
  for (std::size_t hits = 0; hits < case_count(100);) {
    const auto [sphere, triangle] = draw_sphere_pair<double>(SphereFamily::general, random);
    const auto right = intersect(sphere, triangle);
    if (!right) {
      EXPECT_TRUE(cgal_error<double>(sphere, triangle, ShapeHit<double>{.triangle = 0}));
      continue;
    }
    ++hits;
    EXPECT_TRUE(cgal_error<double>(sphere, triangle, std::nullopt));
    for (double ShapeHit<double>::*field : {&ShapeHit<double>::t, &ShapeHit<double>::u, &ShapeHit<double>::v}) {
      for (const int steps : {-1, 1}) {
        ShapeHit<double> wrong = *right;
        wrong.*field = neighbour(wrong.*field, steps);
        EXPECT_TRUE(cgal_error<double>(sphere, triangle, wrong));
      }
    }
    ShapeHit<double> wrong = *right;
    wrong.started_touching = !wrong.started_touching;
    EXPECT_TRUE(cgal_error<double>(sphere, triangle, wrong));
    wrong = *right;
    wrong.feature = wrong.feature == Feature::face ? Feature::corner_a : Feature::face;
    EXPECT_TRUE(cgal_error<double>(sphere, triangle, wrong));
  }
}

/// A point that moves has a double contact, whose square root is zero.
TEST(CgalSphereOracle, tells_the_face_from_the_edge_that_a_point_meets) {
  const SweptSpheref point{{1, 1, 0}, {0, -3, 0}, 0};
  const Trianglef triangle{{3, 0, 1}, {2, -2, 0}, {-3, 2, 0}};
  // They meet at (13, -20, 0) / 24, which is on the edge from b to c.
  ShapeHitf hit{11.0F / 24, 17.0F / 24, 7.0F / 24, 0, Feature::edge_bc, false};
  EXPECT_EQ(cgal_error<float>(point, triangle, hit), std::nullopt);
  hit.feature = Feature::face;
  EXPECT_TRUE(cgal_error<float>(point, triangle, hit));
}

INSTANTIATE_TEST_SUITE_P(Families, SphereCrosscheck, testing::ValuesIn(all_sphere_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::sphere_crosscheck_test
