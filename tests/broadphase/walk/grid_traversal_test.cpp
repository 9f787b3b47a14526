#include "walk/grid_traversal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "grid_walk.hpp"
#include "support/box_sides.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_traversal_test {
namespace {

template <typename Scalar>
using GridTraversalTest = GridWalk<Scalar>;
TYPED_TEST_SUITE(GridTraversalTest, Scalars, ScalarNames);

TYPED_TEST(GridTraversalTest, empty_grid_has_no_walk) {
  const Grid grid;
  const Line<TypeParam> line = {{0, 0, 0}, {1, 0, 0}};
  const ClippedPath clipped(grid, Path<TypeParam>(line), -infinity, infinity);
  EXPECT_EQ(clipped.status, ClippedPath::Status::miss);
  EXPECT_TRUE(GridTraversal(grid, clipped).at_end());
}

TYPED_TEST(GridTraversalTest, finds_all_that_the_path_meets) { this->scan(1000); }

TYPED_TEST(GridTraversalTest, finds_all_in_divided_cells) {
  this->place_ground(1, {0, 0, 0}, this->nested());
  ASSERT_EQ(this->grid_.levels(), Grid::max_levels);
  this->scan(750);
  Random random(7);
  for (const std::uint32_t crowded : {1U, 4U}) {
    this->build(scattered_triangles<TypeParam>(150, 0.05F, random), {.resolution = {2, 3, 1}, .crowded = crowded});
    ASSERT_GT(this->grid_.levels(), 0U);
    this->scan(250);
  }
}

TYPED_TEST(GridTraversalTest, finds_all_in_meshes_of_every_size) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const GridOptions& options : {this->uniform(), this->nested()}) {
    this->place_ground(Limits::max() / 2, {0, 0, 0}, options);
    this->scan(150);
    this->place_ground(64 * Limits::denorm_min(), {0, 0, 0}, options);
    this->scan(150);
    this->place_ground(1000, {1e7F, 1e7F, -1e7F}, options);
    this->scan(150);
  }
}

TYPED_TEST(GridTraversalTest, finds_all_from_far_away) {
  for (const GridOptions& options : {this->uniform(), this->nested()}) {
    this->place_ground(1, {0, 0, 0}, options);
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    for (const TypeParam distance : {5.F, 100.F, 1e6F, 1e9F, 1e12F, 1e15F, 0x1p58F}) {
      for (std::size_t i = 0; i < case_count(100); ++i) this->expect_found(drawer.draw_from_afar(distance));
    }
  }
  EXPECT_GT(this->met_, 0U);
}

/// Where a far path is near the mesh must be worked out in more than a double.
TYPED_TEST(GridTraversalTest, finds_all_through_the_origin_from_far_away) {
  this->build(placed<TypeParam>(lattice_cube<TypeParam>(4), TypeParam{0.25}, {-0.5F, -0.5F, -0.5F}), this->uniform());
  Random random(7);
  for (const int exponent : {24, 40, 50, 58, 60}) {
    for (std::size_t i = 0; i < 40; ++i) {
      const std::size_t met_before = this->met_;
      const Segment<TypeParam> segment = far_through_origin<TypeParam>(exponent, random);
      this->expect_found(segment);
      ASSERT_GE(this->met_, met_before + 2) << hex_text(Path<TypeParam>(segment));
      this->expect_found(Ray<TypeParam>{segment.start, segment.end});
    }
  }
}

TYPED_TEST(GridTraversalTest, finds_all_along_the_axes) {
  for (const GridOptions& options : {this->uniform(), this->nested()}) {
    this->place_ground(1, {0, 0, 0}, options);
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    for (std::size_t i = 0; i < case_count(750); ++i) this->expect_found(drawer.draw_axis_parallel());
  }
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, finds_all_on_cell_planes) {
  for (const GridOptions& options :
       {GridOptions{.resolution = {8, 8, 8}}, GridOptions{.resolution = {2, 2, 2}, .crowded = 2}}) {
    this->build(lattice_cube<TypeParam>(4), options);
    const GridFrame& frame = this->grid_.frame();
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    const auto on_planes = [&] {
      Vector3<TypeParam> point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto plane = static_cast<std::uint32_t>(drawer.random().below(frame.resolution(axis) + 1));
        point[static_cast<Eigen::Index>(axis)] = static_cast<TypeParam>(out_of_frame(frame, axis, plane));
      }
      return point;
    };
    for (std::size_t i = 0; i < case_count(500); ++i) this->expect_found(drawer.any_kind({on_planes(), on_planes()}));
  }
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, finds_all_with_directions_of_every_size) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  using Limits = std::numeric_limits<TypeParam>;
  for (std::size_t i = 0; i < case_count(250); ++i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    const Vector3<TypeParam> direction = drawer.point_on_mesh() - start;
    for (const TypeParam size : {Limits::max() / 4, TypeParam{1}, Limits::min(), 256 * Limits::denorm_min()}) {
      this->expect_found(Ray<TypeParam>{start, direction * size});
      this->expect_found(Line<TypeParam>{start, direction * size});
    }
  }
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, point_has_one_cell_inside_and_none_outside) {
  for (const Path<TypeParam>& path : {Path<TypeParam>(Segment<TypeParam>{{0, 0, 0.3F}, {0, 0, 0.3F}}),
                                      Path<TypeParam>(Ray<TypeParam>{{0, 0, 0.3F}, {0, 0, 0}}),
                                      Path<TypeParam>(Line<TypeParam>{{0, 0, 0.3F}, {0, 0, 0}})}) {
    EXPECT_EQ(this->walk(path, Range(path)).visited.size(), 1U);
    Path<TypeParam> far = path;
    far.start[0] = 1e9F;
    if (far.has_end()) far.toward[0] = 1e9F;
    EXPECT_TRUE(this->walk(far, Range(far)).visited.empty());
  }
}

/// Paths that run along one of its planes, as near as a Scalar comes, through cells that are narrow for its roundings.
TYPED_TEST(GridTraversalTest, meets_a_slab_that_the_path_touches) {
  Random random(113);
  // All boxes of lists are as large as their cells.
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}});
  mesh.add({{0, 0, 0}, {1, 1, 1}, {0, 1, 1}});
  const Grid grid(mesh.view(), box_of(mesh.view()), {.resolution = {2048, 1, 1}, .crowded = 0});
  const GridFrame& frame = grid.frame();
  ASSERT_EQ(frame.resolution(0), 2048U);
  std::size_t met = 0;
  std::size_t missed = 0;
  for (std::size_t i = case_count(3000); i > 0; --i) {
    const std::uint32_t column = 100 + static_cast<std::uint32_t>(random.below(1900));
    std::array<std::int32_t, 3> normal = {15, 0, 0};
    for (std::size_t axis = 1; axis < 3; ++axis) normal[axis] = static_cast<std::int32_t>(random.between(-15, 15));
    if (random.one_in(2)) normal[0] = -15;
    const auto place = static_cast<std::int32_t>(random.between(-50, 50));
    const auto width = static_cast<std::int32_t>(random.between(1, 9));
    const CellSlab slab = random.one_in(2) ? CellSlab::between(normal, place, place + width - 1)
                                           : CellSlab::between(normal, place - width, place - 1);
    const double off = random.symmetric<double>() * frame.padding(0) / 4;
    const auto point = [&]() -> Vector3<TypeParam> {
      const double y = random.unit<double>();
      const double z = random.unit<double>();
      const double height = place * double{CellSlab::step} - normal[1] * (y - 0.5) - normal[2] * (z - 0.5);
      const double x = column + 0.5 + height / normal[0] + off;
      return {static_cast<TypeParam>(out_of_frame(frame, 0, x)), static_cast<TypeParam>(out_of_frame(frame, 1, y)),
              static_cast<TypeParam>(out_of_frame(frame, 2, z))};
    };
    const Path<TypeParam> path = Segment<TypeParam>{point(), point()};
    const ClippedPath clipped(grid, path, 0, 1);
    for (GridTraversal walk(grid, clipped); !walk.at_end(); walk.advance()) {
      const auto low = static_cast<std::uint32_t>(walk.low()[0]);
      if (((clipped.octant & 1) != 0 ? 2047 - low : low) != column) continue;
      ASSERT_TRUE(walk.meets_box());
      const LeafCell leaf{{column, 0, 0}, 1, walk.word()};
      if (meets_part_in_slab(frame, path, 0, 1, leaf.box(), leaf.placed(slab))) {
        EXPECT_TRUE(walk.meets(slab)) << hex_text(path);
        ++met;
      } else {
        ++missed;
      }
    }
  }
  EXPECT_GT(met, case_count(300));
  EXPECT_GT(missed, case_count(300));
}

/// Through corners of cells by steps and by leaps of every length, which are short in divided cells. A leap on one axis
/// may land where another plane is crossed at the same rounded tau. If the rounded position lies before that plane, the
/// next leap stays where it is.
TYPED_TEST(GridTraversalTest, never_turns_back) {
  Random random(7);
  const auto dust = dust_in_square<TypeParam>(4000, random);
  for (const GridOptions& options :
       {GridOptions{.resolution = {400, 400, 1}, .crowded = 0}, GridOptions{.resolution = {25, 25, 1}, .crowded = 1}}) {
    const Grid grid(dust.view(), box_of(dust.view()), options);
    ASSERT_EQ(grid.frame().resolution(0), 400U);
    for (std::size_t i = 0; i < case_count(1000); ++i) {
      const auto line = line_through_corners<TypeParam>(grid.frame(), random);
      const ClippedPath clipped(grid, Path<TypeParam>(line), -infinity, infinity);
      std::array<std::int32_t, 3> before = {0, 0, 0};
      std::size_t cells = 0;
      for (GridTraversal walk(grid, clipped); !walk.at_end(); walk.advance(), ++cells) {
        const auto low = walk.low();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_GT(low[axis] + walk.size(), before[axis]) << hex_text(Path<TypeParam>(line));
        }
        ASSERT_LT(cells, 2000U) << hex_text(Path<TypeParam>(line));
        before = low;
      }
    }
  }
}

/// A step that enters a divided cell where the rounded position lies beyond it, or before it.
TYPED_TEST(GridTraversalTest, enters_divided_cells_through_their_corners) {
  Random random(7);
  this->build(dust_in_square<TypeParam>(4000, random), {.resolution = {25, 25, 1}, .crowded = 1});
  ASSERT_EQ(this->grid_.levels(), Grid::max_levels);
  // These are four of 20,000 lines in float. A position on them is rounded beyond the cell that they enter.
  std::vector<Line<TypeParam>> lines = {{{0x1.3ae0e6p-2F, 0x1.a6663ap-2F, 0}, {4, -4, 0}},
                                        {{0x1.479eb8p-6F, 0x1.451edap-1F, 0}, {4, 3, 0}},
                                        {{0x1.828f1ep-2F, 0x1.147a6cp-2F, 0}, {3, -4, 0}},
                                        {{0x1.d0a44p-1F, 0x1.c2883ep-5F, 0}, {1, 2, 0}}};
  for (std::size_t i = 0; i < case_count(300); ++i) {
    lines.push_back(line_through_corners<TypeParam>(this->grid_.frame(), random));
  }
  for (const Path<TypeParam> line : lines) {
    SCOPED_TRACE(hex_text(line));
    EXPECT_FALSE(this->walk(line, Range(line)).visited.empty());
  }
}

TYPED_TEST(GridTraversalTest, walks_through_every_cell_of_a_row) {
  GeneratedMesh<TypeParam> everywhere;
  for (std::uint32_t i = 0; i <= 100; ++i) {
    for (std::uint32_t j = 0; j <= 100; ++j) {
      const auto y = static_cast<TypeParam>(i) / 50 - 1;
      const auto z = static_cast<TypeParam>(j) / 50 - 1;
      everywhere.add({{-1, y, z}, {1, y, z}, {1, y, z}});
    }
  }
  this->build(std::move(everywhere), this->uniform());
  for (const LeafCell& leaf : *this->leaves_) ASSERT_FALSE(leaf.word.is_empty());
  for (const TypeParam end : {2.F, -2.F}) {
    const Segment<TypeParam> along_x = {{-end, 0.01F, 0.3F}, {end, 0.01F, 0.3F}};
    const Segment<TypeParam> along_y = {{0.01F, -end, 0.01F}, {0.01F, end, 0.01F}};
    const Segment<TypeParam> along_z = {{0.01F, 0.01F, -end}, {0.01F, 0.01F, end}};
    EXPECT_EQ(this->walk(along_x, Range{Path<TypeParam>(along_x)}).visited.size(), 9U);
    EXPECT_EQ(this->walk(along_y, Range{Path<TypeParam>(along_y)}).visited.size(), 8U);
    EXPECT_EQ(this->walk(along_z, Range{Path<TypeParam>(along_z)}).visited.size(), 5U);
  }
}

/// On cell planes, and where the grid has no width, triangles touch the sides of their cells' boxes.
TYPED_TEST(GridTraversalTest, finds_all_in_flat_meshes) {
  Random random(7);
  for (const int axis : {0, 1, 2}) {
    for (const std::uint32_t crowded : {0U, 3U}) {
      this->build(flattened<TypeParam>(scattered_triangles<TypeParam>(80, 0.2F, random), axis, 3),
                  {.resolution = {4, 3, 5}, .crowded = crowded});
      this->scan(100);
      PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
      for (std::size_t i = 0; i < case_count(50); ++i) {
        this->expect_found(drawer.draw_axis_parallel());
        this->expect_found(drawer.draw_from_afar(TypeParam{1e6F}));
      }
    }
  }
}

/// Too slow on one axis or two to cross a plane there, or just not.
TYPED_TEST(GridTraversalTest, finds_all_where_the_path_hardly_moves) {
  for (const GridOptions& options : {this->uniform(), this->nested()}) {
    this->place_ground(1, {0, 0, 0}, options);
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    Random& random = drawer.random();
    for (std::size_t i = 0; i < case_count(200); ++i) {
      const Vector3<TypeParam> through = drawer.point_on_mesh();
      Vector3<TypeParam> direction = drawer.point_on_mesh() - through;
      const std::size_t kept = random.below(3);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis == kept && random.one_in(2)) continue;
        TypeParam& rate = direction[static_cast<Eigen::Index>(axis)];
        rate = std::ldexp(rate, -static_cast<int>(random.below(100)));
      }
      this->expect_found(Ray<TypeParam>{through - direction / 2, direction});
      this->expect_found(Line<TypeParam>{through - direction / 4, direction});
      this->expect_found(Segment<TypeParam>{through - direction / 2, through + direction});
    }
  }
  EXPECT_GT(this->met_, 0U);
}

/// Aimed at corners, paths touch the boxes of their lists just there.
TYPED_TEST(GridTraversalTest, finds_all_on_the_sides_of_boxes) {
  Random random(7);
  for (const GridOptions& options : {GridOptions{.resolution = {9, 7, 11}, .crowded = 0},
                                     GridOptions{.resolution = {150, 130, 170}, .crowded = 0}}) {
    this->build(triangles_on_box_sides<TypeParam>(100, options, random), options);
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    for (std::size_t i = 0; i < case_count(200); ++i) {
      this->expect_found(drawer.draw_axis_parallel());
      const Vector3<TypeParam>& corner = this->mesh_.vertices[random.below(this->mesh_.vertices.size())];
      const Vector3<TypeParam> start = drawer.point_around_mesh();
      this->expect_found(Segment<TypeParam>{start, corner});
      this->expect_found(Ray<TypeParam>{corner, start - corner});
    }
  }
  EXPECT_GT(this->met_, 0U);
}

/// Triangles in the far corner of each cell leave most of it to paths that pass them by.
TYPED_TEST(GridTraversalTest, passes_by_lists_that_take_up_little_of_their_cells) {
  GeneratedMesh<TypeParam> mesh;
  for (const TypeParam x : {TypeParam{0}, TypeParam{8}}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  Random random(7);
  for (int i = 0; i < 60; ++i) {
    Vector3<TypeParam> corner;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      corner[axis] = static_cast<TypeParam>(random.below(8)) + TypeParam{0.25} + random.unit<TypeParam>() / 2;
    }
    const auto near = [&] {
      return Vector3<TypeParam>(corner + Vector3<TypeParam>::NullaryExpr([&] { return random.unit<TypeParam>() / 4; }));
    };
    mesh.add({near(), near(), near()});
  }
  for (const GridOptions& options :
       {GridOptions{.resolution = {8, 8, 8}}, GridOptions{.resolution = {2, 2, 2}, .crowded = 1}}) {
    this->build(mesh, options);
    const auto anywhere = [&]() -> Vector3<TypeParam> {
      return Vector3<TypeParam>::NullaryExpr([&] { return 8 * random.unit<TypeParam>(); });
    };
    std::size_t lists = 0;
    std::size_t met = 0;
    for (std::size_t i = 0; i < 500; ++i) {
      const Path<TypeParam> path = Segment<TypeParam>{anywhere(), anywhere()};
      const Walk walk = this->walk(path, Range(path));
      this->expect_listed(path, Range(path), walk);
      met += walk.met.size();
      lists += static_cast<std::size_t>(std::ranges::count_if(
          walk.visited, [&](std::size_t leaf) { return !(*this->leaves_)[leaf].word.is_empty(); }));
    }
    EXPECT_GT(met, 0U);
    EXPECT_LT(met, lists / 2);
  }
}

TYPED_TEST(GridTraversalTest, leaps_through_empty_space) {
  GeneratedMesh<TypeParam> mesh;
  for (const TypeParam x : {TypeParam{0}, TypeParam{1}}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  this->build(std::move(mesh), {.resolution = {60, 60, 60}});
  for (const Segment<TypeParam>& segment : {Segment<TypeParam>{{0.5F, 0, 0.01F}, {0.52F, 1, 0.99F}},
                                            Segment<TypeParam>{{0.5F, 0.9F, 0.01F}, {0.1F, 0.9F, 0.99F}}}) {
    const Path<TypeParam> path = segment;
    const auto visited = this->walk(path, Range(path)).visited;
    EXPECT_LE(visited.size(), 20U) << "60 cells or more, and up to 15 at once";
  }
}

/// Among few triangles, where some segments end just where the space around their start does.
TYPED_TEST(GridTraversalTest, stays_in_empty_space_only_where_there_is_nothing) {
  Random random(7);
  for (const GridOptions& options :
       {GridOptions{.resolution = {10, 10, 10}, .crowded = 0}, GridOptions{.resolution = {10, 10, 10}, .crowded = 1}}) {
    this->build(scattered_triangles<TypeParam>(200, 0.02F, random), options);
    EXPECT_EQ(this->grid_.levels() > 0, options.crowded != 0);
    const auto anywhere = [&] {
      return Vector3<TypeParam>(random.symmetric<TypeParam>(), random.symmetric<TypeParam>(),
                                random.symmetric<TypeParam>());
    };
    for (std::size_t i = 0; i < case_count(1500); ++i) {
      const Vector3<TypeParam> start = anywhere();
      const Triangle<TypeParam> triangle = this->mesh_.view().triangle(random.below(this->mesh_.triangles.size()));
      const bool is_aimed = random.one_in(2);
      const Vector3<TypeParam> toward = is_aimed ? triangle.a : Vector3<TypeParam>(start + anywhere() / 2);
      this->expect_found(Segment<TypeParam>{start, toward});
      this->expect_found(Ray<TypeParam>{start, toward - start});
    }
  }
  EXPECT_GT(this->stayed_, case_count(1500) / 10);
  EXPECT_GT(this->met_, case_count(1500) / 2);
}

TYPED_TEST(GridTraversalTest, is_unclipped_only_where_it_cannot_be_placed) {
  const auto at = [&](TypeParam distance) {
    const Segment<TypeParam> segment = {{distance, 0, 0.3F}, {-distance, 0, 0.3F}};
    return ClippedPath(this->grid_, Path<TypeParam>(segment), 0, 1);
  };
  using Status = ClippedPath::Status;
  EXPECT_EQ(at(0x1p59F).status, Status::clipped);
  EXPECT_EQ(at(0x1p63F).status, Status::too_far);
  EXPECT_EQ(at(std::numeric_limits<TypeParam>::max()).status, Status::too_far);
  const ClippedPath unclipped = at(0x1p63F);
  EXPECT_TRUE(GridTraversal(this->grid_, unclipped).at_end());
}

TYPED_TEST(GridTraversalTest, is_outside_where_it_ends_before_the_grid_or_begins_behind_it) {
  using Status = ClippedPath::Status;
  const double low = this->grid_.frame().low[0];
  const double width = this->grid_.frame().high[0] - low;
  const auto along_x = [&](double from, double to, double first = 0, double last = 1) {
    const auto at = [&](double share) { return Vector3<TypeParam>(TypeParam(low + share * width), 0, 0.3F); };
    return ClippedPath(this->grid_, Path<TypeParam>(Segment<TypeParam>{at(from), at(to)}), first, last).status;
  };
  EXPECT_EQ(along_x(-0.75, -0.25), Status::miss);
  EXPECT_EQ(along_x(-0.75, 0.25), Status::clipped);
  EXPECT_EQ(along_x(-0.75, 0.25, 0, 0.5), Status::miss);
  EXPECT_EQ(along_x(-0.75, 0.25, 0.5, 1), Status::clipped);
  EXPECT_EQ(along_x(0.75, 1.25), Status::clipped);
  EXPECT_EQ(along_x(0.75, 1.25, 0.75, 1), Status::miss);
  EXPECT_EQ(along_x(-0.25, 1.75, 0.9, 1), Status::miss);
  EXPECT_EQ(along_x(1.25, 1.75), Status::miss);
  EXPECT_EQ(along_x(1.25, 0.75), Status::clipped);
}

TYPED_TEST(GridTraversalTest, starts_near_and_ends_anywhere) {
  constexpr TypeParam largest = std::numeric_limits<TypeParam>::max();
  for (const TypeParam far : {TypeParam{0x1p63F}, largest / 4, largest}) {
    this->expect_found(Segment<TypeParam>{{0, 0, 1}, {far / 3, far / 5, -far}});
    this->expect_found(Segment<TypeParam>{{0.1F, 0, 1}, {0.1F, 0, -far}});
  }
  EXPECT_GE(this->met_, 6U);
}

}  // namespace
}  // namespace surehit::test::grid_traversal_test
