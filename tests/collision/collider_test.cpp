#include "surehit/collider.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::collider_test {
namespace {

template <typename Scalar>
class ColliderQueries : public testing::Test {
 protected:
  static constexpr Scalar quarter{0.25};

  Collider<Scalar> stack{stack_of_triangles<Scalar>(5).view()};
  Segment<Scalar> upwards = through_stack<Scalar>(-1, 9);
  Segment<Scalar> downwards = through_stack<Scalar>(9, -1);

  static std::vector<std::uint32_t> ids_of(const std::vector<Hit<Scalar>>& hits) {
    std::vector<std::uint32_t> ids;
    for (const Hit<Scalar>& hit : hits) ids.push_back(hit.triangle);
    return ids;
  }

  static std::vector<std::uint32_t> all_ids(const Collider<Scalar>& collider, const Path<Scalar>& path,
                                            const QueryOptions<Scalar>& options = {}) {
    std::vector<Hit<Scalar>> hits;
    collider.all_hits(path, hits, options);
    return ids_of(hits);
  }

  static std::uint32_t first_id(const Collider<Scalar>& collider, const Path<Scalar>& path,
                                const QueryOptions<Scalar>& options = {}) {
    return collider.first_hit(path, options).value_or(Hit<Scalar>{}).triangle;
  }
};
TYPED_TEST_SUITE(ColliderQueries, Scalars, ScalarNames);

using Ids = std::vector<std::uint32_t>;

// The order of hits.

TYPED_TEST(ColliderQueries, first_hit_is_the_one_of_least_t) {
  const auto up = this->stack.first_hit(this->upwards);
  ASSERT_TRUE(up);
  EXPECT_TRUE(same_bits(*up, Hit<TypeParam>{TypeParam(0.1), this->quarter, this->quarter, 0, Side::back}))
      << hex_text(*up);
  const auto down = this->stack.first_hit(this->downwards);
  ASSERT_TRUE(down);
  EXPECT_TRUE(same_bits(*down, Hit<TypeParam>{TypeParam{0.5}, this->quarter, this->quarter, 4, Side::front}))
      << hex_text(*down);
}

TYPED_TEST(ColliderQueries, first_hit_of_a_line_may_lie_behind_its_origin) {
  const Line<TypeParam> line{{this->quarter, this->quarter, TypeParam{2.5}}, {0, 0, 1}};
  const auto hit = this->stack.first_hit(line);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0u);
  EXPECT_EQ(hit->t, TypeParam{-2.5});
}

TYPED_TEST(ColliderQueries, among_equal_t_the_least_index_is_first) {
  GeneratedMesh<TypeParam> mesh;
  // Four triangles around the origin: every path through it meets all of them at the same t, at their corners.
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.add({{0, 1, 0}, {-1, 0, 0}, {0, 0, 0}});
  mesh.add({{-1, 0, 0}, {0, -1, 0}, {0, 0, 0}});
  mesh.add({{0, 0, 0}, {0, -1, 0}, {1, 0, 0}});
  std::vector<std::array<std::uint32_t, 3>> order = mesh.triangles;
  std::sort(order.begin(), order.end());
  do {
    mesh.triangles = order;
    const Collider<TypeParam> collider(mesh.view());
    const Segment<TypeParam> through{{1, 2, 3}, {-1, -2, -3}};
    EXPECT_EQ(this->first_id(collider, through), 0u);
    EXPECT_EQ(this->all_ids(collider, through), (Ids{0, 1, 2, 3}));
    EXPECT_EQ(this->first_id(collider, through, {.ignored_triangle = 0}), 1u);
  } while (std::next_permutation(order.begin(), order.end()));
}

TYPED_TEST(ColliderQueries, equal_rounded_t_is_no_tie) {
  // Met at t = 1/3 and at the least bit beyond: both round to the same number, but the later index is met first.
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{1, -1, -tiny}, {1, 1, -tiny}, {2, 0, 1}});
  mesh.add({{1, -1, -1}, {1, 1, -1}, {1, 0, 2}});
  const Collider<TypeParam> collider(mesh.view());
  const Segment<TypeParam> path{{0, 0, 0}, {3, 0, 0}};
  std::vector<Hit<TypeParam>> hits;
  collider.all_hits(path, hits);
  EXPECT_EQ(this->ids_of(hits), (Ids{1, 0}));
  EXPECT_EQ(hits.at(0).t, hits.at(1).t);
  EXPECT_EQ(this->first_id(collider, path), 1u);
}

TYPED_TEST(ColliderQueries, all_hits_are_sorted) {
  EXPECT_EQ(this->all_ids(this->stack, this->upwards), (Ids{0, 1, 2, 3, 4}));
  EXPECT_EQ(this->all_ids(this->stack, this->downwards), (Ids{4, 3, 2, 1, 0}));
}

TYPED_TEST(ColliderQueries, all_hits_has_every_triangle_once_though_many_cells_list_it) {
  GeneratedMesh<TypeParam> mesh = stack_of_triangles<TypeParam>(40);
  mesh.add({{-50, -50, -50}, {90, -50, -50}, {this->quarter, this->quarter, 90}});
  BuildOptions options;
  options.grid.resolution = {16, 16, 16};
  const Collider<TypeParam> collider(mesh.view(), options);
  Ids ids = this->all_ids(collider, through_stack<TypeParam>(60, -60));
  EXPECT_EQ(ids.size(), 40u + (std::count(ids.begin(), ids.end(), 40u) > 0 ? 1u : 0u));
  std::sort(ids.begin(), ids.end());
  EXPECT_TRUE(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
}

TYPED_TEST(ColliderQueries, all_hits_clears_its_vector_first) {
  std::vector<Hit<TypeParam>> hits(7);
  this->stack.all_hits(this->upwards, hits, {.max_t = TypeParam{0.25}});
  EXPECT_EQ(this->ids_of(hits), (Ids{0, 1}));
  this->stack.all_hits(Segment<TypeParam>{{9, 9, 9}, {9, 9, 10}}, hits);
  EXPECT_TRUE(hits.empty());
}

// What narrows a query.

TYPED_TEST(ColliderQueries, triangle_takes_part_if_it_shares_a_bit_with_the_mask) {
  const std::vector<std::uint32_t> masks = {1, 2, 4, 3, 0};
  const Collider<TypeParam> collider(stack_of_triangles<TypeParam>(5).view(), with_masks(masks));
  EXPECT_EQ(this->all_ids(collider, this->upwards), (Ids{0, 1, 2, 3}));
  EXPECT_EQ(this->all_ids(collider, this->upwards, {.mask = 1}), (Ids{0, 3}));
  EXPECT_EQ(this->all_ids(collider, this->upwards, {.mask = 6}), (Ids{1, 2, 3}));
  EXPECT_EQ(this->first_id(collider, this->upwards, {.mask = 4}), 2u);
  EXPECT_FALSE(collider.any_hit(this->upwards, {.mask = 8}));
  EXPECT_TRUE(collider.any_hit(this->upwards, {.mask = 4}));
}

TYPED_TEST(ColliderQueries, without_masks_every_bit_is_set) {
  EXPECT_TRUE(this->stack.any_hit(this->upwards, {.mask = 0x80000000}));
  EXPECT_FALSE(this->stack.any_hit(this->upwards, {.mask = 0}));
}

TYPED_TEST(ColliderQueries, ignored_triangle_is_never_hit) {
  EXPECT_EQ(this->first_id(this->stack, this->upwards, {.ignored_triangle = 0}), 1u);
  EXPECT_EQ(this->first_id(this->stack, this->upwards, {.ignored_triangle = 3}), 0u);
  EXPECT_EQ(this->all_ids(this->stack, this->upwards, {.ignored_triangle = 2}), (Ids{0, 1, 3, 4}));
  const auto one_alone = through_stack<TypeParam>(TypeParam{1.5}, TypeParam{2.5});
  EXPECT_TRUE(this->stack.any_hit(one_alone, {.ignored_triangle = 1}));
  EXPECT_FALSE(this->stack.any_hit(one_alone, {.ignored_triangle = 2}));
}

TYPED_TEST(ColliderQueries, ignored_start_contact_leaves_out_what_holds_the_start_alone) {
  const auto from_2 = through_stack<TypeParam>(2, 9);
  EXPECT_EQ(this->all_ids(this->stack, from_2), (Ids{2, 3, 4}));
  EXPECT_EQ(this->all_ids(this->stack, from_2, {.ignore_start_contact = true}), (Ids{3, 4}));
  EXPECT_EQ(this->first_id(this->stack, from_2, {.ignore_start_contact = true}), 3u);
  EXPECT_EQ(this->all_ids(this->stack, through_stack<TypeParam>(1, 3), {.ignore_end_contact = true}), (Ids{1, 2}));
}

// Filters.

TYPED_TEST(ColliderQueries, filter_says_which_hits_count) {
  const auto from_3 = [](const Hit<TypeParam>& hit) { return hit.triangle >= 3; };
  EXPECT_EQ(this->stack.first_hit(this->upwards, from_3)->triangle, 3u);
  EXPECT_TRUE(this->stack.any_hit(this->upwards, from_3));
  std::vector<Hit<TypeParam>> hits;
  this->stack.all_hits(this->upwards, hits, from_3);
  EXPECT_EQ(this->ids_of(hits), (Ids{3, 4}));

  const auto none = [](const Hit<TypeParam>&) { return false; };
  EXPECT_FALSE(this->stack.first_hit(this->upwards, none));
  EXPECT_FALSE(this->stack.any_hit(this->upwards, none));
  this->stack.all_hits(this->upwards, hits, none);
  EXPECT_TRUE(hits.empty());
}

TYPED_TEST(ColliderQueries, filter_is_shown_hits_as_they_are_reported) {
  std::vector<Hit<TypeParam>> expected;
  this->stack.all_hits(this->upwards, expected);
  const auto is_reported = [&](const Hit<TypeParam>& shown) {
    return std::any_of(expected.begin(), expected.end(), [&](const auto& hit) { return same_bits(hit, shown); });
  };
  std::size_t strangers = 0;
  const auto check = [&](const Hit<TypeParam>& hit) {
    if (!is_reported(hit)) ++strangers;
    return true;
  };
  static_cast<void>(this->stack.first_hit(this->upwards, check));
  static_cast<void>(this->stack.any_hit(this->upwards, check));
  std::vector<Hit<TypeParam>> hits;
  this->stack.all_hits(this->upwards, hits, check);
  EXPECT_EQ(strangers, 0u);
  ASSERT_EQ(hits.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_TRUE(same_bits(hits[i], expected[i]));
}

TYPED_TEST(ColliderQueries, filter_is_asked_after_the_options) {
  const auto reject_what_options_left_out = [](const Hit<TypeParam>& hit) {
    EXPECT_NE(hit.triangle, 0u);
    EXPECT_EQ(hit.side, Side::back);
    return true;
  };
  EXPECT_EQ(
      this->stack
          .first_hit(this->upwards, reject_what_options_left_out, {.culling = Culling::front, .ignored_triangle = 0})
          ->triangle,
      1u);
}

// Statistics.

TYPED_TEST(ColliderQueries, statistics_count_what_a_query_did) {
  QueryStatistics statistics;
  static_cast<void>(this->stack.first_hit(this->downwards, {}, &statistics));
  EXPECT_EQ(statistics.paths, 1u);
  EXPECT_GE(statistics.cells, 1u);
  EXPECT_GE(statistics.candidates, 1u);
  EXPECT_EQ(statistics.exact_decisions, 0u);
  EXPECT_EQ(statistics.unclipped, 0u);

  QueryStatistics in_plane;  // The path meets one corner alone.
  const TypeParam half{0.5F};
  static_cast<void>(this->stack.first_hit(Segment<TypeParam>{{half, -half, 2}, {1 + half, half, 2}}, {}, &in_plane));
  EXPECT_GE(in_plane.undecided, 1u);
  EXPECT_GE(in_plane.exact_decisions, 1u);
  EXPECT_EQ(in_plane.exact_roundings, 1u);
  EXPECT_LE(in_plane.exact_decisions, in_plane.undecided);
  EXPECT_LE(in_plane.undecided, in_plane.candidates);
}

TYPED_TEST(ColliderQueries, statistics_are_added_to) {
  QueryStatistics once;
  QueryStatistics thrice;
  const auto in_plane = Segment<TypeParam>{{-1, this->quarter, 2}, {1, this->quarter, 2}};
  static_cast<void>(this->stack.first_hit(in_plane, {}, &once));
  for (int i = 0; i < 3; ++i) static_cast<void>(this->stack.first_hit(in_plane, {}, &thrice));
  EXPECT_EQ(thrice.paths, 3 * once.paths);
  EXPECT_EQ(thrice.cells, 3 * once.cells);
  EXPECT_EQ(thrice.candidates, 3 * once.candidates);
  EXPECT_EQ(thrice.undecided, 3 * once.undecided);
  EXPECT_EQ(thrice.exact_decisions, 3 * once.exact_decisions);
  EXPECT_EQ(thrice.exact_roundings, 3 * once.exact_roundings);
}

TYPED_TEST(ColliderQueries, statistics_of_a_tie_count_its_exact_order) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}});
  mesh.add({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}});
  QueryStatistics statistics;
  EXPECT_EQ(Collider<TypeParam>(mesh.view()).first_hit(this->upwards, {}, &statistics)->triangle, 0u);
  EXPECT_GE(statistics.exact_orders, 1u);
}

TYPED_TEST(ColliderQueries, statistics_of_every_query_count_its_path) {
  QueryStatistics statistics;
  const auto all = [](const Hit<TypeParam>&) { return true; };
  std::vector<Hit<TypeParam>> hits;
  static_cast<void>(this->stack.first_hit(this->upwards, all, {}, &statistics));
  static_cast<void>(this->stack.any_hit(this->upwards, {}, &statistics));
  static_cast<void>(this->stack.any_hit(this->upwards, all, {}, &statistics));
  this->stack.all_hits(this->upwards, hits, {}, &statistics);
  this->stack.all_hits(this->upwards, hits, all, {}, &statistics);
  EXPECT_EQ(statistics.paths, 5u);
}

TYPED_TEST(ColliderQueries, path_outside_the_grid_walks_no_cell) {
  QueryStatistics statistics;
  EXPECT_FALSE(this->stack.any_hit(Segment<TypeParam>{{9, 9, 0}, {9, 9, 4}}, {}, &statistics));
  EXPECT_EQ(statistics.paths, 1u);
  EXPECT_EQ(statistics.cells, 0u);
  EXPECT_EQ(statistics.candidates, 0u);
}

TYPED_TEST(ColliderQueries, path_from_too_far_away_to_be_clipped_meets_every_triangle) {
  QueryStatistics statistics;
  const TypeParam far{0x1p100};
  const Line<TypeParam> line{{0, 0, far}, {0, 0, 1}};
  const Collider<TypeParam> collider(stack_of_triangles<TypeParam>(5).view(),
                                     BuildOptions{.grid = {.resolution = {1, 1, 2}}});
  EXPECT_EQ(collider.first_hit(line, {}, &statistics)->triangle, 0u);
  EXPECT_EQ(statistics.unclipped, 1u);
  EXPECT_EQ(statistics.candidates, 5u);
}

// Odd meshes and odd paths.

TYPED_TEST(ColliderQueries, non_finite_path_misses_everything) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    QueryStatistics statistics;
    const Segment<TypeParam> segment{{this->quarter, this->quarter, -1}, {this->quarter, this->quarter, bad}};
    EXPECT_FALSE(this->stack.first_hit(segment, {}, &statistics));
    EXPECT_FALSE(this->stack.any_hit(segment));
    EXPECT_TRUE(this->all_ids(this->stack, segment).empty());
    EXPECT_FALSE(this->stack.any_hit(Ray<TypeParam>{{0, bad, 0}, {0, 0, 1}}));
    EXPECT_EQ(statistics.paths, 1u);
    EXPECT_EQ(statistics.cells, 0u);
  }
}

TYPED_TEST(ColliderQueries, random_meshes_answer_as_the_oracle_does) {
  Random random(81);
  for (std::size_t round = case_count(20); round > 0; --round) {
    GeneratedMesh<TypeParam> mesh = scattered_triangles<TypeParam>(20, TypeParam{0.75}, random);
    for (int i = 0; i < 10; ++i) mesh.add(draw_pair<TypeParam>(PairFamily::small_integers, random).triangle);
    std::vector<std::uint32_t> masks(mesh.triangles.size());
    for (std::uint32_t& mask : masks) mask = static_cast<std::uint32_t>(random.below(8));
    const Collider<TypeParam> collider(mesh.view(), with_masks(masks));
    const ExactMeshOracle<TypeParam> oracle(mesh.view(), masks);
    for (int i = 0; i < 60; ++i) {
      const auto segment = draw_pair<TypeParam>(PairFamily::small_integers, random).segment;
      const Path<TypeParam> path = path_along(segment, static_cast<PathKind>(random.below(3)));
      QueryOptions<TypeParam> options = draw_options(random, random.unit<TypeParam>());
      options.mask = static_cast<std::uint32_t>(random.below(8));
      options.ignored_triangle = static_cast<std::uint32_t>(random.below(60));
      SCOPED_TRACE(hex_text(path) + hex_text(options));
      const auto expected = oracle.all_hits(path, options);
      std::vector<Hit<TypeParam>> hits;
      collider.all_hits(path, hits, options);
      ASSERT_EQ(this->ids_of(hits), this->ids_of(expected));
      for (std::size_t k = 0; k < hits.size(); ++k) ASSERT_TRUE(same_bits(hits[k], expected[k]));
      ASSERT_EQ(collider.any_hit(path, options), !expected.empty());
      const auto first = collider.first_hit(path, options);
      ASSERT_EQ(first.has_value(), !expected.empty());
      if (first) {
        ASSERT_TRUE(same_bits(*first, expected.front()));
      }
    }
  }
}

TYPED_TEST(ColliderQueries, no_grid_changes_an_answer) {
  Random random(82);
  const GeneratedMesh<TypeParam> mesh = scattered_triangles<TypeParam>(60, TypeParam{0.5}, random);
  const Collider<TypeParam> usual(mesh.view());
  for (const std::array<std::uint32_t, 3>& resolution :
       {std::array<std::uint32_t, 3>{1, 1, 1}, {64, 64, 64}, {1, 200, 3}, {0, 1, 0}}) {
    BuildOptions options;
    options.grid.resolution = resolution;
    const Collider<TypeParam> other(mesh.view(), options);
    for (std::size_t i = case_count(300); i > 0; --i) {
      const auto segment = draw_pair<TypeParam>(PairFamily::general, random).segment;
      std::vector<Hit<TypeParam>> expected;
      std::vector<Hit<TypeParam>> hits;
      usual.all_hits(segment, expected);
      other.all_hits(segment, hits);
      ASSERT_EQ(hits, expected);
      ASSERT_EQ(other.first_hit(segment), usual.first_hit(segment));
    }
  }
}

}  // namespace
}  // namespace surehit::test::collider_test
