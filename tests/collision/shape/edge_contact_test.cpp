#include "shape/edge_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

namespace surehit::test::edge_contact_test {
namespace {

using detail::DoubleRange;
using detail::edge_feature;
using detail::EdgeContact;
using detail::exact_contact;
using detail::FaceContact;
using detail::SphereContact;
using detail::Verdict;

/// Holds simple contacts with edges against integers (S9, S10).
template <typename Scalar>
class EdgeContactOf : public testing::Test {
 protected:
  /// Checks that a hit of an edge is the first contact, that its t is within the bounds, and so is its place.
  static void check_hit(const SweptSphere<Scalar>& ball, const Triangle<Scalar>& triangle, std::size_t edge,
                        const DoubleRange& t) {
    const auto what = [&] { return hex_text(ball) + '\n' + hex_text(triangle); };
    const auto exact = exact_contact(ball, triangle);
    ASSERT_TRUE(exact && exact->feature == edge_feature(edge)) << what();
    EXPECT_EQ(t.upper == 0, exact->at_start) << what();
    if (!exact->at_start) {
      EXPECT_GE(t.upper, exact->t_lower) << what();
      EXPECT_LE(t.lower, exact->t_upper) << what();
    }
    ShapeHit<Scalar> hit;
    round_exactly(ball, triangle, *exact, hit);
    const Scalar expected = edge == 0 ? hit.u : edge == 1 ? hit.v : 1 - hit.v;
    const DoubleRange share = EdgeContact(ball, triangle, edge).share(t);
    const double ulp = std::numeric_limits<Scalar>::epsilon();
    EXPECT_LE(share.lower, expected + ulp) << what();
    EXPECT_GE(share.upper, expected - ulp) << what();
  }

  /// Checks a verdict about an edge that a ball is known to pass. Returns it, or nothing if no edge is known.
  static std::optional<Verdict> check(const SweptSphere<Scalar>& ball, const Triangle<Scalar>& triangle, Scalar limit) {
    DoubleRange t;
    std::optional<std::size_t> passed;
    if (FaceContact(ball, triangle).find(limit, t, passed) != Verdict::undecided || !passed) return std::nullopt;
    const Verdict verdict = EdgeContact(ball, triangle, *passed).find(limit, t);
    if (verdict == Verdict::hit) check_hit(ball, triangle, *passed, t);
    if (verdict == Verdict::miss) {
      const auto exact = exact_contact(ball, triangle);
      const bool is_late = !exact || (!exact->at_start && compare_time(ball, triangle, *exact, limit) > 0);
      EXPECT_TRUE(is_late) << hex_text(ball) << '\n' << hex_text(triangle);
    }
    return verdict;
  }
};
TYPED_TEST_SUITE(EdgeContactOf, Scalars, ScalarNames);

TYPED_TEST(EdgeContactOf, is_certain_of_what_integers_find) {
  using Scalar = TypeParam;
  for (const SphereFamily family : all_sphere_families) {
    Random random(103 + static_cast<std::uint64_t>(family));
    std::array<std::size_t, 3> verdicts = {};
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 4000 : 1500); ++i) {
      const auto [ball, triangle] = draw_shape_pair<Scalar>(family, random);
      const Scalar limit = random.one_in(2) ? Scalar{1} : random.unit<Scalar>();
      const std::optional<Verdict> verdict = this->check(ball, triangle, limit);
      if (verdict) ++verdicts[static_cast<std::size_t>(*verdict)];
      ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    }
    if (family != SphereFamily::general) continue;
    EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::miss)], case_count(30) / 2);
    EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::hit)], case_count(30) / 2);
  }
}

// A hit needs no premise: it is one of each edge, whether the ball passes this edge or not.
TYPED_TEST(EdgeContactOf, hits_an_edge_only_where_it_is_touched_first) {
  using Scalar = TypeParam;
  std::size_t hits = 0;
  for (const SphereFamily family : all_sphere_families) {
    Random random(107 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(1000); ++i) {
      const auto [ball, triangle] = draw_shape_pair<Scalar>(family, random);
      for (std::size_t edge = 0; edge < 3; ++edge) {
        DoubleRange t;
        if (EdgeContact(ball, triangle, edge).find(1, t) != Verdict::hit) continue;
        ++hits;
        this->check_hit(ball, triangle, edge, t);
        ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
      }
    }
  }
  EXPECT_GT(hits, case_count(500));
}

// The ball comes to the edge beside one of its ends by a few units in the last place of the bounds, or by more.
TYPED_TEST(EdgeContactOf, is_not_certain_beside_an_end) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Random random(109);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < case_count(4000); ++i) {
    const Scalar beside = std::ldexp(random.symmetric<Scalar>(), -static_cast<int>(random.below(50)));
    const Scalar x = random.one_in(2) ? beside : 1 + beside;
    const Scalar y = -random.unit<Scalar>() / 2 - Scalar(0.125);
    const Vector3<Scalar> start(x, y, 2);
    const Vector3<Scalar> end(random.one_in(2) ? x : Scalar{1}, y, -1);
    hits += this->check({start, end, Scalar(0.75)}, triangle, 1) == Verdict::hit;
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
  EXPECT_GT(hits, case_count(400));
}

// The ball comes to the edge, and to the inside of the triangle, at nearly the same time.
TYPED_TEST(EdgeContactOf, is_not_certain_where_the_inside_is_as_near) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Random random(113);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < case_count(4000); ++i) {
    const Scalar beside = std::ldexp(random.symmetric<Scalar>(), -static_cast<int>(random.below(50)));
    const SweptSphere<Scalar> ball = {{Scalar(0.25), beside, 2}, {Scalar(0.25), beside, -1}, random.unit<Scalar>()};
    DoubleRange t;
    if (EdgeContact(ball, triangle, 0).find(1, t) != Verdict::hit) continue;
    ++hits;
    this->check_hit(ball, triangle, 0, t);
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
  EXPECT_GT(hits, case_count(400));
}

TYPED_TEST(EdgeContactOf, misses_until_the_limit) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const SweptSphere<Scalar> ball = {{1, -5, 0}, {1, 3, 0}, 1};  // touches the edge at t = 1/2
  DoubleRange t;
  EXPECT_EQ(EdgeContact(ball, triangle, 0).find(1, t), Verdict::hit);
  EXPECT_LE(t.lower, 0.5);
  EXPECT_GE(t.upper, 0.5);
  EXPECT_LT(t.upper - t.lower, 0x1p-30);
  EXPECT_EQ(EdgeContact(ball, triangle, 0).find(0.375, t), Verdict::miss);
  EXPECT_EQ(EdgeContact(SweptSphere<Scalar>{{1, -5, 0}, {1, -6, 0}, 1}, triangle, 0).find(1, t), Verdict::miss);
  EXPECT_EQ(EdgeContact(SweptSphere<Scalar>{{1, -5, 2}, {1, 3, 2}, 1}, triangle, 0).find(1, t), Verdict::miss);
}

// Its numbers would underflow or overflow.
TYPED_TEST(EdgeContactOf, leaves_unusual_sizes_open) {
  using Scalar = TypeParam;
  for (const Scalar size : {std::ldexp(Scalar{1}, -70), Scalar{1}, std::ldexp(Scalar{1}, 60)}) {
    const Triangle<Scalar> triangle = {{0, 0, 0}, {4 * size, 0, 0}, {0, 4 * size, 0}};
    const SweptSphere<Scalar> ball = {{size, -5 * size, 0}, {size, 3 * size, 0}, size};
    DoubleRange t;
    EXPECT_EQ(EdgeContact(ball, triangle, 0).find(1, t), size == 1 ? Verdict::hit : Verdict::undecided);
    EXPECT_EQ(EdgeContact(ball, triangle, 0).share({0.5, 0.5}).upper > 0, size == 1);
  }
}

// Climbs from drawn balls to the worst ones (S9). What the errors of t and of the place take up is a share of the
// bounds.
TYPED_TEST(EdgeContactOf, stays_within_its_bounds_where_hill_climbing_makes_the_errors_worst) {
  Random random(127);
  const auto share_with = [](const auto& share_of) {
    return [share_of](const SpherePair<TypeParam>& pair) {
      double worst = 0;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        DoubleRange t;
        const EdgeContact contact(pair.sphere, pair.triangle, edge);
        if (contact.find(1, t) != Verdict::hit || t.upper == 0) continue;
        worst = std::max(worst, share_of(contact, edge, t, truth_of(pair.sphere, pair.triangle)));
      }
      return worst;
    };
  };
  const auto share_of_t = [](const EdgeContact&, std::size_t, const DoubleRange& t, const SweptTruth& truth) {
    return share_of_range(t, truth.t.number());
  };
  const auto share_of_place = [](const EdgeContact& contact, std::size_t edge, const DoubleRange& t,
                                 const SweptTruth& truth) {
    if (edge != 2) return share_of_range(contact.share(t), edge == 0 ? truth.u : truth.v);
    OneRootNumber rest = truth.v;
    rest.p = rest.r - rest.p;
    rest.q = -rest.q;
    return share_of_range(contact.share(t), rest);
  };
  const auto check = [&](const char* name, const auto& share_of) {
    expect_within_bound(name, worst_share<TypeParam>(random, share_with(share_of)));
  };
  check("t", share_of_t);
  check("place", share_of_place);
}

}  // namespace
}  // namespace surehit::test::edge_contact_test
