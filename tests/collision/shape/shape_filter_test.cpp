#include "shape/shape_filter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "shape/exact_box.hpp"
#include "shape/exact_capsule.hpp"
#include "shape/exact_sphere.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/shape_families.hpp"
#include "support/shape_text.hpp"

namespace surehit::test::shape_filter_test {
namespace {

using detail::exact_contact;
using detail::ShapeFilter;

template <typename Scalar>
class ShapeFilterOf : public testing::Test {
 protected:
  /// A list of one triangle. A vector load may read beyond it.
  struct List {
    explicit List(const Triangle<Scalar>& triangle) {
      std::size_t k = 0;
      for (const Vector3<Scalar>* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        for (const Scalar x : *corner) corners[k++] = x;
      }
    }
    std::array<Scalar, 9 + 64> corners = {};
  };

  /// Holds the filter against integers: it keeps what is touched, also with the t of the contact as the limit, and no
  /// time of entry is after it. Returns the share of misses that it leaves out.
  template <typename Family>
  static double check(Family family) {
    Random random(83 + static_cast<std::uint64_t>(family));
    std::size_t misses = 0;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 4000 : 1500); ++i) {
      const auto [shape, triangle] = draw_shape_pair<Scalar>(family, random);
      const auto contact = exact_contact(shape, triangle);
      const List list(triangle);
      const ShapeFilter<Scalar> filter(shape);
      typename ShapeFilter<Scalar>::Times enters;
      const double limit = contact ? contact->t_upper : 1;
      const bool is_kept = (filter.find(list.corners.data(), 1, 0, limit, enters) & 1) != 0;
      if (contact) {
        EXPECT_TRUE(is_kept && enters[0] <= limit) << hex_text(shape) << '\n' << hex_text(triangle);
        EXPECT_EQ(filter.find(list.corners.data(), 1, 0, 1, enters), 1U) << hex_text(shape) << '\n'
                                                                         << hex_text(triangle);
        if (testing::Test::HasFailure()) return 0;
      } else {
        ++misses;
        left_out += is_kept ? 0 : 1;
      }
    }
    return static_cast<double>(left_out) / static_cast<double>(misses + 1);
  }
};
TYPED_TEST_SUITE(ShapeFilterOf, Scalars, ScalarNames);

TYPED_TEST(ShapeFilterOf, keeps_the_balls_that_touch) {
  for (const SphereFamily family : all_sphere_families) {
    const double share = this->check(family);
    ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    if (family == SphereFamily::general) {
      EXPECT_GT(share, 0.9);
    }
  }
}

TYPED_TEST(ShapeFilterOf, keeps_the_boxes_that_touch) {
  for (const BoxFamily family : all_box_families) {
    const double share = this->check(family);
    ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    if (family == BoxFamily::general) {
      EXPECT_GT(share, 0.9);
    }
  }
}

TYPED_TEST(ShapeFilterOf, keeps_the_capsules_that_touch) {
  for (const CapsuleFamily family : all_capsule_families) {
    const double share = this->check(family);
    ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    if (family == CapsuleFamily::general) {
      EXPECT_GT(share, 0.7);
    }
  }
}

/// A ball that rolls at a height of the radius touches nothing beside it (V6).
TYPED_TEST(ShapeFilterOf, leaves_out_what_is_beside_a_rolling_ball) {
  using Scalar = TypeParam;
  const SweptSphere<Scalar> sphere{{0, 0, 1}, {4, 0, 1}, 1};
  const auto is_kept = [&](Scalar y) {
    const typename TestFixture::List list({{0, y, 0}, {4, y, 0}, {2, y + 3, 0}});
    typename ShapeFilter<Scalar>::Times enters;
    return (ShapeFilter<Scalar>(sphere).find(list.corners.data(), 1, 0, 1, enters) & 1) != 0;
  };
  EXPECT_TRUE(is_kept(0));
  EXPECT_FALSE(is_kept(Scalar(0.25)));
}

using ShapeFilterOfDouble = ShapeFilterOf<double>;

// Two squares would be infinite, and so their difference would be no number.
TEST_F(ShapeFilterOfDouble, keeps_what_huge_balls_touch) {
  const Triangle<double> triangle = {{0, 0, 0}, {0x1p175, 0, 0}, {0, 0x1p175, 0}};
  const Vector3<double> centre(-0.25 * 0x1p180, 0x1p174, 0.875 * 0x1p180);
  const SweptSphere<double> sphere{centre, centre, 0x1p180};
  ASSERT_TRUE(exact_contact(sphere, triangle).has_value());
  const List list(triangle);
  ShapeFilter<double>::Times enters;
  EXPECT_EQ(ShapeFilter<double>(sphere).find(list.corners.data(), 1, 0, 1, enters) & 1, 1U);
}

}  // namespace
}  // namespace surehit::test::shape_filter_test
