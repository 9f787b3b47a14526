#include "query_meaning.hpp"

#include <array>
#include <cstddef>

#include "support/neighbour.hpp"

namespace surehit::test::query_meaning_test {
namespace {

TYPED_TEST_SUITE(QueryMeaning, Scalars, ScalarNames);

// The paths.

TYPED_TEST(QueryMeaning, segment_runs_from_t_0_to_t_1) {
  this->expect_hit(this->ask_across(0.25, 0.5, 3, -1), TypeParam{0.75}, TypeParam{0.25}, TypeParam{0.5}, Side::front);
  EXPECT_FALSE(this->ask_across(0.25, 0.5, 3, 1));
  EXPECT_FALSE(this->ask_across(0.25, 0.5, -1, -3));
}

TYPED_TEST(QueryMeaning, t_of_a_swept_point_is_the_time_of_impact_as_a_fraction_of_the_step) {
  // From a height of 8, falling 16 in the step: on the floor after half of it.
  const auto answer =
      this->ask(Segment<TypeParam>{{0, 0, 8}, {TypeParam{0.5}, TypeParam{0.5}, -8}}, unit_triangle<TypeParam>());
  this->expect_hit(answer, TypeParam{0.5}, TypeParam{0.25}, TypeParam{0.25}, Side::front);
}

TYPED_TEST(QueryMeaning, t_of_a_ray_counts_in_its_direction_as_given) {
  const auto ask_ray = [&](TypeParam length) {
    return this->ask(Ray<TypeParam>{{TypeParam{0.25}, TypeParam{0.25}, 4}, {0, 0, -length}},
                     unit_triangle<TypeParam>());
  };
  for (const auto& [length, t] :
       std::array<std::array<TypeParam, 2>, 4>{{{1, 4}, {4, 1}, {TypeParam{0.125}, 32}, {1024, TypeParam{0x1p-8}}}}) {
    this->expect_hit(ask_ray(length), t, TypeParam{0.25}, TypeParam{0.25}, Side::front);
  }
  EXPECT_FALSE(ask_ray(-1));
}

TYPED_TEST(QueryMeaning, line_also_meets_what_lies_behind_its_origin) {
  const Line<TypeParam> line{{TypeParam{0.25}, TypeParam{0.25}, 4}, {0, 0, 2}};
  this->expect_hit(this->ask(line, unit_triangle<TypeParam>()), -2, TypeParam{0.25}, TypeParam{0.25}, Side::back);
  EXPECT_FALSE(this->ask(Ray<TypeParam>{line.origin, line.direction}, unit_triangle<TypeParam>()));
}

// "A triangle is the closed convex hull of its three corners, and a path is closed."

TYPED_TEST(QueryMeaning, triangle_is_closed_on_its_edges) {
  this->expect_hit(this->ask_across(0.5, 0, 1, -1), TypeParam{0.5}, TypeParam{0.5}, 0, Side::front);
  this->expect_hit(this->ask_across(0, 0.5, 1, -1), TypeParam{0.5}, 0, TypeParam{0.5}, Side::front);
  this->expect_hit(this->ask_across(0.5, 0.5, 1, -1), TypeParam{0.5}, TypeParam{0.5}, TypeParam{0.5}, Side::front);
}

TYPED_TEST(QueryMeaning, triangle_is_closed_on_its_corners) {
  this->expect_hit(this->ask_across(0, 0, 1, -1), TypeParam{0.5}, 0, 0, Side::front);
  this->expect_hit(this->ask_across(1, 0, 1, -1), TypeParam{0.5}, 1, 0, Side::front);
  this->expect_hit(this->ask_across(0, 1, 1, -1), TypeParam{0.5}, 0, 1, Side::front);
}

TYPED_TEST(QueryMeaning, nothing_beside_the_closed_triangle_is_met) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  EXPECT_FALSE(this->ask_across(0.5, -tiny, 1, -1));
  EXPECT_FALSE(this->ask_across(-tiny, 0.5, 1, -1));
  EXPECT_FALSE(this->ask_across(TypeParam{0.5}, neighbour(TypeParam{0.5}, 1), 1, -1));
  EXPECT_FALSE(this->ask_across(neighbour(TypeParam{1}, 1), 0, 1, -1));
}

TYPED_TEST(QueryMeaning, path_is_closed_at_both_ends) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  this->expect_hit(this->ask_across(0.25, 0.25, 1, 0), 1, TypeParam{0.25}, TypeParam{0.25}, Side::front);
  this->expect_hit(this->ask_across(0.25, 0.25, 0, 1), 0, TypeParam{0.25}, TypeParam{0.25}, Side::back);
  EXPECT_FALSE(this->ask_across(0.25, 0.25, 1, tiny));
  EXPECT_FALSE(this->ask_across(0.25, 0.25, tiny, 1));
  this->expect_hit(this->ask(Ray<TypeParam>{{0, 0, 0}, {0, 0, 1}}, unit_triangle<TypeParam>()), 0, 0, 0, Side::back);
}

// "u is the weight of b and v that of c. t, u and v are the exact values rounded once to nearest."

TYPED_TEST(QueryMeaning, u_and_v_locate_the_point) {
  const Triangle<TypeParam> triangle{{1, 1, 1}, {9, 1, 1}, {1, 17, 1}};
  const auto answer = this->ask(Segment<TypeParam>{{3, 9, 5}, {3, 9, 0}}, triangle);
  this->expect_hit(answer, TypeParam(0.8), TypeParam{0.25}, TypeParam{0.5}, Side::front);
}

TYPED_TEST(QueryMeaning, t_and_u_and_v_are_rounded_once) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {7, 0, 0}, {0, 11, 0}};
  const auto answer = this->ask(Segment<TypeParam>{{2, 5, 3}, {2, 5, -10}}, triangle);
  this->expect_hit(answer, TypeParam{3} / 13, TypeParam{2} / 7, TypeParam{5} / 11, Side::front);
}

TYPED_TEST(QueryMeaning, halfway_between_two_numbers_rounds_to_the_even_one) {
  // t = (2^digits + 1) / 2^(digits + 1) lies halfway between 1/2 and its neighbour, and 1/2 is the even one; two halves
  // farther on, the upper neighbour is.
  constexpr int digits = std::numeric_limits<TypeParam>::digits;
  const TypeParam parts = std::ldexp(TypeParam{1}, digits);
  const TypeParam half{0.5};
  const auto t_at = [&](TypeParam height) {
    // From -parts to parts: 2^(digits + 1) units long, on which `height` is unit parts + height.
    return this->ask(Segment<TypeParam>{{0, 0, -parts}, {0, 0, parts}}, unit_triangle(height)).value().t;
  };
  EXPECT_EQ(t_at(1), half);
  EXPECT_EQ(t_at(2), neighbour(half, 1));
  EXPECT_EQ(t_at(3), neighbour(half, 2));
}

TYPED_TEST(QueryMeaning, zero_is_positive) {
  const TypeParam negative_zero{-0.0};
  const auto answer = this->ask(Segment<TypeParam>{{negative_zero, negative_zero, negative_zero}, {0, 0, -1}},
                                Triangle<TypeParam>{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}});
  this->expect_hit(answer, 0, 0, 0, Side::front);
}

TYPED_TEST(QueryMeaning, u_plus_v_may_exceed_1_by_rounding) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}};
  const auto answer = this->ask(Segment<TypeParam>{{1, 4, 1}, {1, 4, -1}}, triangle);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->u, TypeParam(0.2));
  EXPECT_EQ(answer->v, TypeParam(0.8));
  EXPECT_GT(answer->u, 1 - answer->v);  // exact: v is over a half
}

TYPED_TEST(QueryMeaning, rounded_t_below_the_exact_one_loses_the_hit_as_next_limit) {
  const auto ask_up_to = [&](TypeParam max_t) {
    return this->ask(through_stack<TypeParam>(10, 0), unit_triangle<TypeParam>(3), {.max_t = max_t});
  };
  const auto answer = ask_up_to(1);
  this->expect_hit(answer, TypeParam(0.7), TypeParam{0.25}, TypeParam{0.25}, Side::front);
  EXPECT_LT(10 * mpq_class(double{answer->t}), 7);
  EXPECT_FALSE(ask_up_to(answer->t));
  EXPECT_TRUE(ask_up_to(neighbour(answer->t, 1)));
}

// "A t that no finite Scalar holds rounds to infinity; it is a hit all the same."

TYPED_TEST(QueryMeaning, t_beyond_every_finite_number_is_infinite_and_a_hit) {
  using Limits = std::numeric_limits<TypeParam>;
  const Triangle<TypeParam> far{{-1, -1, Limits::max()}, {3, -1, Limits::max()}, {-1, 3, Limits::max()}};
  const auto answer = this->ask(Ray<TypeParam>{{0, 0, 0}, {0, 0, Limits::denorm_min()}}, far);
  this->expect_hit(answer, Limits::infinity(), TypeParam{0.25}, TypeParam{0.25}, Side::back);
  const auto behind = this->ask(Line<TypeParam>{{0, 0, 0}, {0, 0, -Limits::denorm_min()}}, far);
  this->expect_hit(behind, -Limits::infinity(), TypeParam{0.25}, TypeParam{0.25}, Side::front);
}

TYPED_TEST(QueryMeaning, infinite_t_lies_beyond_every_finite_limit) {
  using Limits = std::numeric_limits<TypeParam>;
  const Triangle<TypeParam> far{{-1, -1, Limits::max()}, {3, -1, Limits::max()}, {-1, 3, Limits::max()}};
  const Ray<TypeParam> ray{{0, 0, 0}, {0, 0, Limits::denorm_min()}};
  EXPECT_FALSE(this->ask(ray, far, {.max_t = Limits::max()}));
  EXPECT_TRUE(this->ask(ray, far, {.min_t = Limits::max()}));
}

TYPED_TEST(QueryMeaning, t_below_every_positive_number_is_zero_and_a_hit) {
  using Limits = std::numeric_limits<TypeParam>;
  const auto answer = this->ask(Ray<TypeParam>{{0, 0, 0}, {0, 0, Limits::max()}}, unit_triangle(Limits::denorm_min()));
  this->expect_hit(answer, 0, 0, 0, Side::back);
  EXPECT_FALSE(
      this->ask(Ray<TypeParam>{{0, 0, 0}, {0, 0, Limits::max()}}, unit_triangle(Limits::denorm_min()), {.max_t = 0}));
}

// "A limit on t is closed: exact t <= limit."

TYPED_TEST(QueryMeaning, limit_is_closed) {
  const auto across = [&](const QueryOptions<TypeParam>& options) {
    return this->ask_across(0.25, 0.25, 3, -1, options);
  };
  EXPECT_TRUE(across({.max_t = TypeParam{0.75}}));
  EXPECT_FALSE(across({.max_t = neighbour(TypeParam{0.75}, -1)}));
  EXPECT_TRUE(across({.min_t = TypeParam{0.75}}));
  EXPECT_FALSE(across({.min_t = neighbour(TypeParam{0.75}, 1)}));
  EXPECT_TRUE(across({.min_t = TypeParam{0.75}, .max_t = TypeParam{0.75}}));
}

TYPED_TEST(QueryMeaning, limit_is_compared_with_the_exact_t) {
  // t = 7/10 rounds down and t = 4/5 rounds up, in float and in double alike.
  const auto ask_limited = [&](TypeParam height, const QueryOptions<TypeParam>& options) {
    return this->ask(through_stack<TypeParam>(10, 0), unit_triangle(height), options).has_value();
  };
  EXPECT_FALSE(ask_limited(3, {.max_t = TypeParam(0.7)}));
  EXPECT_TRUE(ask_limited(3, {.min_t = TypeParam(0.7)}));
  EXPECT_TRUE(ask_limited(2, {.max_t = TypeParam(0.8)}));
  EXPECT_FALSE(ask_limited(2, {.min_t = TypeParam(0.8)}));
}

// "Segment in the triangle's plane: it meets the triangle or it does not, exactly; t is where it enters."

TYPED_TEST(QueryMeaning, segment_in_the_plane_that_overlaps_enters_at_t) {
  const TypeParam quarter{0.25};
  const auto answer = this->ask(Segment<TypeParam>{{-1, quarter, 0}, {3, quarter, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(answer, quarter, 0, quarter, Side::edge_on);
  const auto backwards = this->ask(Segment<TypeParam>{{3, quarter, 0}, {-1, quarter, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(backwards, TypeParam{0.5625}, TypeParam{0.75}, quarter, Side::edge_on);
}

TYPED_TEST(QueryMeaning, segment_in_the_plane_that_starts_inside_is_met_at_0) {
  const TypeParam quarter{0.25};
  const auto answer = this->ask(Segment<TypeParam>{{quarter, quarter, 0}, {3, quarter, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(answer, 0, quarter, quarter, Side::edge_on);
  const auto within =
      this->ask(Segment<TypeParam>{{quarter, quarter, 0}, {TypeParam{0.375}, quarter, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(within, 0, quarter, quarter, Side::edge_on);
}

TYPED_TEST(QueryMeaning, segment_in_the_plane_that_touches_a_corner_or_an_edge) {
  const auto corner = this->ask(Segment<TypeParam>{{-1, 1, 0}, {1, -1, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(corner, TypeParam{0.5}, 0, 0, Side::edge_on);
  const auto along_edge = this->ask(Segment<TypeParam>{{-1, 0, 0}, {3, 0, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(along_edge, TypeParam{0.25}, 0, 0, Side::edge_on);
  const auto up_to_edge =
      this->ask(Segment<TypeParam>{{1, 1, 0}, {TypeParam{0.5}, TypeParam{0.5}, 0}}, unit_triangle<TypeParam>());
  this->expect_hit(up_to_edge, 1, TypeParam{0.5}, TypeParam{0.5}, Side::edge_on);
}

TYPED_TEST(QueryMeaning, segment_in_the_plane_that_is_disjoint_misses) {
  const TypeParam above_half = neighbour(TypeParam{0.5}, 1);
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{-1, 2, 0}, {2, 2, 0}}, unit_triangle<TypeParam>()));
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{-2, 0, 0}, {-1, 0, 0}}, unit_triangle<TypeParam>()));
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{1, 1, 0}, {above_half, TypeParam{0.5}, 0}}, unit_triangle<TypeParam>()));
  EXPECT_FALSE(
      this->ask(Segment<TypeParam>{{-1, 1, 0}, {1, neighbour(TypeParam{-1}, -1), 0}}, unit_triangle<TypeParam>()));
}

TYPED_TEST(QueryMeaning, segment_parallel_to_the_plane_beside_it_misses) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{-1, TypeParam{0.25}, tiny}, {3, TypeParam{0.25}, tiny}},
                         unit_triangle<TypeParam>()));
}

TYPED_TEST(QueryMeaning, ray_and_line_in_the_plane) {
  const TypeParam quarter{0.25};
  this->expect_hit(this->ask(Ray<TypeParam>{{-1, quarter, 0}, {4, 0, 0}}, unit_triangle<TypeParam>()), quarter, 0,
                   quarter, Side::edge_on);
  EXPECT_FALSE(this->ask(Ray<TypeParam>{{-1, quarter, 0}, {-4, 0, 0}}, unit_triangle<TypeParam>()));
  this->expect_hit(this->ask(Line<TypeParam>{{3, quarter, 0}, {2, 0, 0}}, unit_triangle<TypeParam>()), TypeParam{-1.5},
                   0, quarter, Side::edge_on);
}

TYPED_TEST(QueryMeaning, limit_in_the_plane_moves_where_the_path_enters) {
  const TypeParam quarter{0.25};
  const Segment<TypeParam> segment{{-1, quarter, 0}, {3, quarter, 0}};
  const auto answer = this->ask(segment, unit_triangle<TypeParam>(), {.min_t = TypeParam{0.375}});
  this->expect_hit(answer, TypeParam{0.375}, TypeParam{0.5}, quarter, Side::edge_on);
  EXPECT_TRUE(this->ask(segment, unit_triangle<TypeParam>(), {.max_t = quarter}));
  EXPECT_FALSE(this->ask(segment, unit_triangle<TypeParam>(), {.max_t = neighbour(quarter, -1)}));
}

// "Zero-length segment, ray or line with a zero direction: a point; t = 0 if it lies on the triangle."

TYPED_TEST(QueryMeaning, path_of_no_length_is_met_at_0_if_it_lies_on_the_triangle) {
  const TypeParam quarter{0.25};
  const Vector3<TypeParam> on{quarter, TypeParam{0.5}, 0};
  const Vector3<TypeParam> nowhere{0, 0, 0};
  for (const Path<TypeParam>& path : std::array<Path<TypeParam>, 3>{
           Segment<TypeParam>{on, on}, Ray<TypeParam>{on, nowhere}, Line<TypeParam>{on, nowhere}}) {
    this->expect_hit(this->ask(path, unit_triangle<TypeParam>()), 0, quarter, TypeParam{0.5}, Side::edge_on);
    EXPECT_FALSE(this->ask(path, unit_triangle(std::numeric_limits<TypeParam>::denorm_min())));
    EXPECT_FALSE(this->ask(path, Triangle<TypeParam>{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}));
    EXPECT_FALSE(this->ask(path, unit_triangle<TypeParam>(), {.min_t = quarter}));
    EXPECT_FALSE(this->ask(path, unit_triangle<TypeParam>(), {.max_t = -quarter}));
    EXPECT_TRUE(this->ask(path, unit_triangle<TypeParam>(), {.min_t = 0, .max_t = 0}));
  }
}

TYPED_TEST(QueryMeaning, path_of_no_length_on_an_edge_or_a_corner) {
  for (const Vector3<TypeParam>& on :
       {Vector3<TypeParam>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {TypeParam{0.5}, TypeParam{0.5}, 0}}) {
    this->expect_hit(this->ask(Segment<TypeParam>{on, on}, unit_triangle<TypeParam>()), 0, on[0], on[1], Side::edge_on);
  }
}

// "Every finite input is in the domain, denormals and the largest numbers included."

TYPED_TEST(QueryMeaning, least_and_largest_numbers_are_numbers_as_any) {
  using Limits = std::numeric_limits<TypeParam>;
  // Powers of two, and the largest that divide by four.
  for (const TypeParam size :
       {4 * Limits::denorm_min(), 4 * Limits::min(), std::ldexp(TypeParam{1}, Limits::max_exponent - 2)}) {
    const Triangle<TypeParam> triangle{{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    const TypeParam half = size / 2;
    const TypeParam quarter = size / 4;
    this->expect_hit(this->ask(Segment<TypeParam>{{quarter, half, size}, {quarter, half, -size}}, triangle),
                     TypeParam{0.5}, TypeParam{0.25}, TypeParam{0.5}, Side::front);
    this->expect_hit(this->ask(Segment<TypeParam>{{half, half, size}, {half, half, -size}}, triangle), TypeParam{0.5},
                     TypeParam{0.5}, TypeParam{0.5}, Side::front);
    EXPECT_FALSE(
        this->ask(Segment<TypeParam>{{half, neighbour(half, 1), size}, {half, neighbour(half, 1), -size}}, triangle));
  }
}

TYPED_TEST(QueryMeaning, ends_as_far_apart_as_numbers_go) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const Triangle<TypeParam> triangle{{-huge, -huge, 0}, {huge, -huge, 0}, {-huge, huge, 0}};
  const auto answer =
      this->ask(Segment<TypeParam>{{-huge / 2, -huge / 2, huge}, {-huge / 2, -huge / 2, -huge}}, triangle);
  this->expect_hit(answer, TypeParam{0.5}, TypeParam{0.25}, TypeParam{0.25}, Side::front);
  const auto in_plane = this->ask(Segment<TypeParam>{{huge, 0, 0}, {-huge, 0, 0}}, triangle);
  this->expect_hit(in_plane, TypeParam{0.5}, TypeParam{0.5}, TypeParam{0.5}, Side::edge_on);
}

TYPED_TEST(QueryMeaning, least_and_largest_numbers_in_one_pair) {
  using Limits = std::numeric_limits<TypeParam>;
  const Triangle<TypeParam> triangle{{0, 0, 0}, {Limits::max(), 0, 0}, {0, Limits::denorm_min(), 0}};
  const auto answer =
      this->ask(Segment<TypeParam>{{0, Limits::denorm_min(), Limits::max()}, {0, Limits::denorm_min(), -Limits::max()}},
                triangle);
  this->expect_hit(answer, TypeParam{0.5}, 0, 1, Side::front);
  EXPECT_FALSE(this->ask(Segment<TypeParam>{{Limits::denorm_min(), Limits::denorm_min(), 1},
                                            {Limits::denorm_min(), Limits::denorm_min(), -1}},
                         triangle));
}

// "Non-finite path or pair: a miss"

TYPED_TEST(QueryMeaning, non_finite_path_is_a_miss) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    EXPECT_FALSE(this->ask_across(bad, 0, 1, -1));
    EXPECT_FALSE(this->ask_across(0, 0, 1, bad));
    EXPECT_FALSE(this->ask(Ray<TypeParam>{{0, 0, 1}, {0, 0, bad}}, unit_triangle<TypeParam>()));
    EXPECT_FALSE(this->ask(Line<TypeParam>{{0, bad, 1}, {0, 0, 1}}, unit_triangle<TypeParam>()));
  }
}

}  // namespace
}  // namespace surehit::test::query_meaning_test
