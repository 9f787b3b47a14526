#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::last_free_point_test {
namespace {

template <typename Scalar>
class LastFreePoint : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  /// A floor, and two walls that meet over it in the corner x = y = 0.
  static GeneratedMesh<Scalar> room_corner() {
    GeneratedMesh<Scalar> mesh;
    mesh.add({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}});
    mesh.add({{0, 0, 0}, {8, 0, 0}, {0, 0, 8}});
    mesh.add({{0, 0, 0}, {0, 8, 0}, {0, 0, 8}});
    return mesh;
  }

  static Segment<Scalar> to(const Segment<Scalar>& segment, const Vector3<Scalar>& end) { return {segment.start, end}; }
};
TYPED_TEST_SUITE(LastFreePoint, Scalars, ScalarNames);

TYPED_TEST(LastFreePoint, is_the_first_candidate_before_the_hit_where_that_is_free) {
  const Collider<TypeParam> floor(stack_of_triangles<TypeParam>(1).view());
  const auto segment = through_stack<TypeParam>(1, -1);
  const auto hit = floor.first_hit(segment);
  ASSERT_TRUE(hit);
  // t = 1/2; 1 - 2 s for s one ulp(1/2) less is two such ulps.
  const TypeParam ulp = std::numeric_limits<TypeParam>::epsilon() / 2;
  EXPECT_EQ(floor.last_free_point(segment, *hit), (Vector3<TypeParam>{TypeParam{0.25}, TypeParam{0.25}, 2 * ulp}));
}

TYPED_TEST(LastFreePoint, never_touches_and_is_never_behind_what_was_hit) {
  Random random(91);
  const auto mesh = this->room_corner();
  const Collider<TypeParam> room(mesh.view());
  for (std::size_t i = case_count(3'000); i > 0; --i) {
    const auto inside = [&] {
      return random.unit<TypeParam>() * TypeParam{2.5} + std::numeric_limits<TypeParam>::min();
    };
    const Vector3<TypeParam> start{inside(), inside(), inside()};
    // Into the corner, an edge or a wall: each component either reaches 0 or goes beyond.
    Vector3<TypeParam> end;
    for (TypeParam& x : end.reshaped()) x = random.one_in(3) ? 0 : -random.unit<TypeParam>();
    const Segment<TypeParam> segment{start, end};
    const auto hit = room.first_hit(segment);
    if (!hit) continue;
    const auto free = room.last_free_point(segment, *hit);
    ASSERT_FALSE(room.any_hit(this->to(segment, free))) << hex_text(Path<TypeParam>(segment));
    ASSERT_GT(free.minCoeff(), 0) << hex_text(Path<TypeParam>(segment));
  }
}

TYPED_TEST(LastFreePoint, is_the_definitions_to_the_bit) {
  Random random(92);
  for (std::size_t round = case_count(100); round > 0; --round) {
    GeneratedMesh<TypeParam> mesh = this->room_corner();
    for (int i = 0; i < 5; ++i) mesh.add(draw_pair<TypeParam>(PairFamily::small_integers, random).triangle);
    const Collider<TypeParam> collider(mesh.view());
    const ExactMeshOracle<TypeParam> oracle(mesh.view(), {});
    for (int i = 0; i < 15; ++i) {
      const auto segment =
          draw_pair<TypeParam>(random.one_in(2) ? PairFamily::small_integers : PairFamily::general, random).segment;
      QueryOptions<TypeParam> options;
      options.ignore_start_contact = random.one_in(2);
      options.ignore_end_contact = random.one_in(4);
      if (random.one_in(3)) options.min_t = random.unit<TypeParam>() / 2;
      if (random.one_in(4)) options.max_t = random.unit<TypeParam>();
      if (random.one_in(4)) options.culling = Culling::back;
      const auto hit = collider.first_hit(segment, options);
      if (!hit) continue;
      ASSERT_EQ(collider.last_free_point(segment, *hit, options), oracle.last_free_point(segment, *hit, options))
          << hex_text(Path<TypeParam>(segment)) << hex_text(options);
    }
  }
}

TYPED_TEST(LastFreePoint, of_a_hit_at_the_start_is_the_start) {
  const Collider<TypeParam> floor(stack_of_triangles<TypeParam>(1).view());
  const auto from_floor = through_stack<TypeParam>(0, 1);
  const auto hit = floor.first_hit(from_floor);
  ASSERT_TRUE(hit);
  EXPECT_EQ(floor.last_free_point(from_floor, *hit), from_floor.start);
}

TYPED_TEST(LastFreePoint, of_a_hit_at_the_least_t_is_the_start) {
  const Collider<TypeParam> floor(stack_of_triangles<TypeParam>(1).view());
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const auto from_above = through_stack<TypeParam>(tiny, -1);
  const auto hit = floor.first_hit(from_above);
  ASSERT_TRUE(hit);
  EXPECT_GT(hit->t, 0);
  EXPECT_EQ(floor.last_free_point(from_above, *hit), from_above.start);
}

TYPED_TEST(LastFreePoint, is_the_start_where_the_room_is_too_narrow_for_any_other_number) {
  // One ulp above the floor at z = 1: there is no number in between.
  GeneratedMesh<TypeParam> mesh;
  mesh.add(unit_triangle<TypeParam>(1));
  const Collider<TypeParam> floor(mesh.view());
  const auto from_above = through_stack<TypeParam>(neighbour(TypeParam{1}, 1), 0);
  const auto hit = floor.first_hit(from_above);
  ASSERT_TRUE(hit);
  EXPECT_EQ(floor.last_free_point(from_above, *hit), from_above.start);
}

TYPED_TEST(LastFreePoint, leaves_the_triangle_of_an_ignored_start_contact) {
  const Collider<TypeParam> stack(stack_of_triangles<TypeParam>(2).view());
  const auto upwards = through_stack<TypeParam>(0, 3);
  const QueryOptions<TypeParam> options{.ignore_start_contact = true};
  const auto hit = stack.first_hit(upwards, options);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 1u);
  const auto free = stack.last_free_point(upwards, *hit, options);
  EXPECT_LT(free[2], 1);
  EXPECT_GT(free[2], TypeParam(0.99));
  EXPECT_FALSE(stack.any_hit(this->to(upwards, free), options));
}

TYPED_TEST(LastFreePoint, min_t_keeps_its_place_on_the_whole_segment) {
  // Triangle 0 lies before min_t: it does not stop the point, though it would the shorter segment under an unscaled
  // limit.
  const Collider<TypeParam> stack(stack_of_triangles<TypeParam>(2).view());
  const auto upwards = through_stack<TypeParam>(-1, 3);
  for (const TypeParam min_t : {TypeParam{0.375}, TypeParam(0.49)}) {
    const QueryOptions<TypeParam> options{.min_t = min_t};
    const auto hit = stack.first_hit(upwards, options);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, TypeParam{0.5});
    EXPECT_EQ(stack.last_free_point(upwards, *hit, options)[2], 1 - std::numeric_limits<TypeParam>::epsilon() * 2);
  }
}

TYPED_TEST(LastFreePoint, max_t_never_cuts_what_lies_before_the_candidate) {
  const Collider<TypeParam> stack(stack_of_triangles<TypeParam>(2).view());
  const auto upwards = through_stack<TypeParam>(-1, 3);
  const auto hit_on_1 = stack.first_hit(upwards, {.min_t = TypeParam{0.5}});
  ASSERT_TRUE(hit_on_1);
  // Under these options the first hit is triangle 0 at 1/4: every candidate beyond it touches that.
  const auto free = stack.last_free_point(upwards, *hit_on_1, {.max_t = TypeParam{0.125}});
  EXPECT_LT(free[2], 0);
}

TYPED_TEST(LastFreePoint, of_options_that_admit_nothing_or_numbers_that_are_none) {
  using Limits = std::numeric_limits<TypeParam>;
  const Collider<TypeParam> floor(stack_of_triangles<TypeParam>(1).view());
  const auto segment = through_stack<TypeParam>(1, -1);
  EXPECT_EQ(floor.last_free_point(segment, Hit<TypeParam>{.t = Limits::quiet_NaN()}), segment.start);
  EXPECT_EQ(floor.last_free_point(segment, Hit<TypeParam>{.t = Limits::infinity()}), segment.start);
  EXPECT_EQ(floor.last_free_point(segment, Hit<TypeParam>{.t = -1}), segment.start);
  const Segment<TypeParam> endless{{1, 2, 3}, {0, Limits::infinity(), 0}};
  EXPECT_EQ(floor.last_free_point(endless, Hit<TypeParam>{.t = TypeParam{0.5}}), endless.start);
}

TYPED_TEST(LastFreePoint, heeds_filter_and_mask_and_ignored_triangle) {
  const std::vector<std::uint32_t> masks = {1, 2};
  const Collider<TypeParam> stack(stack_of_triangles<TypeParam>(2).view(), with_masks(masks));
  const auto upwards = through_stack<TypeParam>(-1, 3);
  const auto expect_below_1 = [](const Vector3<TypeParam>& free) {
    EXPECT_LT(free[2], 1);
    EXPECT_GT(free[2], TypeParam(0.99));
  };
  const auto upper = [](const Hit<TypeParam>& hit) { return hit.triangle == 1; };
  expect_below_1(stack.last_free_point(upwards, *stack.first_hit(upwards, upper), upper));
  const QueryOptions<TypeParam> masked{.mask = 2};
  expect_below_1(stack.last_free_point(upwards, *stack.first_hit(upwards, masked), masked));
  const QueryOptions<TypeParam> ignoring{.ignored_triangle = 0};
  expect_below_1(stack.last_free_point(upwards, *stack.first_hit(upwards, ignoring), ignoring));
}

}  // namespace
}  // namespace surehit::test::last_free_point_test
