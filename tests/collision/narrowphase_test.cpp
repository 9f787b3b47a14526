#include "narrowphase.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "family_cases.hpp"
#include "rational_determinants.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "unit_triangles.hpp"

namespace surehit::test {
namespace {

using detail::Contact;
using detail::Narrowphase;

class NarrowphaseOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    visit_family<Scalar>(GetParam(), 41, 3'000, check_against_oracle<Scalar>);
  }

  template <typename Scalar>
  static void check_against_oracle(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                   const QueryOptions<Scalar>& options) {
    SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
    const auto truth = exact_contact(path, triangle, options);
    QueryStatistics statistics;
    const Narrowphase<Scalar> narrowphase(path, options, statistics);
    if (narrowphase.admits_nothing()) {
      EXPECT_FALSE(truth);
      return;
    }
    const std::optional<Contact> contact = narrowphase.contact(triangle);
    EXPECT_EQ(contact.has_value(), truth.has_value());
    EXPECT_EQ(narrowphase.meets(triangle), truth.has_value());
    if (contact && truth) {
      EXPECT_TRUE(same_bits(narrowphase.hit({&triangle, 5, *contact}), rounded_hit<Scalar>(*truth, 5)));
    }
    EXPECT_EQ(statistics.paths, 1u);
    EXPECT_EQ(statistics.candidates, 2u);
    EXPECT_LE(statistics.exact_decisions, statistics.undecided);
    EXPECT_LE(statistics.undecided, statistics.candidates);
  }
};

TEST_P(NarrowphaseOfFamily, agrees_with_the_oracle_for_float) { check<float>(); }
TEST_P(NarrowphaseOfFamily, agrees_with_the_oracle_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, NarrowphaseOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class NarrowphaseOf : public testing::Test {
 protected:
  using Candidate = typename Narrowphase<Scalar>::Candidate;

  static Candidate candidate_of(const Narrowphase<Scalar>& narrowphase, const Triangle<Scalar>& triangle,
                                std::uint32_t id) {
    return {&triangle, id, narrowphase.contact(triangle).value()};
  }
};
TYPED_TEST_SUITE(NarrowphaseOf, Scalars, ScalarNames);

TYPED_TEST(NarrowphaseOf, clear_hit_takes_no_exact_decision) {
  const Path<TypeParam> path =
      Segment<TypeParam>{{TypeParam{0.21875}, TypeParam{0.3125}, -1}, {TypeParam{0.3125}, TypeParam{0.21875}, 2}};
  const QueryOptions<TypeParam> options;
  QueryStatistics statistics;
  const Narrowphase<TypeParam> narrowphase(path, options, statistics);
  const auto triangle = unit_triangle<TypeParam>();
  const auto candidate = this->candidate_of(narrowphase, triangle, 0);
  static_cast<void>(narrowphase.hit(candidate));
  EXPECT_EQ(statistics.candidates, 1u);
  EXPECT_EQ(statistics.undecided, 0u);
  EXPECT_EQ(statistics.exact_decisions, 0u);
  EXPECT_EQ(statistics.exact_orders, 0u);
  // A bound in double is narrow enough to round to float by; to double, it never is.
  EXPECT_EQ(statistics.exact_roundings, (std::is_same_v<TypeParam, float> ? 0u : 1u));
}

TYPED_TEST(NarrowphaseOf, contact_in_the_plane_takes_exact_arithmetic) {
  const Path<TypeParam> path = Segment<TypeParam>{{-1, TypeParam{0.25}, 0}, {2, TypeParam{0.25}, 0}};
  const QueryOptions<TypeParam> options;
  QueryStatistics statistics;
  const Narrowphase<TypeParam> narrowphase(path, options, statistics);
  const auto triangle = unit_triangle<TypeParam>();
  const auto candidate = this->candidate_of(narrowphase, triangle, 0);
  static_cast<void>(narrowphase.hit(candidate));
  EXPECT_EQ(statistics.undecided, 1u);
  EXPECT_EQ(statistics.exact_decisions, 1u);
  EXPECT_EQ(statistics.exact_roundings, 1u);
}

TYPED_TEST(NarrowphaseOf, order_is_by_t_and_then_by_id) {
  const Path<TypeParam> path =
      Segment<TypeParam>{{TypeParam{0.25}, TypeParam{0.25}, -1}, {TypeParam{0.25}, TypeParam{0.25}, 3}};
  const QueryOptions<TypeParam> options;
  QueryStatistics statistics;
  const Narrowphase<TypeParam> narrowphase(path, options, statistics);
  const auto near = unit_triangle<TypeParam>(0);
  const auto far = unit_triangle<TypeParam>(1);
  const Triangle<TypeParam> also_near{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const auto first = this->candidate_of(narrowphase, near, 9);
  const auto later = this->candidate_of(narrowphase, far, 1);
  const auto tied = this->candidate_of(narrowphase, also_near, 4);
  EXPECT_TRUE(narrowphase.comes_before(first, later));
  EXPECT_FALSE(narrowphase.comes_before(later, first));
  EXPECT_EQ(statistics.exact_orders, 0u);
  EXPECT_TRUE(narrowphase.comes_before(tied, first));
  EXPECT_FALSE(narrowphase.comes_before(first, tied));
  EXPECT_FALSE(narrowphase.comes_before(first, first));
  EXPECT_EQ(statistics.exact_orders, 3u);
}

TYPED_TEST(NarrowphaseOf, overlapping_bounds_are_told_apart_exactly) {
  const TypeParam up = 1 + std::numeric_limits<TypeParam>::epsilon();
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, 0}, {3, 0, 0}};
  const QueryOptions<TypeParam> options;
  QueryStatistics statistics;
  const Narrowphase<TypeParam> narrowphase(path, options, statistics);
  // Met at x = 1 and at x = 1 + epsilon/2^k: at the middle of an edge that climbs by one ulp over a long way.
  const Triangle<TypeParam> straight{{1, -1, -1}, {1, 1, -1}, {1, 0, 2}};
  const Triangle<TypeParam> turned{{1, -1, -1}, {up, 1024, -1}, {1, 0, 2}};
  const auto first = this->candidate_of(narrowphase, straight, 2);
  const auto second = this->candidate_of(narrowphase, turned, 1);
  EXPECT_TRUE(narrowphase.comes_before(first, second));
  EXPECT_FALSE(narrowphase.comes_before(second, first));
}

TYPED_TEST(NarrowphaseOf, path_or_options_that_admit_nothing) {
  const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  QueryStatistics statistics;
  const auto admits_nothing = [&](const Path<TypeParam>& path, const QueryOptions<TypeParam>& options) {
    return Narrowphase<TypeParam>(path, options, statistics).admits_nothing();
  };
  const Segment<TypeParam> good{{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(admits_nothing(good, {}));
  EXPECT_TRUE(admits_nothing(Segment<TypeParam>{{0, nan, 0}, {1, 0, 0}}, {}));
  EXPECT_TRUE(admits_nothing(good, {.min_t = nan}));
  EXPECT_TRUE(admits_nothing(good, {.min_t = 2}));
  EXPECT_EQ(statistics.paths, 4u);
}

}  // namespace
}  // namespace surehit::test
