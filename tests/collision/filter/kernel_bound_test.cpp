#include "filter/kernel_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "collision/rational_determinants.hpp"
#include "coordinate_changes.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::kernel_bound_test {
namespace {

using detail::KernelBound;
using detail::PathRange;
using detail::RangeWeights;

// The determinants, recomputed as the kernel computes them: they hide there, and only a true error against its bound
// tells how much room there is.

template <typename Scalar, bool fused>
struct Arithmetic {
  static Scalar difference_of_products(Scalar a, Scalar b, Scalar c, Scalar d) {
    return fused ? std::fma(a, b, -(c * d)) : a * b - c * d;
  }
  static Scalar product_plus(Scalar a, Scalar b, Scalar c) { return fused ? std::fma(a, b, c) : a * b + c; }
  static Vector3<Scalar> cross(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
    return {difference_of_products(x[1], y[2], x[2], y[1]), difference_of_products(x[2], y[0], x[0], y[2]),
            difference_of_products(x[0], y[1], x[1], y[0])};
  }
  static Scalar dot(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
    return product_plus(x[0], y[0], product_plus(x[1], y[1], x[2] * y[2]));
  }
};

/// The greatest share of its bound that the error of any determinant takes up, for a limit on both sides of t and a
/// list of one triangle.
template <typename Scalar, bool fused>
double worst_share(const Path<Scalar>& path, const Triangle<Scalar>& triangle, Scalar limit) {
  using A = Arithmetic<Scalar, fused>;
  const Vector3<Scalar> d = path.has_end() ? Vector3<Scalar>(path.toward - path.start) : path.toward;
  const Vector3<Scalar> e1 = triangle.b - triangle.a;
  const Vector3<Scalar> e2 = triangle.c - triangle.a;
  const Vector3<Scalar> s = path.start - triangle.a;
  const auto size = [](const Vector3<Scalar>& x) { return x.cwiseAbs().maxCoeff(); };
  const Vector3<Scalar> p = A::cross(d, e2);
  const Vector3<Scalar> q = A::cross(s, e1);
  const Scalar det = A::dot(e1, p);
  const Scalar height = A::dot(e2, q);
  const Scalar u = A::dot(s, p);
  const Scalar v = A::dot(d, q);

  PathRange<Scalar> range(path, {});
  range.first = range.last = limit;
  const RangeWeights<Scalar> weights(range);
  const Scalar first = A::product_plus(height, weights.t_first, det * weights.det_first);
  const Scalar last = A::product_plus(height, weights.t_last, det * weights.det_last);

  const detail::ListBounds<Scalar> bounds(size(d), size(s), std::max(size(e1), size(e2)), weights);

  const RationalDeterminants exact = rational_determinants(path, triangle);
  double worst = 0;
  const auto weigh = [&](Scalar value, Scalar bound, const mpq_class& truth) {
    const mpq_class share = abs(mpq_class(double{value}) - truth) / mpq_class(double{bound});
    worst = std::max(worst, share.get_d());
  };
  weigh(u, bounds.side, exact.u);
  weigh(v, bounds.side, exact.v);
  weigh(det - u - v, bounds.side, exact.w);
  const mpq_class true_limit(double{limit});
  weigh(det, bounds.det, exact.det);
  weigh(height, bounds.height, exact.height);
  weigh(first, bounds.range, exact.height - true_limit * exact.det);
  weigh(last, bounds.range, true_limit * exact.det - exact.height);
  return worst;
}

template <typename Scalar>
class KernelBoundOf : public testing::Test {
 protected:
  struct Case {
    std::array<Scalar, 15> coordinates;
    Scalar limit;
  };

  static Case draw(Random& random) {
    Case drawn{{}, random.one_in(2) ? Scalar{1} : std::ldexp(random.symmetric<Scalar>(), 16)};
    for (Scalar& coordinate : drawn.coordinates) coordinate = draw_coordinate<Scalar>(random);
    return drawn;
  }

  static Case changed(Random& random, Case x) {
    Scalar& coordinate = x.coordinates[random.below(x.coordinates.size())];
    coordinate = changed_coordinate(random, coordinate);
    return x;
  }

  template <bool fused>
  static double share_of(const Case& drawn) {
    const auto& x = drawn.coordinates;
    const Segment<Scalar> segment{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
    const Triangle<Scalar> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
    return worst_share<Scalar, fused>(segment, triangle, drawn.limit);
  }

  template <bool fused>
  static double climb() {
    Random random(25);
    double worst = 0;
    for (int start = 0; start < 25; ++start) {
      Case best = draw(random);
      double best_share = share_of<fused>(best);
      for (std::size_t step = case_count(1'000); step > 0; --step) {
        const Case next = changed(random, best);
        if (const double share = share_of<fused>(next); share > best_share) {
          best = next;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
    return worst;
  }

  template <bool fused>
  static double draw_worst(int min_exponent, int max_exponent) {
    Random random(26);
    double worst = 0;
    for (std::size_t i = case_count(15'000); i > 0; --i) {
      Case x = draw(random);
      for (Scalar& coordinate : x.coordinates) {
        coordinate = std::ldexp(coordinate, static_cast<int>(random.between(min_exponent, max_exponent)));
      }
      worst = std::max(worst, share_of<fused>(x));
    }
    return worst;
  }

  void expect_below_one(const char* name, double share) {
    testing::Test::RecordProperty(name, std::to_string(share));
    EXPECT_LT(share, 1) << name;
  }
};
TYPED_TEST_SUITE(KernelBoundOf, Scalars, ScalarNames);

TYPED_TEST(KernelBoundOf, holds_on_random_pairs) {
  this->expect_below_one("worst_share", this->template draw_worst<false>(-2, 2));
  this->expect_below_one("worst_share_fused", this->template draw_worst<true>(-2, 2));
}

TYPED_TEST(KernelBoundOf, holds_where_hill_climbing_makes_the_error_worst) {
  this->expect_below_one("worst_share", this->template climb<false>());
  this->expect_below_one("worst_share_fused", this->template climb<true>());
}

TYPED_TEST(KernelBoundOf, holds_where_products_underflow) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const int exponent :
       {Limits::min_exponent - Limits::digits, Limits::min_exponent / 2, Limits::min_exponent / 3}) {
    this->expect_below_one("worst_share", this->template draw_worst<false>(exponent, exponent + 20));
    this->expect_below_one("worst_share_fused", this->template draw_worst<true>(exponent, exponent + 20));
  }
}

TYPED_TEST(KernelBoundOf, has_little_room_to_waste) { EXPECT_GT(this->template climb<false>(), 0.05); }

/// An end at infinity asks nothing, and one beyond the bound leaves something to ask.
TYPED_TEST(KernelBoundOf, knows_which_limits_it_holds) {
  const auto weights = [](TypeParam first, TypeParam last) {
    PathRange<TypeParam> range(Line<TypeParam>{{0, 0, 0}, {1, 0, 0}}, {});
    range.first = first;
    range.last = last;
    return RangeWeights<TypeParam>(range);
  };
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  const auto open = weights(-infinity, infinity);
  EXPECT_TRUE(open.decides);
  EXPECT_EQ(open.t_bound, 0);
  EXPECT_EQ(open.det_size, 2);
  const auto segment = weights(0, 1);
  EXPECT_TRUE(segment.decides);
  EXPECT_EQ(segment.t_first, 1);
  EXPECT_EQ(segment.det_first, 0);
  EXPECT_EQ(segment.t_last, -1);
  EXPECT_EQ(segment.det_last, 1);
  EXPECT_EQ(segment.t_bound, KernelBound<TypeParam>::relative);
  EXPECT_EQ(segment.det_size, 2);
  EXPECT_EQ(weights(-7, 3).det_size, 8);
  EXPECT_EQ(weights(2, 9).det_size, 10);
  const TypeParam most = KernelBound<TypeParam>::largest_limit;
  EXPECT_TRUE(weights(-most, most).decides);
  EXPECT_FALSE(weights(0, neighbour(most, 1)).decides);
  EXPECT_FALSE(weights(neighbour(-most, -1), 1).decides);
}

}  // namespace
}  // namespace surehit::test::kernel_bound_test
