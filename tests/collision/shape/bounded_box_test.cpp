#include "shape/bounded_box.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/shape/ball_climb.hpp"
#include "shape/exact_box.hpp"
#include "support/box_families.hpp"
#include "support/case_count.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/shape_text.hpp"
#include "support/swept_truth.hpp"

namespace surehit::test::bounded_box_test {
namespace {

using detail::bounded_contact;
using detail::BoxContact;
using detail::exact_contact;
using detail::Verdict;

template <typename Scalar>
class BoundedBox : public testing::Test {};
TYPED_TEST_SUITE(BoundedBox, Scalars, ScalarNames);

/// Whether the exact t of a contact is between its bounds.
template <typename Scalar>
bool has_t_in_bounds(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle, const BoxContact& contact) {
  const SweptBox<double> box_in_double{box.start.template cast<double>(), box.end.template cast<double>(),
                                       box.half_extents.template cast<double>()};
  const Triangle<double> in_double{triangle.a.template cast<double>(), triangle.b.template cast<double>(),
                                   triangle.c.template cast<double>()};
  return compare_time(box_in_double, in_double, contact, contact.t_lower) >= 0 &&
         compare_time(box_in_double, in_double, contact, contact.t_upper) <= 0;
}

TYPED_TEST(BoundedBox, agrees_with_integers_in_all_families) {
  using Scalar = TypeParam;
  for (const BoxFamily family : all_box_families) {
    Random random(61 + static_cast<std::uint64_t>(family));
    std::size_t decided = 0;
    const std::size_t count = case_count(sizeof(Scalar) == 4 ? 3000 : 1000);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
      BoxContact bounded;
      const Verdict verdict = bounded_contact(box, triangle, bounded);
      decided += verdict != Verdict::undecided;
      const std::optional<BoxContact> exact = exact_contact(box, triangle);
      ASSERT_TRUE(!exact || has_t_in_bounds(box, triangle, *exact)) << name_of(family) << ", case " << i;
      if (verdict == Verdict::undecided) continue;
      ASSERT_EQ(verdict == Verdict::hit, exact.has_value()) << name_of(family) << ", case " << i;
      if (!exact) continue;
      ASSERT_EQ(bounded.at_start, exact->at_start) << name_of(family) << ", case " << i;
      ASSERT_EQ(compare_times(box, triangle, bounded, triangle, *exact), 0) << name_of(family) << ", case " << i;
      ASSERT_TRUE(has_t_in_bounds(box, triangle, bounded)) << name_of(family) << ", case " << i;
    }
    EXPECT_GE(decided, family == BoxFamily::general ? count * 99 / 100 : count / 8) << name_of(family);
  }
}

TYPED_TEST(BoundedBox, rounds_as_integers_do_in_all_families) {
  using Scalar = TypeParam;
  for (const BoxFamily family : all_box_families) {
    Random random(67 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 3000 : 1000); ++i) {
      const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
      BoxContact contact;
      if (bounded_contact(box, triangle, contact) != Verdict::hit) continue;
      ShapeHit<Scalar> bounded;
      if (!try_round(box, triangle, contact, bounded)) continue;
      ShapeHit<Scalar> exact;
      round_exactly(box, triangle, contact, exact);
      ASSERT_EQ(bounded, exact) << name_of(family) << ", case " << i;
    }
  }
}

// Two triangles that share an edge, a corner, or their height on an axis.
TYPED_TEST(BoundedBox, takes_only_equal_times_for_alike) {
  using Scalar = TypeParam;
  std::size_t alike = 0;
  for (const BoxFamily family : all_box_families) {
    Random random(71 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 3000 : 1000); ++i) {
      const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
      Triangle<Scalar> other = draw_box_pair<Scalar>(family, random).triangle;
      if (random.one_in(3)) {
        other.a = triangle.b;
        other.b = triangle.a;
      } else if (random.one_in(2)) {
        other.a = triangle.a;  // The edges from here are different ones.
      } else {
        other.b = triangle.c;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          if (random.one_in(2)) other.a[axis] = other.c[axis] = triangle.c[axis];
        }
      }
      const std::optional<BoxContact> x = exact_contact(box, triangle);
      const std::optional<BoxContact> y = exact_contact(box, other);
      if (!x || !y || x->at_start || y->at_start || !are_timed_alike(triangle, *x, other, *y)) continue;
      ++alike;
      ASSERT_EQ(compare_times(box, triangle, *x, other, *y), 0) << name_of(family) << ", case " << i;
    }
  }
  EXPECT_GE(alike, case_count(500));
}

/// Numbers of a box and a triangle, one after the other.
template <typename Scalar>
using BoxNumbers = std::array<Vector3<Scalar>, 6>;

// Climbs from drawn boxes to the worst ones (B7). How far the exact t is from the middle of its bounds is a share of
// them. A certain miss must be one.
TYPED_TEST(BoundedBox, stays_within_its_bounds_where_hill_climbing_makes_the_errors_worst) {
  using Scalar = TypeParam;
  Random random(73);
  const auto draw = [&] {
    const BoxFamily family = all_box_families[random.below(all_box_families.size())];
    const auto [box, triangle] = draw_box_pair<Scalar>(random.one_in(2) ? BoxFamily::general : family, random);
    return BoxNumbers<Scalar>{box.start, box.end, box.half_extents, triangle.a, triangle.b, triangle.c};
  };
  const auto changed = [&](BoxNumbers<Scalar> numbers) {
    Scalar& x = numbers[random.below(numbers.size())][static_cast<Eigen::Index>(random.below(3))];
    x = changed_coordinate(random, x);
    numbers[2] = numbers[2].cwiseAbs();
    return numbers;
  };
  const auto share_of = [](const BoxNumbers<Scalar>& numbers) {
    const auto& [start, end, half, a, b, c] = numbers;
    const SweptBox<Scalar> box{start, end, half};
    const Triangle<Scalar> triangle{a, b, c};
    BoxContact contact;
    const Verdict verdict = bounded_contact(box, triangle, contact);
    if (verdict == Verdict::undecided) return 0.0;
    const SweptTruth truth = truth_of(box, triangle);
    EXPECT_EQ(truth.touches, verdict == Verdict::hit) << hex_text(box) << '\n' << hex_text(triangle);
    if (!truth.touches || contact.at_start) return 0.0;
    return share_of_range({contact.t_lower, contact.t_upper}, truth.t.number());
  };
  expect_within_bound("t", climb_to_worst(40, 100, draw, changed, share_of));
}

}  // namespace
}  // namespace surehit::test::bounded_box_test
