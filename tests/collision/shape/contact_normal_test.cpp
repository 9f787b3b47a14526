#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "support/box_families.hpp"
#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/nearest_points.hpp"
#include "support/random.hpp"
#include "support/sphere_families.hpp"
#include "support/sphere_oracle.hpp"
#include "support/swept_truth.hpp"
#include "surehit/hit.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::contact_normal_test {
namespace {

template <typename Scalar>
class ContactNormal : public testing::Test {
 protected:
  /// What `contact_normal` promises.
  static constexpr double allowed = sizeof(Scalar) == 4 ? 0x1p-23 : 0x1p-49;
  static constexpr std::size_t count = sizeof(Scalar) == 4 ? 150 : 25;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactNormal, Scalars);

TYPED_TEST(ContactNormal, LeadsFromTheTouchedPointToTheCentreOfABall) {
  for (const SphereFamily family : all_sphere_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count); ++i) {
      const auto [sphere, triangle] = draw_sphere_pair<TypeParam>(family, random);
      const auto hit = intersect(sphere, triangle);
      const Vector3<TypeParam> normal = contact_normal(sphere, triangle);
      if (!hit) {
        ASSERT_TRUE(normal.isZero(0)) << name_of(family) << ", case " << i;
        continue;
      }
      const auto error = find_error_of_normal(sphere, triangle, *hit, normal, this->allowed);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
  }
}

TYPED_TEST(ContactNormal, LeadsFromTheTouchedPointToTheCoreOfACapsule) {
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count); ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<TypeParam>(family, random);
      const auto hit = intersect(capsule, triangle);
      const Vector3<TypeParam> normal = contact_normal(capsule, triangle);
      if (!hit) {
        ASSERT_TRUE(normal.isZero(0)) << name_of(family) << ", case " << i;
        continue;
      }
      const auto error = find_error_of_normal(capsule, triangle, *hit, normal, this->allowed);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
  }
}

using oracle::operator-;

/// A box and a triangle in rationals, with the centre of the box at some t.
struct RationalBox {
  using Point = oracle::Vec<mpq_class>;

  template <typename Scalar>
  RationalBox(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle, const mpq_class& t)
      : half(oracle::vector_of<mpq_class>(box.half_extents)),
        corners{oracle::vector_of<mpq_class>(triangle.a), oracle::vector_of<mpq_class>(triangle.b),
                oracle::vector_of<mpq_class>(triangle.c)} {
    const Point start = oracle::vector_of<mpq_class>(box.start);
    centre = oracle::along(start, t, Point(oracle::vector_of<mpq_class>(box.end) - start));
  }

  /// Returns how deep the box is in the triangle along m, times its length: so far does it have to move out.
  [[nodiscard]] mpq_class depth(const Point& m) const {
    mpq_class reach = 0;
    for (std::size_t i = 0; i < 3; ++i) reach += abs(m[i]) * half[i];
    mpq_class top = oracle::dot(m, Point(corners[0] - centre));
    for (const Point& corner : corners) top = std::max(top, oracle::dot(m, Point(corner - centre)));
    return top + reach;
  }
  /// Returns more than what `depth` is off by if each component of m is off by 1.
  [[nodiscard]] mpq_class size() const {
    mpq_class sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += half[i];
      for (const Point& corner : corners) sum += abs(mpq_class(corner[i] - centre[i]));
    }
    return sum;
  }
  /// Returns the directions of the sides of B1. Some may be zero.
  [[nodiscard]] std::vector<Point> directions() const {
    const std::array<Point, 3> axes = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
    std::vector<Point> all(axes.begin(), axes.end());
    all.push_back(oracle::cross(Point(corners[1] - corners[0]), Point(corners[2] - corners[0])));
    for (std::size_t i = 0; i < 3; ++i) {
      for (const Point& axis : axes) all.push_back(oracle::cross(Point(corners[(i + 1) % 3] - corners[i]), axis));
    }
    return all;
  }

  Point half;
  std::array<Point, 3> corners;
  Point centre;
};

// At the exact t, all of the triangle is below all of the box along the normal.
TYPED_TEST(ContactNormal, SeparatesABoxFromTheTriangle) {
  for (const BoxFamily family : all_box_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count); ++i) {
      const auto [box, triangle] = draw_box_pair<TypeParam>(family, random);
      const auto hit = intersect(box, triangle);
      const Vector3<TypeParam> normal = contact_normal(box, triangle);
      if (!hit) {
        ASSERT_TRUE(normal.isZero(0)) << name_of(family) << ", case " << i;
        continue;
      }
      if (hit->started_touching) continue;
      ASSERT_NEAR(normal.template cast<double>().norm(), 1, this->allowed * 2) << name_of(family) << ", case " << i;
      const QuadraticRoot t = truth_of(box, triangle).t;
      mpq_class exact_t(-t.b, t.a);
      exact_t.canonicalize();
      const RationalBox pair(box, triangle, exact_t);
      ASSERT_LE(pair.depth(oracle::vector_of<mpq_class>(normal)), this->allowed * pair.size())
          << name_of(family) << ", case " << i;
    }
  }
}

// No other direction leads out of the triangle sooner.
TYPED_TEST(ContactNormal, IsTheShortestWayOutForABoxThatStartsTouching) {
  for (const BoxFamily family : all_box_families) {
    Random random(11 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count / 5); ++i) {
      const auto [box, triangle] = draw_box_pair<TypeParam>(family, random);
      const auto hit = intersect(box, triangle);
      if (!hit || !hit->started_touching) continue;
      const RationalBox pair(box, triangle, 0);
      const Vector3<TypeParam> normal = contact_normal(box, triangle);
      ASSERT_NEAR(normal.template cast<double>().norm(), 1, this->allowed * 2) << name_of(family) << ", case " << i;
      const mpq_class found = pair.depth(oracle::vector_of<mpq_class>(normal)) - this->allowed * pair.size();
      if (found <= 0) continue;
      for (auto m : pair.directions()) {
        const mpq_class square = oracle::dot(m, m);
        for (int side = 0; side < 2; ++side) {
          const mpq_class depth = pair.depth(m);
          ASSERT_LE(found * found * square, depth * depth) << name_of(family) << ", case " << i;
          for (mpq_class& x : m) x = -x;
        }
      }
    }
  }
}

TYPED_TEST(ContactNormal, TakesTheAxesOfABoxFirst) {
  using Scalar = TypeParam;
  const Triangle<Scalar> floor = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  const SweptBox<Scalar> falling = {{1, 1, 5}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(falling, floor), (Vector3<Scalar>{0, 0, 1}));
  const SweptBox<Scalar> rising = {{1, 1, -5}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(rising, floor), (Vector3<Scalar>{0, 0, -1}));
  // From the start, the shortest way out leads up by 1/2, or aside by 3/4.
  const SweptBox<Scalar> inside = {{4, Scalar(-0.25), Scalar(0.5)}, {4, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(inside, floor), (Vector3<Scalar>{0, 0, 1}));
  const SweptBox<Scalar> beside = {{4, Scalar(-0.75), Scalar(0.5)}, {4, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(beside, floor), (Vector3<Scalar>{0, -1, 0}));
}

// The centre is on the triangle, so the step decides the side.
TYPED_TEST(ContactNormal, IsThatOfTheTriangleAgainstTheStepWhereTheCentreMeetsIt) {
  using Scalar = TypeParam;
  const Triangle<Scalar> floor = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  const auto normal_of = [&](const Vector3<Scalar>& end) {
    return contact_normal(SweptSphere<Scalar>{{1, 1, 0}, end, 1}, floor);
  };
  EXPECT_EQ(normal_of({1, 1, -3}), (Vector3<Scalar>{0, 0, 1}));
  EXPECT_EQ(normal_of({1, 1, 3}), (Vector3<Scalar>{0, 0, -1}));
  EXPECT_EQ(normal_of({1, 1, 0}), (Vector3<Scalar>{0, 0, 1}));
  const SweptCapsule<Scalar> across = {{1, 1, 0}, {1, 1, 2}, {0, 0, 3}, 1};
  EXPECT_EQ(contact_normal(across, floor), (Vector3<Scalar>{0, 0, -1}));
  const Triangle<Scalar> needle = {{0, 0, 0}, {8, 0, 0}, {4, 0, 0}};
  EXPECT_EQ(contact_normal(SweptSphere<Scalar>{{1, 0, 0}, {1, 0, 3}, 1}, needle), (Vector3<Scalar>{0, 0, 0}));
}

TYPED_TEST(ContactNormal, BelongsToAPointThatIsNearTheTouchedOne) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{1, 2, 3}, {5, 2, 3}, {1, 10, 7}};
  ShapeHit<Scalar> hit;
  hit.u = Scalar(0.25);
  hit.v = Scalar(0.5);
  EXPECT_EQ(contact_point(triangle, hit), (Vector3<Scalar>{2, 6, 5}));
  const Scalar large = std::numeric_limits<Scalar>::max();
  ShapeHit<Scalar> above_one;  // Weights are rounded, so their sum may be above 1.
  above_one.u = std::nextafter(Scalar(0.75), Scalar{1});
  above_one.v = Scalar(0.25);
  EXPECT_EQ(contact_point({{-large, 0, 0}, {large, 0, 0}, {large, 1, 0}}, above_one)[0], large);
  EXPECT_EQ(contact_point({{-large, 0, 0}, {large, 0, 0}, {0, large, 0}}, hit), (Vector3<Scalar>{0, large / 2, 0}));
}

// "Each of them adds at most half an ulp of 1 times its edge. The sum adds at most 4 ulp of the largest coordinate."
TYPED_TEST(ContactNormal, BelongsToAPointThatIsOffByWhatIsStated) {
  using Scalar = TypeParam;
  using Limits = std::numeric_limits<Scalar>;
  Random random(71);
  const auto ulp_of = [](Scalar x) {
    return std::ldexp(Scalar{1},
                      std::max(x > 0 ? std::ilogb(x) : -9999, Limits::min_exponent - 1) - Limits::digits + 1);
  };
  double worst = 0;
  for (const int exponent : {Limits::min_exponent - Limits::digits + 5, Limits::min_exponent, 0,
                             Limits::max_exponent - 4, Limits::max_exponent - 3, Limits::max_exponent}) {
    const auto draw = [&] {
      const int below = random.one_in(4) ? static_cast<int>(random.below(60)) : 0;
      return std::clamp(std::ldexp(random.symmetric<Scalar>(), exponent - below), -Limits::max(), Limits::max());
    };
    for (std::size_t i = case_count(2000); i > 0; --i) {
      const Scalar a = draw();
      const Scalar b = draw();
      const Scalar c = draw();
      mpq_class u(random.unit<double>());
      mpq_class v = (1 - u) * mpq_class(random.unit<double>());
      if (random.one_in(4)) v = 1 - u;
      if (random.one_in(8)) u = mpq_class(1, 3);
      if (random.one_in(8)) v = 0;
      if (u + v > 1) continue;
      ShapeHit<Scalar> hit;
      hit.u = nearest<Scalar>(u);
      hit.v = nearest<Scalar>(v);
      const mpq_class point(double{contact_point({{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}, hit)[0]});
      const auto number = [](Scalar x) { return mpq_class(double{x}); };
      const mpq_class ab = number(b) - number(a);
      const mpq_class ac = number(c) - number(a);
      const mpq_class four = 4 * number(ulp_of(std::max({std::fabs(a), std::fabs(b), std::fabs(c)})));
      const mpq_class of_weights = number(Limits::epsilon()) / 2 * (abs(ab) + abs(ac));
      ASSERT_LE(abs(mpq_class(number(a) + u * ab + v * ac - point)), four + of_weights) << exponent << ", case " << i;
      if (number(hit.u) + number(hit.v) > 1) continue;
      const mpq_class error = abs(mpq_class(number(a) + number(hit.u) * ab + number(hit.v) * ac - point));
      ASSERT_LE(error, four) << exponent << ", case " << i;
      worst = std::max(worst, mpq_class(error / four).get_d());
    }
  }
  testing::Test::RecordProperty("worst_share", std::to_string(worst));
}

TYPED_TEST(ContactNormal, BelongsToAPointThatLosesNoDenormals) {
  using Scalar = TypeParam;
  const Scalar least = std::numeric_limits<Scalar>::denorm_min();
  ShapeHit<Scalar> hit;
  hit.u = Scalar(0.2501);
  hit.v = Scalar(0.376);
  const Triangle<Scalar> tiny = {{6 * least, 0, 0}, {14 * least, 0, 0}, {22 * least, 0, 0}};
  EXPECT_EQ(contact_point(tiny, hit)[0], 14 * least);  // 14.02 times the least number
}

}  // namespace
}  // namespace surehit::test::contact_normal_test
