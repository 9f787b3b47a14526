#include "surehit/explain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "collision/rational_determinants.hpp"
#include "collision/same_answers.hpp"
#include "support/case_count.hpp"
#include "support/floating_point_mode.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::explain_test {
namespace {

template <typename Scalar>
class Explain : public testing::Test {
 protected:
  static void expect_within(const FilterNumber& number, const mpq_class& exact) {
    // Sizes that are too large have an infinite bound or none.
    if (number.bound < std::numeric_limits<double>::infinity()) {
      ASSERT_TRUE(std::isfinite(number.value));
      EXPECT_LE(abs(mpq_class(number.value) - exact), mpq_class(number.bound));
    }
  }

  /// What the filter says, and what is said in the end.
  void check_candidate(const Collider<Scalar>& collider, const Path<Scalar>& path,
                       const ExplainedCandidate& candidate) {
    const bool is_left_out = candidate.outcome == PairOutcome::left_out;
    EXPECT_EQ(candidate.decided_by == DecidedBy::options, is_left_out);
    EXPECT_EQ(candidate.numbers.has_value(), candidate.filter_verdict != FilterVerdict::not_asked);
    if (candidate.filter_verdict == FilterVerdict::miss && !is_left_out) {
      EXPECT_EQ(candidate.outcome, PairOutcome::miss);
    }
    if (candidate.filter_verdict == FilterVerdict::hit) {
      EXPECT_NE(candidate.outcome, PairOutcome::miss);
    }
    decided_.insert(candidate.decided_by);
    if (!candidate.numbers || ++numbers_ % 8 != 0) return;  // Rationals take their time.
    const auto [det, height, u, v, w] = rational_determinants(path, collider.triangle(candidate.triangle));
    expect_within(candidate.numbers->det, det);
    expect_within(candidate.numbers->t_det, height);
    expect_within(candidate.numbers->u_det, u);
    expect_within(candidate.numbers->v_det, v);
    expect_within(candidate.numbers->w_det, w);
  }

  void check_cells(const Explanation<Scalar>& explanation) {
    std::size_t next = 0;
    for (const ExplainedCell& cell : explanation.cells) {
      EXPECT_LE(cell.enters, cell.leaves);
      EXPECT_FALSE(cell.box.is_empty());
      EXPECT_EQ(cell.first_candidate, next);
      if (cell.finding != CellFinding::list) {
        EXPECT_EQ(cell.candidate_count, 0u);
      }
      next += cell.candidate_count;
      findings_.insert(cell.finding);
      inner_cells_ += cell.is_inner ? 1 : 0;
    }
    if (explanation.walk != ExplainedWalk::all_triangles) {
      EXPECT_EQ(next, explanation.candidates.size());
    }
  }

  /// The hits are some of all hits, in the same order, and are those of the candidates.
  void check_hits(const Collider<Scalar>& collider, const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                  const Explanation<Scalar>& explanation) {
    std::vector<Hit<Scalar>> all;
    collider.all_hits(path, all, options);
    auto place = all.begin();
    std::set<std::uint32_t> met;
    for (const auto& [hit, t_lower, t_upper, ordered_by, is_rounded_by_integers] : explanation.hits) {
      place = std::find(place, all.end(), hit);
      ASSERT_NE(place, all.end()) << hex_text(hit);
      EXPECT_EQ(ordered_by == OrderedBy::nothing, met.empty());
      if (ordered_by == OrderedBy::triangle) {
        EXPECT_EQ(hit.t, std::prev(place)->t);
      }
      EXPECT_LE(t_lower, t_upper);
      EXPECT_LE(static_cast<Scalar>(t_lower), hit.t);
      EXPECT_GE(static_cast<Scalar>(t_upper), hit.t);
      met.insert(hit.triangle);
      orders_.insert(ordered_by);
      exact_roundings_ += is_rounded_by_integers ? 1 : 0;
    }
    std::set<std::uint32_t> candidates;
    for (const ExplainedCandidate& candidate : explanation.candidates) {
      if (candidate.outcome == PairOutcome::hit) candidates.insert(candidate.triangle);
    }
    EXPECT_EQ(met, candidates);
  }

  void check(const Collider<Scalar>& collider, const Path<Scalar>& path, const QueryOptions<Scalar>& options = {}) {
    SCOPED_TRACE(hex_text(path) + '\n' + hex_text(options));
    const Explanation<Scalar> explanation = explain(collider, path, options);
    expect_same(explanation.first_hit(), collider.first_hit(path, options));
    EXPECT_EQ(explanation.first_hit().has_value(), collider.any_hit(path, options));
    for (const ExplainedCandidate& candidate : explanation.candidates) check_candidate(collider, path, candidate);
    check_cells(explanation);
    check_hits(collider, path, options, explanation);
    walks_.insert(explanation.walk);
    hits_ += explanation.hits.empty() ? 0 : 1;
  }

  void check_mesh(const GeneratedMesh<Scalar>& mesh, const GridOptions& grid = {}) {
    std::vector<std::uint32_t> masks;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) masks.push_back(static_cast<std::uint32_t>(i % 3));
    const Collider<Scalar> collider(mesh.view(), {.grid = grid});
    const Collider<Scalar> masked(mesh.view(), {.grid = grid, .masks = masks});
    PathDrawer<Scalar> drawer(mesh.view(), 5);
    for (std::size_t i = case_count(200); i > 0; --i) {
      for (const Path<Scalar>& path :
           {drawer.draw(), drawer.draw_axis_parallel(), drawer.draw_from_afar(Scalar{1e4F})}) {
        check(collider, path);
        check(collider, path, draw_options(drawer.random(), drawer.random().template unit<Scalar>()));
        check(masked, path, {.mask = 2});
      }
    }
    EXPECT_GT(hits_, 0u);
  }

  Random random_{20260417};
  std::set<ExplainedWalk> walks_;
  std::set<CellFinding> findings_;
  std::set<DecidedBy> decided_;
  std::set<OrderedBy> orders_;
  std::size_t numbers_ = 0;
  std::size_t inner_cells_ = 0;
  std::size_t exact_roundings_ = 0;
  std::size_t hits_ = 0;
};
TYPED_TEST_SUITE(Explain, Scalars, ScalarNames);

TYPED_TEST(Explain, answers_as_queries_do_on_small_meshes) {
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    SCOPED_TRACE(name_of_small_mesh(kind));
    for (std::size_t i = case_count(40); i > 0; --i) {
      const auto mesh = draw_small_mesh<TypeParam>(kind, this->random_);
      const Collider<TypeParam> collider(mesh.view());
      for (const Path<TypeParam>& path : mesh.paths) this->check(collider, path);
    }
  }
  EXPECT_TRUE(this->walks_.contains(ExplainedWalk::one_list));
  EXPECT_TRUE(this->orders_.contains(OrderedBy::triangle));
  EXPECT_GT(this->exact_roundings_, 0u);
  for (const DecidedBy stage :
       {DecidedBy::filter, DecidedBy::coordinates, DecidedBy::doubles, DecidedBy::plane, DecidedBy::integers}) {
    EXPECT_TRUE(this->decided_.contains(stage)) << static_cast<int>(stage);
  }
}

TYPED_TEST(Explain, answers_as_queries_do_on_scattered_triangles) {
  this->check_mesh(scattered_triangles<TypeParam>(500, 0.2F, this->random_));
  EXPECT_TRUE(this->walks_.contains(ExplainedWalk::cells));
  EXPECT_TRUE(this->decided_.contains(DecidedBy::options));
  EXPECT_TRUE(this->findings_.contains(CellFinding::empty));
  EXPECT_TRUE(this->findings_.contains(CellFinding::misses_box));
}

TYPED_TEST(Explain, answers_as_queries_do_in_inner_grids) {
  const auto ground = rough_ground<TypeParam>(20, 0.1F, this->random_);
  this->check_mesh(with_small_copy(ground, {0.3F, -0.2F, 0.1F}), {.resolution = {3, 4, 2}, .crowded = 3});
  EXPECT_TRUE(this->orders_.contains(OrderedBy::bounds));
}

TYPED_TEST(Explain, answers_as_queries_do_with_slabs) {
  this->check_mesh(smooth_bowl<TypeParam>(20));
  if (std::is_same_v<TypeParam, float>) {
    EXPECT_TRUE(this->findings_.contains(CellFinding::misses_slab));
  }
}

TYPED_TEST(Explain, answers_as_queries_do_on_ties) { this->check_mesh(lattice_cube<TypeParam>(6)); }

TYPED_TEST(Explain, answers_alike_on_each_instruction_set) {
  const auto mesh = rough_ground<TypeParam>(12, 0.2F, this->random_);
  const Collider<TypeParam> collider(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 6);
  for (std::size_t i = case_count(100); i > 0; --i) {
    const Path<TypeParam> path = drawer.draw();
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      this->check(collider, path);
    }
  }
}

TYPED_TEST(Explain, answers_alike_in_any_floating_point_mode) {
  const auto mesh = rough_ground<TypeParam>(12, 0.2F, this->random_);
  const Collider<TypeParam> collider(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 7);
  const FloatingPointMode mode = {"upward and flushing", FE_UPWARD, true};
  for (std::size_t i = case_count(100); i > 0; --i) {
    const Path<TypeParam> path = drawer.draw();
    const auto expected = explain(collider, path).first_hit();
    const FloatingPointModeScope scope(mode);
    const std::uint64_t before = control_word();
    const auto answer = explain(collider, path).first_hit();
    EXPECT_EQ(control_word(), before);
    expect_same(answer, expected);
  }
}

TYPED_TEST(Explain, asks_all_triangles_for_a_path_from_very_far_away) {
  const auto mesh = rough_ground<TypeParam>(6, 0.1F, this->random_);
  const Collider<TypeParam> collider(mesh.view());
  const Line<TypeParam> line{{TypeParam(0x1p70), 0, 0}, {-1, 0, 0}};
  this->check(collider, line);
  EXPECT_EQ(explain(collider, line).walk, ExplainedWalk::all_triangles);
  EXPECT_EQ(explain(collider, line).candidates.size(), collider.triangle_count());
}

TYPED_TEST(Explain, goes_nowhere_where_there_is_nothing) {
  const Segment<TypeParam> segment{{0, 0, 1}, {0, 0, -1}};
  this->check(Collider<TypeParam>(), segment);
  EXPECT_EQ(explain(Collider<TypeParam>(), segment).walk, ExplainedWalk::nowhere);
  const auto mesh = rough_ground<TypeParam>(6, 0.1F, this->random_);
  const Collider<TypeParam> collider(mesh.view());
  this->check(collider, Segment<TypeParam>{{9, 9, 1}, {9, 9, -1}});
  this->check(collider, segment, {.min_t = 2});
  this->check(collider, Segment<TypeParam>{{0, 0, std::numeric_limits<TypeParam>::quiet_NaN()}, {0, 0, 1}});
  EXPECT_EQ(this->walks_, std::set{ExplainedWalk::nowhere});
}

/// A path along x at the given height passes the cells of a ground one after the other.
TYPED_TEST(Explain, tells_the_cells_in_the_order_of_the_path) {
  const auto mesh = rough_ground<TypeParam>(20, 0.3F, this->random_);
  const Collider<TypeParam> collider(mesh.view(), {.grid = {.resolution = {8, 8, 2}}});
  for (const TypeParam way : {TypeParam{4}, TypeParam{-4}}) {
    const Ray<TypeParam> ray{{-way / 2, TypeParam{0.3F}, TypeParam{0.29F}}, {way, 0, 0}};
    const auto explanation = explain(collider, ray);
    ASSERT_GE(explanation.cells.size(), 2u);
    double t = 0.25;
    for (const ExplainedCell& cell : explanation.cells) {
      EXPECT_NEAR(cell.enters, t, 1e-4);
      t = cell.leaves;
      const double middle = (cell.enters + cell.leaves) / 2;
      const Vector3d point = ray.origin.template cast<double>() + middle * ray.direction.template cast<double>();
      EXPECT_TRUE(cell.box.contains(point));
    }
    if (explanation.hits.empty()) {
      EXPECT_NEAR(t, 0.75, 1e-4);
    } else {
      EXPECT_GE(t, explanation.hits[0].t_lower);
      EXPECT_LE(explanation.cells.back().enters, explanation.hits[0].t_upper + 1e-4);
    }
  }
}

// One pair, and what is told of it.

const Trianglef floor_triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

Colliderf collider_of(const std::vector<Trianglef>& triangles) {
  GeneratedMesh<float> mesh;
  for (const Trianglef& triangle : triangles) mesh.add(triangle);
  return Colliderf(mesh.view());
}

ExplainedCandidate told_of(const Trianglef& triangle, const Pathf& path, const QueryOptionsf& options = {}) {
  const auto explanation = explain(collider_of({triangle}), path, options);
  EXPECT_EQ(explanation.candidates.size(), 1u);
  return explanation.candidates.at(0);
}

TEST(ExplainedCandidate, has_the_determinants_of_a_hit_that_the_filter_decides) {
  const auto told = told_of(floor_triangle, Segmentf{{1, 2, 1}, {1, 2, -1}});
  ASSERT_TRUE(told.numbers);
  EXPECT_EQ(told.numbers->det.value, 32);
  EXPECT_EQ(told.numbers->t_det.value, 16);
  EXPECT_EQ(told.numbers->u_det.value, 8);
  EXPECT_EQ(told.numbers->v_det.value, 16);
  EXPECT_EQ(told.numbers->w_det.value, 8);
  EXPECT_EQ(told.filter_verdict, FilterVerdict::hit);
  EXPECT_EQ(told.decided_by, DecidedBy::filter);
  EXPECT_EQ(told.outcome, PairOutcome::hit);
}

TEST(ExplainedCandidate, is_decided_in_double_at_an_edge_that_is_not_hit_in_float) {
  const auto told = told_of(floor_triangle, Segmentf{{1, 0x1p-24F, 1}, {1, 0x1p-24F, -1}});
  EXPECT_EQ(told.filter_verdict, FilterVerdict::undecided);
  EXPECT_EQ(told.decided_by, DecidedBy::doubles);
  EXPECT_EQ(told.outcome, PairOutcome::hit);
}

TEST(ExplainedCandidate, is_decided_by_integers_on_an_edge) {
  const auto told = told_of(floor_triangle, Segmentf{{0, 2, 2}, {2, 3, -1}});
  EXPECT_EQ(told.filter_verdict, FilterVerdict::undecided);
  EXPECT_EQ(told.decided_by, DecidedBy::integers);
  EXPECT_EQ(told.outcome, PairOutcome::hit);
}

TEST(ExplainedCandidate, is_decided_in_two_coordinates_in_a_plane_across_an_axis) {
  const auto told = told_of(floor_triangle, Segmentf{{-1, 1, 0}, {5, 1, 0}});
  EXPECT_EQ(told.decided_by, DecidedBy::plane);
  EXPECT_EQ(told.outcome, PairOutcome::hit);
}

/// The coordinates span too many binary places for compact integers.
TEST(ExplainedCandidate, is_decided_by_running_bounds_where_operations_are_exact) {
  const Trianglef triangle = {{0, 0, 0}, {0x1p50F, 0, 0}, {0, 0x1p50F, 0}};
  const auto told = told_of(triangle, Segmentf{{1, 0, 1}, {1, 0, -1}});
  EXPECT_EQ(told.filter_verdict, FilterVerdict::undecided);
  EXPECT_EQ(told.decided_by, DecidedBy::running_bounds);
  EXPECT_EQ(told.outcome, PairOutcome::hit);
}

TEST(ExplainedCandidate, is_left_out_by_options) {
  const Segmentf down = {{1, 2, 1}, {1, 2, -1}};
  EXPECT_EQ(told_of(floor_triangle, down, {.ignored_triangle = 0}).outcome, PairOutcome::left_out);
  EXPECT_EQ(told_of(floor_triangle, down, {.culling = Culling::front}).outcome, PairOutcome::contact_left_out);
  EXPECT_EQ(told_of(floor_triangle, Segmentf{{1, 2, 1}, {1, 2, 0}}, {.ignore_end_contact = true}).outcome,
            PairOutcome::contact_left_out);
}

TEST(ExplainedHit, says_why_it_is_not_earlier) {
  const Trianglef below = {{0, 0, -1}, {4, 0, -1}, {0, 4, -1}};
  const Trianglef just_below = {{0, 0, -0x1p-70F}, {4, 0, -0x1p-70F}, {0, 4, -0x1p-70F}};
  const auto explanation =
      explain(collider_of({floor_triangle, below, just_below, floor_triangle}), Segmentf{{1, 2, 1}, {1, 2, -2}});
  ASSERT_EQ(explanation.hits.size(), 4u);
  EXPECT_EQ(explanation.hits[0].hit.triangle, 0u);
  EXPECT_EQ(explanation.hits[1].hit.triangle, 3u);
  EXPECT_EQ(explanation.hits[1].ordered_by, OrderedBy::triangle);
  EXPECT_EQ(explanation.hits[2].hit.triangle, 2u);
  EXPECT_EQ(explanation.hits[2].ordered_by, OrderedBy::exact_t);
  EXPECT_EQ(explanation.hits[3].hit.triangle, 1u);
  EXPECT_EQ(explanation.hits[3].ordered_by, OrderedBy::bounds);
}

TEST(ExplainedHit, is_rounded_by_integers_half_way_between_two_floats) {
  const Trianglef triangle = {{0, 0, 0x1p-24F}, {4, 0, 0x1p-24F}, {0, 4, 0x1p-24F}};
  const auto half_way = explain(collider_of({triangle}), Segmentf{{1, 2, -1}, {1, 2, 1}});
  ASSERT_EQ(half_way.hits.size(), 1u);
  EXPECT_EQ(half_way.hits[0].hit.t, 0.5F);
  EXPECT_TRUE(half_way.hits[0].is_rounded_by_integers);
  const auto between = explain(collider_of({triangle}), Segmentf{{1, 2, -1}, {1, 2, 2}});
  ASSERT_EQ(between.hits.size(), 1u);
  EXPECT_FALSE(between.hits[0].is_rounded_by_integers);
}

}  // namespace
}  // namespace surehit::test::explain_test
