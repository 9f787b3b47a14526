#include "surehit/hit.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "rational_determinants.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"

namespace surehit::test::hit_test {
namespace {

template <typename Scalar>
bool is_point_at(const Vector3<Scalar>& point, const Vector3<Scalar>& start, const RationalVector& way, Scalar t) {
  const RationalVector from = rational(start);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const mpq_class truth = from[axis] + mpq_class(double{t}) * way[axis];
    if (!same_bits(point[static_cast<Eigen::Index>(axis)], nearest<Scalar>(truth))) return false;
  }
  return true;
}

template <typename Scalar>
class PointOf : public testing::Test {
 protected:
  static bool is_nan(const Vector3<Scalar>& x) { return std::isnan(x[0]) && std::isnan(x[1]) && std::isnan(x[2]); }
};
TYPED_TEST_SUITE(PointOf, Scalars, ScalarNames);

TYPED_TEST(PointOf, any_path_is_exact_and_rounded_once) {
  Random random(61);
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    for (const PairFamily family : all_pair_families) {
      const Segment<TypeParam> segment = draw_pair<TypeParam>(family, random).segment;
      const Hit<TypeParam> hit{.t = random.unit<TypeParam>()};
      const RationalVector from_start = difference(rational(segment.end), rational(segment.start));
      ASSERT_TRUE(is_point_at(point(segment, hit), segment.start, from_start, hit.t))
          << hex_text(Path<TypeParam>(segment)) << hex_text(hit);
      const Ray<TypeParam> ray{segment.start, segment.end};
      ASSERT_TRUE(is_point_at(point(ray, hit), ray.origin, rational(ray.direction), hit.t));
      const Line<TypeParam> line{segment.start, segment.end};
      const Hit<TypeParam> behind{.t = -1000 * hit.t};
      ASSERT_TRUE(is_point_at(point(line, behind), line.origin, rational(line.direction), behind.t));
    }
  }
}

TYPED_TEST(PointOf, ends_of_a_segment_are_its_ends) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const Segment<TypeParam> segment{{tiny, -huge, 1}, {huge, huge, -tiny}};
  EXPECT_EQ(point(segment, Hit<TypeParam>{.t = 0}), segment.start);
  EXPECT_EQ(point(segment, Hit<TypeParam>{.t = 1}), segment.end);
}

TYPED_TEST(PointOf, middle_of_the_largest_segment_does_not_overflow) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const Segment<TypeParam> segment{{-huge, -huge, huge}, {huge, huge, huge}};
  EXPECT_EQ(point(segment, Hit<TypeParam>{.t = TypeParam{0.5}}), (Vector3<TypeParam>{0, 0, huge}));
}

TYPED_TEST(PointOf, zero_is_positive) {
  const Segment<TypeParam> segment{{-0.0, -1, -1}, {-0.0, 1, 1}};
  const Vector3<TypeParam> middle = point(segment, Hit<TypeParam>{.t = TypeParam{0.5}});
  for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(same_bits(middle[axis], TypeParam{0}));
}

TYPED_TEST(PointOf, what_is_not_finite_is_nan) {
  using Limits = std::numeric_limits<TypeParam>;
  const Segment<TypeParam> good{{0, 0, 0}, {1, 1, 1}};
  for (const TypeParam bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_TRUE(this->is_nan(point(good, Hit<TypeParam>{.t = bad})));
    EXPECT_TRUE(this->is_nan(point(Segment<TypeParam>{{0, bad, 0}, {1, 1, 1}}, Hit<TypeParam>{})));
    EXPECT_TRUE(this->is_nan(point(Ray<TypeParam>{{0, 0, 0}, {bad, 1, 1}}, Hit<TypeParam>{})));
    EXPECT_TRUE(this->is_nan(point(Line<TypeParam>{{0, 0, bad}, {1, 1, 1}}, Hit<TypeParam>{})));
  }
}

template <typename Scalar>
class DistanceOf : public testing::Test {
 protected:
  /// Compares squares, so that the truth is rational.
  static bool is_within_an_ulp(Scalar distance, const RationalVector& way, Scalar t) {
    const mpq_class factor(double{t});
    const mpq_class truth = factor * factor * (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const Scalar below = std::nextafter(distance, Scalar{0});
    const Scalar above = std::nextafter(distance, std::numeric_limits<Scalar>::infinity());
    const mpq_class low(double{below});
    if (std::isinf(above)) return low * low <= truth;
    const mpq_class high(double{above});
    return low * low <= truth && truth <= high * high;
  }
};
TYPED_TEST_SUITE(DistanceOf, Scalars, ScalarNames);

TYPED_TEST(DistanceOf, any_path_is_within_an_ulp) {
  Random random(71);
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    for (const PairFamily family : all_pair_families) {
      const Segment<TypeParam> segment = draw_pair<TypeParam>(family, random).segment;
      const RationalVector from_start = difference(rational(segment.end), rational(segment.start));
      for (const TypeParam t : {random.unit<TypeParam>(), TypeParam{1}, std::numeric_limits<TypeParam>::denorm_min()}) {
        const Hit<TypeParam> hit{.t = t};
        ASSERT_TRUE(this->is_within_an_ulp(distance(segment, hit), from_start, t))
            << hex_text(Path<TypeParam>(segment)) << hex_text(hit);
      }
      const Line<TypeParam> line{segment.start, segment.end};
      const Hit<TypeParam> behind{.t = -1000 * random.unit<TypeParam>()};
      const TypeParam back = distance(line, behind);
      if (std::isinf(back)) continue;
      ASSERT_TRUE(this->is_within_an_ulp(back, rational(line.direction), behind.t)) << hex_text(Path<TypeParam>(line));
    }
  }
}

TYPED_TEST(DistanceOf, the_largest_and_the_smallest_paths_do_not_lose_it) {
  using Limits = std::numeric_limits<TypeParam>;
  const TypeParam huge = Limits::max();
  const TypeParam tiny = Limits::denorm_min();
  const Segment<TypeParam> longest{{-huge, -huge, huge}, {huge, huge, -huge}};
  EXPECT_TRUE(std::isinf(distance(longest, Hit<TypeParam>{.t = 1})));
  const RationalVector way = difference(rational(longest.end), rational(longest.start));
  EXPECT_TRUE(this->is_within_an_ulp(distance(longest, Hit<TypeParam>{.t = TypeParam{0.125}}), way, TypeParam{0.125}));
  EXPECT_EQ(distance(Segment<TypeParam>{{huge, 0, 0}, {huge, tiny, 0}}, Hit<TypeParam>{.t = 1}), tiny);
  EXPECT_EQ(distance(Ray<TypeParam>{{huge, 0, 0}, {0, 3 * tiny, 4 * tiny}}, Hit<TypeParam>{.t = 2}), 10 * tiny);
  EXPECT_EQ(distance(Ray<TypeParam>{{0, 0, 0}, {tiny, 0, 0}}, Hit<TypeParam>{.t = huge}), tiny * huge);
  EXPECT_EQ(distance(Segment<TypeParam>{{1, 2, 3}, {1, 2, 3}}, Hit<TypeParam>{.t = 1}), 0);
}

TYPED_TEST(DistanceOf, what_is_not_finite_is_not_finite) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_FALSE(std::isfinite(distance(Segment<TypeParam>{{0, 0, 0}, {1, 1, 1}}, Hit<TypeParam>{.t = bad})));
    EXPECT_FALSE(std::isfinite(distance(Segment<TypeParam>{{0, bad, 0}, {1, 1, 1}}, Hit<TypeParam>{.t = 1})));
    EXPECT_FALSE(std::isfinite(distance(Line<TypeParam>{{0, 0, 0}, {bad, 1, 1}}, Hit<TypeParam>{.t = 1})));
    EXPECT_EQ(distance(Ray<TypeParam>{{bad, 0, 0}, {0, 0, 1}}, Hit<TypeParam>{.t = 2}), 2);
  }
}

template <typename Scalar>
class NormalOf : public testing::Test {
 protected:
  static Vector3<Scalar> normal_of(const Triangle<Scalar>& triangle) {
    const std::array<Vector3<Scalar>, 3> vertices = {triangle.a, triangle.b, triangle.c};
    const std::array<std::uint32_t, 3> corners = {0, 1, 2};
    return normal(TriangleMeshView<Scalar>(vertices, corners), 0);
  }

  /// The true unit normal to 300 bits, which is as good as exact here.
  static std::array<mpf_class, 3> true_normal(const Triangle<Scalar>& triangle) {
    const RationalVector a = rational(triangle.a);
    const RationalVector n = cross(difference(rational(triangle.b), a), difference(rational(triangle.c), a));
    const mpq_class largest = std::max({mpq_class(abs(n[0])), mpq_class(abs(n[1])), mpq_class(abs(n[2]))});
    std::array<mpf_class, 3> unit = {mpf_class(0, 300), mpf_class(0, 300), mpf_class(0, 300)};
    if (largest == 0) return unit;
    mpf_class squares(0, 300);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      unit[axis] = mpf_class(mpq_class(n[axis] / largest), 300);
      squares += unit[axis] * unit[axis];
    }
    const mpf_class length = sqrt(squares);
    for (mpf_class& component : unit) component /= length;
    return unit;
  }
};
TYPED_TEST_SUITE(NormalOf, Scalars, ScalarNames);

TYPED_TEST(NormalOf, every_family_is_within_two_ulps_of_one) {
  Random random(62);
  const mpf_class tolerance(2 * double{std::numeric_limits<TypeParam>::epsilon()}, 300);
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    for (const PairFamily family : all_pair_families) {
      const Triangle<TypeParam> triangle = draw_pair<TypeParam>(family, random).triangle;
      const auto truth = this->true_normal(triangle);
      const Vector3<TypeParam> unit = this->normal_of(triangle);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const mpf_class component(double{unit[static_cast<Eigen::Index>(axis)]}, 300);
        ASSERT_LE(mpf_class(abs(component - truth[axis])), tolerance) << hex_text(triangle);
      }
    }
  }
}

TYPED_TEST(NormalOf, counterclockwise_corners_points_to_the_viewer) {
  EXPECT_EQ(this->normal_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (Vector3<TypeParam>{0, 0, 1}));
  EXPECT_EQ(this->normal_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}), (Vector3<TypeParam>{0, 0, -1}));
}

TYPED_TEST(NormalOf, least_and_largest_numbers_is_a_unit_vector) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam size : {Limits::denorm_min(), Limits::min(), Limits::max()}) {
    EXPECT_EQ(this->normal_of({{0, 0, 0}, {0, size, 0}, {0, 0, size}}), (Vector3<TypeParam>{1, 0, 0}));
  }
}

TYPED_TEST(NormalOf, degenerate_triangle_is_zero) {
  EXPECT_EQ(this->normal_of({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), (Vector3<TypeParam>{0, 0, 0}));
  EXPECT_EQ(this->normal_of({{0, 0, 0}, {1, 2, 3}, {3, 6, 9}}), (Vector3<TypeParam>{0, 0, 0}));
}

}  // namespace
}  // namespace surehit::test::hit_test
