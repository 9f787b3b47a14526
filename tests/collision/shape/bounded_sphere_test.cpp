#include "shape/bounded_sphere.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "shape/exact_sphere.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/sphere_families.hpp"

namespace surehit::test::bounded_sphere_test {
namespace {

using detail::bounded_contact;
using detail::exact_contact;
using detail::SphereContact;
using detail::SphereFindings;
using detail::Verdict;

template <typename Scalar>
class BoundedSphere : public testing::Test {};
TYPED_TEST_SUITE(BoundedSphere, Scalars, ScalarNames);

bool is_same(const std::optional<SphereContact>& x, const std::optional<SphereContact>& y) {
  if (!x || !y) return x.has_value() == y.has_value();
  return x->t_lower == y->t_lower && x->t_upper == y->t_upper && x->feature == y->feature &&
         x->timed_by == y->timed_by && x->at_start == y->at_start;
}

TYPED_TEST(BoundedSphere, finds_out_what_is_true) {
  using Scalar = TypeParam;
  std::size_t undecided = 0;
  std::size_t ruled_out = 0;
  std::size_t begin_outside = 0;
  for (const SphereFamily family : all_sphere_families) {
    Random random(43 + static_cast<std::uint64_t>(family));
    const std::size_t count = case_count(sizeof(Scalar) == 4 ? 4000 : 800);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [sphere, triangle] = draw_sphere_pair<Scalar>(family, random);
      SphereContact bounded;
      SphereFindings findings;
      const Verdict verdict = bounded_contact(sphere, triangle, bounded, findings);
      const std::optional<SphereContact> exact = exact_contact(sphere, triangle);
      if (verdict == Verdict::undecided) {
        ASSERT_TRUE(is_same(exact, exact_contact(sphere, triangle, findings))) << name_of(family) << ", case " << i;
        if (findings.never_nearest.none()) continue;  // The triangle may have no area.
        ++undecided;
        ruled_out += findings.never_entered.count() + findings.never_nearest.count();
        begin_outside += static_cast<std::size_t>(findings.begins_outside);
        continue;
      }
      ASSERT_EQ(verdict == Verdict::hit, exact.has_value()) << name_of(family) << ", case " << i;
      if (!exact) continue;
      ASSERT_EQ(bounded.feature, exact->feature) << name_of(family) << ", case " << i;
      ASSERT_EQ(bounded.at_start, exact->at_start) << name_of(family) << ", case " << i;
      ASSERT_LE(bounded.t_lower, exact->t_upper) << name_of(family) << ", case " << i;
      ASSERT_GE(bounded.t_upper, exact->t_lower) << name_of(family) << ", case " << i;
    }
  }
  // There are seven parts, and six of them are asked whether they are nearest.
  EXPECT_GT(undecided, 0U);
  EXPECT_GT(ruled_out, 6 * undecided);
  EXPECT_GT(begin_outside, 0U);
}

}  // namespace
}  // namespace surehit::test::bounded_sphere_test
