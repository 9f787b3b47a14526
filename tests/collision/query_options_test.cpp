#include "surehit/query_options.hpp"

#include <cstddef>
#include <limits>
#include <vector>

#include "query_meaning.hpp"
#include "support/neighbour.hpp"

namespace surehit::test::query_options_test {
namespace {

/// Options in each query of a pair; masks and ids are the collider's alone and have their tests there.
template <typename Scalar>
class QueryOptionsOf : public QueryMeaning<Scalar> {
 protected:
  static constexpr Scalar quarter{0.25};

  static bool meets(Scalar from, Scalar to, const QueryOptions<Scalar>& options) {
    return QueryMeaning<Scalar>::ask_across(quarter, quarter, from, to, options).has_value();
  }
};
TYPED_TEST_SUITE(QueryOptionsOf, Scalars, ScalarNames);

TYPED_TEST(QueryOptionsOf, defaults_leave_nothing_out) {
  const QueryOptions<TypeParam> options;
  EXPECT_EQ(options.min_t, -std::numeric_limits<TypeParam>::infinity());
  EXPECT_EQ(options.max_t, std::numeric_limits<TypeParam>::infinity());
  EXPECT_EQ(options.culling, Culling::none);
  EXPECT_EQ(options.mask, std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(options.ignored_triangle, no_triangle);
  EXPECT_FALSE(options.ignore_start_contact);
  EXPECT_FALSE(options.ignore_end_contact);
}

// Side and culling.

TYPED_TEST(QueryOptionsOf, side_is_where_the_path_arrives_from) {
  EXPECT_EQ(this->ask_across(0.25, 0.25, 1, -1)->side, Side::front);
  EXPECT_EQ(this->ask_across(0.25, 0.25, -1, 1)->side, Side::back);
  EXPECT_EQ(this->ask(Segment<TypeParam>{{-1, 0, 0}, {1, 0, 0}}, unit_triangle<TypeParam>())->side, Side::edge_on);
}

TYPED_TEST(QueryOptionsOf, culling_back_keeps_front_hits_alone) {
  EXPECT_TRUE(this->meets(1, -1, {.culling = Culling::back}));
  EXPECT_FALSE(this->meets(-1, 1, {.culling = Culling::back}));
}

TYPED_TEST(QueryOptionsOf, culling_front_keeps_back_hits_alone) {
  EXPECT_FALSE(this->meets(1, -1, {.culling = Culling::front}));
  EXPECT_TRUE(this->meets(-1, 1, {.culling = Culling::front}));
}

TYPED_TEST(QueryOptionsOf, edge_on_hits_are_kept_only_without_culling) {
  const Segment<TypeParam> in_plane{{-1, this->quarter, 0}, {1, this->quarter, 0}};
  const Segment<TypeParam> standing{{0, 0, 0}, {0, 0, 0}};
  for (const auto& path : {in_plane, standing}) {
    EXPECT_TRUE(this->ask(path, unit_triangle<TypeParam>()));
    EXPECT_FALSE(this->ask(path, unit_triangle<TypeParam>(), {.culling = Culling::back}));
    EXPECT_FALSE(this->ask(path, unit_triangle<TypeParam>(), {.culling = Culling::front}));
  }
}

// min_t and max_t.

TYPED_TEST(QueryOptionsOf, nan_admits_nothing) {
  const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_FALSE(this->meets(1, -1, {.min_t = nan}));
  EXPECT_FALSE(this->meets(1, -1, {.max_t = nan}));
  EXPECT_FALSE(this->meets(1, -1, {.min_t = nan, .max_t = nan}));
  const Line<TypeParam> line{{0, 0, 0}, {0, 0, 1}};
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.min_t = nan}));
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.max_t = nan}));
}

TYPED_TEST(QueryOptionsOf, limits_never_lengthen_a_segment_or_a_ray) {
  EXPECT_FALSE(this->meets(3, 1, {.max_t = 2}));
  EXPECT_FALSE(this->meets(-1, -3, {.min_t = -1}));
  const Ray<TypeParam> away{{0, 0, 1}, {0, 0, 1}};
  EXPECT_FALSE(this->ask(away, unit_triangle<TypeParam>(), {.min_t = -2}));
  EXPECT_TRUE(this->ask(Line<TypeParam>{away.origin, away.direction}, unit_triangle<TypeParam>(), {.min_t = -2}));
}

TYPED_TEST(QueryOptionsOf, limits_cut_rays_and_lines_on_either_side_of_0) {
  const Line<TypeParam> line{{0, 0, 2}, {0, 0, 1}};
  EXPECT_TRUE(this->ask(line, unit_triangle<TypeParam>(), {.min_t = -2, .max_t = -2}));
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.min_t = neighbour(TypeParam{-2}, 1)}));
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.max_t = neighbour(TypeParam{-2}, -1)}));
  const Ray<TypeParam> ray{{0, 0, -2}, {0, 0, 1}};
  EXPECT_TRUE(this->ask(ray, unit_triangle<TypeParam>(), {.min_t = 2, .max_t = 2}));
  EXPECT_FALSE(this->ask(ray, unit_triangle<TypeParam>(), {.min_t = neighbour(TypeParam{2}, 1)}));
  EXPECT_FALSE(this->ask(ray, unit_triangle<TypeParam>(), {.max_t = neighbour(TypeParam{2}, -1)}));
}

TYPED_TEST(QueryOptionsOf, limits_that_cross_or_that_only_infinity_meets_admit_nothing) {
  const TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  EXPECT_FALSE(this->meets(1, -1, {.min_t = 1, .max_t = 0}));
  const Line<TypeParam> line{{0, 0, 2}, {0, 0, 1}};
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.min_t = infinity}));
  EXPECT_FALSE(this->ask(line, unit_triangle<TypeParam>(), {.max_t = -infinity}));
}

TYPED_TEST(QueryOptionsOf, limits_of_every_size_are_exact) {
  using Limits = std::numeric_limits<TypeParam>;
  // The origin is `t` steps of one denormal, or of a large power of two, below the triangle.
  for (const TypeParam t :
       {Limits::denorm_min(), Limits::min(), TypeParam{0x1p-20}, TypeParam{0x1p20}, TypeParam{0x1p60}}) {
    const TypeParam step = t < 1 ? TypeParam{1} : std::ldexp(TypeParam{1}, -60);
    const Ray<TypeParam> ray{{0, 0, -t * step}, {0, 0, step}};
    EXPECT_TRUE(this->ask(ray, unit_triangle<TypeParam>(), {.max_t = t}));
    EXPECT_TRUE(this->ask(ray, unit_triangle<TypeParam>(), {.min_t = t}));
    EXPECT_FALSE(this->ask(ray, unit_triangle<TypeParam>(), {.max_t = neighbour(t, -1)}));
    EXPECT_FALSE(this->ask(ray, unit_triangle<TypeParam>(), {.min_t = neighbour(t, 1)}));
  }
}

// "ignore_start_contact, ignore_end_contact leave out the triangles that contain that end exactly."

TYPED_TEST(QueryOptionsOf, both_ends_count_unless_they_are_ignored) {
  EXPECT_TRUE(this->meets(0, 1, {}));
  EXPECT_TRUE(this->meets(1, 0, {}));
  EXPECT_FALSE(this->meets(0, 1, {.ignore_start_contact = true}));
  EXPECT_FALSE(this->meets(1, 0, {.ignore_end_contact = true}));
  EXPECT_TRUE(this->meets(0, 1, {.ignore_end_contact = true}));
  EXPECT_TRUE(this->meets(1, 0, {.ignore_start_contact = true}));
}

TYPED_TEST(QueryOptionsOf, ignored_contact_is_exact) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  EXPECT_TRUE(this->meets(tiny, -1, {.ignore_start_contact = true}));
  EXPECT_TRUE(this->meets(1, -tiny, {.ignore_end_contact = true}));
}

TYPED_TEST(QueryOptionsOf, ignored_contact_leaves_out_the_whole_triangle) {
  // In the plane, from an edge across the triangle: the start lies on it, so that none of it counts.
  const Segment<TypeParam> across{{0, this->quarter, 0}, {2, this->quarter, 0}};
  EXPECT_FALSE(this->ask(across, unit_triangle<TypeParam>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->ask(across, unit_triangle<TypeParam>(), {.ignore_end_contact = true}));
  const Segment<TypeParam> inside{{this->quarter, this->quarter, 0}, {TypeParam{0.5}, this->quarter, 0}};
  EXPECT_FALSE(this->ask(inside, unit_triangle<TypeParam>(), {.ignore_end_contact = true}));
}

TYPED_TEST(QueryOptionsOf, ray_has_a_start_and_no_end_and_a_line_has_neither) {
  const Ray<TypeParam> ray{{this->quarter, this->quarter, 0}, {0, 0, 1}};
  EXPECT_FALSE(this->ask(ray, unit_triangle<TypeParam>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->ask(ray, unit_triangle<TypeParam>(), {.ignore_end_contact = true}));
  const Ray<TypeParam> arriving{{this->quarter, this->quarter, 1}, {0, 0, -1}};
  EXPECT_TRUE(this->ask(arriving, unit_triangle<TypeParam>(), {.ignore_end_contact = true}));
  const Line<TypeParam> line{ray.origin, ray.direction};
  EXPECT_TRUE(this->ask(line, unit_triangle<TypeParam>(), {.ignore_start_contact = true, .ignore_end_contact = true}));
}

TYPED_TEST(QueryOptionsOf, limits_do_not_move_the_ends) {
  // Cut to begin on the triangle, and to end on it: neither is the segment's own end.
  EXPECT_TRUE(this->meets(1, -1, {.min_t = TypeParam{0.5}, .ignore_start_contact = true}));
  EXPECT_TRUE(this->meets(1, -1, {.max_t = TypeParam{0.5}, .ignore_end_contact = true}));
  // In the plane, cut away from the start that lies on the triangle.
  const Segment<TypeParam> across{{0, this->quarter, 0}, {2, this->quarter, 0}};
  EXPECT_FALSE(
      this->ask(across, unit_triangle<TypeParam>(), {.min_t = TypeParam{0.125}, .ignore_start_contact = true}));
}

TYPED_TEST(QueryOptionsOf, path_of_no_length_starts_and_ends_where_it_is) {
  const Segment<TypeParam> standing{{0, 0, 0}, {0, 0, 0}};
  EXPECT_FALSE(this->ask(standing, unit_triangle<TypeParam>(), {.ignore_start_contact = true}));
  EXPECT_FALSE(this->ask(standing, unit_triangle<TypeParam>(), {.ignore_end_contact = true}));
}

}  // namespace
}  // namespace surehit::test::query_options_test
