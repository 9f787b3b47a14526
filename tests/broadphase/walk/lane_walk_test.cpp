#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collision/drawn_triangles.hpp"
#include "support/brute_force.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::lane_walk_test {
namespace {

/// Batches of paths at the limits of what can be walked in lanes: each is answered as brute force does.
template <typename Scalar>
class LaneWalk : public testing::Test {
 protected:
  template <typename AnyPath>
  void expect_found(const GeneratedMesh<Scalar>& mesh, const GridOptions& options, const std::vector<AnyPath>& paths) {
    std::vector<Hit<Scalar>> expected;
    for (const AnyPath& path : paths) {
      const auto all = brute_force_hits<Scalar>(mesh.view(), path);
      expected.push_back(all.empty() ? Hit<Scalar>{} : all.front());
      hits_ += all.empty() ? 0 : 1;
    }
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      const Collider<Scalar> collider(mesh.view(), BuildOptions{options, {}});
      SCOPED_TRACE(name_of_instruction_set(target));
      std::vector<Hit<Scalar>> first(paths.size());
      std::vector<std::uint8_t> any(paths.size());
      collider.first_hits(paths, first);
      collider.any_hits(paths, any);
      for (std::size_t i = 0; i < paths.size(); ++i) {
        SCOPED_TRACE(hex_text(Path<Scalar>(paths[i])));
        EXPECT_TRUE(same_bits(first[i], expected[i])) << hex_text(first[i]) << " and not " << hex_text(expected[i]);
        EXPECT_EQ(any[i] != 0, expected[i].triangle != no_triangle);
        const Hit<Scalar> single = collider.first_hit(paths[i]).value_or(Hit<Scalar>{});
        EXPECT_TRUE(same_bits(single, expected[i])) << hex_text(single) << " and not " << hex_text(expected[i]);
        EXPECT_EQ(collider.any_hit(paths[i]), expected[i].triangle != no_triangle);
      }
    }
  }

  /// A ramp is met in the cell before the one in which the paths hit it, and a wall between that cell's plane and the
  /// ramp in the latter alone. Both are within `room` of what is before them.
  void expect_wall_found(double room, double slope, Random& random) {
    GeneratedMesh<Scalar> mesh;
    for (const Scalar x : {Scalar{0}, Scalar{16}}) {
      const Vector3<Scalar> corner = {x, x / 16, x / 8 - 1};
      mesh.add({corner, corner, corner});
    }
    const GridOptions options{.resolution = {16, 1, 1}, .crowded = 0};
    const GridFrame frame = Grid(mesh.view(), box_of(mesh.view()), options).frame();
    ASSERT_EQ(frame.resolution(0), 16U);
    const double plane = out_of_frame(frame, 0, static_cast<double>(random.between(3, 13)));
    // Beyond the padding, below which the wall is listed before the plane too.
    const double wall = plane + 1.5 * frame.padding(0) + room * random.unit<double>();
    const double ramp = wall + room * random.unit<double>();
    const auto at = [&](double x, Scalar y) -> Vector3<Scalar> {
      const auto rounded = static_cast<Scalar>(x);
      return {rounded, y, static_cast<Scalar>(slope * (double{rounded} - ramp))};
    };
    mesh.add({at(plane - 2, 0), at(plane + 2, 0), at(plane, 1)});
    const auto x = static_cast<Scalar>(wall);
    mesh.add({{x, 0, -0.1F}, {x, 0, 0.1F}, {x, 1, 0}});
    std::vector<Segment<Scalar>> segments;
    for (std::size_t k = 0; k < 20; ++k) {
      const Scalar y = (1 + random.unit<Scalar>()) / 4;
      segments.push_back({{-1, y, 0}, {17, y, 0}});
      segments.push_back({{1, y, 0}, {Scalar(15) + random.unit<Scalar>(), y, 0}});
    }
    expect_found(mesh, options, segments);
  }

  std::size_t hits_ = 0;
};
TYPED_TEST_SUITE(LaneWalk, Scalars, ScalarNames);

constexpr GridOptions uniform{.resolution = {9, 8, 5}, .crowded = 0};
constexpr GridOptions nested{.resolution = {3, 2, 1}, .crowded = 4};

TYPED_TEST(LaneWalk, of_paths_of_every_octant) {
  Random random(89);
  const auto ground = rough_ground<TypeParam>(8, TypeParam{0.7F}, random);
  const auto mesh = with_small_copy<TypeParam>(ground, {0.3F, -0.2F, 0.1F});
  PathDrawer<TypeParam> drawer(mesh.view(), 90);
  std::vector<Segment<TypeParam>> segments;
  std::vector<Ray<TypeParam>> rays;
  for (std::size_t i = case_count(1000); i > 0; --i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    const Vector3<TypeParam> target = drawer.point_on_mesh();
    segments.push_back({start, target + (target - start)});
    rays.push_back({start, target - start});
  }
  for (const GridOptions& options : {uniform, nested}) {
    this->expect_found(mesh, options, segments);
    this->expect_found(mesh, options, rays);
  }
  EXPECT_GT(this->hits_, case_count(1000));
}

/// Where long paths alone begin with what the grid's cover leaves of them.
TYPED_TEST(LaneWalk, of_paths_past_a_mesh_that_stands_askew) {
  Random random(101);
  const auto mesh = grounds_askew<TypeParam>(random);
  PathDrawer<TypeParam> drawer(mesh.view(), 102);
  std::vector<Segment<TypeParam>> segments;
  std::vector<Line<TypeParam>> lines;
  for (std::size_t i = case_count(1000); i > 0; --i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    const Vector3<TypeParam> target = random.one_in(3) ? drawer.point_around_mesh() : drawer.point_on_mesh();
    segments.push_back({start, target});
    lines.push_back({target, start - target});
    // Through one ground and over another.
    const auto offset = Vector3<TypeParam>::NullaryExpr([&] { return random.symmetric<TypeParam>() / 4; });
    lines.push_back({target, drawer.point_on_mesh() + offset - target});
  }
  for (const GridOptions& options :
       {GridOptions{.resolution = {60, 50, 60}, .crowded = 0}, GridOptions{.resolution = {5, 6, 4}, .crowded = 4}}) {
    ASSERT_TRUE(Grid(mesh.view(), box_of(mesh.view()), options).cover().is_useful());
    this->expect_found(mesh, options, segments);
    this->expect_found(mesh, options, lines);
  }
  EXPECT_GT(this->hits_, case_count(1000));
}

/// So slow that the walk's parameter comes to what moves on one axis only.
TYPED_TEST(LaneWalk, of_slow_rays_and_lines) {
  Random random(91);
  const auto mesh = rough_ground<TypeParam>(8, TypeParam{0.5F}, random);
  PathDrawer<TypeParam> drawer(mesh.view(), 92);
  std::vector<Ray<TypeParam>> rays;
  std::vector<Line<TypeParam>> lines;
  for (std::size_t i = case_count(600); i > 0; --i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    Vector3<TypeParam> way = drawer.point_on_mesh() - start;
    for (TypeParam& rate : way) rate = std::ldexp(rate, -static_cast<int>(10 + random.below(3)));
    way = way * std::ldexp(TypeParam{1}, -static_cast<int>(random.below(90)));
    rays.push_back({start, way});
    lines.push_back({start, way});
  }
  for (const GridOptions& options : {uniform, nested}) {
    this->expect_found(mesh, options, rays);
    this->expect_found(mesh, options, lines);
  }
  EXPECT_GT(this->hits_, case_count(600) / 2);
}

/// From so far away that floats do not tell a cell from the next where they start, to triangles no larger than a cell:
/// what is placed in float passes some of them by.
TYPED_TEST(LaneWalk, of_paths_from_afar) {
  Random random(93);
  GeneratedMesh<TypeParam> mesh;
  for (const TypeParam x : {TypeParam{-1}, TypeParam{1}}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  std::vector<Segment<TypeParam>> segments;
  std::vector<Ray<TypeParam>> rays;
  for (std::size_t i = case_count(3000); i > 0; --i) {
    const Vector3<TypeParam> target = draw_vector<TypeParam>(random);
    mesh.add(draw_around<TypeParam>(random, target, TypeParam{0.004F}));
    const Vector3<TypeParam> start = target - TypeParam{0x1p16F} * draw_vector<TypeParam>(random);
    // Slow enough for a lane.
    rays.push_back({start, (target - start) / std::ldexp(TypeParam{1}, static_cast<int>(5 + random.below(20)))});
    segments.push_back({start, start + TypeParam{2} * (target - start)});
  }
  const GridOptions options{.resolution = {400, 400, 1}, .crowded = 0};
  this->expect_found(mesh, options, segments);
  this->expect_found(mesh, options, rays);
  EXPECT_GT(this->hits_, case_count(1500));
}

/// The hit on the ramp must not end the walk before the wall.
TYPED_TEST(LaneWalk, of_hits_just_behind_a_plane_between_cells) {
  Random random(95);
  for (std::size_t i = case_count(200); i > 0 && !this->HasFailure(); --i) {
    this->expect_wall_found(1.0 / 512, 0.04 * (1 + random.unit<double>()), random);
  }
  EXPECT_GT(this->hits_, case_count(200) * 30);
}

/// Where the ramp hardly rises, not even doubles know well where it is hit: all that may come before it counts.
TYPED_TEST(LaneWalk, of_hits_just_behind_a_plane_that_are_hardly_located) {
  Random random(96);
  for (std::size_t i = case_count(200); i > 0 && !this->HasFailure(); --i) {
    this->expect_wall_found(0x1p-14, std::ldexp(1 + random.unit<double>(), -static_cast<int>(30 + random.below(4))),
                            random);
  }
  EXPECT_GT(this->hits_, case_count(200) * 30);
}

/// Adds points that no path meets to the cells of a grid without levels. If most cells list triangles, a path is in all
/// of its cells at once.
template <typename Scalar>
void fill_cells(GeneratedMesh<Scalar>& mesh, const GridFrame& frame) {
  for (std::uint32_t x = 0; x < frame.resolution(0); ++x) {
    for (std::uint32_t y = 0; y < frame.resolution(1); ++y) {
      for (std::uint32_t z = x % 2; z < frame.resolution(2); z += 2) {
        const auto at = [&](std::size_t axis, std::uint32_t cell) {
          return static_cast<Scalar>(out_of_frame(frame, axis, cell + 0.5));
        };
        const Vector3<Scalar> point = {at(0, x), at(1, y), at(2, z)};
        mesh.add({point, point, point});
      }
    }
  }
}

/// Walls are at most three paddings away from a plane between cells. Short paths meet them through corners of cells.
/// There, planes of two or three axes are crossed at once, except for roundings. Other paths end beside a wall.
TYPED_TEST(LaneWalk, of_short_paths_through_corners_of_cells) {
  Random random(97);
  const GridOptions options{.resolution = {7, 6, 5}, .crowded = 0};
  GeneratedMesh<TypeParam> corners;
  for (const TypeParam x : {TypeParam{-1}, TypeParam{1}}) corners.add({{x, x, x}, {x, x, x}, {x, x, x}});
  const GridFrame frame = Grid(corners.view(), box_of(corners.view()), options).frame();
  fill_cells(corners, frame);
  for (std::size_t i = case_count(600); i > 0 && !this->HasFailure(); --i) {
    GeneratedMesh<TypeParam> mesh = corners;
    std::vector<Segment<TypeParam>> segments;
    for (std::size_t k = 0; k < 12; ++k) {
      Vector3<TypeParam> corner;
      Vector3<TypeParam> cell;  // in space
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        const auto plane = static_cast<double>(random.between(1, frame.resolution(axis) - 1));
        corner[at] = static_cast<TypeParam>(out_of_frame(frame, axis, plane));
        cell[at] = static_cast<TypeParam>(out_of_frame(frame, axis, plane + 1)) - corner[at];
      }
      const std::size_t axis = random.below(3);
      const auto at = static_cast<Eigen::Index>(axis);
      const TypeParam padding = cell[at] * static_cast<TypeParam>(frame.padding(axis));
      Triangle<TypeParam> wall = draw_around<TypeParam>(random, corner, TypeParam{0.1F});
      const TypeParam place = corner[at] + padding * random.symmetric<TypeParam>() * 3;
      wall.a[at] = wall.b[at] = wall.c[at] = place;
      mesh.add(wall);
      // As many cells on each axis, or not.
      Vector3<TypeParam> way = cell;
      for (TypeParam& component : way) component *= static_cast<TypeParam>(random.between(0, 2)) - 1;
      if (way.isZero()) way = cell;
      if (random.one_in(3)) way += cell.cwiseProduct(draw_vector<TypeParam>(random)) / 2;
      const TypeParam before = 1 + 2 * random.unit<TypeParam>();
      const TypeParam behind = 1 + 2 * random.unit<TypeParam>();
      Segment<TypeParam> segment{corner - before * way, corner + behind * way};
      if (random.one_in(3)) {  // ends beside the wall, through it
        const Vector3<TypeParam> inside = (wall.a + wall.b + wall.c) / 3;
        segment = {inside - 2 * before * way, inside};
        segment.end[at] = place + padding * random.symmetric<TypeParam>() * 2;
      }
      segments.push_back(segment);
      segments.push_back({segment.end, segment.start});
    }
    this->expect_found(mesh, options, segments);
  }
  EXPECT_GT(this->hits_, case_count(600) * 5);
}

/// The walk of a path begins where it enters the grid's cover. For this path, that is at a plane between cells, or just
/// before it if rounded differently. A walk of all its cells at once left out the cell behind that plane. (Found by a
/// fuzzer.)
TYPED_TEST(LaneWalk, of_a_path_that_enters_the_cover_at_a_plane) {
  const auto mesh = covered_from_a_plane<TypeParam>();
  const Vector3<TypeParam> start = {0x1.9f2b66p-1F, 0x1.63d34ep-4F, -0x1.dea05ap-2F};
  const Vector3<TypeParam> end = {-0x1.faa466p-3F, -0x1.acff5ap-6F, 0x1.d1ce4ap-2F};
  const GridOptions options{.resolution = {40, 40, 40}, .crowded = 0};
  this->expect_found(mesh, options, std::vector<Segment<TypeParam>>{{start, end}, {end, start}});
  EXPECT_EQ(this->hits_, 2U);
}

/// Through corners of cells by leaps of every length: see GridTraversalTest.never_turns_back.
TYPED_TEST(LaneWalk, never_turns_back) {
  Random random(7);
  const auto dust = dust_in_square<TypeParam>(4000, random);
  const GridOptions options{.resolution = {400, 400, 1}, .crowded = 0};
  const GridFrame frame = Grid(dust.view(), box_of(dust.view()), options).frame();
  std::vector<Line<TypeParam>> lines;
  for (std::size_t i = case_count(2000); i > 0; --i) {
    lines.push_back(line_through_corners<TypeParam>(frame, random));
  }
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<TypeParam> collider(dust.view(), BuildOptions{options, {}});
    QueryStatistics statistics;
    std::vector<Hit<TypeParam>> hits(lines.size());
    collider.first_hits(lines, hits, {.options = {.mask = 0}, .statistics = &statistics});
    EXPECT_LT(statistics.cells, lines.size() * 800) << name_of_instruction_set(target);
  }
}

}  // namespace
}  // namespace surehit::test::lane_walk_test
