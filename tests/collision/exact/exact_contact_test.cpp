#include "exact/exact_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "collision/contact_oracle.hpp"
#include "collision/rational_determinants.hpp"
#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"

namespace surehit::test::exact_contact_test {
namespace {

using detail::PathRange;

class ExactContactOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar, typename Check>
  void for_each_pair(std::size_t count, Check&& check) {
    Random random(31);
    for (std::size_t i = case_count(count); i > 0 && !HasFailure(); --i) {
      const auto [segment, triangle] = draw_pair<Scalar>(GetParam(), random);
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const Path<Scalar> path = path_along(segment, kind);
        const auto unlimited = exact_contact(path, triangle);
        QueryOptions<Scalar> limits;
        if (random.one_in(2)) limits = draw_options(random, unlimited ? nearest<Scalar>(unlimited->t) : Scalar{1});
        keep_limits_alone(limits);
        if (!PathRange<Scalar>(path, limits).is_empty()) check(path, triangle, limits);
      }
    }
  }

  template <typename Scalar>
  void check_contact() {
    for_each_pair<Scalar>(
        1'500, [](const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& limits) {
          SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(limits));
          const auto truth = exact_contact(path, triangle, limits);
          const auto contact = detail::exact_contact(path, triangle, PathRange<Scalar>(path, limits));
          ASSERT_EQ(contact.has_value(), truth.has_value());
          if (truth) expect_contact_of(*truth, *contact, path, triangle, limits);
        });
  }

  template <typename Scalar>
  void check_rounding() {
    for_each_pair<Scalar>(
        1'500, [](const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& limits) {
          const auto truth = exact_contact(path, triangle, limits);
          if (!truth) return;
          Hit<Scalar> hit{.triangle = 7, .side = truth->side};
          detail::exact_rounding(path, triangle, PathRange<Scalar>(path, limits), hit);
          EXPECT_TRUE(same_bits(hit, rounded_hit<Scalar>(*truth, 7)))
              << hex_text(path) << hex_text(triangle) << hex_text(limits) << hex_text(hit);
        });
  }

  /// Against triangles that the same path meets: the family's own with its corners in other orders, where t is the
  /// same, and one that is put through a corner of it.
  template <typename Scalar>
  void check_order() {
    for_each_pair<Scalar>(750, [](const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                  const QueryOptions<Scalar>& limits) {
      const PathRange<Scalar> range(path, limits);
      const auto truth = exact_contact(path, triangle, limits);
      if (!truth) return;
      const Vector3<Scalar> nudged{triangle.a[0], triangle.a[1], triangle.a[2] / 2};
      for (const Triangle<Scalar>& other :
           {Triangle<Scalar>{triangle.b, triangle.c, triangle.a}, Triangle<Scalar>{triangle.c, triangle.b, triangle.a},
            Triangle<Scalar>{nudged, triangle.b, triangle.c}, Triangle<Scalar>{path.start, triangle.b, triangle.c}}) {
        const auto other_truth = exact_contact(path, other, limits);
        if (!other_truth) continue;
        const int expected = cmp(truth->t, other_truth->t);
        const auto order = detail::exact_order(path, triangle, other, range);
        EXPECT_EQ(order < 0   ? -1
                  : order > 0 ? 1
                              : 0,
                  (expected > 0) - (expected < 0))
            << hex_text(path) << hex_text(triangle) << hex_text(other) << hex_text(limits);
      }
    });
  }
};

TEST_P(ExactContactOfFamily, is_the_oracles_for_float) { check_contact<float>(); }
TEST_P(ExactContactOfFamily, is_the_oracles_for_double) { check_contact<double>(); }
TEST_P(ExactContactOfFamily, is_rounded_once_for_float) { check_rounding<float>(); }
TEST_P(ExactContactOfFamily, is_rounded_once_for_double) { check_rounding<double>(); }
TEST_P(ExactContactOfFamily, is_ordered_by_exact_t_for_float) { check_order<float>(); }
TEST_P(ExactContactOfFamily, is_ordered_by_exact_t_for_double) { check_order<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, ExactContactOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class Exact : public testing::Test {
 protected:
  static Vector3<Scalar> draw_vector(Random& random) {
    const auto coordinate = [&] { return random.one_in(2) ? random.symmetric<Scalar>() : random.any_finite<Scalar>(); };
    const Scalar x = coordinate();
    const Scalar y = coordinate();
    return {x, y, coordinate()};
  }
};
TYPED_TEST_SUITE(Exact, Scalars, ScalarNames);

TYPED_TEST(Exact, order_tells_neighbours_in_t_apart_that_round_to_one_double) {
  // The plane x = 1, and one that is turned by the least denormal: exact parameters differ far below double's last
  // place.
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, 0}, {3, 0, 0}};
  const Triangle<TypeParam> straight{{1, -1, -1}, {1, 1, -1}, {1, 0, 2}};
  const Triangle<TypeParam> turned{{1, -1, -tiny}, {1, 1, -tiny}, {2, 0, 1}};
  const PathRange<TypeParam> range(path, {});
  EXPECT_TRUE(detail::exact_order(path, straight, turned, range) < 0);
  EXPECT_TRUE(detail::exact_order(path, turned, straight, range) > 0);
  EXPECT_TRUE(detail::exact_order(path, straight, straight, range) == 0);
}

TYPED_TEST(Exact, point_is_the_paths_rounded_once) {
  Random random(32);
  for (std::size_t i = case_count(20'000); i > 0 && !this->HasFailure(); --i) {
    const Vector3<TypeParam> start = this->draw_vector(random);
    const Vector3<TypeParam> toward = this->draw_vector(random);
    const TypeParam t = random.one_in(2) ? random.unit<TypeParam>() : random.any_finite<TypeParam>();
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const Path<TypeParam> path = kind == PathKind::segment ? Path<TypeParam>(Segment<TypeParam>{start, toward})
                                   : kind == PathKind::ray   ? Path<TypeParam>(Ray<TypeParam>{start, toward})
                                                             : Path<TypeParam>(Line<TypeParam>{start, toward});
      const RationalVector from = rational(start);
      const RationalVector way = kind == PathKind::segment ? difference(rational(toward), from) : rational(toward);
      const Vector3<TypeParam> point = detail::exact_point(path, t);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const mpq_class truth = from[axis] + mpq_class(double{t}) * way[axis];
        EXPECT_TRUE(same_bits(point[static_cast<Eigen::Index>(axis)], nearest<TypeParam>(truth)))
            << hex_text(path) << " at " << std::hexfloat << t;
      }
    }
  }
}

TYPED_TEST(Exact, cross_is_the_exact_one_but_for_its_scale) {
  Random random(33);
  for (std::size_t i = case_count(10'000); i > 0 && !this->HasFailure(); --i) {
    Triangle<TypeParam> triangle{this->draw_vector(random), this->draw_vector(random), this->draw_vector(random)};
    if (random.one_in(8)) triangle.c = triangle.b;
    const RationalVector a = rational(triangle.a);
    const RationalVector truth = cross(difference(rational(triangle.b), a), difference(rational(triangle.c), a));
    const Vector3<double> computed = detail::exact_cross(triangle);
    const double greatest = computed.cwiseAbs().maxCoeff();
    if (truth[0] == 0 && truth[1] == 0 && truth[2] == 0) {
      EXPECT_EQ(greatest, 0);
      continue;
    }
    EXPECT_TRUE(greatest >= 0.5 && greatest <= 1) << hex_text(triangle);
    Eigen::Index largest = 0;
    computed.cwiseAbs().maxCoeff(&largest);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      // The same ratio to the largest component, but for one rounding of each.
      const mpq_class ratio = truth[static_cast<std::size_t>(axis)] / truth[static_cast<std::size_t>(largest)];
      EXPECT_LE(abs(mpq_class(computed[axis]) - ratio * mpq_class(computed[largest])), mpq_class(0x1p-52))
          << hex_text(triangle);
    }
  }
}

}  // namespace
}  // namespace surehit::test::exact_contact_test
