#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "same_answers.hpp"
#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/neighbour.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "unit_triangles.hpp"

/// Situations in which other libraries were publicly reported to let a ray slip through or to answer wrongly, made
/// anew: each test names one, and the thread that tells of it. Others have their tests elsewhere:
///
/// - moving shapes: public_shape_reports_test
/// - rays through the edges and vertices of closed meshes in any direction
///   (https://github.com/dimforge/parry/issues/444, https://github.com/RenderKit/embree/issues/174 and /181):
///   grid/watertight_test
/// - an answer that changes with the instruction set (https://github.com/RenderKit/embree/issues/423):
///   instruction_sets_test
/// - many threads on one mesh (https://github.com/AndresTraks/BulletSharpPInvoke/issues/63): query_threads_test
/// - a body that tunnels through a thin wall (https://github.com/godotengine/godot/issues/72889):
///   last_free_point_test, level/trial_test
/// - a degenerate triangle that everything hits (https://github.com/libgdx/libgdx/issues/4901):
///   query_meaning_degenerate_test
namespace surehit::test::public_reports_test {
namespace {

template <typename Scalar>
class PublicReports : public testing::Test {
 protected:
  using Point = Vector3<Scalar>;
  using Hits = std::vector<Hit<Scalar>>;

  /// Asks in every way there is, and expects exactly these hits.
  static void expect_hits(const Collider<Scalar>& collider, const Path<Scalar>& path, const Hits& expected) {
    SCOPED_TRACE(hex_text(path));
    const auto first = expected.empty() ? std::nullopt : std::optional(expected.front());
    expect_same(collider.first_hit(path), first);
    EXPECT_EQ(collider.any_hit(path), first.has_value());
    Hits hits;
    collider.all_hits(path, hits);
    expect_same<Scalar>(hits, expected);
    for (std::uint32_t id = 0; id < collider.triangle_count(); ++id) {
      auto pair = intersect(path, collider.triangle(id));
      if (pair) pair->triangle = id;
      const auto of_id =
          std::find_if(expected.begin(), expected.end(), [&](const auto& hit) { return hit.triangle == id; });
      expect_same(pair, of_id == expected.end() ? std::nullopt : std::optional(*of_id));
    }
    // As many as fill the widest lanes twice, and some that are left over.
    const Hits firsts(37, first.value_or(Hit<Scalar>{}));
    if (path.kind == PathKind::segment) {
      expect_batch(collider, std::vector<Segment<Scalar>>(firsts.size(), {path.start, path.toward}), firsts);
    } else if (path.kind == PathKind::ray) {
      expect_batch(collider, std::vector<Ray<Scalar>>(firsts.size(), {path.start, path.toward}), firsts);
    } else {
      expect_batch(collider, std::vector<Line<Scalar>>(firsts.size(), {path.start, path.toward}), firsts);
    }
  }

  template <typename AnyPath>
  static void expect_batch(const Collider<Scalar>& collider, const std::vector<AnyPath>& paths, const Hits& expected) {
    Hits hits(paths.size());
    collider.first_hits(paths, hits);
    expect_same<Scalar>(hits, expected);
    std::vector<std::uint8_t> blocked(paths.size());
    collider.any_hits(paths, blocked);
    for (std::size_t i = 0; i < paths.size(); ++i) EXPECT_EQ(blocked[i], expected[i].triangle == no_triangle ? 0 : 1);
  }

  /// Triangles (0, 1, 2) and (0, 2, 3).
  static GeneratedMesh<Scalar> square(const std::array<Point, 4>& corners) {
    return {{corners.begin(), corners.end()}, {{0, 1, 2}, {0, 2, 3}}};
  }

  /// At the point of a square that lies x of its side from corner 0 towards corner 1, and y towards corner 3: on one
  /// triangle, on both or on none.
  static Hits hits_on_square(Scalar x, Scalar y, Scalar t, Side side) {
    if (std::min(x, y) < 0 || std::max(x, y) > 1) return {};
    Hits hits;
    if (x >= y) hits.push_back({t, x - y, y, 0, side});
    if (x <= y) hits.push_back({t, x, y - x, 1, side});
    return hits;
  }

  /// A square of ground of side 8, whose corners are at unequal heights.
  static GeneratedMesh<Scalar> ground_at(const Point& place) {
    return placed(square({Point{0, 0, 1}, {8, 0, 3}, {8, 8, 2}, {0, 8, 5}}), Scalar{1}, place);
  }

  /// Down onto that ground, from 9 above the place, two units at a time.
  static Ray<Scalar> downward(const Point& place, Scalar x, Scalar y) { return {place + Point{x, y, 9}, {0, 0, -2}}; }

  static Hits hits_on_ground(Scalar x, Scalar y) {
    const Scalar height = 1 + (x >= y ? 2 * (x - y) + y : x + 4 * (y - x)) / 8;
    return hits_on_square(x / 8, y / 8, (9 - height) / 2, Side::front);
  }

  /// Rays along every axis both ways, from outside the cube [-reach, reach]³ that holds the mesh, through every vertex
  /// or beside it. Every hit is that of rationals; `judge` is given the vertex, the axis and the hits.
  template <typename Judge>
  void scan(const GeneratedMesh<Scalar>& mesh, Scalar reach, const Point& beside, const Judge& judge) {
    const Collider<Scalar> collider(mesh.view());
    const ExactMeshOracle<Scalar> oracle(mesh.view(), {});
    for (const Point& vertex : mesh.vertices) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (const Scalar way : {Scalar{1}, Scalar{-1}}) {
          Ray<Scalar> ray{vertex + beside, Point::Unit(axis) * way};
          ray.origin[axis] = -way * reach;
          const Hits hits = oracle.all_hits(ray, {});
          expect_hits(collider, ray, hits);
          judge(vertex, axis, hits);
        }
      }
    }
  }

  /// A ray enters a convex mesh as far before the plane through the origin as it leaves behind it. `half_length` is
  /// this distance for a vertex and an axis.
  template <typename HalfLength>
  void expect_enters_and_leaves(const GeneratedMesh<Scalar>& mesh, Scalar reach, const HalfLength& half_length) {
    scan(mesh, reach, Point::Zero(), [&](const Point& vertex, Eigen::Index axis, const Hits& hits) {
      ASSERT_FALSE(hits.empty());
      EXPECT_EQ(hits.front().t, reach - half_length(vertex, axis));
      EXPECT_EQ(hits.back().t, reach + half_length(vertex, axis));
    });
  }

  Random random_{1951};
};
TYPED_TEST_SUITE(PublicReports, Scalars, ScalarNames);

// Downward rays fall through the ground where its triangles meet:
// https://github.com/dimforge/rapier/issues/165, https://github.com/mrdoob/three.js/issues/11449
TYPED_TEST(PublicReports, vertical_ray_on_the_diagonal_of_two_triangles) {
  const typename TestFixture::Point here{0, 0, 0};
  const Collider<TypeParam> ground(this->ground_at(here).view());
  for (int i = 0; i <= 64; ++i) {
    const TypeParam x = static_cast<TypeParam>(i) / 8;
    const Ray<TypeParam> ray = this->downward(here, x, x);
    this->expect_hits(ground, ray, this->hits_on_ground(x, x));
    this->expect_hits(ground, Line<TypeParam>{ray.origin, ray.direction}, this->hits_on_ground(x, x));
  }
  // All bits of the numbers in use, so that products are rounded.
  for (std::size_t i = case_count(300); i > 0; --i) {
    const TypeParam side = 1 + this->random_.template unit<TypeParam>();
    const TypeParam x = side * this->random_.template unit<TypeParam>();
    const Collider<TypeParam> floor(
        this->square({typename TestFixture::Point{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}).view());
    this->expect_hits(floor, Ray<TypeParam>{{x, x, 3}, {0, 0, -2}},
                      {{TypeParam{1.5}, 0, x / side, 0, Side::front}, {TypeParam{1.5}, x / side, 0, 1, Side::front}});
  }
}

// A ray that starts on a corner is said to miss: https://github.com/libgdx/libgdx/issues/3122
TYPED_TEST(PublicReports, ray_whose_origin_is_a_corner) {
  const Triangle<TypeParam> slope{{16, -48, 1100}, {16, -8, 1130}, {64, -48, 1091}};
  GeneratedMesh<TypeParam> mesh;
  mesh.add(slope);
  const Collider<TypeParam> collider(mesh.view());
  const TypeParam diagonal = TypeParam(0.70710678118654752);
  // The normal is (-3, 12, -16) times 120.
  const auto expect_at_corners = [&](const Vector3<TypeParam>& direction, Side side) {
    this->expect_hits(collider, Ray<TypeParam>{slope.a, direction}, {{0, 0, 0, 0, side}});
    this->expect_hits(collider, Ray<TypeParam>{slope.b, direction}, {{0, 1, 0, 0, side}});
    this->expect_hits(collider, Ray<TypeParam>{slope.c, direction}, {{0, 0, 1, 0, side}});
  };
  expect_at_corners({-diagonal, 0, diagonal}, Side::front);
  expect_at_corners({diagonal, 0, -diagonal}, Side::back);
  expect_at_corners({0, diagonal, diagonal}, Side::front);
  expect_at_corners({0, 0, -1}, Side::back);
  expect_at_corners({0, 4, 3}, Side::edge_on);
  expect_at_corners({-16, 0, 3}, Side::edge_on);
}

// A path in the plane of a triangle is never reported, however it crosses it:
// https://github.com/RenderKit/embree/issues/298
TYPED_TEST(PublicReports, segment_along_an_edge) {
  const Collider<TypeParam> floor(
      this->square({typename TestFixture::Point{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}).view());
  const TypeParam eighth{0.125};
  const TypeParam quarter{0.25};
  const auto expect_along = [&](const Vector3<TypeParam>& start, const Vector3<TypeParam>& end,
                                const typename TestFixture::Hits& hits) {
    this->expect_hits(floor, Segment<TypeParam>{start, end}, hits);
  };
  // The shared edge: all of it, a part of it, and back.
  expect_along({-1, -1, 0}, {7, 7, 0}, {{eighth, 0, 0, 0, Side::edge_on}, {eighth, 0, 0, 1, Side::edge_on}});
  expect_along({1, 1, 0}, {3, 3, 0}, {{0, 0, quarter, 0, Side::edge_on}, {0, quarter, 0, 1, Side::edge_on}});
  expect_along({7, 7, 0}, {-1, -1, 0}, {{3 * eighth, 0, 1, 0, Side::edge_on}, {3 * eighth, 1, 0, 1, Side::edge_on}});
  // An outer edge, which the other triangle has one corner in common with.
  expect_along({-1, 0, 0}, {7, 0, 0}, {{eighth, 0, 0, 0, Side::edge_on}, {eighth, 0, 0, 1, Side::edge_on}});
  expect_along({1, 0, 0}, {3, 0, 0}, {{0, quarter, 0, 0, Side::edge_on}});
  // Beside it, and above it.
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  expect_along({-1, -tiny, 0}, {7, -tiny, 0}, {});
  expect_along({-1, 0, tiny}, {7, 0, tiny}, {});
}

// A ray that passes a skinny triangle far off, nearly parallel to it, is said to hit it, farther away than anything is:
// https://github.com/RenderKit/embree/issues/387, https://github.com/RenderKit/embree/issues/423
TYPED_TEST(PublicReports, ray_far_off_a_skinny_triangle_nearly_parallel_to_it) {
  const auto vary = [&](double x) {
    return static_cast<TypeParam>(x) * (1 + this->random_.template unit<TypeParam>() / 16);
  };
  for (std::size_t i = case_count(2000); i > 0; --i) {
    const TypeParam slope = this->random_.template symmetric<TypeParam>();
    const auto at = [&](TypeParam x, TypeParam y) { return Vector3<TypeParam>{x, y, x * slope}; };
    // With edges of some 11, 10 and 1.4, where y < 4; the ray stays where y >= 5, and in the cell that lists all three.
    const TypeParam x = vary(60);
    GeneratedMesh<TypeParam> mesh;
    mesh.add({at(x, vary(2)), at(x + vary(11), vary(2)), at(x + vary(9.6), vary(3))});
    for (const TypeParam y : {TypeParam{-1000}, TypeParam{1000}})
      mesh.add({{-600, y, -600}, {-600, y, 600}, {600, y, 0}});
    const Collider<TypeParam> collider(mesh.view(), {.grid = {.resolution = {1, 1, 1}, .crowded = 0}});
    const TypeParam angle = this->random_.template symmetric<TypeParam>() / static_cast<TypeParam>(1 << (i % 24));
    const Vector3<TypeParam> origin = at(vary(-500), vary(5));
    const Vector3<TypeParam> direction{1, i % 2 == 0 ? 0 : vary(0.001), slope + angle};
    this->expect_hits(collider, Ray<TypeParam>{origin, direction}, {});
    this->expect_hits(collider, Segment<TypeParam>{origin, origin + 12'000 * direction}, {});
  }
}

// The same must not be mended by an epsilon that loses those that do hit.
TYPED_TEST(PublicReports, ray_onto_a_skinny_triangle_nearly_parallel_to_it) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0, 0, 0}, {1024, 0, 0}, {512, 1, 0}});
  const Collider<TypeParam> collider(mesh.view());
  // At t = 4 at (512, y, 0).
  const auto ray = [](TypeParam y) { return Ray<TypeParam>{{-3584, y, 4}, {1024, 0, -1}}; };
  this->expect_hits(collider, ray(TypeParam{0.25}), {{4, TypeParam{0.375}, TypeParam{0.25}, 0, Side::front}});
  this->expect_hits(collider, ray(0), {{4, TypeParam{0.5}, 0, 0, Side::front}});
  this->expect_hits(collider, ray(1), {{4, 0, 1, 0, Side::front}});
  this->expect_hits(collider, ray(-std::numeric_limits<TypeParam>::denorm_min()), {});
  this->expect_hits(collider, ray(neighbour(TypeParam{1}, 1)), {});
}

// Hits on an edge are gathered twice, or not all, or one triangle again and again:
// https://github.com/RenderKit/embree/issues/188, https://github.com/mikedh/trimesh/issues/2504
TYPED_TEST(PublicReports, all_hits_on_an_edge_have_each_triangle_once) {
  // Twelve pages of a book, whose spine the path crosses in the middle.
  GeneratedMesh<TypeParam> mesh;
  typename TestFixture::Hits expected;
  const TypeParam half{0.5};
  for (int page = 0; page < 12; ++page) {
    const int slope = page - 6;
    mesh.add({{0, 0, 0}, {0, 0, 8}, {static_cast<TypeParam>(slope), 1, 3}});
    // det = 48 - 112 slope.
    expected.push_back({half, half, 0, static_cast<std::uint32_t>(page), slope <= 0 ? Side::front : Side::back});
  }
  for (const GridOptions& grid : {GridOptions{}, GridOptions{.resolution = {9, 9, 9}}}) {
    const Collider<TypeParam> collider(mesh.view(), {.grid = grid});
    this->expect_hits(collider, Segment<TypeParam>{{-3, -7, 6}, {3, 7, 2}}, expected);
  }
}

// Far from the origin hits get lost, or are found again and again: https://github.com/mikedh/trimesh/issues/2504
TYPED_TEST(PublicReports, coordinates_of_a_hundred_thousand_and_of_ten_million) {
  for (const TypeParam far : {TypeParam{1e5}, TypeParam{-1e5}, TypeParam{1e7}, TypeParam{-1e7}}) {
    for (const auto& place : {Vector3<TypeParam>{far, far, 0}, {far, -far, far}, {0, 0, far}}) {
      const Collider<TypeParam> ground(this->ground_at(place).view());
      for (int x = -1; x <= 9; ++x) {
        for (int y = -1; y <= 9; ++y) {
          const auto [at_x, at_y] = std::array{static_cast<TypeParam>(x), static_cast<TypeParam>(y)};
          this->expect_hits(ground, this->downward(place, at_x, at_y), this->hits_on_ground(at_x, at_y));
        }
      }
    }
  }
}

// From 12 km away, small things are hit or missed by turns as the path's end moves sideways:
// https://github.com/jrouwe/JoltPhysics/issues/1818
TYPED_TEST(PublicReports, path_of_twelve_kilometres) {
  const Collider<TypeParam> target(
      this->square({typename TestFixture::Point{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}).view());
  const TypeParam t = TypeParam{12'000} / TypeParam{12'004};
  const auto across = [](TypeParam y, TypeParam z, TypeParam slope) {
    return Segment<TypeParam>{{-12'000, y - 12'000 * slope, z}, {4, y + 4 * slope, z}};
  };
  const TypeParam z{0.5};
  for (int i = -64; i <= 320; ++i) {
    const TypeParam y = static_cast<TypeParam>(i) / 256;
    for (const TypeParam slope : {TypeParam{0}, TypeParam{0x1p-6}, TypeParam{-0x1p-5}}) {
      this->expect_hits(target, across(y, z, slope), this->hits_on_square(y, z, t, Side::back));
    }
  }
  this->expect_hits(target, across(neighbour(TypeParam{1}, 1), z, 0), {});
  this->expect_hits(target, across(-std::numeric_limits<TypeParam>::denorm_min(), z, 0), {});
}

// Scans of a closed mesh on whole numbers have gaps where rays meet vertices, or lie in a plane of the mesh's box:
// https://github.com/jbikker/tinybvh/issues/168, https://github.com/gkjohnson/three-mesh-bvh/issues/169,
// https://github.com/bepu/bepuphysics1/issues/6

TYPED_TEST(PublicReports, axis_parallel_rays_through_every_vertex_of_a_lattice_cube) {
  const auto cube = placed<TypeParam>(lattice_cube<TypeParam>(3), 2, {-3, -3, -3});
  this->expect_enters_and_leaves(cube, 8, [](const auto&, auto) { return TypeParam{3}; });
}

TYPED_TEST(PublicReports, axis_parallel_rays_through_every_vertex_of_dense_fans) {
  // |x| and |y| are at most 4 - |z|.
  this->expect_enters_and_leaves(double_fan<TypeParam>(4), 8, [](const Vector3<TypeParam>& vertex, Eigen::Index axis) {
    const Vector3<TypeParam> size = vertex.cwiseAbs();
    return 4 - (axis == 2 ? std::max(size.x(), size.y()) : size.z());
  });
}

TYPED_TEST(PublicReports, axis_parallel_rays_through_and_beside_every_vertex_of_a_bumpy_surface) {
  const auto mesh = bumpy_octahedron<TypeParam>(3, this->random_);
  const TypeParam reach{0x1p24};
  this->scan(mesh, reach, {0, 0, 0}, [](const auto&, auto, const auto& hits) { EXPECT_FALSE(hits.empty()); });
  // Past all vertices and edges, so that each hit enters or leaves.
  this->scan(mesh, reach, {1, 2, 3}, [](const auto&, auto, const auto& hits) { EXPECT_EQ(hits.size() % 2, 0U); });
}

// A path of no length or with a NaN crashes, or spoils what is answered with it:
// https://github.com/defold/defold/issues/10312, https://github.com/tommy-xr/shock2quest/pull/409
TYPED_TEST(PublicReports, paths_of_no_length_and_of_no_number_among_others) {
  const Collider<TypeParam> stack(stack_of_triangles<TypeParam>(3).view());
  const TypeParam quarter{0.25};
  const Hit<TypeParam> across{TypeParam{0.5}, quarter, quarter, 1, Side::front};
  const Hit<TypeParam> resting{0, quarter, quarter, 2, Side::edge_on};
  std::vector<Segment<TypeParam>> segments;
  typename TestFixture::Hits expected;
  const auto add = [&](const Segment<TypeParam>& segment, const Hit<TypeParam>& hit) {
    segments.push_back(segment);
    expected.push_back(hit);
  };
  const auto still_at = [&](TypeParam height) { return through_stack<TypeParam>(height, height); };
  for (const TypeParam bad :
       {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity()}) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto good = through_stack<TypeParam>(TypeParam{1.5}, TypeParam{0.5});
      auto bad_start = good;
      auto bad_end = good;
      bad_start.start[axis] = bad;
      bad_end.end[axis] = -bad;
      add(good, across);
      add(bad_start, {});
      add(still_at(2), resting);
      add(bad_end, {});
      add(still_at(neighbour(TypeParam{2}, -1)), {});
    }
  }
  this->expect_batch(stack, segments, expected);
  std::vector<Ray<TypeParam>> rays;
  for (const auto& [start, end] : segments) rays.push_back({start, end - start});
  // The ray goes on through what the segment ends before, which is not the first hit.
  this->expect_batch(stack, rays, expected);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const bool is_hit = expected[i].triangle != no_triangle;
    this->expect_hits(stack, segments[i],
                      is_hit ? typename TestFixture::Hits{expected[i]} : typename TestFixture::Hits{});
  }
}

}  // namespace
}  // namespace surehit::test::public_reports_test
