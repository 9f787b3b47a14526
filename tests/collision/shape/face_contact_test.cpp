#include "shape/face_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "collision/shape/ball_climb.hpp"
#include "shape/exact_sphere.hpp"
#include "support/case_count.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/shape_families.hpp"
#include "support/shape_text.hpp"
#include "support/swept_truth.hpp"

namespace surehit::test::face_contact_test {
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
    std::optional<std::size_t> passed;
    const Verdict verdict = FaceContact(ball, triangle).find(limit, t, passed);
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

// Climbs from drawn balls to the worst ones (S8). What the errors of t and of the weights take up is a share of the
// bounds.
TYPED_TEST(FaceContactOf, stays_within_its_bounds_where_hill_climbing_makes_the_errors_worst) {
  Random random(101);
  const auto share_of_t = [](const SpherePair<TypeParam>& pair) {
    DoubleRange t;
    std::optional<std::size_t> passed;
    const Verdict verdict = FaceContact(pair.sphere, pair.triangle).find(1, t, passed);
    if (verdict != Verdict::hit || t.upper == 0) return 0.0;
    return share_of_range(t, truth_of(pair.sphere, pair.triangle).t.number());
  };
  const auto share_of_weights = [](const SpherePair<TypeParam>& pair) {
    DoubleRange t;
    std::optional<std::size_t> passed;
    const FaceContact contact(pair.sphere, pair.triangle);
    if (contact.find(1, t, passed) != Verdict::hit || t.upper == 0) return 0.0;
    const auto weights = contact.weights(t);
    if (weights[0].upper == 0) return 0.0;
    const SweptTruth truth = truth_of(pair.sphere, pair.triangle);
    return std::max(share_of_range(weights[0], truth.u), share_of_range(weights[1], truth.v));
  };
  const auto check = [&](const char* name, const auto& share_of) {
    expect_within_bound(name, worst_share<TypeParam>(random, share_of));
  };
  check("t", share_of_t);
  check("weights", share_of_weights);
}

}  // namespace
}  // namespace surehit::test::face_contact_test
