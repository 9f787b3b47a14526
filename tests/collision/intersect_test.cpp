#include "surehit/intersect.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::intersect_test {
namespace {

template <typename Scalar>
class Intersect : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;
  static inline const Segment<Scalar> through = through_stack<Scalar>(1, -1);
  static inline const Triangle<Scalar> triangle = unit_triangle<Scalar>();
};
TYPED_TEST_SUITE(Intersect, Scalars, ScalarNames);

TYPED_TEST(Intersect, says_where_and_from_where) {
  const std::optional<Hit<TypeParam>> hit = intersect(this->through, this->triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, TypeParam{0.5});
  EXPECT_EQ(hit->u, TypeParam{0.25});
  EXPECT_EQ(hit->v, TypeParam{0.25});
  EXPECT_EQ(hit->triangle, 0u);
  EXPECT_EQ(hit->side, Side::front);
}

TYPED_TEST(Intersect, weights_tell_b_from_c) {
  const TypeParam x{0.125};
  const TypeParam y{0.5};
  const auto hit = intersect(Segment<TypeParam>{{x, y, 1}, {x, y, -1}}, this->triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->u, x);
  EXPECT_EQ(hit->v, y);
}

TYPED_TEST(Intersect, takes_every_kind_of_path) {
  EXPECT_TRUE(intersect(this->through, this->triangle));
  EXPECT_TRUE(intersect(Ray<TypeParam>{this->through.start, {0, 0, -4}}, this->triangle));
  EXPECT_TRUE(intersect(Line<TypeParam>{this->through.start, {0, 0, 4}}, this->triangle));
  EXPECT_TRUE(intersect(Path<TypeParam>(this->through), this->triangle));
}

TYPED_TEST(Intersect, mask_and_ignored_triangle_say_nothing) {
  EXPECT_TRUE(intersect(this->through, this->triangle, {.mask = 0}));
  EXPECT_TRUE(intersect(this->through, this->triangle, {.ignored_triangle = 0}));
}

TYPED_TEST(Intersect, never_throws) {
  const Path<TypeParam> path = this->through;
  static_assert(noexcept(intersect(path, this->triangle)));
  static_assert(noexcept(intersect(path, this->triangle, QueryOptions<TypeParam>{})));
}

TYPED_TEST(Intersect, non_finite_path_or_triangle_misses) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int point = 0; point < 5; ++point) {
        Segment<TypeParam> segment = this->through;
        Triangle<TypeParam> triangle = this->triangle;
        Vector3<TypeParam>* const points[] = {&segment.start, &segment.end, &triangle.a, &triangle.b, &triangle.c};
        (*points[point])[axis] = bad;
        for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
          const Path<TypeParam> path = kind == PathKind::segment ? Path<TypeParam>(segment)
                                       : kind == PathKind::ray
                                           ? Path<TypeParam>(Ray<TypeParam>{segment.start, segment.end})
                                           : Path<TypeParam>(Line<TypeParam>{segment.start, segment.end});
          EXPECT_FALSE(intersect(path, triangle)) << hex_text(path) << hex_text(triangle);
        }
      }
    }
  }
}

TYPED_TEST(Intersect, degenerate_shapes_with_an_infinity_miss_too) {
  const TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  const Vector3<TypeParam> far{infinity, 0, 0};
  EXPECT_FALSE(intersect(Segment<TypeParam>{far, far}, Triangle<TypeParam>{far, far, far}));
  EXPECT_FALSE(intersect(Ray<TypeParam>{{0, 0, 0}, far}, Triangle<TypeParam>{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}));
}

/// Truths that need no oracle, on pairs of every family.
class IntersectFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar, typename Check>
  void for_each_pair(Check&& check) {
    Random random(51);
    for (std::size_t i = case_count(10'000); i > 0 && !HasFailure(); --i) {
      const auto [segment, triangle] = draw_pair<Scalar>(GetParam(), random);
      check(segment, triangle);
    }
  }

  /// With b and c exchanged, t is the same and the triangle is seen from the other side.
  template <typename Scalar>
  void check_exchange() {
    for_each_pair<Scalar>([](const Segment<Scalar>& segment, const Triangle<Scalar>& triangle) {
      const auto hit = intersect(segment, triangle);
      auto exchanged = intersect(segment, Triangle<Scalar>{triangle.a, triangle.c, triangle.b});
      ASSERT_EQ(hit.has_value(), exchanged.has_value());
      if (!hit || (triangle.b == triangle.c)) return;
      std::swap(exchanged->u, exchanged->v);
      if (exchanged->side != Side::edge_on) {
        exchanged->side = exchanged->side == Side::front ? Side::back : Side::front;
      }
      EXPECT_TRUE(same_bits(*hit, *exchanged)) << hex_text(Path<Scalar>(segment)) << hex_text(triangle);
    });
  }

  template <typename Scalar>
  void check_reversal() {
    for_each_pair<Scalar>([](const Segment<Scalar>& segment, const Triangle<Scalar>& triangle) {
      const auto hit = intersect(segment, triangle);
      const auto reversed = intersect(Segment<Scalar>{segment.end, segment.start}, triangle);
      ASSERT_EQ(hit.has_value(), reversed.has_value()) << hex_text(triangle);
      if (!hit) return;
      EXPECT_EQ(hit->side == Side::edge_on, reversed->side == Side::edge_on);
      if (hit->side == Side::edge_on) return;
      EXPECT_NE(hit->side, reversed->side);
      EXPECT_TRUE(same_bits(hit->u, reversed->u) && same_bits(hit->v, reversed->v)) << hex_text(triangle);
      EXPECT_NEAR(hit->t + reversed->t, 1, 2 * std::numeric_limits<Scalar>::epsilon());
    });
  }
};

TEST_P(IntersectFamily, exchanging_b_and_c_exchanges_u_and_v_and_turns_the_side_for_float) { check_exchange<float>(); }
TEST_P(IntersectFamily, exchanging_b_and_c_exchanges_u_and_v_and_turns_the_side_for_double) {
  check_exchange<double>();
}
TEST_P(IntersectFamily, reversed_segment_meets_the_same_for_float) { check_reversal<float>(); }
TEST_P(IntersectFamily, reversed_segment_meets_the_same_for_double) { check_reversal<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, IntersectFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::intersect_test
