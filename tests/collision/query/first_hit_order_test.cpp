#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "collision/drawn_triangles.hpp"
#include "support/brute_force.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::first_hit_order_test {
namespace {

/// Hits that are closer to each other than the kernel can tell apart: the first one is still the one of least exact t,
/// then of least id.
template <typename Scalar>
class FirstHitOrder : public testing::Test {
 protected:
  static constexpr std::size_t paths_at_once = 19;

  static void shuffle(std::vector<Triangle<Scalar>>& triangles, Random& random) {
    for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
  }

  /// On every instruction set, one by one and in a batch, in one cell and in many.
  void expect_first(const std::vector<Triangle<Scalar>>& triangles, const std::vector<Segment<Scalar>>& segments) {
    GeneratedMesh<Scalar> mesh;
    for (const Triangle<Scalar>& triangle : triangles) mesh.add(triangle);
    std::vector<Hit<Scalar>> expected;
    for (const Segment<Scalar>& segment : segments) {
      const auto all = brute_force_hits<Scalar>(mesh.view(), segment);
      expected.push_back(all.empty() ? Hit<Scalar>{} : all.front());
      hits_ += all.empty() ? 0 : 1;
      if (all.size() > 1 && all[1].t == all[0].t) ++ties_;
    }
    for (const GridOptions& grid :
         {GridOptions{.resolution = {1, 1, 1}, .crowded = 0}, GridOptions{.resolution = {3, 4, 5}, .crowded = 8}}) {
      for (const std::int64_t target : instruction_sets()) {
        const ForcedInstructionSet forced(target);
        const Collider<Scalar> collider(mesh.view(), BuildOptions{grid, {}});
        SCOPED_TRACE(name_of_instruction_set(target));
        std::vector<Hit<Scalar>> hits(segments.size());
        collider.first_hits(segments, hits);
        for (std::size_t i = 0; i < segments.size(); ++i) {
          SCOPED_TRACE(hex_text(Path<Scalar>(segments[i])) + " through " + std::to_string(triangles.size()) +
                       " triangles in " + std::to_string(grid.resolution[0]));
          EXPECT_TRUE(same_bits(hits[i], expected[i])) << hex_text(hits[i]) << " and not " << hex_text(expected[i]);
          const Hit<Scalar> single = collider.first_hit(segments[i]).value_or(Hit<Scalar>{});
          EXPECT_TRUE(same_bits(single, expected[i])) << hex_text(single) << " and not " << hex_text(expected[i]);
        }
      }
    }
  }

  /// A path through two cells meets two floors in one plane. The first hit is that of triangle 0, alone and in a batch
  /// of more paths than it has at once.
  static void expect_lower_id(const GeneratedMesh<Scalar>& mesh) {
    const std::vector<Segment<Scalar>> segments(100, {{-1, 0, 1}, {1.5F, 0, -1}});
    const auto expected = brute_force_hits<Scalar>(mesh.view(), segments.front());
    ASSERT_EQ(expected.size(), 2U);
    ASSERT_EQ(expected.front().triangle, 0U);
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      const Collider<Scalar> collider(mesh.view(), BuildOptions{{.resolution = {2, 1, 1}, .crowded = 0}, {}});
      SCOPED_TRACE(name_of_instruction_set(target));
      const Hit<Scalar> single = collider.first_hit(segments.front()).value_or(Hit<Scalar>{});
      EXPECT_TRUE(same_bits(single, expected.front())) << hex_text(single);
      std::vector<Hit<Scalar>> hits(segments.size());
      collider.first_hits(segments, hits);
      for (const Hit<Scalar>& hit : hits) EXPECT_TRUE(same_bits(hit, expected.front())) << hex_text(hit);
    }
  }

  std::size_t hits_ = 0;
  std::size_t ties_ = 0;
};
TYPED_TEST_SUITE(FirstHitOrder, Scalars, ScalarNames);

/// All paths start at one point and all triangles lie around another one, or at a distance of some ulps.
TYPED_TEST(FirstHitOrder, of_triangles_within_the_kernels_bound) {
  Random random(81);
  for (std::size_t i = case_count(60); i > 0 && !this->HasFailure(); --i) {
    const Vector3<TypeParam> target = draw_vector<TypeParam>(random);
    const TypeParam apart = random.one_in(3) ? 0 : std::ldexp(TypeParam{1}, -static_cast<int>(10 + random.below(50)));
    std::vector<Triangle<TypeParam>> triangles(2 + random.below(90));
    for (Triangle<TypeParam>& triangle : triangles) {
      const Vector3<TypeParam> point = target + apart * draw_vector<TypeParam>(random);
      triangle = random.one_in(4) ? triangles.front() : draw_around<TypeParam>(random, point, TypeParam{1});
    }
    this->shuffle(triangles, random);
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      const Vector3<TypeParam> start = TypeParam{2} * draw_vector<TypeParam>(random);
      segments.push_back({start, start + TypeParam{2} * (target - start)});
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->hits_, case_count(60) * this->paths_at_once / 2);
  EXPECT_GT(this->ties_, case_count(60));
}

/// A path meets only two triangles, and only grazes one of them. So the kernel knows little of where it meets this one.
/// Whichever is met first, the other may still come before it. What lies between them in the list is missed.
TYPED_TEST(FirstHitOrder, of_two_of_which_one_is_grazed) {
  Random random(85);
  for (std::size_t i = case_count(300); i > 0 && !this->HasFailure(); --i) {
    const Vector3<TypeParam> target = draw_vector<TypeParam>(random);
    std::vector<Segment<TypeParam>> segments;
    std::vector<Triangle<TypeParam>> triangles;
    const Vector3<TypeParam> way = draw_vector<TypeParam>(random);
    const Vector3<TypeParam> across = way.cross(draw_vector<TypeParam>(random));
    const Vector3<TypeParam> rise = std::ldexp(TypeParam{1}, -static_cast<int>(random.below(10))) * across.cross(way);
    triangles.push_back({target + 2 * way + rise, target - way + across, target - way - across - rise});
    for (std::size_t missed = random.below(40); missed > 0; --missed) {
      const Vector3<TypeParam> beside = target + 3 * across + TypeParam{0.1F} * draw_vector<TypeParam>(random);
      triangles.push_back(draw_around<TypeParam>(random, beside, TypeParam{0.1F}));
    }
    triangles.push_back(draw_around<TypeParam>(random, target, TypeParam{1}));
    if (random.one_in(2)) std::swap(triangles.front(), triangles.back());
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      const TypeParam apart =
          std::ldexp(TypeParam{1}, -static_cast<int>(5 + random.below(std::is_same_v<TypeParam, float> ? 20 : 50)));
      const Vector3<TypeParam> start = target - 2 * way + apart * draw_vector<TypeParam>(random);
      segments.push_back({start, start + 4 * way});
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->hits_, case_count(300) * this->paths_at_once / 2);
}

/// Floors that lie on floors, and others that one corner lifts by an ulp: those tie, and these do not.
TYPED_TEST(FirstHitOrder, of_floors_some_of_which_an_ulp_tilts) {
  Random random(86);
  for (std::size_t i = case_count(60); i > 0 && !this->HasFailure(); --i) {
    const TypeParam height = 1 + random.template unit<TypeParam>();
    std::vector<Triangle<TypeParam>> triangles;
    for (std::size_t k = 0; k < 2 + random.below(40); ++k) {
      const auto reach = static_cast<TypeParam>(1 + random.below(4));
      Triangle<TypeParam> triangle{{-reach, -1, height}, {3 * reach, -1, height}, {-1, 3, height}};
      if (random.one_in(3)) {
        const TypeParam beside = std::nextafter(height, static_cast<TypeParam>(random.one_in(2) ? 9 : 0));
        (random.one_in(2) ? triangle.a : triangle.c)[2] = beside;
      }
      triangles.push_back(triangle);
    }
    // What one path meets at its corner, above the floors or below, the kernel leaves undecided.
    const Vector3<TypeParam> corner{TypeParam{0.25F}, TypeParam{0.25F},
                                    static_cast<TypeParam>(random.one_in(2) ? 3 : -1)};
    triangles.push_back({corner, corner + Vector3<TypeParam>{1, 0, 0}, corner + Vector3<TypeParam>{0, 1, 0}});
    this->shuffle(triangles, random);
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      Segment<TypeParam> segment{draw_vector<TypeParam>(random) / 4, draw_vector<TypeParam>(random) / 4};
      if (random.one_in(3)) segment = {corner, corner};
      segment.start[2] = random.one_in(2) ? -3 : 5;
      segment.end[2] = segment.start[2] > 0 ? -3 : 5;
      segments.push_back(segment);
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->ties_, case_count(60));
}

/// The list of the first cell has a triangle so large that the kernel leaves its floor undecided in the
/// precision of the mesh. In the next cell it ties with a floor of a lower id, and the kernel is certain of that one.
TYPED_TEST(FirstHitOrder, of_a_floor_that_was_decided_and_one_that_was_not) {
  constexpr bool is_float = std::is_same_v<TypeParam, float>;
  constexpr TypeParam large = is_float ? 0x1p12 : 0x1p20;
  constexpr TypeParam reach = is_float ? 1 : 0x1p18;
  const TypeParam near = TypeParam{0.05F};
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{near, -1, 0}, {3, -1, 0}, {near, 3, 0}});
  mesh.add({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}});
  mesh.add({{-large, -large, -5}, {-1, -large, -5}, {-large, large, 5}});
  mesh.add({{large, 0, -5}, {large - 1, 0, -5}, {large, 1, 5}});  // so that the path begins in the first cell
  const Segment<TypeParam> segment{{-reach, 0, 1}, {reach + TypeParam{0.5F}, 0, -1}};
  const auto expected = brute_force_hits<TypeParam>(mesh.view(), segment);
  ASSERT_EQ(expected.size(), 2U);
  ASSERT_EQ(expected.front().triangle, 0U);
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<TypeParam> collider(mesh.view(), BuildOptions{{.resolution = {2, 1, 1}, .crowded = 0}, {}});
    SCOPED_TRACE(name_of_instruction_set(target));
    QueryStatistics statistics;
    const Hit<TypeParam> hit = collider.first_hit(segment, {}, &statistics).value_or(Hit<TypeParam>{});
    EXPECT_TRUE(same_bits(hit, expected.front())) << hex_text(hit);
    EXPECT_GT(statistics.undecided, 0U);
    EXPECT_EQ(statistics.cells, 2U);
  }
}

/// In the first cell, the path meets a floor exactly at an edge, so the narrowphase decides this floor. In the next
/// cell the kernel is certain of a floor of a lower id, before it comes to the first floor again.
TYPED_TEST(FirstHitOrder, of_a_floor_that_was_met_at_an_edge) {
  const TypeParam near = TypeParam{0.05F};
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{near, -1, 0}, {3, -1, 0}, {near, 3, 0}});
  for (int i = 0; i < 40; ++i) mesh.add({{2, 2, 3}, {3, 2, 3}, {2, 3, 3}});
  for (const TypeParam x : {TypeParam{-3}, TypeParam{3}}) mesh.add({{x, 0, 0}, {x, 0, 0}, {x, 0, 0}});
  mesh.add({{-2, 2, -3}, {-2.5F, 2, 3}, {-2, 2.5F, 3}});  // So the path comes to the box of the first list.
  mesh.add({{-1, 0, 0}, {3, 0, 0}, {-1, 3, 0}});
  this->expect_lower_id(mesh);
}

/// A floor is met in the first cell, but the path hits it in the next one. There it also hits another floor, which has
/// a lower id and other u and v.
TYPED_TEST(FirstHitOrder, of_a_floor_and_one_of_a_lower_id_in_the_next_cell) {
  const TypeParam near = TypeParam{0.05F};
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{near, -1, 0}, {3, -1, 0}, {near, 3, 0}});
  mesh.add({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}});
  for (const TypeParam x : {TypeParam{-3}, TypeParam{3}}) mesh.add({{x, 0, 0}, {x, 0, 0}, {x, 0, 0}});
  this->expect_lower_id(mesh);
}

/// Planes square to an axis, one ulp or none apart, in any order of their ids: more than become jobs at once.
TYPED_TEST(FirstHitOrder, of_long_stacks_an_ulp_apart) {
  Random random(82);
  for (std::size_t i = case_count(40); i > 0 && !this->HasFailure(); --i) {
    std::vector<Triangle<TypeParam>> triangles;
    const auto axis = static_cast<Eigen::Index>(random.below(3));
    TypeParam height = 1 + random.template unit<TypeParam>();
    for (std::size_t k = 0; k < 2 + random.below(120); ++k) {
      if (random.one_in(2)) height = std::nextafter(height, TypeParam{9});
      Triangle<TypeParam> triangle{{-1, -1, -1}, {3, -1, -1}, {-1, 3, -1}};
      if (axis == 0) triangle = {{-1, -1, -1}, {-1, 3, -1}, {-1, -1, 3}};
      if (axis == 1) triangle = {{-1, -1, -1}, {3, -1, -1}, {-1, -1, 3}};
      triangle.a[axis] = triangle.b[axis] = triangle.c[axis] = height;
      triangles.push_back(triangle);
    }
    this->shuffle(triangles, random);
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      Segment<TypeParam> segment{draw_vector<TypeParam>(random) / 4, draw_vector<TypeParam>(random) / 4};
      segment.start[axis] = random.one_in(2) ? -3 : 5;
      segment.end[axis] = segment.start[axis] > 0 ? -3 : 5;
      segments.push_back(segment);
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->ties_, case_count(40));
}

/// Many certain hits tie exactly, because all planes and paths pass through one point. The lowest id wins wherever it
/// is listed.
TYPED_TEST(FirstHitOrder, of_exact_ties_across_cells) {
  Random random(83);
  for (std::size_t i = case_count(60); i > 0 && !this->HasFailure(); --i) {
    // All planes pass through the whole-numbered point p, in which certain hits of all are.
    const auto whole = [&](std::int64_t most) -> Vector3<TypeParam> {
      return Vector3<TypeParam>::NullaryExpr([&] { return static_cast<TypeParam>(random.between(-most, most)); });
    };
    const Vector3<TypeParam> p = whole(8);
    std::vector<Triangle<TypeParam>> triangles(3 + random.below(60));
    for (Triangle<TypeParam>& triangle : triangles) {
      const Vector3<TypeParam> a = whole(4);
      const Vector3<TypeParam> b = whole(4);
      triangle = random.one_in(5) ? triangles.front() : Triangle<TypeParam>{p + a, p + b, p - (a + b)};
    }
    for (std::size_t far = 0; far < 8; ++far) triangles.push_back(draw_around<TypeParam>(random, 30 * whole(1), 3));
    this->shuffle(triangles, random);
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      const Vector3<TypeParam> way = whole(16);
      segments.push_back({p - way, p + static_cast<TypeParam>(1 + random.below(4)) * way});
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->ties_, case_count(60) * this->paths_at_once / 4);
}

/// Through edges and vertices that triangles share, and beside them.
TYPED_TEST(FirstHitOrder, of_shared_edges) {
  Random random(84);
  for (std::size_t i = case_count(30); i > 0 && !this->HasFailure(); --i) {
    const auto ground = rough_ground<TypeParam>(4, TypeParam{0.5F}, random);
    std::vector<Triangle<TypeParam>> triangles;
    for (std::uint32_t id = 0; id < ground.triangles.size(); ++id) triangles.push_back(ground.view().triangle(id));
    this->shuffle(triangles, random);
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < this->paths_at_once; ++k) {
      const Triangle<TypeParam>& triangle = triangles[random.below(triangles.size())];
      const TypeParam weight = random.one_in(3) ? 0 : random.template unit<TypeParam>();
      const Vector3<TypeParam> on_edge = triangle.a + weight * (triangle.b - triangle.a);
      const Vector3<TypeParam> way = draw_vector<TypeParam>(random) + Vector3<TypeParam>{0, 0, 1};
      segments.push_back({on_edge - way, on_edge + way});
    }
    this->expect_first(triangles, segments);
  }
  EXPECT_GT(this->ties_, case_count(30));
}

}  // namespace
}  // namespace surehit::test::first_hit_order_test
