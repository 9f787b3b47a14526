#include "shape/face_contact.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "collision/filter/coordinate_changes.hpp"
#include "shape/exact_sphere.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/shape_families.hpp"
#include "support/shape_text.hpp"
#include "support/swept_truth.hpp"

namespace surehit::test {
namespace {

using detail::DoubleRange;
using detail::exact_contact;
using detail::FaceContact;
using detail::SphereContact;
using detail::Verdict;

/// Holds simple contacts against integers (S8).
template <typename Scalar>
class FaceContactOf : public testing::Test {
 protected:
  /// Checks a verdict about a ball and a triangle, where nothing counts after `limit`.
  static Verdict check(const SweptSphere<Scalar>& ball, const Triangle<Scalar>& triangle, Scalar limit) {
    DoubleRange t;
    const Verdict verdict = FaceContact(ball, triangle).find(limit, t);
    const auto exact = exact_contact(ball, triangle);
    const auto what = [&] { return hex_text(ball) + '\n' + hex_text(triangle); };
    if (verdict == Verdict::miss) {
      const bool is_late = !exact || (!exact->at_start && compare_time(ball, triangle, *exact, limit) > 0);
      EXPECT_TRUE(is_late) << what();
    } else if (exact) {
      EXPECT_LE(t.lower, exact->at_start ? 0 : exact->t_upper) << what();
    }
    if (verdict != Verdict::hit) return verdict;
    EXPECT_TRUE(exact && exact->feature == Feature::face) << what();
    if (testing::Test::HasFailure()) return verdict;
    EXPECT_EQ(t.upper == 0, exact->at_start) << what();
    if (!exact->at_start) {
      EXPECT_GE(t.upper, exact->t_lower) << what();
    }
    ShapeHit<Scalar> hit;
    round_exactly(ball, triangle, *exact, hit);
    const auto weights = FaceContact(ball, triangle).weights(t);
    const auto holds = [](const DoubleRange& range, Scalar rounded) {
      return static_cast<Scalar>(range.lower) <= rounded && rounded <= static_cast<Scalar>(range.upper);
    };
    EXPECT_TRUE(holds(weights[0], hit.u) && holds(weights[1], hit.v)) << what();
    return verdict;
  }
};
TYPED_TEST_SUITE(FaceContactOf, Scalars, ScalarNames);

TYPED_TEST(FaceContactOf, is_certain_of_what_integers_find) {
  using Scalar = TypeParam;
  for (const SphereFamily family : all_sphere_families) {
    Random random(89 + static_cast<std::uint64_t>(family));
    std::array<std::size_t, 3> verdicts = {};
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 3000 : 1000); ++i) {
      const auto [ball, triangle] = draw_shape_pair<Scalar>(family, random);
      const Scalar limit = random.one_in(2) ? Scalar{1} : random.unit<Scalar>();
      ++verdicts[static_cast<std::size_t>(this->check(ball, triangle, limit))];
      ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    }
    if (family != SphereFamily::general) continue;
    EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::miss)], case_count(30));
    EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::hit)], case_count(30) / 2);
  }
}

// The foot of the centre at the contact is beside an edge by a few units in the last place of the bounds.
TYPED_TEST(FaceContactOf, is_not_certain_beside_an_edge) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Random random(97);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < case_count(4000); ++i) {
    const Scalar beside = std::ldexp(random.symmetric<Scalar>(), -static_cast<int>(random.below(50)));
    const Vector3<Scalar> start(random.unit<Scalar>() / 2 + Scalar(0.25), beside, 2);
    const Vector3<Scalar> end(start[0], random.one_in(2) ? beside : Scalar{0}, -1);
    hits += this->check({start, end, random.unit<Scalar>()}, triangle, 1) == Verdict::hit;
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
  EXPECT_GT(hits, case_count(400));
}

// The square of the normal is below its bound, so a quotient of the two says nothing.
TYPED_TEST(FaceContactOf, has_no_weights_for_a_sliver) {
  using Scalar = TypeParam;
  const Scalar height = std::ldexp(Scalar{1}, -40);
  const Triangle<Scalar> sliver = {{0, 0, 0}, {1, 0, 0}, {1, height, 0}};
  const SweptSphere<Scalar> ball = {{Scalar(0.75), height / 2, 2}, {Scalar(0.75), height / 2, -2}, 1};
  for (const DoubleRange& weight : FaceContact(ball, sliver).weights({0.25, 0.25})) {
    EXPECT_EQ(weight.lower, 0);
    EXPECT_EQ(weight.upper, 0);
  }
}

// Its numbers would underflow or overflow.
TYPED_TEST(FaceContactOf, leaves_unusual_sizes_open) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(this->check({{1, 1, 3}, {1, 1, -3}, 1}, triangle, 1), Verdict::hit);
  EXPECT_EQ(this->check({{1, 1, 3}, {1, 1, -3}, 1}, triangle, Scalar(0.25)), Verdict::miss);
  EXPECT_EQ(this->check({{1, 1, 3}, {1, 1, 3}, 1}, triangle, 1), Verdict::undecided);
  for (const Scalar size : {std::ldexp(Scalar{1}, -70), std::ldexp(Scalar{1}, 60)}) {
    const Triangle<Scalar> scaled = {triangle.a * size, triangle.b * size, triangle.c * size};
    const Vector3<Scalar> up(size, size, 3 * size);
    const Vector3<Scalar> down(size, size, -3 * size);
    EXPECT_EQ(this->check({up, down, size}, scaled, 1), Verdict::undecided);
  }
}

/// The shares of the bounds that the errors of t and of the weights take up, where a ball comes to the inside of a
/// triangle. They are 0 for other pairs.
struct Shares {
  double t = 0;
  double weights = 0;
};

mpf_class long_float(const OneRootNumber& x) {
  constexpr mp_bitcnt_t bits = 8192;
  const mpf_class root = sqrt(mpf_class(x.d, bits));
  return (mpf_class(x.p, bits) + mpf_class(x.q, bits) * root) / mpf_class(x.r, bits);
}

double share_of_range(const DoubleRange& range, const OneRootNumber& exact) {
  const mpf_class number = long_float(exact);
  const mpf_class twice_off = abs(2 * number - mpf_class(range.lower) - mpf_class(range.upper));
  return mpf_class(twice_off / (mpf_class(range.upper) - mpf_class(range.lower))).get_d();
}

/// Numbers of a ball and a triangle, one after the other.
template <typename Scalar>
using BallNumbers = std::array<Scalar, 16>;

template <typename Scalar>
BallNumbers<Scalar> draw_numbers(Random& random) {
  const auto [ball, triangle] = draw_shape_pair<Scalar>(SphereFamily::general, random);
  BallNumbers<Scalar> numbers;
  std::size_t k = 0;
  for (const Vector3<Scalar>* point : {&ball.start, &ball.end, &triangle.a, &triangle.b, &triangle.c}) {
    for (const Scalar x : *point) numbers[k++] = x;
  }
  numbers[k] = ball.radius;
  return numbers;
}

template <typename Scalar>
Shares shares_of(const BallNumbers<Scalar>& x) {
  const SweptSphere<Scalar> ball = {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, std::fabs(x[15])};
  const Triangle<Scalar> triangle = {{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
  const FaceContact contact(ball, triangle);
  DoubleRange t;
  if (contact.find(1, t) != Verdict::hit || t.upper == 0) return {};
  const SweptTruth truth = truth_of(ball, triangle);
  const auto weights = contact.weights(t);
  Shares shares{share_of_range(t, truth.t.number()), 0};
  if (weights[0].upper == 0) return shares;
  shares.weights = std::max(share_of_range(weights[0], truth.u), share_of_range(weights[1], truth.v));
  return shares;
}

// Climbs from drawn balls to the worst ones (S8).
TYPED_TEST(FaceContactOf, stays_within_its_bounds_where_hill_climbing_makes_the_errors_worst) {
  Random random(101);
  for (const auto& [share, name] : {std::pair{&Shares::t, "t"}, std::pair{&Shares::weights, "weights"}}) {
    double worst = 0;
    for (int start = 0; start < 10; ++start) {
      auto best = draw_numbers<TypeParam>(random);
      double best_share = shares_of(best).*share;
      for (std::size_t step = case_count(400); step > 0; --step) {
        auto next = best;
        // Where the pair has no share, another one is drawn.
        if (best_share == 0) next = draw_numbers<TypeParam>(random);
        TypeParam& number = next[random.below(next.size())];
        number = changed_coordinate(random, number);
        const double next_share = shares_of(next).*share;
        if (next_share <= best_share && best_share > 0) continue;
        best = next;
        best_share = next_share;
      }
      worst = std::max(worst, best_share);
    }
    testing::Test::RecordProperty(std::string("worst_share_of_") + name, std::to_string(worst));
    EXPECT_LT(worst, 1) << name;
    EXPECT_GT(worst, 0) << name;
  }
}

}  // namespace
}  // namespace surehit::test
