#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "grid_comparison.hpp"
#include "support/case_count.hpp"
#include "support/floating_point_mode.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"

namespace surehit::test::brute_force_comparison_test {
namespace {

template <typename Scalar>
class BruteForceComparison : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  static Scalar magnitude(float of_float, double of_double) {
    return std::is_same_v<Scalar, float> ? static_cast<Scalar>(of_float) : static_cast<Scalar>(of_double);
  }

  /// Paths around the mesh, on its features and far away, some under hard options.
  static void compare(const GeneratedMesh<Scalar>& mesh, std::size_t paths, std::uint64_t seed = 1) {
    GridComparison<Scalar> comparison(mesh.view());
    PathDrawer<Scalar> drawer(mesh.view(), seed);
    for (std::size_t i = 0; i < case_count(paths); ++i) {
      const Path<Scalar> path = drawer.draw();
      const auto hits = comparison.expect_same(path);
      const Scalar t = hits.empty() ? drawer.random().template unit<Scalar>() : hits.front().t;
      comparison.expect_same(path, draw_options(drawer.random(), t));
    }
    EXPECT_GT(comparison.hit_count(), 0U);
  }

  static GeneratedMesh<Scalar> single(const Triangle<Scalar>& triangle) {
    GeneratedMesh<Scalar> mesh;
    mesh.add(triangle);
    return mesh;
  }

  Random random_{20240229};
};

TYPED_TEST_SUITE(BruteForceComparison, Scalars, ScalarNames);

/// An axis of little width and many cells, along which a path is far away in cells though near in space: it drifts
/// across the others at a rate that is next to nothing, for a long time.
TYPED_TEST(BruteForceComparison, drift_across_a_thin_mesh_of_many_cells) {
  const auto mesh = this->single({{0, 0, 0}, {1, 0, TypeParam(0x1p-19)}, {0, 1, TypeParam(0x1p-19)}});
  GridComparison<TypeParam> comparison(mesh.view(), {},
                                       {{.resolution = {1, 1, 2048}}, {}, {.resolution = {7, 1, 300}}});
  for (const TypeParam start : {TypeParam(-0.001F), TypeParam(-0.002F), TypeParam(0.3F)}) {
    for (const TypeParam rate : {TypeParam(0x1.8p-61), TypeParam(0x1.8p-63), TypeParam(0x1.8p-67)}) {
      for (const TypeParam height : {TypeParam(7), TypeParam(1.5F), TypeParam(0x1p-10)}) {
        const Vector3<TypeParam> from(start, TypeParam(0.3F), height);
        const Vector3<TypeParam> along(rate, 0, TypeParam(-0x1p-49));
        comparison.expect_same(Ray<TypeParam>{from, along});
        comparison.expect_same(Line<TypeParam>{from, along});
      }
    }
  }
  EXPECT_GE(comparison.hit_count(), 20U);
}

TYPED_TEST(BruteForceComparison, empty_mesh) {
  GridComparison<TypeParam> comparison(TriangleMeshView<TypeParam>{});
  comparison.expect_same(Line<TypeParam>{{0, 0, 0}, {1, 1, 1}});
  comparison.expect_same(Segment<TypeParam>{{0, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(comparison.hit_count(), 0U);
  EXPECT_EQ(comparison.statistics().cells, 0U);
}

TYPED_TEST(BruteForceComparison, single_triangle) {
  this->compare(this->single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 250);
  this->compare(this->single({{-3, 1, 2}, {4, -2, 7}, {1, 9, -5}}), 250);
}

TYPED_TEST(BruteForceComparison, scattered_triangles) {
  this->compare(scattered_triangles<TypeParam>(1000, TypeParam{0.2F}, this->random_), 250);
}

TYPED_TEST(BruteForceComparison, rough_ground) {
  this->compare(rough_ground<TypeParam>(24, TypeParam{0.1F}, this->random_), 250);
}

TYPED_TEST(BruteForceComparison, smooth_surface) {
  const auto bowl = smooth_bowl<TypeParam>(24);
  this->compare(bowl, 250);
  this->compare(placed<TypeParam>(bowl, TypeParam{100}, {1e5, -1e5, 1e5}), 100);
}

TYPED_TEST(BruteForceComparison, spots_crowded_with_small_triangles) {
  const auto ground = rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_);
  const auto uneven = with_small_copy(ground, {TypeParam{0.3F}, TypeParam{-0.2F}, TypeParam{0.1F}});
  EXPECT_EQ(Collider<TypeParam>(uneven.view(), BuildOptions{compared_grids().back(), {}}).grid_summary().levels,
            Grid::max_levels);
  this->compare(uneven, 250);
}

/// So few triangles are asked without a walk, and a path that misses their box asks none.
TYPED_TEST(BruteForceComparison, a_few_triangles) {
  for (const std::size_t count : {1U, 12U, 32U}) {
    const auto mesh = scattered_triangles<TypeParam>(count, TypeParam{0.4F}, this->random_);
    const std::vector<GridOptions> grids = {{}};
    GridComparison<TypeParam> comparison(mesh.view(), {}, grids);
    PathDrawer<TypeParam> drawer(mesh.view(), 3);
    for (std::size_t i = 0; i < case_count(400); ++i) {
      const Path<TypeParam> path = drawer.random().one_in(4) ? drawer.draw_axis_parallel() : drawer.draw();
      const auto hits = comparison.expect_same(path);
      comparison.expect_same(path, draw_options(drawer.random(), hits.empty() ? TypeParam{1} : hits.front().t));
      comparison.expect_same(drawer.draw_from_afar(TypeParam{1e6F}));
    }
    EXPECT_GT(comparison.hit_count(), 0U);
    // Lines that begin beyond the mesh, and lead away from it.
    for (int axis = 0; axis < 3; ++axis) {
      for (const TypeParam side : {TypeParam{3}, TypeParam{-3}}) {
        const Triangle<TypeParam> triangle = mesh.view().triangle(0);
        const Vector3<TypeParam> away = side * Vector3<TypeParam>::Unit(axis);
        const Vector3<TypeParam> inside = (triangle.a + triangle.b + triangle.c) / 3;
        comparison.expect_same(Line<TypeParam>{inside + away, away});
      }
    }
    EXPECT_EQ(comparison.colliders().front().grid_summary().cells, 1U);
    QueryStatistics beside;
    const Segment<TypeParam> segment{{2, 2, 2}, {3, 3, 3}};
    EXPECT_FALSE(comparison.colliders().front().first_hit(segment, {}, &beside));
    EXPECT_EQ(beside.candidates, 0U);
  }
  const auto more = scattered_triangles<TypeParam>(33, TypeParam{0.4F}, this->random_);
  EXPECT_GT(Collider<TypeParam>(more.view()).grid_summary().cells, 1U);
}

TYPED_TEST(BruteForceComparison, long_paths_from_far_outside) {
  const auto mesh = rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_);
  for (const TypeParam distance :
       {TypeParam{1e6F}, TypeParam{1e12F}, TypeParam{1e18F}, TypeParam{1e19F}, this->magnitude(1e30F, 1e200)}) {
    GridComparison<TypeParam> comparison(mesh.view());
    PathDrawer<TypeParam> drawer(mesh.view(), 1);
    for (std::size_t i = 0; i < case_count(50); ++i) comparison.expect_same(drawer.draw_from_afar(distance));
    EXPECT_GT(comparison.hit_count(), 0U);
    EXPECT_EQ(comparison.statistics().unclipped, distance <= TypeParam{1e18F} ? 0 : comparison.statistics().paths);
  }
}

TYPED_TEST(BruteForceComparison, long_paths_to_their_own_negative) {
  const auto mesh = placed<TypeParam>(lattice_cube<TypeParam>(4), TypeParam{1} / 4, {-0.5, -0.5, -0.5});
  GridComparison<TypeParam> comparison(mesh.view());
  const std::size_t paths = case_count(50);
  for (std::size_t i = 0; i < paths; ++i) {
    Vector3<TypeParam> start;
    for (auto& x : start) x = TypeParam{1e18F} * this->random_.template symmetric<TypeParam>();
    comparison.expect_same(Segment<TypeParam>{start, -start});
    comparison.expect_same(Ray<TypeParam>{start, -start});
    comparison.expect_same(Line<TypeParam>{start, -start});
  }
  EXPECT_EQ(comparison.hit_count(), 3 * paths);
  EXPECT_EQ(comparison.statistics().unclipped, 0U);
}

TYPED_TEST(BruteForceComparison, long_paths_through_the_origin) {
  const auto mesh = placed<TypeParam>(lattice_cube<TypeParam>(4), TypeParam{1} / 4, {-0.5, -0.5, -0.5});
  GridComparison<TypeParam> comparison(mesh.view());
  const std::size_t paths = case_count(30);
  for (std::size_t i = 0; i < paths; ++i) {
    const auto segment = far_through_origin<TypeParam>(60, this->random_);
    comparison.expect_same(segment);
    comparison.expect_same(Line<TypeParam>{segment.start, segment.end});
  }
  EXPECT_EQ(comparison.hit_count(), 2 * paths);
  EXPECT_EQ(comparison.statistics().unclipped, 0U);
}

TYPED_TEST(BruteForceComparison, long_paths_that_end_near_their_start) {
  const auto mesh = rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_);
  GridComparison<TypeParam> comparison(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  for (std::size_t i = 0; i < case_count(100); ++i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    Vector3<TypeParam> end;
    for (auto& x : end) x = this->random_.template any_finite<TypeParam>();
    comparison.expect_same(drawer.any_kind({start, end}));
    comparison.expect_same(drawer.any_kind({end, start}));
  }
  EXPECT_GT(comparison.hit_count(), 0U);
}

TYPED_TEST(BruteForceComparison, axis_parallel_and_zero_component_directions) {
  for (const auto& mesh : {lattice_cube<TypeParam>(6), rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_)}) {
    GridComparison<TypeParam> comparison(mesh.view());
    PathDrawer<TypeParam> drawer(mesh.view(), 1);
    for (std::size_t i = 0; i < case_count(125); ++i) comparison.expect_same(drawer.draw_axis_parallel());
    EXPECT_GT(comparison.hit_count(), 0U);
  }
}

/// Triangles and paths that lie in the planes between cells, as near as a Scalar comes.
TYPED_TEST(BruteForceComparison, points_exactly_on_cell_planes) {
  constexpr std::uint32_t cells = 6;
  const std::vector<GridOptions> grids = {
      {.resolution = {cells, cells, cells}, .crowded = 0}, {.resolution = {3, 2, 1}}, {}};
  const auto corners = scattered_triangles<TypeParam>(20, TypeParam{1}, this->random_);
  const GridFrame frame = Grid(corners.view(), box_of(corners.view()), grids.front()).frame();
  const auto on_plane = [&](std::size_t axis, std::uint32_t index) {
    const double place = (index - double{frame.margin[axis]}) / frame.scale[axis] + frame.origin[axis];
    return static_cast<TypeParam>(std::ldexp(place, -frame.exponent));
  };
  const auto crossing = [&] {
    Vector3<TypeParam> point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[static_cast<Eigen::Index>(axis)] =
          neighbour(on_plane(axis, static_cast<std::uint32_t>(this->random_.between(1, cells - 1))),
                    static_cast<int>(this->random_.between(-1, 1)));
    }
    return point;
  };
  // The outer planes are those of the box, which the triangles on inner planes do not move.
  GeneratedMesh<TypeParam> mesh = corners;
  for (int i = 0; i < 60; ++i) mesh.add({crossing(), crossing(), crossing()});

  GridComparison<TypeParam> comparison(mesh.view(), {}, grids);
  ASSERT_EQ(detail::ColliderState<TypeParam>::of(comparison.colliders().front()).grid.frame().scale, frame.scale);
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  for (std::size_t i = 0; i < case_count(1250); ++i) {
    Segment<TypeParam> segment = {crossing(), crossing()};
    if (drawer.random().one_in(2)) segment.end = segment.start + 2 * (segment.end - segment.start);
    comparison.expect_same(drawer.any_kind(segment));
  }
  EXPECT_GT(comparison.hit_count(), case_count(1250) / 10);
}

TYPED_TEST(BruteForceComparison, extents_of_the_largest_numbers) {
  const TypeParam huge = this->magnitude(3e38F, 1.7e308);
  this->compare(
      placed<TypeParam>(scattered_triangles<TypeParam>(200, TypeParam{0.25F}, this->random_), huge / 2, {0, 0, 0}),
      150);
  GeneratedMesh<TypeParam> spanning = this->single({{-huge, -huge, -huge}, {huge, huge, -huge}, {0, huge, huge}});
  spanning.add({{huge, -huge, huge}, {-huge, 0, 0}, {1, 1, 1}});
  spanning.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  this->compare(spanning, 75);
}

TYPED_TEST(BruteForceComparison, extents_of_the_least_numbers) {
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  this->compare(placed<TypeParam>(lattice_cube<TypeParam>(4), least, {0, 0, 0}), 100);
  this->compare(placed<TypeParam>(lattice_cube<TypeParam>(1), least, {0, 0, 0}), 100);
  this->compare(this->single({{0, 0, 0}, {least, 0, 0}, {0, 0, 0}}), 100);
  this->compare(this->single({{-least, 0, 0}, {least, 0, least}, {0, 1, -least}}), 100);
}

TYPED_TEST(BruteForceComparison, extents_of_the_least_numbers_seen_from_one) {
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  const auto mesh = placed<TypeParam>(lattice_cube<TypeParam>(4), least, {0, 0, 0});
  GridComparison<TypeParam> comparison(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  for (std::size_t i = 0; i < case_count(125); ++i) comparison.expect_same(drawer.draw_from_afar(1));
  EXPECT_GT(comparison.hit_count(), 0U);
}

TYPED_TEST(BruteForceComparison, extent_zero) {
  const TypeParam far = TypeParam{1e30F};
  for (const Vector3<TypeParam>& point :
       {Vector3<TypeParam>{0, 0, 0}, Vector3<TypeParam>{far, -far, far}, Vector3<TypeParam>{0, far, 1}}) {
    GeneratedMesh<TypeParam> mesh = this->single({point, point, point});
    mesh.add({point, point, point});
    this->compare(mesh, 100);
    GridComparison<TypeParam> comparison(mesh.view());
    PathDrawer<TypeParam> drawer(mesh.view(), 1);
    for (std::size_t i = 0; i < case_count(100); ++i) comparison.expect_same(drawer.draw_from_afar(far));
    EXPECT_GT(comparison.hit_count(), 0U);
  }
}

TYPED_TEST(BruteForceComparison, flat_meshes) {
  for (const int axis : {0, 1, 2}) {
    const auto ground = scattered_triangles<TypeParam>(100, TypeParam{0.3F}, this->random_);
    this->compare(flattened<TypeParam>(ground, axis, 0), 50);
    this->compare(flattened<TypeParam>(ground, axis, TypeParam{1234.5F}), 50);
  }
  GeneratedMesh<TypeParam> oblique = lattice_cube<TypeParam>(5);
  for (auto& vertex : oblique.vertices) vertex[2] = vertex[0] + 2 * vertex[1];
  this->compare(oblique, 50);
}

/// As thin as numbers go where everything else is as large as they go: no scale suits all axes.
TYPED_TEST(BruteForceComparison, flat_mesh_far_away_on_its_own_axis) {
  const TypeParam far = this->magnitude(1e38F, 1e300);
  const TypeParam small = this->magnitude(1e-38F, 1e-300);
  for (const int axis : {0, 1, 2}) {
    const auto plate =
        placed<TypeParam>(scattered_triangles<TypeParam>(20, TypeParam{1}, this->random_), small, {0, 0, 0});
    this->compare(flattened<TypeParam>(plate, axis, far), 50);
    this->compare(flattened<TypeParam>(plate, axis, small), 50);
  }
}

TYPED_TEST(BruteForceComparison, out_of_range_conversions_to_integer) {
  constexpr std::uint32_t absurd = std::numeric_limits<std::uint32_t>::max();
  const auto mesh = rough_ground<TypeParam>(4, TypeParam{0.3F}, this->random_);
  const std::vector<GridOptions> grids = {
      {.resolution = {absurd, absurd, absurd}},
      {.cells_per_triangle = std::numeric_limits<double>::infinity()},
      {.cells_per_triangle = std::numeric_limits<double>::quiet_NaN()},
      {.cells_per_triangle = std::numeric_limits<double>::max()},
      {.cells_per_triangle = -1},
      {.resolution = {0, 0, absurd}},
  };
  GridComparison<TypeParam> comparison(mesh.view(), {}, grids);
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  for (std::size_t i = 0; i < 10; ++i) {
    comparison.expect_same(drawer.draw());
    comparison.expect_same(drawer.draw_from_afar(TypeParam{1e10F}));
    comparison.expect_same(drawer.draw_from_afar(this->magnitude(3e38F, 1e308)));
  }
  EXPECT_GT(comparison.hit_count(), 0U);
}

TYPED_TEST(BruteForceComparison, line_of_needles) { this->compare(line_of_needles<TypeParam>(500, this->random_), 50); }

TYPED_TEST(BruteForceComparison, mesh_far_from_the_origin) {
  const auto ground = rough_ground<TypeParam>(16, TypeParam{0.3F}, this->random_);
  this->compare(placed<TypeParam>(ground, TypeParam{100}, {1e7, -1e7, 1e7}), 75);
  this->compare(placed<TypeParam>(ground, TypeParam{1}, {1e7, 0, 0}), 75);
}

TYPED_TEST(BruteForceComparison, many_identical_triangles) {
  GeneratedMesh<TypeParam> mesh = rough_ground<TypeParam>(3, TypeParam{0.3F}, this->random_);
  const auto once = mesh.triangles;
  for (int i = 0; i < 20; ++i) mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  this->compare(mesh, 50);
}

TYPED_TEST(BruteForceComparison, closed_lattice_through_its_vertices_and_edges) {
  constexpr std::uint32_t size = 8;
  const auto mesh = lattice_cube<TypeParam>(size);
  GridComparison<TypeParam> comparison(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  const auto half = [&] { return static_cast<TypeParam>(this->random_.between(-4, 2 * size + 4)) / 2; };
  for (std::size_t i = 0; i < case_count(1250); ++i) {
    comparison.expect_same(drawer.any_kind({{half(), half(), half()}, {half(), half(), half()}}));
  }
  EXPECT_GT(comparison.hit_count(), case_count(1250) / 4);
}

TYPED_TEST(BruteForceComparison, rays_with_tiny_and_huge_directions) {
  const auto mesh = rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_);
  GridComparison<TypeParam> comparison(mesh.view());
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  const TypeParam huge = this->magnitude(1e38F, 1e308);
  for (std::size_t i = 0; i < case_count(50); ++i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    Vector3<TypeParam> direction = drawer.point_on_mesh() - start;
    comparison.expect_same(Ray<TypeParam>{start, direction * huge / 8});
    comparison.expect_same(Line<TypeParam>{start, direction * (4096 * least)});
    direction = direction.unaryExpr([](TypeParam x) { return x < 0 ? -least : least; });
    comparison.expect_same(Ray<TypeParam>{start, direction});
    direction[static_cast<Eigen::Index>(this->random_.below(3))] =
        this->random_.one_in(2) ? TypeParam{1} : TypeParam{0};
    comparison.expect_same(Ray<TypeParam>{start, direction});
    comparison.expect_same(Segment<TypeParam>{start, start + direction});
  }
  EXPECT_GT(comparison.hit_count(), 0U);
}

/// Under flushing and rounding upwards, a grid is built and walked as it is without.
TYPED_TEST(BruteForceComparison, other_floating_point_environments) {
  const auto mesh = placed<TypeParam>(rough_ground<TypeParam>(12, TypeParam{0.3F}, this->random_),
                                      256 * std::numeric_limits<TypeParam>::denorm_min(), {0, 0, 0});
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  const FloatingPointMode mode{"upward, flushing", FE_UPWARD, true};
  const auto build = [&] {
    const FloatingPointModeScope scope(mode);
    return Collider<TypeParam>(mesh.view());
  };
  const Collider<TypeParam> collider = build();
  EXPECT_EQ(collider.grid_summary().resolution, Collider<TypeParam>(mesh.view()).grid_summary().resolution);
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < case_count(500); ++i) {
    const Path<TypeParam> path = drawer.draw();
    const auto expected = brute_force_hits(mesh.view(), path);
    const auto first = [&] {
      const FloatingPointModeScope scope(mode);
      return collider.first_hit(path);
    }();
    ASSERT_EQ(first.has_value(), !expected.empty()) << hex_text(path);
    if (!first) continue;
    ++hit_count;
    EXPECT_TRUE(same_bits(*first, expected.front())) << hex_text(path);
  }
  EXPECT_GT(hit_count, 0U);
}

TYPED_TEST(BruteForceComparison, masks_and_ignored_triangles) {
  const auto mesh = scattered_triangles<TypeParam>(300, TypeParam{0.5F}, this->random_);
  std::vector<std::uint32_t> masks(mesh.triangles.size());
  for (auto& mask : masks) mask = static_cast<std::uint32_t>(this->random_.below(8));
  GridComparison<TypeParam> comparison(mesh.view(), masks);
  PathDrawer<TypeParam> drawer(mesh.view(), 1);
  for (std::size_t i = 0; i < case_count(250); ++i) {
    const Path<TypeParam> path = drawer.draw();
    QueryOptions<TypeParam> options;
    options.mask = static_cast<std::uint32_t>(this->random_.below(8));
    const auto hits = comparison.expect_same(path, options);
    if (hits.empty()) continue;
    options.ignored_triangle = hits.front().triangle;
    comparison.expect_same(path, options);
  }
  EXPECT_GT(comparison.hit_count(), 0U);
}

}  // namespace
}  // namespace surehit::test::brute_force_comparison_test
