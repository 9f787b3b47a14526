#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "grid_comparison.hpp"
#include "support/brute_force.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::inner_grid_comparison_test {
namespace {

/// Props in levels. All queries must answer as asking every triangle does, to the bit.
template <typename Scalar>
class InnerGridComparison : public testing::Test {
 protected:
  static constexpr std::size_t prop_triangles = 150;

  static std::vector<GridOptions> grids() {
    return {{.crowded = 30}, {.resolution = {2, 3, 1}, .crowded = 12}, {.resolution = {1, 1, 1}, .crowded = 20}};
  }

  GeneratedMesh<Scalar> prop(Scalar ratio, const Vector3<Scalar>& offset) {
    return placed<Scalar>(scattered_triangles<Scalar>(prop_triangles, Scalar{0.4F}, random_), 1 / ratio, offset);
  }
  GeneratedMesh<Scalar> level(Scalar size) {
    return placed<Scalar>(rough_ground<Scalar>(6, Scalar{0.3F}, random_), size, {0, 0, 0});
  }

  /// Draws a path about the prop: through it, from inside, to a vertex, along a face of its box, or from far away.
  static Path<Scalar> draw(PathDrawer<Scalar>& of_mesh, PathDrawer<Scalar>& of_prop, const Box<Scalar>& box) {
    Random& random = of_prop.random();
    const auto inside = [&] { return of_prop.point_around_mesh(); };
    switch (random.below(7)) {
      case 0:
        return of_prop.draw();
      case 1:
        return of_mesh.any_kind({inside(), of_mesh.point_around_mesh()});
      case 2:
        return of_mesh.any_kind({of_mesh.point_around_mesh(), inside()});
      case 3:
        return of_prop.draw_axis_parallel();
      case 4: {
        Segment<Scalar> along{inside(), inside()};
        const auto axis = static_cast<Eigen::Index>(random.below(3));
        along.start[axis] = along.end[axis] = random.one_in(2) ? box.low[axis] : box.high[axis];
        return of_prop.any_kind(along);
      }
      case 5: {  // From the prop to an edge of the level, or as far beyond.
        const Vector3<Scalar> start = inside();
        const Vector3<Scalar> end = of_mesh.point_on_mesh();
        return of_mesh.any_kind({start, random.one_in(2) ? end : Vector3<Scalar>(start + 2 * (end - start))});
      }
      default:
        return of_mesh.draw();
    }
  }

  void compare(const GeneratedMesh<Scalar>& level, const GeneratedMesh<Scalar>& prop, std::size_t paths) {
    const GeneratedMesh<Scalar> mesh = joined(level, prop);
    GridComparison<Scalar> comparison(mesh.view(), {}, grids());
    PathDrawer<Scalar> of_mesh(mesh.view(), 1);
    PathDrawer<Scalar> of_prop(prop.view(), 2);
    const Box<Scalar> box = box_of(prop.view());
    std::vector<Segment<Scalar>> segments;
    std::vector<Ray<Scalar>> rays;
    for (std::size_t i = 0; i < case_count(paths); ++i) {
      const Path<Scalar> path = draw(of_mesh, of_prop, box);
      const auto hits = comparison.expect_same(path);
      const Scalar t = hits.empty() ? of_mesh.random().template unit<Scalar>() : hits.front().t;
      comparison.expect_same(path, draw_options(of_mesh.random(), t));
      if (path.kind == PathKind::segment) segments.push_back({path.start, path.toward});
      rays.push_back(
          {path.start, path.kind == PathKind::segment ? Vector3<Scalar>(path.toward - path.start) : path.toward});
    }
    EXPECT_GT(comparison.hit_count(), 0U);
    for (const Collider<Scalar>& collider : comparison.colliders()) {
      expect_batch<Scalar, Segment<Scalar>>(collider, segments);
      expect_batch<Scalar, Ray<Scalar>>(collider, rays);
    }
  }

  static std::span<const GridFrame> inner_frames(const Collider<Scalar>& collider) {
    return detail::ColliderState<Scalar>::of(collider).grid.inner_frames();
  }
  /// Returns in how many of the grids the prop has an inner grid, once it is in the level.
  static int grids_with_inner_ones(const GeneratedMesh<Scalar>& level, const GeneratedMesh<Scalar>& prop) {
    const GeneratedMesh<Scalar> mesh = joined(level, prop);
    int count = 0;
    for (const GridOptions& grid : grids()) {
      count += inner_frames(Collider<Scalar>(mesh.view(), BuildOptions{.grid = grid})).empty() ? 0 : 1;
    }
    return count;
  }

  /// A single call answers as asking every triangle does.
  static void expect_as_all(const Collider<Scalar>& collider, const GeneratedMesh<Scalar>& mesh,
                            const Path<Scalar>& path) {
    const auto expected = brute_force_hits<Scalar>(mesh.view(), path);
    const Hit<Scalar> first = expected.empty() ? Hit<Scalar>{} : expected.front();
    EXPECT_TRUE(same_bits(collider.first_hit(path).value_or(Hit<Scalar>{}), first)) << hex_text(path);
    EXPECT_EQ(collider.any_hit(path), !expected.empty()) << hex_text(path);
  }

  Random random_{77};
};
TYPED_TEST_SUITE(InnerGridComparison, Scalars, ScalarNames);

TYPED_TEST(InnerGridComparison, of_props_of_all_sizes) {
  for (const double ratio : {10., 1e3, 1e6}) {
    SCOPED_TRACE(ratio);
    const auto size = static_cast<TypeParam>(ratio);
    // The bricks of a level are fine enough for a prop of a tenth.
    const int with_inner_ones = ratio > 10 ? 3 : 0;
    const Vector3<TypeParam> place(TypeParam{0.31F}, TypeParam{0.27F}, 0);
    const auto level = this->level(1);
    const auto prop = this->prop(size, place);
    EXPECT_EQ(this->grids_with_inner_ones(level, prop), with_inner_ones);
    this->compare(level, prop, 120);
    const auto large_level = this->level(size);
    const auto prop_of_one = this->prop(1, size * place);
    EXPECT_EQ(this->grids_with_inner_ones(large_level, prop_of_one), with_inner_ones);
    this->compare(large_level, prop_of_one, 120);
  }
}

TYPED_TEST(InnerGridComparison, of_a_prop_in_a_level_of_almost_any_size) {
  for (const TypeParam size : {TypeParam{1e15F}, TypeParam{1e30F}}) {
    SCOPED_TRACE(size);
    const auto level = this->level(size);
    const auto prop = this->prop(size == TypeParam{1e15F} ? size : 1, {0, 0, 0});
    EXPECT_EQ(this->grids_with_inner_ones(level, prop), 2);
    this->compare(level, prop, 200);
  }
}

/// Paths in the outer planes of an inner grid, and one float beside them. These planes are a little outside of the
/// prop.
TYPED_TEST(InnerGridComparison, of_paths_in_the_faces_of_an_inner_grid) {
  const auto prop = this->prop(1e3F, {TypeParam{0.31F}, TypeParam{0.27F}, 0});
  const auto mesh = joined(this->level(1), prop);
  const Collider<TypeParam> collider(mesh.view(), BuildOptions{.grid = {.crowded = 30}});
  ASSERT_FALSE(this->inner_frames(collider).empty());
  const GridFrame& frame = this->inner_frames(collider).front();
  PathDrawer<TypeParam> drawer(prop.view(), 1);
  Random& random = drawer.random();
  std::vector<Segment<TypeParam>> segments;
  std::vector<Ray<TypeParam>> rays;
  for (std::size_t i = 0; i < case_count(2'000); ++i) {
    Segment<TypeParam> segment{drawer.point_around_mesh(), drawer.point_around_mesh()};
    const std::size_t axis = random.below(3);
    const double cells = (random.one_in(2) ? 0 : frame.resolution(axis)) - double{frame.margin[axis]};
    const auto plane =
        static_cast<TypeParam>(std::ldexp(frame.origin[axis] + cells / frame.scale[axis], -frame.exponent));
    const auto beside = [&] {
      constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
      return random.one_in(2) ? plane : std::nextafter(plane, random.one_in(2) ? infinity : -infinity);
    };
    segment.start[static_cast<Eigen::Index>(axis)] = beside();
    if (!random.one_in(4)) segment.end[static_cast<Eigen::Index>(axis)] = beside();
    segments.push_back(segment);
    rays.push_back({segment.start, segment.end - segment.start});
    this->expect_as_all(collider, mesh, Path<TypeParam>(segment));
    this->expect_as_all(collider, mesh, Path<TypeParam>(rays.back()));
  }
  expect_batch<TypeParam, Segment<TypeParam>>(collider, segments);
  expect_batch<TypeParam, Ray<TypeParam>>(collider, rays);
}

/// A triangle of the ground lies in the prop. The cell lists it, so a path meets it before it enters the inner grid.
TYPED_TEST(InnerGridComparison, of_a_prop_in_the_ground) {
  const auto level = this->level(1);
  const auto& [a, b, c] = level.triangles[level.triangles.size() / 2];
  const auto& corners = level.vertices;
  const auto prop = this->prop(1e3F, (corners[a] + corners[b] + corners[c]) / 3);
  const auto mesh = joined(level, prop);
  const Collider<TypeParam> collider(mesh.view(), BuildOptions{.grid = {.crowded = 30}});
  ASSERT_FALSE(this->inner_frames(collider).empty());
  PathDrawer<TypeParam> drawer(prop.view(), 1);
  std::vector<Segment<TypeParam>> segments;
  for (std::size_t i = 0; i < case_count(1'000); ++i) {
    segments.push_back({drawer.point_around_mesh(), drawer.point_around_mesh()});
    this->expect_as_all(collider, mesh, Path<TypeParam>(segments.back()));
  }
  expect_batch<TypeParam, Segment<TypeParam>>(collider, segments);
}

/// Paths within a hollow prop, whose cells there are empty, meet no triangle at all.
TYPED_TEST(InnerGridComparison, of_paths_in_a_hollow_prop) {
  const Vector3<TypeParam> middle(TypeParam{0.31F}, TypeParam{0.27F}, TypeParam{0.8F});
  constexpr auto radius = TypeParam{0x1p-9F};  // Of the largest octahedron in the prop.
  const auto prop = placed<TypeParam>(bumpy_octahedron<TypeParam>(8, this->random_), radius / 8000, middle);
  const auto mesh = joined(this->level(1), prop);
  const Collider<TypeParam> collider(mesh.view());
  ASSERT_EQ(this->inner_frames(collider).size(), 1U);
  std::vector<Segment<TypeParam>> segments;
  for (std::size_t i = 0; i < case_count(1'000); ++i) {
    const auto inside = [&]() -> Vector3<TypeParam> {
      return middle + radius / 8 * Vector3<TypeParam>::NullaryExpr([&] {
                        return this->random_.template symmetric<TypeParam>();
                      });
    };
    segments.push_back({inside(), inside()});
    QueryStatistics statistics;
    EXPECT_FALSE(collider.first_hit(segments.back(), {}, &statistics));
    EXPECT_GT(statistics.cells, 0U);
    EXPECT_EQ(statistics.candidates, 0U) << hex_text(Path<TypeParam>(segments.back()));
    this->expect_as_all(collider, mesh, Path<TypeParam>(segments.back()));
    // It leaves the prop through a face.
    segments.push_back({segments.back().start, middle + TypeParam{1} * (segments.back().end - middle).normalized()});
    EXPECT_TRUE(collider.any_hit(segments.back())) << hex_text(Path<TypeParam>(segments.back()));
  }
  expect_batch<TypeParam, Segment<TypeParam>>(collider, segments);
}

TYPED_TEST(InnerGridComparison, of_a_prop_that_many_cells_share) {
  auto prop = this->prop(20, {0, 0, 0});
  for (int i = 0; i < 4; ++i) prop = joined(prop, this->prop(20, {0, 0, 0}));
  this->compare(this->level(1), prop, 120);
}

TYPED_TEST(InnerGridComparison, of_props_in_props) {
  auto prop = this->prop(1e3F, {0, 0, 0});
  for (const TypeParam ratio : {1e6F, 1e9F, 1e12F, 1e15F, 1e18F}) prop = joined(prop, this->prop(ratio, {0, 0, 0}));
  this->compare(this->level(1), prop, 200);
}

TYPED_TEST(InnerGridComparison, of_cubes_on_whole_numbers) {
  const auto level = placed<TypeParam>(lattice_cube<TypeParam>(6), 1024, {-3072, -3072, -3072});
  this->compare(level, lattice_cube<TypeParam>(5), 150);
}

/// Rays from a prop to edges of a few small triangles that are far away, in a list of the outermost grid. The kernel's
/// bounds must be those of the way, not of the prop.
TYPED_TEST(InnerGridComparison, of_far_edges_beyond_a_prop) {
  const auto few = placed<TypeParam>(scattered_triangles<TypeParam>(20, TypeParam{0.5F}, this->random_),
                                     TypeParam{0.1F}, {1000, 700, 300});
  const auto prop = this->prop(1, {2, 2, 2});
  const auto mesh = joined(few, prop);
  const Collider<TypeParam> collider(mesh.view(), BuildOptions{.grid = {.crowded = 30}});
  ASSERT_EQ(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().size(), 1U);
  PathDrawer<TypeParam> of_few(few.view(), 1);
  PathDrawer<TypeParam> of_prop(prop.view(), 2);
  std::vector<Ray<TypeParam>> rays;
  for (std::size_t i = 0; i < case_count(12'000); ++i) {
    const Vector3<TypeParam> start = of_prop.point_around_mesh();
    rays.push_back({start, of_few.point_on_mesh() - start});
    if (rays.size() < 12) continue;  // There is room for so many outer walks.
    expect_batch<TypeParam, Ray<TypeParam>>(collider, rays);
    rays.clear();
  }
}

/// Paths that begin at corners of small triangles in an inner grid, and of large ones in the list around it. Of all
/// that contain the start, the lowest id is first, in whichever order the grids come.
TYPED_TEST(InnerGridComparison, of_starts_in_triangles_of_two_grids) {
  const auto prop = this->prop(1e3F, {TypeParam{0.31F}, TypeParam{0.27F}, 0});
  GeneratedMesh<TypeParam> large;
  std::vector<Vector3<TypeParam>> starts;
  PathDrawer<TypeParam> ends(prop.view(), 1);
  const auto far_point = [&]() -> Vector3<TypeParam> {
    return Vector3<TypeParam>::NullaryExpr([&] { return 4 * this->random_.template symmetric<TypeParam>(); });
  };
  for (std::size_t i = 0; i < prop.vertices.size(); i += 40) {
    starts.push_back(prop.vertices[i]);
    large.add({starts.back(), far_point(), far_point()});
  }
  for (const GeneratedMesh<TypeParam>& mesh : {joined(large, prop), joined(prop, large)}) {
    GridComparison<TypeParam> comparison(mesh.view(), {}, TestFixture::grids());
    for (const Vector3<TypeParam>& start : starts) {
      for (int i = 0; i < 8; ++i) {
        comparison.expect_same(Segment<TypeParam>{start, i % 2 == 0 ? far_point() : ends.point_around_mesh()});
      }
    }
    for (const Collider<TypeParam>& collider : comparison.colliders()) {
      EXPECT_FALSE(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().empty());
    }
  }
}

/// On a smooth level, whose lists have slabs. The slab of a cell with a prop must hold the prop too.
TYPED_TEST(InnerGridComparison, of_smooth_props) {
  const auto level = smooth_bowl<TypeParam>(14);
  const Vector3<TypeParam> place =
      level.vertices[level.vertices.size() / 3] + Vector3<TypeParam>(0, 0, TypeParam{0.02F});
  this->compare(level, placed<TypeParam>(smooth_bowl<TypeParam>(14), TypeParam{0x1p-9F}, place), 150);
}

TYPED_TEST(InnerGridComparison, of_a_stray_triangle) {
  const auto ground = rough_ground<TypeParam>(10, TypeParam{0.3F}, this->random_);
  for (const double distance : {10., 1e3, 1e5, 1e9, 1e30}) {
    SCOPED_TRACE(distance);
    const auto far = static_cast<TypeParam>(distance);
    GeneratedMesh<TypeParam> stray;
    stray.add({{far, far, far}, {far * TypeParam{1.5F}, far, far}, {far, far * TypeParam{1.5F}, far}});
    this->compare(stray, ground, 80);
  }
}

/// Nearly all triangles are in one inner grid, wherever they lie in the box. Paths that miss the others begin there.
TYPED_TEST(InnerGridComparison, of_a_main_part_and_a_few_others) {
  constexpr bool is_float = std::is_same_v<TypeParam, float>;
  for (const double distance : {100., 1e3, 1e9, 1e30, 1e60}) {
    SCOPED_TRACE(distance);
    // The boxes around the others are of floats.
    const bool has_main_grid = distance < 1e38;
    if (is_float && !has_main_grid) continue;
    const auto far = static_cast<TypeParam>(distance);
    for (const TypeParam other_side : {TypeParam{0}, TypeParam{0.9F}, TypeParam{0.5F}}) {
      const auto ground = rough_ground<TypeParam>(20, TypeParam{0.3F}, this->random_);
      GeneratedMesh<TypeParam> few;
      few.add({{far, far, far}, {far * TypeParam{0.9F}, far, far}, {far, far * TypeParam{0.9F}, far}});
      if (other_side != 0) {
        const TypeParam to = -far * other_side;
        few.add({{to, to, to}, {to / 2, to, to}, {to, to, to / 2}});
      }
      const auto mesh = joined(ground, few);
      const Collider<TypeParam> collider(mesh.view());
      const Grid& grid = detail::ColliderState<TypeParam>::of(collider).grid;
      EXPECT_EQ(grid.inner_frames().size(), 1U);
      EXPECT_LE(grid.top().size(), 27U);
      EXPECT_EQ(is_float ? grid.main_grid().takes_floats() : grid.main_grid().exists(), has_main_grid);
      this->compare(few, ground, 100);
      // Few of the first paths come near the others, so all of them begin in the main grid.
      PathDrawer<TypeParam> of_ground(ground.view(), 3);
      PathDrawer<TypeParam> of_few(few.view(), 4);
      std::vector<Segment<TypeParam>> segments;
      std::vector<Ray<TypeParam>> rays;
      for (std::size_t i = 0; i < case_count(300); ++i) {
        const Vector3<TypeParam> start = of_ground.point_around_mesh();
        const bool is_aimed_at_few = i >= 64 && i % 3 == 0;
        const Vector3<TypeParam> end = is_aimed_at_few ? of_few.point_on_mesh() : of_ground.point_on_mesh();
        const Vector3<TypeParam> from = i % 2 == 0 ? start : Vector3<TypeParam>(start + 80 * (start - end));
        segments.push_back({from, start + TypeParam{1.01F} * (end - start)});
        rays.push_back({from, end - start});
        this->expect_as_all(collider, mesh, Path<TypeParam>(segments.back()));
      }
      expect_batch<TypeParam, Segment<TypeParam>>(collider, segments);
      expect_batch<TypeParam, Ray<TypeParam>>(collider, rays);
    }
  }
}

/// The main part is three walls that meet in a corner, and this corner lies within a padding of the box's middle, on
/// either side. A cell that ends in the middle would list a wall that is beyond it, in an inner grid of its own.
TYPED_TEST(InnerGridComparison, of_walls_in_the_middle_of_the_box) {
  constexpr TypeParam far = 1000;
  constexpr TypeParam padding = 2 * far * TypeParam{GridFrame::padding_share};
  GeneratedMesh<TypeParam> few;
  for (const TypeParam to : {-far, far}) few.add({{to, to, to}, {to * TypeParam{0.9F}, to, to}, {to, to, to / 2}});
  for (const double share : {-0.9, -0.5, 0., 0.5, 0.9, 1.5}) {
    for (const bool is_low : {false, true}) {
      SCOPED_TRACE(share);
      const auto corner = Vector3<TypeParam>::Constant(static_cast<TypeParam>(share) * padding);
      GeneratedMesh<TypeParam> walls;
      for (int axis = 0; axis < 3; ++axis) {
        const auto ground = rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_);
        const auto wall = flattened<TypeParam>(ground, axis, TypeParam{0});
        const Box<TypeParam> box = box_of(wall.view());
        walls = joined(walls, placed<TypeParam>(wall, 1, corner - (is_low ? box.low : box.high)));
      }
      const Collider<TypeParam> collider(joined(walls, few).view());
      EXPECT_EQ(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().size(), 1U);
    }
  }
}

/// It also leaves the level, far beyond, and comes back. Each step is a rebuild.
TYPED_TEST(InnerGridComparison, of_a_prop_that_moves_through_the_level) {
  const auto level = this->level(1);
  const auto prop = this->prop(1e3F, {0, 0, 0});
  Collider<TypeParam> moving(joined(level, prop).view(), BuildOptions{this->grids().front(), {}});
  const Grid& grid = detail::ColliderState<TypeParam>::of(moving).grid;
  for (const TypeParam at : {0.9F, 0.53F, 0.16F, -0.21F, -0.58F, -0.95F, -3.F, -1e6F, 1e20F, 0.4F, 0.1F}) {
    SCOPED_TRACE(at);
    const auto moved = placed<TypeParam>(prop, 1, {at, at / 3, at / 5});
    const auto mesh = joined(level, moved);
    moving.rebuild(mesh.vertices);
    EXPECT_FALSE(grid.inner_frames().empty());
    const Collider<TypeParam> fresh(mesh.view());
    PathDrawer<TypeParam> of_mesh(mesh.view(), 1);
    PathDrawer<TypeParam> of_prop(moved.view(), 2);
    const Box<TypeParam> box = box_of(moved.view());
    std::vector<Segment<TypeParam>> segments;
    std::vector<Ray<TypeParam>> rays;
    for (std::size_t i = 0; i < case_count(100); ++i) {
      const Path<TypeParam> path = this->draw(of_mesh, of_prop, box);
      this->expect_as_all(moving, mesh, path);
      EXPECT_TRUE(same_bits(moving.first_hit(path).value_or(Hit<TypeParam>{}),
                            fresh.first_hit(path).value_or(Hit<TypeParam>{})))
          << hex_text(path);
      segments.push_back({path.start, path.toward});
      rays.push_back({path.start, path.toward});
    }
    expect_batch<TypeParam, Segment<TypeParam>>(moving, segments);
    expect_batch<TypeParam, Ray<TypeParam>>(moving, rays);
  }
}

}  // namespace
}  // namespace surehit::test::inner_grid_comparison_test
