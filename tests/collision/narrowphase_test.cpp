#include "narrowphase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
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

namespace surehit::test::narrowphase_test {
namespace {

using detail::Candidate;
using detail::Contact;
using detail::Narrowphase;
using detail::PathRange;

class NarrowphaseOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    visit_family<Scalar>(GetParam(), 41, 1'500, check_against_oracle<Scalar>);
  }

  template <typename Scalar>
  static void check_against_oracle(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                   const QueryOptions<Scalar>& options) {
    SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
    const auto truth = exact_contact(path, triangle, options);
    const PathRange<Scalar> range(path, options);
    if (range.is_empty()) {
      EXPECT_FALSE(truth);
      return;
    }
    QueryStatistics statistics;
    const Narrowphase<Scalar> narrowphase(path, options, range, statistics);
    Candidate<Scalar> candidate{5, triangle, {}};
    const bool found = narrowphase.find_contact(triangle, candidate.contact);
    EXPECT_EQ(found, truth.has_value());
    EXPECT_LE(statistics.exact_decisions, 1u);
    if (!found || !truth) return;
    const Contact& contact = candidate.contact;
    EXPECT_EQ(contact.side, truth->side);
    if (std::isfinite(contact.t_lower)) {
      EXPECT_LE(mpq_class(contact.t_lower), truth->t);
    }
    if (std::isfinite(contact.t_upper)) {
      EXPECT_GE(mpq_class(contact.t_upper), truth->t);
    }
    EXPECT_TRUE(same_bits(narrowphase.hit(candidate), rounded_hit<Scalar>(*truth, 5)));
  }
};

TEST_P(NarrowphaseOfFamily, agrees_with_the_oracle_for_float) { check<float>(); }
TEST_P(NarrowphaseOfFamily, agrees_with_the_oracle_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, NarrowphaseOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class NarrowphaseOf : public testing::Test {
 protected:
  explicit NarrowphaseOf(const Path<Scalar>& path) : path_(path) {}
  NarrowphaseOf() : NarrowphaseOf(Segment<Scalar>{{Scalar{0.25}, Scalar{0.25}, -1}, {Scalar{0.25}, Scalar{0.25}, 3}}) {}

  [[nodiscard]] Candidate<Scalar> candidate_of(const Triangle<Scalar>& triangle, std::uint32_t id) {
    Candidate<Scalar> candidate{id, triangle, {}};
    EXPECT_TRUE(narrowphase_.find_contact(triangle, candidate.contact));
    return candidate;
  }

  Path<Scalar> path_;
  QueryOptions<Scalar> options_;
  PathRange<Scalar> range_{path_, options_};
  QueryStatistics statistics_;
  Narrowphase<Scalar> narrowphase_{path_, options_, range_, statistics_};
};
TYPED_TEST_SUITE(NarrowphaseOf, Scalars, ScalarNames);

TYPED_TEST(NarrowphaseOf, clear_hit_takes_no_exact_decision) {
  this->path_ =
      Segment<TypeParam>{{TypeParam{0.21875}, TypeParam{0.3125}, -1}, {TypeParam{0.3125}, TypeParam{0.21875}, 2}};
  const auto candidate = this->candidate_of(unit_triangle<TypeParam>(), 0);
  static_cast<void>(this->narrowphase_.hit(candidate));
  EXPECT_EQ(this->statistics_.exact_decisions, 0u);
  EXPECT_EQ(this->statistics_.exact_orders, 0u);
  // A bound in double is narrow enough to round to float by; to double, it never is.
  EXPECT_EQ(this->statistics_.exact_roundings, (std::is_same_v<TypeParam, float> ? 0u : 1u));
}

/// What double with bounds known beforehand cannot tell, running bounds can: exact operations do not enlarge them.
/// A coordinate is too small for compact integers, which would decide before.
TYPED_TEST(NarrowphaseOf, edge_of_exact_products_takes_no_exact_decision) {
  this->path_ = Segment<TypeParam>{{TypeParam{0.25}, 0, -1}, {TypeParam{0.25}, 0, 1}};
  const Triangle<TypeParam> triangle{{0, 0, 0}, {1, 0, 0}, {TypeParam{0x1p-60}, 1, 0}};
  static_cast<void>(this->candidate_of(triangle, 0));
  EXPECT_EQ(this->statistics_.exact_decisions, 0u);
}

TYPED_TEST(NarrowphaseOf, path_between_corners_takes_no_exact_decision) {
  for (const Path<TypeParam>& path : {Path<TypeParam>(Segment<TypeParam>{{0, 1, 0}, {1, 0, 0}}),
                                      Path<TypeParam>(Segment<TypeParam>{{3, 1, 5}, {1, 0, 0}}),
                                      Path<TypeParam>(Ray<TypeParam>{{0, 1, 0}, {5, 1, -2}})}) {
    this->path_ = path;
    this->range_ = PathRange<TypeParam>(path, this->options_);
    static_cast<void>(this->narrowphase_.hit(this->candidate_of(unit_triangle<TypeParam>(), 0)));
    EXPECT_EQ(this->statistics_.exact_decisions, 0u);
    EXPECT_EQ(this->statistics_.exact_roundings, 0u);
  }
}

TYPED_TEST(NarrowphaseOf, contact_in_a_tilted_plane_takes_exact_arithmetic) {
  const TypeParam quarter{0.25};
  this->path_ = Segment<TypeParam>{{-1, quarter, 1 + quarter}, {2, quarter, quarter - 2}};
  const auto candidate = this->candidate_of({{0, 0, 0}, {0, 1, 1}, {1, 0, -1}}, 0);
  static_cast<void>(this->narrowphase_.hit(candidate));
  EXPECT_EQ(this->statistics_.exact_decisions, 1u);
  EXPECT_EQ(this->statistics_.exact_roundings, 1u);
}

TYPED_TEST(NarrowphaseOf, contact_in_the_plane_of_a_wall_takes_no_exact_decision) {
  this->path_ = Segment<TypeParam>{{-1, TypeParam{0.25}, 0}, {2, TypeParam{0.25}, 0}};
  const auto candidate = this->candidate_of(unit_triangle<TypeParam>(), 0);
  EXPECT_TRUE(same_bits(this->narrowphase_.hit(candidate),
                        rounded_hit<TypeParam>(*exact_contact<TypeParam>(this->path_, unit_triangle<TypeParam>()))));
  EXPECT_EQ(this->statistics_.exact_decisions, 0u);
  if constexpr (std::is_same_v<TypeParam, float>) {
    EXPECT_EQ(this->statistics_.exact_roundings, 0u);
  }
}

/// Where a path starts in two triangles, both t are 0, even if it lies in the plane of one of them.
TYPED_TEST(NarrowphaseOf, order_of_a_start_in_a_plane_takes_no_exact_arithmetic) {
  this->path_ = Segment<TypeParam>{{0, 0, 0}, {1, 1, 0}};
  const auto in_plane = this->candidate_of(unit_triangle<TypeParam>(), 4);
  const auto crossed = this->candidate_of({{0, 0, 0}, {0, 1, 1}, {1, 0, -1}}, 9);
  const auto decisions = this->statistics_.exact_orders;
  EXPECT_TRUE(this->narrowphase_.comes_before(in_plane, crossed));
  EXPECT_FALSE(this->narrowphase_.comes_before(crossed, in_plane));
  EXPECT_EQ(this->statistics_.exact_orders, decisions);
}

/// Where a path ends in two triangles, both t are 1.
TYPED_TEST(NarrowphaseOf, order_of_two_triangles_that_share_the_end_takes_no_exact_arithmetic) {
  const Triangle<TypeParam> tilted{{0, 0, 0}, {0, 1, 1}, {1, 0, -1}};
  for (const bool ends : {true, false}) {
    this->path_ = ends ? Segment<TypeParam>{{0, 0, -1}, {0, 0, 0}} : Segment<TypeParam>{{0, 0, 0}, {0, 0, -1}};
    const auto first = this->candidate_of(unit_triangle<TypeParam>(), 9);
    const auto second = this->candidate_of(tilted, 4);
    EXPECT_TRUE(this->narrowphase_.comes_before(second, first));
    EXPECT_FALSE(this->narrowphase_.comes_before(first, second));
    EXPECT_EQ(this->statistics_.exact_orders, 0u);
  }
}

/// A path in the plane of one triangle ends where it touches both.
TYPED_TEST(NarrowphaseOf, order_of_two_bounds_that_are_one_number_takes_no_exact_arithmetic) {
  const Triangle<TypeParam> tilted{{0, 0, 0}, {0, 1, 1}, {1, 0, -1}};
  this->path_ = Segment<TypeParam>{{-2, -1, 0}, {0, 0, 0}};
  const auto flat = this->candidate_of(unit_triangle<TypeParam>(), 9);
  for (const std::uint32_t id : {4U, 12U}) {
    const auto crossed = this->candidate_of(tilted, id);
    EXPECT_EQ(this->narrowphase_.comes_before(crossed, flat), id < 9);
    EXPECT_EQ(this->narrowphase_.comes_before(flat, crossed), id > 9);
  }
  EXPECT_EQ(this->statistics_.exact_orders, 0u);
}

/// The path starts in the first triangle alone. It meets the second one so little after the begin of the range that
/// bounds in double do not tell.
TEST(NarrowphaseOfDouble, order_of_a_start_in_a_plane_and_a_contact_right_after_the_begin) {
  const Path<double> path = Segment<double>{{0, 0, 0}, {1, 0, 0}};
  const QueryOptions<double> options{.min_t = 0.5};
  const PathRange<double> range(path, options);
  QueryStatistics statistics;
  const Narrowphase<double> narrowphase(path, options, range, statistics);
  const double after = std::nextafter(0.5, 1.0);
  const auto candidate_of = [&](const Triangle<double>& triangle, std::uint32_t id) {
    Candidate<double> candidate{id, triangle, {}};
    EXPECT_TRUE(narrowphase.find_contact(triangle, candidate.contact));
    return candidate;
  };
  const auto in_plane = candidate_of({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}, 9);
  const auto crossed = candidate_of({{after, -1, -1}, {after, 1, -1}, {after, 0, 1}}, 4);
  EXPECT_TRUE(in_plane.contact.at_start && !crossed.contact.at_start);
  EXPECT_TRUE(narrowphase.comes_before(in_plane, crossed));
  EXPECT_FALSE(narrowphase.comes_before(crossed, in_plane));
}

TYPED_TEST(NarrowphaseOf, order_is_by_t_and_then_by_id) {
  const Triangle<TypeParam> also_near{{0, 0, 0}, {0, 1, 1}, {1, 0, -1}};  // at height 0 there, but tilted
  const auto first = this->candidate_of(unit_triangle<TypeParam>(0), 9);
  const auto later = this->candidate_of(unit_triangle<TypeParam>(1), 1);
  const auto tied = this->candidate_of(also_near, 4);
  EXPECT_TRUE(this->narrowphase_.comes_before(first, later));
  EXPECT_FALSE(this->narrowphase_.comes_before(later, first));
  EXPECT_EQ(this->statistics_.exact_orders, 0u);
  EXPECT_TRUE(this->narrowphase_.comes_before(tied, first));
  EXPECT_FALSE(this->narrowphase_.comes_before(first, tied));
  EXPECT_EQ(this->statistics_.exact_orders, 2u);
  EXPECT_FALSE(this->narrowphase_.comes_before(first, first));
}

TYPED_TEST(NarrowphaseOf, order_in_a_common_plane_across_an_axis_takes_no_exact_arithmetic) {
  const Triangle<TypeParam> turned{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const auto first = this->candidate_of(unit_triangle<TypeParam>(), 3);
  const auto second = this->candidate_of(turned, 7);
  EXPECT_TRUE(this->narrowphase_.comes_before(first, second));
  EXPECT_FALSE(this->narrowphase_.comes_before(second, first));
  EXPECT_EQ(this->statistics_.exact_orders, 0u);
}

/// Both lie in the plane z = 0, and so does the path: it meets them where their edges are.
TYPED_TEST(NarrowphaseOf, order_of_contacts_in_a_common_plane_is_by_t) {
  this->path_ = Segment<TypeParam>{{-1, TypeParam{0.25}, 0}, {3, TypeParam{0.25}, 0}};
  const Triangle<TypeParam> farther{{TypeParam{0.5}, 0, 0}, {TypeParam{1.5}, 0, 0}, {TypeParam{0.5}, 1, 0}};
  const auto first = this->candidate_of(unit_triangle<TypeParam>(), 7);
  const auto second = this->candidate_of(farther, 3);
  EXPECT_TRUE(this->narrowphase_.comes_before(first, second));
  EXPECT_FALSE(this->narrowphase_.comes_before(second, first));
}

TYPED_TEST(NarrowphaseOf, overlapping_bounds_are_told_apart_exactly) {
  const TypeParam up = 1 + std::numeric_limits<TypeParam>::epsilon();
  this->path_ = Segment<TypeParam>{{0, 0, 0}, {3, 0, 0}};
  // Met at x = 1 and at x = 1 + epsilon/2^k: at the middle of an edge that climbs by one ulp over a long way.
  const Triangle<TypeParam> straight{{1, -1, -1}, {1, 1, -1}, {1, 0, 2}};
  const Triangle<TypeParam> turned{{1, -1, -1}, {up, 1024, -1}, {1, 0, 2}};
  const auto first = this->candidate_of(straight, 2);
  const auto second = this->candidate_of(turned, 1);
  EXPECT_TRUE(this->narrowphase_.comes_before(first, second));
  EXPECT_FALSE(this->narrowphase_.comes_before(second, first));
}

}  // namespace
}  // namespace surehit::test::narrowphase_test
