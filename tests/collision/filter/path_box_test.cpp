#include "filter/path_box.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "collision/family_cases.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::path_box_test {
namespace {

using detail::PathBox;

/// The exact point at t is in the box, if its coordinates are numbers that GMP holds.
template <typename Scalar>
void expect_point_inside(const PathBox<Scalar>& box, const Path<Scalar>& path, double t) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    const mpq_class start(double{path.start[at]});
    const mpq_class toward(double{path.toward[at]});
    const mpq_class way = path.kind == PathKind::segment ? mpq_class(toward - start) : toward;
    const mpq_class point = start + mpq_class(t) * way;
    const double low = double{box.low[axis]};
    const double high = double{box.high[axis]};
    EXPECT_TRUE(std::isinf(low) ? low < 0 : mpq_class(low) <= point) << axis;
    EXPECT_TRUE(std::isinf(high) ? high > 0 : mpq_class(high) >= point) << axis;
  }
}

class PathBoxOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    Random random(73);
    visit_family<Scalar>(GetParam(), 74, 2'000, [&](const Path<Scalar>& path, const auto&, const auto&) {
      const double limit = std::ldexp(random.unit<double>(), static_cast<int>(random.below(8)) - 3);
      SCOPED_TRACE(hex_text(path) + " up to " + std::to_string(limit));
      const PathBox<Scalar> box(path, limit);
      const double last = path.has_end() ? std::min(limit, 1.0) : limit;
      expect_point_inside(box, path, last);
      expect_point_inside(box, path, last * random.unit<double>());
      expect_point_inside(box, path, path.has_start() ? 0 : -limit);
    });
  }
};

TEST_P(PathBoxOfFamily, has_all_points_for_float) { check<float>(); }
TEST_P(PathBoxOfFamily, has_all_points_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, PathBoxOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class PathBoxOf : public testing::Test {
 protected:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};
TYPED_TEST_SUITE(PathBoxOf, Scalars, ScalarNames);

TYPED_TEST(PathBoxOf, whole_segment_is_that_of_its_ends) {
  const PathBox<TypeParam> box(Segment<TypeParam>{{1, 5, 3}, {2, 4, 3}}, this->infinity);
  EXPECT_EQ(box.low, (std::array<TypeParam, 3>{1, 4, 3}));
  EXPECT_EQ(box.high, (std::array<TypeParam, 3>{2, 5, 3}));
}

TYPED_TEST(PathBoxOf, ray_and_line_have_no_end_where_they_move) {
  const PathBox<TypeParam> ray(Ray<TypeParam>{{1, 5, 3}, {2, -4, 0}}, this->infinity);
  EXPECT_EQ(ray.low, (std::array<TypeParam, 3>{1, TypeParam(-this->infinity), 3}));
  EXPECT_EQ(ray.high, (std::array<TypeParam, 3>{TypeParam(this->infinity), 5, 3}));
  const PathBox<TypeParam> line(Line<TypeParam>{{1, 5, 3}, {2, -4, 0}}, this->infinity);
  EXPECT_EQ(line.low, (std::array<TypeParam, 3>{TypeParam(-this->infinity), TypeParam(-this->infinity), 3}));
  EXPECT_EQ(line.high, (std::array<TypeParam, 3>{TypeParam(this->infinity), TypeParam(this->infinity), 3}));
}

TYPED_TEST(PathBoxOf, part_of_a_path_is_hardly_larger_than_it) {
  const PathBox<TypeParam> box(Ray<TypeParam>{{1, 5, 3}, {2, -4, 0}}, 2);
  EXPECT_NEAR(double{box.high[0]}, 5, 1e-4);
  EXPECT_NEAR(double{box.low[1]}, -3, 1e-4);
  EXPECT_EQ(box.low[0], 1);
  EXPECT_EQ(box.high[1], 5);
}

}  // namespace
}  // namespace surehit::test::path_box_test
