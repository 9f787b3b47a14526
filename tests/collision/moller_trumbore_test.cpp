#include "moller_trumbore.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "contact_oracle.hpp"
#include "family_cases.hpp"
#include "rational_determinants.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test {
namespace {

using detail::MollerTrumbore;
using detail::PathRange;
using detail::Verdict;

template <typename Scalar>
Verdict classify(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options = {}) {
  return MollerTrumbore<Scalar>(path, PathRange<Scalar>(path, options)).classify(triangle);
}

template <typename Scalar>
void expect_never_wrong(const Path<Scalar>& path, const Triangle<Scalar>& triangle, QueryOptions<Scalar> options) {
  keep_limits_alone(options);
  if (PathRange<Scalar>(path, options).is_empty()) return;
  const Verdict verdict = classify(path, triangle, options);
  if (verdict == Verdict::undecided) return;
  EXPECT_EQ(verdict == Verdict::hit, exact_contact(path, triangle, options).has_value())
      << hex_text(path) << hex_text(triangle) << hex_text(options);
}

class VerdictOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    visit_family<Scalar>(GetParam(), 21, 5'000, expect_never_wrong<Scalar>);
  }
};

TEST_P(VerdictOfFamily, is_never_wrong_for_float) { check<float>(); }
TEST_P(VerdictOfFamily, is_never_wrong_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, VerdictOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
Pair<Scalar> pair_of(const std::array<Scalar, 15>& x) {
  return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}, {{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}}};
}

template <typename Scalar>
class VerdictOf : public testing::Test {
 protected:
  /// Powers of two around `exponent`, small multiples of which often cancel exactly.
  static Pair<Scalar> draw_near(Random& random, int exponent) {
    std::array<Scalar, 15> x;
    for (Scalar& coordinate : x) {
      coordinate = std::ldexp(static_cast<Scalar>(random.between(-3, 3)), exponent + static_cast<int>(random.below(3)));
      if (random.one_in(4)) coordinate = neighbour(coordinate, static_cast<int>(random.between(-2, 2)));
    }
    return pair_of(x);
  }
};
TYPED_TEST_SUITE(VerdictOf, Scalars, ScalarNames);

TYPED_TEST(VerdictOf, any_bit_patterns_is_never_wrong) {
  Random random(22);
  for (std::size_t i = case_count(30'000); i > 0 && !this->HasFailure(); --i) {
    std::array<TypeParam, 15> x;
    for (TypeParam& coordinate : x) coordinate = random.any_finite<TypeParam>();
    const auto [segment, triangle] = pair_of(x);
    expect_never_wrong<TypeParam>(segment, triangle, {});
  }
}

TYPED_TEST(VerdictOf, sizes_at_which_products_overflow_or_underflow_is_never_wrong) {
  using Limits = std::numeric_limits<TypeParam>;
  Random random(23);
  const int largest_size = Limits::max_exponent == 128 ? 34 : 300;
  for (const int exponent :
       {Limits::min_exponent - Limits::digits + 2, Limits::min_exponent / 3, Limits::min_exponent / 2, largest_size - 2,
        Limits::max_exponent / 3, Limits::max_exponent - 6}) {
    for (std::size_t i = case_count(15'000); i > 0 && !this->HasFailure(); --i) {
      const auto [segment, triangle] = this->draw_near(random, exponent);
      expect_never_wrong<TypeParam>(segment, triangle, {});
      expect_never_wrong(path_along(segment, PathKind::ray), triangle, draw_options(random, random.unit<TypeParam>()));
    }
  }
}

TYPED_TEST(VerdictOf, nearly_every_random_pair_is_decided) {
  Random random(24);
  const std::size_t pairs = case_count(20'000);
  std::size_t undecided = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    std::array<TypeParam, 15> x;
    for (TypeParam& coordinate : x) coordinate = random.symmetric<TypeParam>();
    const auto [segment, triangle] = pair_of(x);
    undecided += classify<TypeParam>(segment, triangle) == Verdict::undecided;
  }
  EXPECT_LE(undecided, pairs / 100);
}

TYPED_TEST(VerdictOf, huge_or_non_finite_coordinates_is_undecided) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  const Segment<TypeParam> segment{{0, 0, -1}, {0, 0, 1}};
  for (const TypeParam x : {huge, -huge, nan}) {
    const Triangle<TypeParam> triangle{{-1, -1, 0}, {x, -1, 0}, {0, 1, 0}};
    EXPECT_EQ(classify<TypeParam>(segment, triangle), Verdict::undecided);
    const Segment<TypeParam> far{{0, 0, -1}, {0, x, 1}};
    EXPECT_EQ(classify<TypeParam>(far, {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}), Verdict::undecided);
  }
}

TYPED_TEST(VerdictOf, limit_too_large_for_the_bound_is_left_open) {
  const Ray<TypeParam> ray{{0, 0, -1}, {0, 0, 1}};
  const Triangle<TypeParam> triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  EXPECT_EQ(classify<TypeParam>(ray, triangle, {.max_t = 4}), Verdict::hit);
  EXPECT_EQ(classify<TypeParam>(ray, triangle, {.max_t = TypeParam{1e9}}), Verdict::undecided);
}

TYPED_TEST(VerdictOf, edge_is_undecided_and_what_is_clear_of_it_is_not) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto at = [&](TypeParam y) {
    return classify<TypeParam>(Segment<TypeParam>{{TypeParam{0.25}, y, -1}, {TypeParam{0.25}, y, 1}}, triangle);
  };
  const TypeParam clear = 1000 * std::numeric_limits<TypeParam>::epsilon();
  EXPECT_EQ(at(0), Verdict::undecided);
  EXPECT_EQ(at(clear), Verdict::hit);
  EXPECT_EQ(at(-clear), Verdict::miss);
}

// The bound, recomputed: it hides inside the kernel, and only a true error against it tells how much room there is.

template <typename Scalar, bool fused>
struct Arithmetic {
  static Scalar difference_of_products(Scalar a, Scalar b, Scalar c, Scalar d) {
    return fused ? std::fma(a, b, -(c * d)) : a * b - c * d;
  }
  static Vector3<Scalar> cross(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
    return {difference_of_products(x[1], y[2], x[2], y[1]), difference_of_products(x[2], y[0], x[0], y[2]),
            difference_of_products(x[0], y[1], x[1], y[0])};
  }
  static Scalar dot(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
    return fused ? std::fma(x[2], y[2], std::fma(x[1], y[1], x[0] * y[0])) : x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  static Scalar product_plus(Scalar a, Scalar b, Scalar c) { return fused ? std::fma(a, b, c) : a * b + c; }
};

/// The greatest share of its bound that the error of any determinant takes up, for a limit on both sides of t.
template <typename Scalar, bool fused>
double worst_share(const Path<Scalar>& path, const Triangle<Scalar>& triangle, Scalar limit) {
  using A = Arithmetic<Scalar, fused>;
  const Vector3<Scalar> d = path.kind == PathKind::segment ? Vector3<Scalar>(path.toward - path.start) : path.toward;
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

  const Scalar underflow = (1 + std::max({size(d), size(e1), size(e2), size(s)})) * std::numeric_limits<Scalar>::min();
  const Scalar det_size = size(d) * size(e1) * size(e2);
  const Scalar height_size = size(s) * size(e1) * size(e2);
  const Scalar u_size = size(s) * size(d) * size(e2);
  const Scalar v_size = size(s) * size(d) * size(e1);

  const RationalDeterminants exact = rational_determinants(path, triangle);
  double worst = 0;
  const auto weigh = [&](Scalar value, Scalar sizes, const mpq_class& truth) {
    constexpr Scalar relative = 66 * (std::numeric_limits<Scalar>::epsilon() / 2);
    const Scalar bound = relative * sizes + underflow;
    const mpq_class share = abs(mpq_class(double{value}) - truth) / mpq_class(double{bound});
    worst = std::max(worst, share.get_d());
  };
  weigh(u, u_size, exact.u);
  weigh(v, v_size, exact.v);
  weigh(det - u - v, det_size + u_size + v_size, exact.w);
  const Scalar limit_size = height_size + std::fabs(limit) * det_size;
  const mpq_class true_limit(double{limit});
  weigh(A::product_plus(-limit, det, height), limit_size, exact.height - true_limit * exact.det);
  weigh(A::product_plus(limit, det, -height), limit_size, true_limit * exact.det - exact.height);
  return worst;
}

template <typename Scalar>
class ErrorBound : public testing::Test {
 protected:
  struct Case {
    std::array<Scalar, 15> coordinates;
    Scalar limit;
  };

  static Scalar draw_coordinate(Random& random) {
    const Scalar x = random.symmetric<Scalar>();
    return random.one_in(4) ? std::ldexp(x, static_cast<int>(random.between(-30, 5))) : x;
  }

  static Case draw(Random& random) {
    Case drawn{{}, random.one_in(2) ? Scalar{1} : std::ldexp(random.symmetric<Scalar>(), 16)};
    for (Scalar& coordinate : drawn.coordinates) coordinate = draw_coordinate(random);
    return drawn;
  }

  static Case changed(Random& random, Case x) {
    Scalar& coordinate = x.coordinates[random.below(x.coordinates.size())];
    switch (random.below(4)) {
      case 0:
        coordinate = draw_coordinate(random);
        break;
      case 1:
        coordinate = -coordinate;
        break;
      case 2:
        coordinate *= 1 + random.symmetric<Scalar>() / 16;
        break;
      default:
        coordinate = neighbour(coordinate, static_cast<int>(random.between(-4, 4)));
    }
    return x;
  }

  template <bool fused>
  static double share_of(const Case& x) {
    const auto [segment, triangle] = pair_of(x.coordinates);
    return worst_share<Scalar, fused>(segment, triangle, x.limit);
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
  static double draw_worst(int least_exponent, int greatest_exponent) {
    Random random(26);
    double worst = 0;
    for (std::size_t i = case_count(15'000); i > 0; --i) {
      Case x = draw(random);
      for (Scalar& coordinate : x.coordinates) {
        coordinate = std::ldexp(coordinate, static_cast<int>(random.between(least_exponent, greatest_exponent)));
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
TYPED_TEST_SUITE(ErrorBound, Scalars, ScalarNames);

TYPED_TEST(ErrorBound, holds_on_random_pairs) {
  this->expect_below_one("worst_share", this->template draw_worst<false>(-2, 2));
  this->expect_below_one("worst_share_fused", this->template draw_worst<true>(-2, 2));
}

TYPED_TEST(ErrorBound, holds_where_hill_climbing_makes_the_error_worst) {
  this->expect_below_one("worst_share", this->template climb<false>());
  this->expect_below_one("worst_share_fused", this->template climb<true>());
}

TYPED_TEST(ErrorBound, holds_where_products_underflow) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const int exponent :
       {Limits::min_exponent - Limits::digits, Limits::min_exponent / 2, Limits::min_exponent / 3}) {
    this->expect_below_one("worst_share", this->template draw_worst<false>(exponent, exponent + 20));
    this->expect_below_one("worst_share_fused", this->template draw_worst<true>(exponent, exponent + 20));
  }
}

TYPED_TEST(ErrorBound, has_little_room_to_waste) { EXPECT_GT(this->template climb<false>(), 0.05); }

}  // namespace
}  // namespace surehit::test
