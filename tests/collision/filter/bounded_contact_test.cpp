#include "filter/bounded_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "collision/contact_oracle.hpp"
#include "collision/family_cases.hpp"
#include "collision/rational_determinants.hpp"
#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::bounded_contact_test {
namespace {

using detail::Bounded;
using detail::BoundedContact;
using detail::PathRange;
using detail::Verdict;

bool holds(const Bounded& x, const mpq_class& truth) { return abs(mpq_class(x.value) - truth) <= mpq_class(x.radius); }

bool holds(const std::array<double, 2>& interval, const mpq_class& truth) {
  return mpq_class(interval[0]) <= truth && truth <= mpq_class(interval[1]);
}

class BoundedContactOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    visit_family<Scalar>(GetParam(), 11, 1'500, check_against_oracle<Scalar>);
  }

  template <typename Scalar>
  static void check_against_oracle(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                   QueryOptions<Scalar> options) {
    keep_limits_alone(options);
    const PathRange<Scalar> range(path, options);
    if (range.is_empty()) return;
    expect_true(detail::bounded_contact(path, triangle, range), path, triangle, options);
    expect_true(detail::double_contact(path, triangle, range), path, triangle, options);
  }

  template <typename Scalar>
  static void expect_true(const BoundedContact& bounded, const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                          const QueryOptions<Scalar>& options) {
    SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
    const auto truth = expect_decided(bounded, path, triangle, options);
    if (!truth) return;
    const RationalDeterminants exact = rational_determinants(path, triangle);
    EXPECT_TRUE(holds(bounded.u_scaled, exact.u));
    EXPECT_TRUE(holds(bounded.v_scaled, exact.v));
    EXPECT_TRUE(holds(bounded.by_det.of(bounded.u_scaled), exact.u / exact.det));
    EXPECT_TRUE(holds(bounded.by_det.of(bounded.v_scaled), exact.v / exact.det));
  }
};

TEST_P(BoundedContactOfFamily, is_never_wrong_for_float) { check<float>(); }
TEST_P(BoundedContactOfFamily, is_never_wrong_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, BoundedContactOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

/// `contact_of(path, triangle)` is a stage of the filter. It may leave one pair in a thousand undecided.
template <typename Scalar, typename ContactOf>
void expect_nearly_all_decided(std::uint64_t seed, const ContactOf& contact_of) {
  Random random(seed);
  const auto point = [&]() -> Vector3<Scalar> {
    return Vector3<Scalar>::NullaryExpr([&] { return random.symmetric<Scalar>(); });
  };
  const std::size_t pairs = case_count(10'000);
  std::size_t undecided = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Triangle<Scalar> triangle{point(), point(), point()};
    undecided += contact_of(Segment<Scalar>{point(), point()}, triangle).verdict == Verdict::undecided;
  }
  EXPECT_LE(undecided, pairs / 1000);
}

template <typename Scalar>
class BoundedContactOf : public testing::Test {
 protected:
  static BoundedContact contact_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    return detail::bounded_contact(path, triangle, PathRange<Scalar>(path, {}));
  }
};
TYPED_TEST_SUITE(BoundedContactOf, Scalars, ScalarNames);

TYPED_TEST(BoundedContactOf, decides_nearly_all_random_pairs) {
  expect_nearly_all_decided<TypeParam>(12, this->contact_of);
}

TYPED_TEST(BoundedContactOf, is_certain_of_edges_and_corners_and_ends_on_small_integers) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (const Vector3<TypeParam>& target : {Vector3<TypeParam>{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, 2, 0}}) {
    const Segment<TypeParam> through{target - Vector3<TypeParam>{1, 2, 3}, target + Vector3<TypeParam>{1, 2, 3}};
    const BoundedContact crossing = this->contact_of(through, triangle);
    EXPECT_EQ(crossing.verdict, Verdict::hit);
    EXPECT_FALSE(crossing.contact.at_start || crossing.contact.at_end);
    const BoundedContact leaving = this->contact_of(Segment<TypeParam>{target, through.end}, triangle);
    EXPECT_EQ(leaving.verdict, Verdict::hit);
    EXPECT_TRUE(leaving.contact.at_start && !leaving.contact.at_end);
    const BoundedContact arriving = this->contact_of(Segment<TypeParam>{through.start, target}, triangle);
    EXPECT_EQ(arriving.verdict, Verdict::hit);
    EXPECT_TRUE(!arriving.contact.at_start && arriving.contact.at_end);
  }
}

TYPED_TEST(BoundedContactOf, leaves_what_lies_in_the_plane_undecided) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Segment<TypeParam> in_plane{{-1, 1, 0}, {5, 1, 0}};
  EXPECT_EQ(this->contact_of(in_plane, triangle).verdict, Verdict::undecided);
}

TYPED_TEST(BoundedContactOf, leaves_a_parameter_beyond_double_undecided) {
  if constexpr (std::is_same_v<TypeParam, double>) {
    const Triangle<TypeParam> triangle{{-1, -1, 1e300}, {1, -1, 1e300}, {0, 1, 1e300}};
    EXPECT_EQ(this->contact_of(Ray<TypeParam>{{0, 0, 0}, {0, 0, 1e-300}}, triangle).verdict, Verdict::undecided);
  } else {
    const Triangle<TypeParam> triangle{{-1, -1, 3e38f}, {1, -1, 3e38f}, {0, 1, 3e38f}};
    const BoundedContact contact = this->contact_of(Ray<TypeParam>{{0, 0, 0}, {0, 0, 1e-45f}}, triangle);
    EXPECT_EQ(contact.verdict, Verdict::hit);
    EXPECT_GT(contact.contact.t_lower, double{std::numeric_limits<TypeParam>::max()});
  }
}

template <typename Scalar>
class DoubleContactOf : public testing::Test {
 protected:
  static BoundedContact contact_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                   const QueryOptions<Scalar>& options = {}) {
    return detail::double_contact(path, triangle, PathRange<Scalar>(path, options));
  }
};
TYPED_TEST_SUITE(DoubleContactOf, Scalars, ScalarNames);

TYPED_TEST(DoubleContactOf, decides_nearly_all_random_pairs) {
  expect_nearly_all_decided<TypeParam>(
      14, [](const auto& path, const auto& triangle) { return TestFixture::contact_of(path, triangle); });
}

TYPED_TEST(DoubleContactOf, knows_side_and_parameter_of_a_clear_hit) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const BoundedContact down = this->contact_of(Segment<TypeParam>{{1, 1, 1}, {1, 1, -3}}, triangle);
  ASSERT_EQ(down.verdict, Verdict::hit);
  EXPECT_EQ(down.contact.side, Side::front);
  EXPECT_LE(down.contact.t_lower, 0.25);
  EXPECT_GE(down.contact.t_upper, 0.25);
  EXPECT_LT(down.contact.t_upper - down.contact.t_lower, 1e-12);
  const BoundedContact up = this->contact_of(Segment<TypeParam>{{1, 1, -3}, {1, 1, 1}}, triangle);
  ASSERT_EQ(up.verdict, Verdict::hit);
  EXPECT_EQ(up.contact.side, Side::back);
}

/// A bound known beforehand is never 0, so no zero is certain.
TYPED_TEST(DoubleContactOf, leaves_edges_ends_and_planes_undecided) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (const Segment<TypeParam>& segment :
       {Segment<TypeParam>{{2, 0, -1}, {2, 0, 1}}, Segment<TypeParam>{{1, 1, 0}, {1, 1, 5}},
        Segment<TypeParam>{{1, 1, 5}, {1, 1, 0}}, Segment<TypeParam>{{-1, 1, 0}, {5, 1, 0}}}) {
    EXPECT_EQ(this->contact_of(segment, triangle).verdict, Verdict::undecided);
  }
}

TYPED_TEST(DoubleContactOf, leaves_what_is_too_large_for_its_bound_undecided) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Ray<TypeParam> ray{{1, 1, -1}, {0, 0, 1}};
  EXPECT_EQ(this->contact_of(ray, triangle, {.max_t = 65536}).verdict, Verdict::hit);
  EXPECT_EQ(this->contact_of(ray, triangle, {.max_t = 65537}).verdict, Verdict::undecided);
  if constexpr (std::is_same_v<TypeParam, double>) {
    EXPECT_EQ(this->contact_of(Ray<TypeParam>{{1, 1, -1}, {0, 0, 1e300}}, triangle).verdict, Verdict::undecided);
    EXPECT_EQ(this->contact_of(ray, {{0, 0, 0}, {4, 0, 0}, {0, 1e300, 0}}).verdict, Verdict::undecided);
  }
}

TEST(BoundedQuotients, holds_the_true_quotient) {
  Random random(13);
  for (std::size_t i = case_count(200'000); i > 0; --i) {
    const auto scaled = [&] {
      return std::ldexp(random.symmetric<double>(), static_cast<int>(random.between(-900, 900)));
    };
    Bounded numerator{scaled(), 0};
    Bounded denominator{scaled(), 0};
    if (random.one_in(2)) numerator.radius = std::fabs(numerator.value) * random.unit<double>();
    if (random.one_in(2)) denominator.radius = std::fabs(denominator.value) * random.unit<double>();
    if (!denominator.sign() || denominator.sign() == 0) continue;
    const auto [lower, upper] = detail::BoundedQuotients(denominator).of(numerator);
    for (const int n : {-1, 0, 1}) {
      for (const int d : {-1, 0, 1}) {
        const mpq_class truth = (mpq_class(numerator.value) + n * mpq_class(numerator.radius)) /
                                (mpq_class(denominator.value) + d * mpq_class(denominator.radius));
        ASSERT_TRUE(!std::isfinite(lower) || mpq_class(lower) <= truth);
        ASSERT_TRUE(!std::isfinite(upper) || mpq_class(upper) >= truth);
      }
    }
  }
}

TEST(BoundedQuotients, of_exact_numbers_is_a_few_ulps_wide) {
  const auto [lower, upper] = detail::BoundedQuotients(detail::exact(3)).of(detail::exact(1));
  EXPECT_LT(upper - lower, 0x1p-49);
  const auto [zero_lower, zero_upper] = detail::BoundedQuotients(detail::exact(-3)).of(detail::exact(0));
  EXPECT_EQ(zero_lower, 0);
  EXPECT_EQ(zero_upper, 0);
}

}  // namespace
}  // namespace surehit::test::bounded_contact_test
