#include <algorithm>
#include <array>
#include <cstddef>

#include "query_meaning.hpp"
#include "support/neighbour.hpp"

namespace surehit::test::query_meaning_degenerate_test {
namespace {

/// "Degenerate triangle: the segment or the point that its corners span, exactly."
template <typename Scalar>
class DegenerateMeaning : public QueryMeaning<Scalar> {
 protected:
  /// Corners (-1, 0, 0), (0, 0, 0) and (3, 0, 0) in the order given: `order[i]` is the corner that point i becomes.
  static Triangle<Scalar> needle(const std::array<std::size_t, 3>& order) {
    std::array<Vector3<Scalar>, 3> corners;
    corners[order[0]] = {-1, 0, 0};
    corners[order[1]] = {0, 0, 0};
    corners[order[2]] = {3, 0, 0};
    return {corners[0], corners[1], corners[2]};
  }

  static Triangle<Scalar> corners(const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) {
    return {a, b, c};
  }

  template <typename Check>
  static void for_each_order(Check&& check) {
    std::array<std::size_t, 3> order = {0, 1, 2};
    do {
      check(order);
    } while (std::next_permutation(order.begin(), order.end()));
  }

  /// The weight of corner `which` when the least corner weighs `least` and the greatest `greatest`.
  static Scalar weight(const std::array<std::size_t, 3>& order, std::size_t which, Scalar least, Scalar greatest) {
    return which == order[0] ? least : which == order[2] ? greatest : Scalar{0};
  }

  static constexpr Scalar quarter{0.25};
  static constexpr Scalar half{0.5};
};
TYPED_TEST_SUITE(DegenerateMeaning, Scalars, ScalarNames);

TYPED_TEST(DegenerateMeaning, needle_is_the_segment_between_its_end_corners_whatever_their_order) {
  this->for_each_order([&](const std::array<std::size_t, 3>& order) {
    const auto needle = this->needle(order);
    const auto ask_at = [&](TypeParam x) { return this->ask(Segment<TypeParam>{{x, 0, 1}, {x, 0, -3}}, needle); };
    // At x = 2, the least corner weighs 1/4 and the greatest 3/4: the middle corner never weighs anything.
    this->expect_hit(ask_at(2), this->quarter, this->weight(order, 1, this->quarter, TypeParam{0.75}),
                     this->weight(order, 2, this->quarter, TypeParam{0.75}), Side::edge_on);
    this->expect_hit(ask_at(0), this->quarter, this->weight(order, 1, TypeParam{0.75}, this->quarter),
                     this->weight(order, 2, TypeParam{0.75}, this->quarter), Side::edge_on);
    this->expect_hit(ask_at(-1), this->quarter, this->weight(order, 1, 1, 0), this->weight(order, 2, 1, 0),
                     Side::edge_on);
    this->expect_hit(ask_at(3), this->quarter, this->weight(order, 1, 0, 1), this->weight(order, 2, 0, 1),
                     Side::edge_on);
    EXPECT_FALSE(ask_at(neighbour(TypeParam{3}, 1)));
    EXPECT_FALSE(ask_at(neighbour(TypeParam{-1}, -1)));
  });
}

TYPED_TEST(DegenerateMeaning, path_that_passes_beside_a_needle_misses) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  this->for_each_order([&](const std::array<std::size_t, 3>& order) {
    EXPECT_FALSE(this->ask(Segment<TypeParam>{{1, tiny, 1}, {1, tiny, -1}}, this->needle(order)));
    EXPECT_FALSE(this->ask(Segment<TypeParam>{{-5, tiny, 0}, {5, tiny, 0}}, this->needle(order)));
  });
}

TYPED_TEST(DegenerateMeaning, path_along_a_needle_enters_at_its_nearer_end) {
  this->for_each_order([&](const std::array<std::size_t, 3>& order) {
    const auto needle = this->needle(order);
    const auto forwards = this->ask(Segment<TypeParam>{{-3, 0, 0}, {5, 0, 0}}, needle);
    this->expect_hit(forwards, this->quarter, this->weight(order, 1, 1, 0), this->weight(order, 2, 1, 0),
                     Side::edge_on);
    const auto backwards = this->ask(Segment<TypeParam>{{5, 0, 0}, {-3, 0, 0}}, needle);
    this->expect_hit(backwards, this->quarter, this->weight(order, 1, 0, 1), this->weight(order, 2, 0, 1),
                     Side::edge_on);
    const auto inside = this->ask(Segment<TypeParam>{{1, 0, 0}, {2, 0, 0}}, needle);
    this->expect_hit(inside, 0, this->weight(order, 1, this->half, this->half),
                     this->weight(order, 2, this->half, this->half), Side::edge_on);
    EXPECT_FALSE(this->ask(Segment<TypeParam>{{-5, 0, 0}, {-2, 0, 0}}, needle));
    EXPECT_TRUE(this->ask(Segment<TypeParam>{{-5, 0, 0}, {-1, 0, 0}}, needle));
  });
}

TYPED_TEST(DegenerateMeaning, point_on_a_needle) {
  const Vector3<TypeParam> on{2, 0, 0};
  const Vector3<TypeParam> off{2, std::numeric_limits<TypeParam>::denorm_min(), 0};
  this->for_each_order([&](const std::array<std::size_t, 3>& order) {
    const auto needle = this->needle(order);
    this->expect_hit(this->ask(Segment<TypeParam>{on, on}, needle), 0,
                     this->weight(order, 1, this->quarter, TypeParam{0.75}),
                     this->weight(order, 2, this->quarter, TypeParam{0.75}), Side::edge_on);
    EXPECT_FALSE(this->ask(Segment<TypeParam>{off, off}, needle));
  });
}

TYPED_TEST(DegenerateMeaning, end_corners_are_found_by_x_then_y_then_z) {
  const auto ask_middle = [&](const Vector3<TypeParam>& low, const Vector3<TypeParam>& high) {
    // A quarter of the way from the least to the greatest corner, which are c and b.
    const Vector3<TypeParam> target = (3 * low + high) / 4;
    const Vector3<TypeParam> aside{-high[1], high[2] + 1, high[0] + 2};
    return this->ask(Segment<TypeParam>{target + aside, target - aside}, this->corners((low + high) / 2, high, low));
  };
  for (const auto& [low, high] : std::array<std::array<Vector3<TypeParam>, 2>, 3>{
           {{{{0, 8, 8}, {8, 0, 0}}}, {{{0, 0, 8}, {0, 8, 0}}}, {{{0, 0, 0}, {0, 0, 8}}}}}) {
    this->expect_hit(ask_middle(low, high), this->half, this->quarter, TypeParam{0.75}, Side::edge_on);
  }
}

TYPED_TEST(DegenerateMeaning, of_equal_corners_the_one_of_lowest_index_weighs) {
  const Vector3<TypeParam> low{0, 0, 0};
  const Vector3<TypeParam> high{4, 0, 0};
  const Segment<TypeParam> at_1{{1, 0, 1}, {1, 0, -1}};
  const TypeParam three_quarters{0.75};
  const auto expect_weights = [&](const Triangle<TypeParam>& triangle, TypeParam u, TypeParam v) {
    this->expect_hit(this->ask(at_1, triangle), this->half, u, v, Side::edge_on);
  };
  expect_weights(this->corners(low, low, high), 0, this->quarter);
  expect_weights(this->corners(high, high, low), 0, three_quarters);
  expect_weights(this->corners(low, high, low), this->quarter, 0);
  expect_weights(this->corners(high, low, high), three_quarters, 0);
  expect_weights(this->corners(high, low, low), three_quarters, 0);
  expect_weights(this->corners(low, high, high), this->quarter, 0);
}

TYPED_TEST(DegenerateMeaning, all_corners_equal_is_a_point_of_no_weights) {
  const Vector3<TypeParam> corner{1, 2, 3};
  const auto point = this->corners(corner, corner, corner);
  const Vector3<TypeParam> aside{1, -1, 2};
  this->expect_hit(this->ask(Segment<TypeParam>{corner + aside, corner - aside}, point), this->half, 0, 0,
                   Side::edge_on);
  this->expect_hit(this->ask(Segment<TypeParam>{corner, corner + aside}, point), 0, 0, 0, Side::edge_on);
  this->expect_hit(this->ask(Segment<TypeParam>{corner, corner}, point), 0, 0, 0, Side::edge_on);
  this->expect_hit(this->ask(Line<TypeParam>{corner + 2 * aside, aside}, point), -2, 0, 0, Side::edge_on);
  const Vector3<TypeParam> beside{neighbour(TypeParam{1}, 1), 2, 3};
  EXPECT_FALSE(this->ask(Segment<TypeParam>{beside + aside, beside - aside}, point));
  EXPECT_FALSE(this->ask(Segment<TypeParam>{beside, beside}, point));
}

TYPED_TEST(DegenerateMeaning, triangle_that_is_not_quite_degenerate_has_a_side) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const Triangle<TypeParam> sliver{{0, 0, 0}, {4, 0, 0}, {0, tiny, 0}};
  this->expect_hit(this->ask(Segment<TypeParam>{{1, 0, 1}, {1, 0, -1}}, sliver), this->half, this->quarter, 0,
                   Side::front);
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{1, tiny, 1}, {1, tiny, -1}}, sliver));
}

TYPED_TEST(DegenerateMeaning, limits_and_ignored_ends_hold_for_needles_too) {
  const auto needle = this->needle({0, 1, 2});
  const Segment<TypeParam> along{{-3, 0, 0}, {5, 0, 0}};
  EXPECT_TRUE(this->ask(along, needle, {.max_t = this->quarter}));
  EXPECT_FALSE(this->ask(along, needle, {.max_t = neighbour(this->quarter, -1)}));
  this->expect_hit(this->ask(along, needle, {.min_t = this->half}), this->half, 0, this->half, Side::edge_on);
  EXPECT_FALSE(this->ask(along, needle, {.min_t = neighbour(TypeParam{0.75}, 1)}));
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{2, 0, 0}, {2, 0, 1}}, needle, {.ignore_start_contact = true}));
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{2, 0, 1}, {2, 0, 0}}, needle, {.ignore_end_contact = true}));
  EXPECT_FALSE(this->ask(along, needle, {.culling = Culling::back}));
  EXPECT_FALSE(this->ask(along, needle, {.culling = Culling::front}));
}

}  // namespace
}  // namespace surehit::test::query_meaning_degenerate_test
