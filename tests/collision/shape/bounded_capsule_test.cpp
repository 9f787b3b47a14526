#include "shape/bounded_capsule.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "shape/exact_capsule.hpp"
#include "support/capsule_families.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::bounded_capsule_test {
namespace {

using detail::bounded_contact;
using detail::CapsuleContact;
using detail::CapsuleFindings;
using detail::exact_contact;
using detail::exact_tilt;
using detail::Verdict;

template <typename Scalar>
class BoundedCapsule : public testing::Test {};
TYPED_TEST_SUITE(BoundedCapsule, Scalars, ScalarNames);

/// What integers find that get nothing of what doubles have found out.
template <typename Scalar>
std::optional<CapsuleContact> found_by_integers(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  CapsuleFindings findings;
  findings.tilt = exact_tilt(capsule, triangle);
  return exact_contact(capsule, triangle, findings);
}

bool is_same(const std::optional<CapsuleContact>& x, const std::optional<CapsuleContact>& y) {
  if (!x || !y) return x.has_value() == y.has_value();
  return x->t_lower == y->t_lower && x->t_upper == y->t_upper && x->feature == y->feature && x->core == y->core &&
         x->at_start == y->at_start;
}

TYPED_TEST(BoundedCapsule, finds_out_what_is_true) {
  using Scalar = TypeParam;
  std::size_t undecided = 0;
  std::size_t ruled_out = 0;
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(43 + static_cast<std::uint64_t>(family));
    const std::size_t count = case_count(sizeof(Scalar) == 4 ? 2000 : 400);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<Scalar>(family, random);
      CapsuleContact bounded;
      CapsuleFindings findings;
      const Verdict verdict = bounded_contact(capsule, triangle, bounded, findings);
      const std::optional<CapsuleContact> exact = found_by_integers(capsule, triangle);
      if (verdict == Verdict::undecided) {
        ASSERT_TRUE(is_same(exact, exact_contact(capsule, triangle, findings))) << name_of(family) << ", case " << i;
        if (!findings.tilt) continue;  // The triangle may have no area.
        ++undecided;
        ruled_out += findings.never_entered.count() + findings.never_nearest.count();
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
  // There are 21 pairs of parts, with two questions each.
  EXPECT_GT(undecided, 0U);
  EXPECT_GT(ruled_out, 16 * undecided);
}

}  // namespace
}  // namespace surehit::test::bounded_capsule_test
