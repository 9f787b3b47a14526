#include "path_range.hpp"

#include <gtest/gtest.h>

#include "support/scalars.hpp"

namespace surehit::test::path_range_test {
namespace {

using detail::PathRange;

template <typename Scalar>
class PathRangeOf : public testing::Test {
 protected:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  static constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

  static PathRange<Scalar> of_segment(Scalar min_t, Scalar max_t) {
    return {Segment<Scalar>{{0, 0, 0}, {1, 0, 0}}, {.min_t = min_t, .max_t = max_t}};
  }
  static PathRange<Scalar> of_line(Scalar min_t, Scalar max_t) {
    return {Line<Scalar>{{0, 0, 0}, {1, 0, 0}}, {.min_t = min_t, .max_t = max_t}};
  }
};
TYPED_TEST_SUITE(PathRangeOf, Scalars, ScalarNames);

TYPED_TEST(PathRangeOf, path_without_limits_is_that_of_its_kind) {
  const PathRange<TypeParam> segment = this->of_segment(-this->infinity, this->infinity);
  EXPECT_EQ(segment.first, 0);
  EXPECT_EQ(segment.last, 1);
  const PathRange<TypeParam> ray(Ray<TypeParam>{{0, 0, 0}, {1, 0, 0}}, {});
  EXPECT_EQ(ray.first, 0);
  EXPECT_EQ(ray.last, this->infinity);
  const PathRange<TypeParam> line = this->of_line(-this->infinity, this->infinity);
  EXPECT_EQ(line.first, -this->infinity);
  EXPECT_EQ(line.last, this->infinity);
}

TYPED_TEST(PathRangeOf, limits_shorten_and_never_lengthen) {
  const PathRange<TypeParam> shortened = this->of_segment(TypeParam{0.25}, TypeParam{0.5});
  EXPECT_EQ(shortened.first, TypeParam{0.25});
  EXPECT_EQ(shortened.last, TypeParam{0.5});
  const PathRange<TypeParam> wider = this->of_segment(-1, 2);
  EXPECT_EQ(wider.first, 0);
  EXPECT_EQ(wider.last, 1);
}

TYPED_TEST(PathRangeOf, one_parameter_is_not_empty_and_none_is) {
  EXPECT_FALSE(this->of_segment(1, 1).is_empty());
  EXPECT_FALSE(this->of_segment(0, 0).is_empty());
  EXPECT_TRUE(this->of_segment(TypeParam{0.5}, TypeParam{0.25}).is_empty());
  EXPECT_TRUE(this->of_segment(2, 3).is_empty());
  EXPECT_TRUE(this->of_segment(-3, -2).is_empty());
}

TYPED_TEST(PathRangeOf, nan_limit_is_empty) {
  EXPECT_TRUE(this->of_segment(this->nan, 1).is_empty());
  EXPECT_TRUE(this->of_segment(0, this->nan).is_empty());
  EXPECT_TRUE(this->of_line(this->nan, this->infinity).is_empty());
  EXPECT_TRUE(this->of_line(-this->infinity, this->nan).is_empty());
}

TYPED_TEST(PathRangeOf, limit_that_only_infinity_meets_is_empty) {
  EXPECT_TRUE(this->of_line(this->infinity, this->infinity).is_empty());
  EXPECT_TRUE(this->of_line(-this->infinity, -this->infinity).is_empty());
  EXPECT_FALSE(this->of_line(-this->infinity, std::numeric_limits<TypeParam>::lowest()).is_empty());
  EXPECT_FALSE(this->of_line(std::numeric_limits<TypeParam>::max(), this->infinity).is_empty());
}

TYPED_TEST(PathRangeOf, finite_means_every_component) {
  for (const TypeParam bad : {this->nan, this->infinity, -this->infinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3<TypeParam> point{1, 2, 3};
      EXPECT_TRUE(detail::is_finite(point));
      point[axis] = bad;
      EXPECT_FALSE(detail::is_finite(point));
      const Vector3<TypeParam> good{0, 0, 0};
      EXPECT_FALSE(detail::is_finite(Path<TypeParam>(Segment<TypeParam>{point, good})));
      EXPECT_FALSE(detail::is_finite(Path<TypeParam>(Segment<TypeParam>{good, point})));
      EXPECT_FALSE(detail::is_finite(Triangle<TypeParam>{point, good, good}));
      EXPECT_FALSE(detail::is_finite(Triangle<TypeParam>{good, point, good}));
      EXPECT_FALSE(detail::is_finite(Triangle<TypeParam>{good, good, point}));
    }
  }
}

}  // namespace
}  // namespace surehit::test::path_range_test
