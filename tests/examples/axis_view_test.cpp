#include "mesh_io/axis_view.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::axis_view_test {
namespace {

template <typename Scalar>
class AxisView : public testing::Test {
 protected:
  using View = example::AxisView<Scalar>;
  using Point = std::array<Scalar, 3>;

  /// By the rationals, of the two coordinates that follow the axis.
  static int turn_of(std::size_t axis, const Point& a, const Point& b, const Point& c) {
    const auto from_a = [&](const Point& point, std::size_t steps) {
      const std::size_t i = (axis + steps) % 3;
      return mpq_class(mpq_class(point[i]) - mpq_class(a[i]));
    };
    return sgn(mpq_class(from_a(b, 1) * from_a(c, 2) - from_a(b, 2) * from_a(c, 1)));
  }

  void expect_right_turn(const Point& a, const Point& b, const Point& c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const View view(axis);
      const int turn = turn_of(axis, a, b, c);
      ++seen_[static_cast<std::size_t>(turn + 1)];
      ASSERT_EQ(view.orientation(a, b, c), turn) << text_of(a) << text_of(b) << text_of(c) << "along axis " << axis;
      ASSERT_EQ(view.orientation(b, c, a), turn) << text_of(b) << text_of(c) << text_of(a) << "along axis " << axis;
      ASSERT_EQ(view.orientation(b, a, c), -turn) << text_of(b) << text_of(a) << text_of(c) << "along axis " << axis;
    }
  }

  static std::string text_of(const Point& point) {
    std::ostringstream text;
    text << std::hexfloat << "{" << point[0] << ", " << point[1] << ", " << point[2] << "} ";
    return text.str();
  }

  std::array<std::size_t, 3> seen_ = {};
};

TYPED_TEST_SUITE(AxisView, Scalars, ScalarNames);

TYPED_TEST(AxisView, sees_what_is_across_the_axis) {
  using View = example::AxisView<TypeParam>;
  EXPECT_EQ(View(0).x({1, 2, 3}), 2);
  EXPECT_EQ(View(0).y({1, 2, 3}), 3);
  EXPECT_EQ(View(1).x({1, 2, 3}), 3);
  EXPECT_EQ(View(1).y({1, 2, 3}), 1);
  EXPECT_EQ(View(2).x({1, 2, 3}), 1);
  EXPECT_EQ(View(2).y({1, 2, 3}), 2);
}

TYPED_TEST(AxisView, does_not_see_how_far_away_points_are) {
  const example::AxisView<TypeParam> view(1);
  EXPECT_TRUE(view.coincide({1, 2, 3}, {1, 9, 3}));
  EXPECT_TRUE(view.coincide({0, 2, 3}, {-TypeParam{0}, 9, 3}));
  EXPECT_FALSE(view.coincide({1, 2, 3}, {1, 2, 4}));
  EXPECT_FALSE(view.coincide({1, 2, 3}, {4, 2, 3}));
  EXPECT_EQ(view.orientation({0, 5, 0}, {0, -7, 1}, {1, 1, 0}), 1);
}

TYPED_TEST(AxisView, sees_a_turn_to_the_left_from_before_the_axis) {
  EXPECT_EQ(example::AxisView<TypeParam>(2).orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1);
  EXPECT_EQ(example::AxisView<TypeParam>(2).orientation({0, 0, 0}, {0, 1, 0}, {1, 0, 0}), -1);
  EXPECT_EQ(example::AxisView<TypeParam>(2).orientation({0, 0, 0}, {1, 1, 0}, {3, 3, 9}), 0);
  EXPECT_EQ(example::AxisView<TypeParam>(0).orientation({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

TYPED_TEST(AxisView, is_exact_where_points_are_nearly_in_line) {
  Random random(1);
  for (std::size_t i = 0; i < case_count(20000) && !this->HasFatalFailure(); ++i) {
    // Squares of some underflow.
    constexpr int least = std::numeric_limits<TypeParam>::min_exponent;
    const int exponent = static_cast<int>(random.between(random.one_in(2) ? least : -40, 40));
    std::array<TypeParam, 3> a, b, c;
    const auto share = random.symmetric<TypeParam>() * 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      a[axis] = std::scalbn(random.symmetric<TypeParam>(), exponent);
      b[axis] = std::scalbn(random.symmetric<TypeParam>(), exponent - static_cast<int>(random.below(20)));
      c[axis] = neighbour(a[axis] + share * (b[axis] - a[axis]), static_cast<int>(random.between(-1, 1)));
    }
    this->expect_right_turn(a, b, c);
  }
}

TYPED_TEST(AxisView, is_exact_in_whole_numbers) {
  Random random(2);
  for (std::size_t i = 0; i < case_count(20000) && !this->HasFatalFailure(); ++i) {
    const std::int64_t size = std::int64_t{1} << random.between(0, 23);
    const auto far = static_cast<TypeParam>(random.one_in(2) ? 0 : random.between(-9, 9) * size);
    const int exponent = static_cast<int>(random.between(-90, 90));
    std::array<std::array<TypeParam, 3>, 3> points;
    for (auto& point : points) {
      for (TypeParam& x : point) {
        x = std::scalbn(far + static_cast<TypeParam>(random.between(-2, 2) * (random.one_in(2) ? size : 1)), exponent);
      }
    }
    this->expect_right_turn(points[0], points[1], points[2]);
  }
  EXPECT_GT(this->seen_[1], case_count(2000)) << "in line";
}

TYPED_TEST(AxisView, is_exact_for_numbers_of_any_size) {
  Random random(3);
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  constexpr TypeParam most = std::numeric_limits<TypeParam>::max();
  for (std::size_t i = 0; i < case_count(20000) && !this->HasFatalFailure(); ++i) {
    std::array<std::array<TypeParam, 3>, 3> points = {};
    for (auto& point : points) {
      for (TypeParam& x : point) {
        switch (random.below(5)) {
          case 0:
            x = random.any_finite<TypeParam>();
            break;
          case 1:
            x = static_cast<TypeParam>(random.between(-4, 4)) * least;
            break;
          case 2:
            x = static_cast<TypeParam>(random.between(-4, 4)) * (most / 4);
            break;
          case 3:
            x = random.one_in(2) ? most : -most;
            break;
          default:
            x = points[0][random.below(3)];
            break;
        }
      }
    }
    this->expect_right_turn(points[0], points[1], points[2]);
  }
}

}  // namespace
}  // namespace surehit::test::axis_view_test
