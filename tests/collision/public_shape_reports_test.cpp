#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "shape/shape_comparison.hpp"
#include "support/box_oracle.hpp"
#include "support/capsule_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/neighbour.hpp"
#include "support/scalars.hpp"
#include "support/shape_text.hpp"
#include "support/sphere_oracle.hpp"
#include "support/swept_truth.hpp"
#include "surehit/collider.hpp"
#include "surehit/scene.hpp"
#include "surehit/shape_hit.hpp"

/// Situations in which other libraries were publicly reported to answer wrongly about a moving shape, made anew: each
/// test names one, and the thread or the source that tells of it. public_reports_test has those of rays.
namespace surehit::test::public_shape_reports_test {
namespace {

template <typename Scalar>
class PublicShapeReports : public testing::Test {
 protected:
  using Point = Vector3<Scalar>;
  using Hits = std::vector<ShapeHit<Scalar>>;

  /// Asks in every way there is, and expects exactly these hits. First, an oracle judges what is expected.
  template <typename Shape>
  static void expect_hits(const GeneratedMesh<Scalar>& mesh, const Shape& shape, const Hits& expected) {
    SCOPED_TRACE(hex_text(shape));
    const TriangleMeshView<Scalar> view = mesh.view();
    for (std::uint32_t id = 0; id < view.triangle_count(); ++id) {
      const auto hit = std::find_if(expected.begin(), expected.end(), [&](const auto& x) { return x.triangle == id; });
      EXPECT_EQ(find_error(shape, view.triangle(id), hit == expected.end() ? std::nullopt : std::optional(*hit)),
                std::nullopt);
    }
    Hits hits;
    Collider<Scalar>(view).all_hits(shape, hits);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hex_text(hits[i]), hex_text(expected[i]));
    const auto is_before = [](const Shape& moving, const auto& x, const auto& y) { return comes_before(moving, x, y); };
    // As many as fill the widest lanes, and one that is left over.
    compare_with_brute_force(view, std::vector<Shape>(17, shape), is_before, "");
  }

  /// What an oracle says, for numbers that nobody can follow by hand. No two hits may be at the same t.
  template <typename Shape>
  static Hits true_hits(const GeneratedMesh<Scalar>& mesh, const Shape& shape) {
    Hits hits;
    for (std::uint32_t id = 0; id < mesh.view().triangle_count(); ++id) {
      const SweptTruth truth = truth_of(shape, mesh.view().triangle(id));
      if (!truth.touches) continue;
      hits.push_back(rounded_hit<Scalar>(truth));
      hits.back().triangle = id;
    }
    std::sort(hits.begin(), hits.end(), [](const auto& x, const auto& y) { return x.t < y.t; });
    return hits;
  }

  static GeneratedMesh<Scalar> mesh_of(const std::vector<Triangle<Scalar>>& triangles) {
    GeneratedMesh<Scalar> mesh;
    for (const Triangle<Scalar>& triangle : triangles) mesh.add(triangle);
    return mesh;
  }

  /// A point whose coordinates a report gives as decimals of floats.
  static Point reported(float x, float y, float z) { return {Scalar{x}, Scalar{y}, Scalar{z}}; }

  /// A floor below the shapes that start on it, and its point below (2, 1).
  static GeneratedMesh<Scalar> floor() { return mesh_of({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}}); }
  static ShapeHit<Scalar> start_on_floor() { return {0, Scalar{0.25}, Scalar{0.125}, 0, Feature::face, true}; }
};
TYPED_TEST_SUITE(PublicShapeReports, Scalars, ScalarNames);

// Which edge to try is guessed from where the plane is met, and shapes pass through the others:
// https://github.com/NVIDIAGameWorks/PhysX/issues/501. The numbers are those of its duplicate, issues/597. Its capsule
// is turned by 90°.
TYPED_TEST(PublicShapeReports, capsule_onto_the_edge_that_was_not_guessed) {
  const auto mesh = this->mesh_of(
      {{this->reported(7.33294010F, 79.6109009F, -26.9337997F), this->reported(7.61456013F, 80.2574005F, -27.3008995F),
        this->reported(7.33294010F, 80.2574005F, -26.9337997F)}});
  const Vector3<TypeParam> start = this->reported(7.74110079F, 80.8543167F, -27.2595482F);
  const Vector3<TypeParam> way = this->reported(-0.929564953F, -0.0281119142F, 0.367584974F);
  const SweptCapsule<TypeParam> capsule{start, start + TypeParam{0.149537891F} * way,
                                        this->reported(0, 0.340350509F, 0), TypeParam{0.265350759F}};
  const auto hits = this->true_hits(mesh, capsule);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].feature, Feature::edge_bc);
  EXPECT_NEAR(hits[0].t * 0.149537891, 0.0944127962, 3e-5);  // what the report expects
  this->expect_hits(mesh, capsule, hits);
}

// The same for balls that fly low over a narrow triangle. The numbers of #501 itself could not be had.
TYPED_TEST(PublicShapeReports, ball_low_over_a_narrow_triangle) {
  const auto mesh = this->mesh_of({{{0, 0, 0}, {64, 0, 0}, {24, 2, 0}}});
  std::set<Feature> touched;
  for (int x = -6; x <= 70; x += 4) {
    for (const TypeParam slope : {TypeParam{-40}, TypeParam{40}}) {
      for (const TypeParam way : {TypeParam{28}, TypeParam{-28}}) {
        // In the middle, it is above the line where y is 1: by its radius, or by less.
        for (const TypeParam height : {TypeParam{4}, TypeParam{3.5}}) {
          const TypeParam middle = static_cast<TypeParam>(x);
          const SweptSphere<TypeParam> ball{
              {middle - slope, 1 - way, height + 2}, {middle + slope, 1 + way, height - 2}, 4};
          const auto hits = this->true_hits(mesh, ball);
          for (const auto& hit : hits) touched.insert(hit.feature);
          this->expect_hits(mesh, ball, hits);
        }
      }
    }
  }
  EXPECT_EQ(touched.size(), 6U);  // All but the blunt corner.
}

// A ball that grazes the edge of one triangle passes through the wall behind it:
// https://github.com/NVIDIA-Omniverse/PhysX/issues/505
TYPED_TEST(PublicShapeReports, ball_that_grazes_an_edge_before_a_wall) {
  const Triangle<TypeParam> ledge{{0, 0, -8}, {0, 0, 8}, {-16, 0, 0}};
  const Triangle<TypeParam> wall{{1, -8, -8}, {1, 8, -8}, {1, 0, 8}};
  const TypeParam part = TypeParam{1} / 128;
  // Its way is 41 parts from the edge, at a right angle at (9, 40, 0) parts. The step is 16 (40, -9, 0) parts.
  SweptSphere<TypeParam> ball{{-151 * part, 76 * part, 0}, {489 * part, -68 * part, 0}, 41 * part};
  ShapeHit<TypeParam> grazing{TypeParam{0.25}, TypeParam{0.5}, 0, 0, Feature::edge_ab, false};
  // The centre is then at (87, 22.45, 0) parts.
  ShapeHit<TypeParam> blocked{TypeParam{119} / 320, TypeParam{10689} / 40960, TypeParam{0.5}, 1, Feature::face, false};
  this->expect_hits(this->mesh_of({ledge, wall}), ball, {grazing, blocked});
  std::swap(grazing.triangle, blocked.triangle);
  this->expect_hits(this->mesh_of({wall, ledge}), ball, {grazing, blocked});
  ball.radius = neighbour(ball.radius, -1);
  const auto hits = this->true_hits(this->mesh_of({wall, ledge}), ball);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].triangle, 0U);
  this->expect_hits(this->mesh_of({wall, ledge}), ball, hits);

  // The numbers of the report, with which the ball reaches the edge.
  const Vector3<TypeParam> start = this->reported(-0.78131F, 0.3092001F, 0);
  const SweptSphere<TypeParam> faster{start, start + this->reported(4, -0.3F, 0), TypeParam{0.25}};
  const auto reported = this->true_hits(this->mesh_of({wall, ledge}), faster);
  ASSERT_EQ(reported.size(), 2U);
  EXPECT_EQ(reported[0].feature, Feature::edge_ab);
  EXPECT_EQ(reported[1].triangle, 0U);
  this->expect_hits(this->mesh_of({wall, ledge}), faster, reported);
}

// A ball never meets a triangle in whose plane it moves, or a triangle of some square millimetres. There, |det| is
// below 1e-5, and no edge is tried: https://github.com/NVIDIA-Omniverse/PhysX, GuSweepSphereTriangle.cpp
TYPED_TEST(PublicShapeReports, ball_in_the_plane_of_a_panel_and_onto_a_tiny_triangle) {
  const auto panel = this->mesh_of({{{1, -4, 0}, {1, 4, 0}, {9, 0, 0}}});
  const SweptSphere<TypeParam> level{{-1, 0, 0}, {3, 0, 0}, TypeParam{0.25}};
  this->expect_hits(panel, level, {{TypeParam{0.4375}, TypeParam{0.5}, 0, 0, Feature::edge_ab, false}});
  const SweptCapsule<TypeParam> lying{{-2, 0, 0}, {2, 0, 0}, {1, 0, 0}, TypeParam{0.25}};
  this->expect_hits(panel, lying, {{TypeParam{0.4375}, TypeParam{0.5}, 0, 0, Feature::edge_ab, false}});

  const TypeParam size{0x1p-10};
  const auto tiny = this->mesh_of({{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}});
  const SweptSphere<TypeParam> falling{{size / 4, size / 4, 1}, {size / 4, size / 4, -1}, TypeParam{0.25}};
  this->expect_hits(tiny, falling, {{TypeParam{0.375}, TypeParam{0.25}, TypeParam{0.25}, 0, Feature::face, false}});
}

// A capsule that begins on a triangle, and moves in its plane, misses it:
// https://github.com/NVIDIAGameWorks/PhysX/issues/600
TYPED_TEST(PublicShapeReports, capsule_that_leaves_a_triangle_in_its_plane) {
  const auto mesh = this->mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}});
  const SweptCapsule<TypeParam> capsule{{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, TypeParam{0.3F}};
  this->expect_hits(mesh, capsule, {{0, 0, 0, 0, Feature::corner_a, true}});
}

// A ball is said to hit a triangle that is almost a line, and some metres away:
// https://github.com/jrouwe/JoltPhysics/issues/886
TYPED_TEST(PublicShapeReports, ball_far_off_a_triangle_that_is_almost_a_line) {
  const auto mesh = this->mesh_of({{this->reported(14.5536213F, 10.5973721F, -0.00600051880F),
                                    this->reported(14.5536213F, 10.5969315F, -3.18638134F),
                                    this->reported(14.5536213F, 10.5969315F, -5.18637228F)}});
  const Vector3<TypeParam> start = this->reported(14.8314590F, 8.19055080F, -4.30825043F);
  SweptSphere<TypeParam> ball{start, start + this->reported(-0.0988006592F, 5.96046448e-08F, 0.000732421875F),
                              TypeParam{0.2F}};
  this->expect_hits(mesh, ball, {});
  // Until it is as large as the gap, which is 2.406 high, and 0.278 wide at first and 0.179 at last.
  ball.radius = TypeParam{2.42F};
  const auto hits = this->true_hits(mesh, ball);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_FALSE(hits[0].started_touching);
  this->expect_hits(mesh, ball, hits);
}

// An edge of 10 cm lets a ball pass whose step is 9 mm. There, |edge x step|² is below 1e-6, and they are taken for
// parallel: https://github.com/jrouwe/JoltPhysics, RayCylinder.h
TYPED_TEST(PublicShapeReports, ball_onto_a_short_edge_in_a_short_step) {
  const TypeParam part = TypeParam{1} / 1024;
  const auto mesh = this->mesh_of({{{-48 * part, 0, 0}, {48 * part, 0, 0}, {0, 96 * part, 0}}});
  const SweptSphere<TypeParam> ball{{0, -53 * part, 0}, {0, -44 * part, 0}, 48 * part};
  this->expect_hits(mesh, ball, {{TypeParam{5} / 9, TypeParam{0.5}, 0, 0, Feature::edge_ab, false}});
}

// A shape that starts in contact, and does not reach into what it touches, may have no hit:
// https://github.com/jrouwe/JoltPhysics/pull/1787. Its numbers could not be had.
TYPED_TEST(PublicShapeReports, shapes_that_start_touching_in_any_direction) {
  const auto floor = this->floor();
  const TypeParam half{0.5};
  for (const Vector3<TypeParam>& step : {Vector3<TypeParam>{0, 0, -4}, {0, 0, 4}, {3, 1, 0}, {-3, 0, 2}, {0, 0, 0}}) {
    const Vector3<TypeParam> low{2, 1, 1};
    const Vector3<TypeParam> high{2, 1, 3};
    const auto start = this->start_on_floor();
    this->expect_hits(floor, SweptSphere<TypeParam>{low, low + step, 1}, {start});
    this->expect_hits(floor, SweptBox<TypeParam>{low, low + step, {half, half, 1}}, {start});
    this->expect_hits(floor, SweptCapsule<TypeParam>{low, low + step, {1, 0, 0}, 1}, {start});
    this->expect_hits(floor, SweptCapsule<TypeParam>{high, high + step, {0, 0, 2}, 1}, {start});
  }
}

// A shape that starts beside a surface has a hit at once, even if it moves away:
// https://github.com/erincatto/box3d/issues/32
TYPED_TEST(PublicShapeReports, shapes_an_ulp_above_the_floor_that_do_not_come_down) {
  const auto floor = this->floor();
  const Vector3<TypeParam> start{2, 1, neighbour(TypeParam{1}, 1)};
  for (const Vector3<TypeParam>& end :
       {Vector3<TypeParam>{2, 1, 4}, {4, 2, start.z()}, {0, 0, start.z()}, {2, 1, start.z()}}) {
    this->expect_hits(floor, SweptSphere<TypeParam>{start, end, 1}, {});
    this->expect_hits(floor, SweptBox<TypeParam>{start, end, {1, 1, 1}}, {});
    this->expect_hits(floor, SweptCapsule<TypeParam>{start, end, {1, 0, 0}, 1}, {});
  }
}

// Where a large capsule barely touches, it is said to reach in by metres:
// https://github.com/jrouwe/JoltPhysics/issues/2103. Its other shape is a cylinder, and here it is a corner. The step
// is that of the report, in both directions.
TYPED_TEST(PublicShapeReports, large_capsule_that_barely_touches_a_corner) {
  // 5² + 5.25² = 7.25²
  const Triangle<TypeParam> triangle{{5, 1, TypeParam{5.25}}, {9, 1, 9}, {8, 3, 10}};
  const Vector3<TypeParam> step = this->reported(0.00244140625F, -0.0068359375F, 0.0029296875F);
  for (const Vector3<TypeParam>& end : {step, Vector3<TypeParam>(-step)}) {
    const SweptCapsule<TypeParam> capsule{{0, 0, 0}, end, {0, 2, 0}, TypeParam{7.25}};
    const ShapeHit<TypeParam> hit{0, 0, 0, 0, Feature::corner_a, true};
    this->expect_hits(this->mesh_of({triangle}), capsule, {hit});
    EXPECT_EQ(contact_point(triangle, hit), triangle.a);
    const Vector3<TypeParam> normal{-20 / TypeParam{29}, 0, -21 / TypeParam{29}};
    EXPECT_LE((contact_normal(SweptShape<TypeParam>(capsule), triangle) - normal).cwiseAbs().maxCoeff(),
              8 * std::numeric_limits<TypeParam>::epsilon());
  }
}

// A shape that moves by nothing does not find all that it overlaps:
// https://github.com/avianphysics/avian/issues/821. Its numbers could not be had.
TYPED_TEST(PublicShapeReports, shapes_at_rest_among_two_triangles) {
  const auto at = [](TypeParam z) { return Triangle<TypeParam>{{-8, -8, z}, {8, -8, z}, {0, 8, z}}; };
  const auto mesh = this->mesh_of({at(-1), at(1)});
  const TypeParam quarter{0.25};
  const typename TestFixture::Hits both{{0, quarter, 2 * quarter, 0, Feature::face, true},
                                        {0, quarter, 2 * quarter, 1, Feature::face, true}};
  const Vector3<TypeParam> origin{0, 0, 0};
  this->expect_hits(mesh, SweptSphere<TypeParam>{origin, origin, 3}, both);
  this->expect_hits(mesh, SweptSphere<TypeParam>{origin, origin, 1}, both);
  this->expect_hits(mesh, SweptBox<TypeParam>{origin, origin, {1, 1, 1}}, both);
  this->expect_hits(mesh, SweptCapsule<TypeParam>{origin, origin, {1, 0, 0}, 1}, both);
}

// A small ball is deflected by a corner that it falls past: https://github.com/avianphysics/avian/issues/990.
// Its numbers could not be had.
TYPED_TEST(PublicShapeReports, small_ball_that_falls_past_an_edge) {
  const auto mesh = this->mesh_of({{{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}}});
  const TypeParam radius{0x1p-6};
  const auto falling = [&](TypeParam x) { return SweptSphere<TypeParam>{{x, 0, 1}, {x, 0, -1}, radius}; };
  const TypeParam half{0.5};
  this->expect_hits(mesh, falling(radius), {{half, half, 0, 0, Feature::edge_ab, false}});
  this->expect_hits(mesh, falling(neighbour(radius, 1)), {});
}

// A square that falls onto a line misses it from one place, and hits it from both places next to it:
// https://github.com/dimforge/parry/issues/180. Here both have a depth, and the step is 64 of its velocities.
TYPED_TEST(PublicShapeReports, box_onto_a_long_strip_from_places_beside_each_other) {
  const auto mesh = this->mesh_of({{{1, 1, -8}, {124, 1, -8}, {124, 1, 8}}, {{1, 1, -8}, {124, 1, 8}, {1, 1, 8}}});
  std::set<TypeParam> times;
  for (const float x : {15.689464F, 15.689465F, 15.689466F}) {
    const Vector3<TypeParam> start = this->reported(x, 54.00709F, 0);
    const Vector3<TypeParam> end = start + TypeParam{64} * this->reported(0.0081385F, -0.999966F, 0);
    const SweptBox<TypeParam> box{start, end, {2, 2, 2}};
    const auto hits = this->true_hits(mesh, box);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_EQ(hits[0].triangle, 1U);
    EXPECT_NEAR(64 * hits[0].t, 51.00709 / 0.999966, 1e-4);
    times.insert(hits[0].t);
    this->expect_hits(mesh, box, hits);
  }
  // The strip is level, so x has no say in when they meet.
  EXPECT_EQ(times.size(), 1U);
}

// The larger what a ball falls onto, the earlier it is said to touch: https://github.com/dimforge/parry/issues/429
TYPED_TEST(PublicShapeReports, ball_onto_plates_of_up_to_a_kilometre) {
  std::set<TypeParam> times;
  for (const TypeParam size : {TypeParam{5}, TypeParam{50}, TypeParam{500}}) {
    const auto plate = this->mesh_of({{{-size, 0, -size}, {3 * size, 0, -size}, {-size, 0, 3 * size}}});
    const TypeParam place = size / 4;
    const SweptSphere<TypeParam> ball{
        {place, TypeParam{2.5}, place}, {place, TypeParam{-2.5}, place}, TypeParam{0.5166F}};
    const auto hits = this->true_hits(plate, ball);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_NEAR(hits[0].t, (2.5 - 0.5166) / 5, 1e-7);
    times.insert(hits[0].t);
    this->expect_hits(plate, ball, hits);
  }
  EXPECT_EQ(times.size(), 1U);
}

// Fast balls pass through a wall: https://github.com/avianphysics/avian/issues/940. Its numbers could not be had. Here
// a ball flies at the seam of a thin wall, up to half a million times as far as the wall is thick.
TYPED_TEST(PublicShapeReports, fast_balls_at_the_seam_of_a_thin_wall) {
  const TypeParam thick{0x1p-6};
  GeneratedMesh<TypeParam> mesh;
  for (const TypeParam x : {TypeParam{0}, thick}) {
    mesh.add({{x, -4, -4}, {x, 4, -4}, {x, 4, 4}});
    mesh.add({{x, -4, -4}, {x, 4, 4}, {x, -4, 4}});
  }
  const TypeParam half{0.5};
  const TypeParam radius{0.25};
  for (const TypeParam reach : {TypeParam{1}, TypeParam{4096}}) {
    const SweptSphere<TypeParam> there{{-reach, 0, 0}, {reach, 0, 0}, radius};
    const SweptSphere<TypeParam> back{{reach, 0, 0}, {-reach, 0, 0}, radius};
    const auto hits_of = [&](TypeParam near, TypeParam far, std::uint32_t first) {
      const auto t = [&](TypeParam way) { return (reach + way - radius) / (2 * reach); };
      return typename TestFixture::Hits{{t(near), 0, half, first, Feature::edge_ca, false},
                                        {t(near), half, 0, first + 1, Feature::edge_ab, false},
                                        {t(far), 0, half, 2 - first, Feature::edge_ca, false},
                                        {t(far), half, 0, 3 - first, Feature::edge_ab, false}};
    };
    this->expect_hits(mesh, there, hits_of(0, thick, 0));
    this->expect_hits(mesh, back, hits_of(-thick, 0, 2));
  }
}

// The same in a closed room, which a ball flies through in steps of up to 20,000 of its widths. Each step ends at
// the last free point, and the ball bounces.
TYPED_TEST(PublicShapeReports, fast_balls_in_a_closed_room) {
  const TypeParam size{8};
  GeneratedMesh<TypeParam> room;
  for (int axis = 0; axis < 3; ++axis) {
    for (const TypeParam side : {-size, size}) {
      const auto corner = [&](TypeParam x, TypeParam y) {
        Vector3<TypeParam> point;
        point[axis] = side;
        point[(axis + 1) % 3] = x;
        point[(axis + 2) % 3] = y;
        return point;
      };
      room.add({corner(-size, -size), corner(size, -size), corner(size, size)});
      room.add({corner(-size, -size), corner(size, size), corner(-size, size)});
    }
  }
  const Collider<TypeParam> collider(room.view());
  const TypeParam radius{0.25};
  for (const TypeParam speed : {TypeParam{1}, TypeParam{100}, TypeParam{10'000}}) {
    Vector3<TypeParam> place{0, 0, 0};
    Vector3<TypeParam> step = speed * Vector3<TypeParam>{1, 1, 1};  // Into a corner at first.
    std::size_t bounces = 0;
    for (int i = 0; i < 500; ++i) {
      const SweptSphere<TypeParam> ball{place, place + step, radius};
      const auto hit = collider.first_hit(ball);
      place = hit ? collider.last_free_point(ball, *hit) : ball.end;
      ASSERT_LT(place.cwiseAbs().maxCoeff(), size - radius) << "step " << i << ", " << hex_text(ball);
      if (!hit) continue;
      ++bounces;
      const Vector3<TypeParam> normal = contact_normal(SweptShape<TypeParam>(ball), collider.triangle(hit->triangle));
      step -= 2 * step.dot(normal) * normal;
      // No two bounces are alike.
      step += speed / 64 * Vector3<TypeParam>{1, static_cast<TypeParam>(i % 3), static_cast<TypeParam>(i % 5)};
      step *= speed / step.cwiseAbs().maxCoeff();
    }
    EXPECT_GE(bounces, 40U);
  }
}

// Where positions are doubles, queries were in float. So 10,000 km away, what grazes a shape by less than an ulp was
// missed, and a mover lost its small steps: https://github.com/erincatto/box3d, docs/large_worlds.md. Here a unit is a
// millimetre in double and an ulp in float, and answers are those at the origin.
TYPED_TEST(PublicShapeReports, shapes_ten_thousand_kilometres_away) {
  using Scalar = TypeParam;
  const Scalar unit = sizeof(Scalar) == 4 ? Scalar{1} : Scalar{0x1p-10};
  const Triangle<Scalar> ledge{{0, -64 * unit, 0}, {0, 64 * unit, 0}, {-64 * unit, 0, 0}};
  const Triangle<Scalar> wall{
      {8 * unit, -64 * unit, -64 * unit}, {8 * unit, 64 * unit, -64 * unit}, {8 * unit, 0, 64 * unit}};
  const ShapeHit<Scalar> grazing{Scalar{0.25}, 0, 0, 0, Feature::corner_a, false};
  const ShapeHit<Scalar> stopped{1, Scalar{0.25}, Scalar{0.5}, 0, Feature::face, false};
  for (const Scalar away : {Scalar{0}, Scalar{10'000'000}}) {
    const Vector3<Scalar> offset{away, away, 0};
    const auto expect = [&](const Triangle<Scalar>& triangle, const auto& shape, const auto& hits) {
      auto moved = shape;
      moved.start += offset;
      moved.end += offset;
      this->expect_hits(this->mesh_of({{triangle.a + offset, triangle.b + offset, triangle.c + offset}}), moved, hits);
      // The mesh is made of floats, and only its pose is far away.
      GeneratedMesh<float> local;
      local.add(
          {triangle.a.template cast<float>(), triangle.b.template cast<float>(), triangle.c.template cast<float>()});
      Scene<Scalar> scene;
      scene.add(std::make_shared<const Collider<float>>(local.view()), Pose<Scalar>::translated(offset));
      scene.commit();
      std::vector<SceneShapeHit<Scalar>> in_scene;
      scene.all_hits(moved, in_scene);
      ASSERT_EQ(in_scene.size(), hits.size());
      for (std::size_t i = 0; i < hits.size(); ++i)
        EXPECT_EQ(hex_text(ShapeHit<Scalar>(in_scene[i])), hex_text(hits[i]));
    };
    // 3² + 4² = 5²: along the edge of the ledge, from beyond its corner. There, it touches.
    SweptSphere<Scalar> passing{{3 * unit, -128 * unit, 4 * unit}, {3 * unit, 128 * unit, 4 * unit}, 5 * unit};
    expect(ledge, passing, typename TestFixture::Hits{grazing});
    passing.radius = neighbour(passing.radius, -1);
    expect(ledge, passing, typename TestFixture::Hits{});
    // A mover is two units in front of a wall. It makes a step of one unit, and then another one.
    for (const int from : {3, 4}) {
      const Vector3<Scalar> start{static_cast<Scalar>(from) * unit, 0, 0};
      const Vector3<Scalar> end = start + Vector3<Scalar>{unit, 0, 0};
      const auto hits = from == 4 ? typename TestFixture::Hits{stopped} : typename TestFixture::Hits{};
      expect(wall, SweptSphere<Scalar>{start, end, 3 * unit}, hits);
      expect(wall, SweptBox<Scalar>{start, end, {3 * unit, 2 * unit, 4 * unit}}, hits);
      expect(wall, SweptCapsule<Scalar>{start, end, {0, 0, 4 * unit}, 3 * unit}, hits);
    }
  }
}

}  // namespace
}  // namespace surehit::test::public_shape_reports_test
