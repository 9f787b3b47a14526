#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "collider_state.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::scene_shapes_test {
namespace {

/// Scenes of few digits: all placed corners are floats. So each pair can be asked about by `intersect`, which has
/// judges of its own.
template <typename Scalar>
class SceneShapes : public testing::Test {
 protected:
  using Shape = SweptShape<Scalar>;
  using Hits = std::vector<SceneShapeHit<Scalar>>;
  using Point = Vector3<Scalar>;
  struct Placed {
    InstanceId id;
    Point motion;
    std::vector<Triangle<Scalar>> triangles;
  };

  Scalar eighths(int reach) { return static_cast<Scalar>(random.between(-8 * reach, 8 * reach)) / 8; }
  Point point_of_eighths(int reach) {
    const Scalar x = eighths(reach);
    const Scalar y = eighths(reach);
    return {x, y, eighths(reach)};
  }

  void draw_scene(bool has_motion) {
    GeneratedMesh<Scalar> mesh;
    for (int i = 0; i < 12; ++i) {
      const Point a = point_of_eighths(2);
      const Point b = random.one_in(8) ? a : point_of_eighths(2);
      mesh.add({a, b, point_of_eighths(2)});
    }
    const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
    scene = Scene<Scalar>();
    placed.clear();
    for (int i = 0; i < 4; ++i) {
      // Now and then two instances are at the same place, so that all of their times are equal.
      const bool is_copy = i == 3 && random.one_in(4);
      const Pose<Scalar> pose =
          is_copy ? scene.pose(placed[0].id) : Pose<Scalar>{matrix_of_eighths<Scalar>(random), point_of_eighths(3)};
      placed.push_back({scene.add(collider, pose), Point::Zero(), {}});
      if (has_motion) placed.back().motion = random.one_in(4) ? Point::Zero() : point_of_eighths(2);
      scene.set_motion(placed.back().id, placed.back().motion);
      const auto image = [&](const Point& x) -> Point { return pose.linear * x + pose.translation; };
      for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
        const Triangle<Scalar> local = mesh.view().triangle(k);
        placed.back().triangles.push_back({image(local.a), image(local.b), image(local.c)});
      }
    }
    scene.commit();
  }

  Shape draw_shape() {
    const Point start = point_of_eighths(6);
    const Point end = random.one_in(8) ? start : Point(start + point_of_eighths(6));
    const auto size = [&] { return random.one_in(8) ? Scalar{0} : std::fabs(eighths(1)) * (random.one_in(4) ? 4 : 1); };
    switch (random.below(3)) {
      case 0:
        return SweptSphere<Scalar>{start, end, size()};
      case 1: {
        const Scalar x = size();
        const Scalar y = size();
        return SweptBox<Scalar>{start, end, {x, y, size()}};
      }
      default:
        return SweptCapsule<Scalar>{start, end, random.one_in(8) ? Point::Zero() : point_of_eighths(1), size()};
    }
  }

  static std::string kind_of(const Shape& shape) {
    constexpr const char* kinds[] = {"ball", "box", "capsule"};
    return kinds[shape.index()];
  }

  /// All that other queries answer follows from all hits.
  void expect_the_same(const Shape& shape, const Hits& all) const {
    const SceneShapeHit<Scalar> none;
    const auto first = scene.first_hit(shape);
    ASSERT_EQ(first.value_or(none), all.empty() ? none : all.front());
    ASSERT_EQ(scene.any_hit(shape), !all.empty());
    ASSERT_EQ(scene.overlaps(shape), !all.empty() && all.front().started_touching);
    const auto is_odd = [](const SceneShapeHit<Scalar>& hit) { return (hit.triangle + hit.instance.index) % 2 == 1; };
    ASSERT_EQ(scene.overlaps(shape, is_odd), std::any_of(all.begin(), all.end(), [&](const auto& hit) {
                return hit.started_touching && is_odd(hit);
              }));
    if (!first || first->started_touching) return;
    const Scalar free = scene.last_free_t(shape, *first);
    ASSERT_FALSE(scene.any_hit(shape, {.max_t = free}));
    ASSERT_TRUE(scene.any_hit(shape, {.max_t = std::nextafter(free, Scalar{2})}));
  }

  Random random{20261126};
  Scene<Scalar> scene;
  std::vector<Placed> placed;
};
TYPED_TEST_SUITE(SceneShapes, Scalars, ScalarNames);

TYPED_TEST(SceneShapes, of_placed_instances_have_the_bits_of_one_collider) {
  using Scalar = TypeParam;
  std::size_t touched = 0;
  for (std::size_t i = case_count(60); i > 0; --i) {
    this->draw_scene(false);
    GeneratedMesh<Scalar> all_triangles;
    for (const auto& instance : this->placed) {
      for (const auto& triangle : instance.triangles) all_triangles.add(triangle);
    }
    const Collider<Scalar> flat(all_triangles.view());
    const std::size_t count = this->placed[0].triangles.size();
    for (int k = 0; k < 15; ++k) {
      const auto shape = this->draw_shape();
      std::vector<SceneShapeHit<Scalar>> hits;
      std::vector<ShapeHit<Scalar>> expected;
      const auto culling = static_cast<Culling>(this->random.below(3));
      this->scene.all_hits(shape, hits, {.culling = culling});
      flat.all_hits(shape, expected, {.culling = culling});
      ASSERT_EQ(hits.size(), expected.size()) << this->kind_of(shape);
      for (std::size_t h = 0; h < hits.size(); ++h) {
        SceneShapeHit<Scalar> one{expected[h], this->placed[expected[h].triangle / count].id};
        one.triangle %= static_cast<std::uint32_t>(count);
        ASSERT_EQ(hits[h], one) << this->kind_of(shape) << ", scene " << i << ", hit " << h;
      }
      touched += hits.size();
      if (culling != Culling::none) continue;
      ASSERT_NO_FATAL_FAILURE(this->expect_the_same(shape, hits));
    }
  }
  EXPECT_GE(touched, case_count(900));
}

// Lists of a smooth mesh of floats have slabs. A placed shape leaves out lists that it does not come to by them.
TYPED_TEST(SceneShapes, of_placed_bowls_have_the_bits_of_one_collider) {
  using Scalar = TypeParam;
  using Point = Vector3<Scalar>;
  GeneratedMesh<Scalar> bowl;
  const auto at = [](int x, int y) {
    const int height = (x + 24) * (x + 24) + (y + 32) * (y + 32);
    return Point(static_cast<Scalar>(x) / 4, static_cast<Scalar>(y) / 4, static_cast<Scalar>(height) / 128);
  };
  for (int y = -16; y < 16; ++y) {
    for (int x = -16; x < 16; ++x) {
      bowl.add({at(x, y), at(x + 1, y), at(x, y + 1)});
      bowl.add({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  const auto collider = std::make_shared<Collider<Scalar>>(bowl.view());
  ASSERT_EQ(detail::ColliderState<Scalar>::of(*collider).mesh.has_slabs(), (std::is_same_v<Scalar, float>));
  const std::size_t count = bowl.triangles.size();
  std::size_t touched = 0;
  for (std::size_t i = case_count(10); i > 0; --i) {
    Scene<Scalar> scene;
    std::vector<InstanceId> ids;
    GeneratedMesh<Scalar> all_triangles;
    for (int k = 0; k < 2; ++k) {
      const Pose<Scalar> pose{matrix_of_eighths<Scalar>(this->random), this->point_of_eighths(3)};
      ids.push_back(scene.add(collider, pose));
      const auto image = [&](const Point& x) -> Point { return pose.linear * x + pose.translation; };
      for (std::size_t t = 0; t < count; ++t) {
        const Triangle<Scalar> local = bowl.view().triangle(t);
        all_triangles.add({image(local.a), image(local.b), image(local.c)});
      }
    }
    scene.commit();
    const Collider<Scalar> flat(all_triangles.view());
    for (int k = 0; k < 20; ++k) {
      auto shape = this->draw_shape();
      const Point near = all_triangles.view().triangle(this->random.below(2 * count)).a + this->point_of_eighths(1);
      std::visit(
          [&](auto& any) {
            any.end += near - any.start;
            any.start = near;
          },
          shape);
      std::vector<SceneShapeHit<Scalar>> hits;
      std::vector<ShapeHit<Scalar>> expected;
      scene.all_hits(shape, hits);
      flat.all_hits(shape, expected);
      ASSERT_EQ(hits.size(), expected.size()) << this->kind_of(shape);
      for (std::size_t h = 0; h < hits.size(); ++h) {
        SceneShapeHit<Scalar> one{expected[h], ids[expected[h].triangle / count]};
        one.triangle %= static_cast<std::uint32_t>(count);
        ASSERT_EQ(hits[h], one) << this->kind_of(shape) << ", scene " << i << ", hit " << h;
      }
      const SceneShapeHit<Scalar> none;
      ASSERT_EQ(scene.first_hit(shape).value_or(none), hits.empty() ? none : hits.front()) << this->kind_of(shape);
      touched += hits.empty() ? 0 : 1;
    }
  }
  EXPECT_GE(touched, case_count(50));
}

// Once a triangle is touched at the start, only lower ids of its instance count, and instances that come before it.
TYPED_TEST(SceneShapes, that_begin_with_a_contact_meet_few_candidates) {
  using Scalar = TypeParam;
  Random random(28);
  const auto mesh = rough_ground<Scalar>(100, Scalar(0.05), random);
  const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
  Scene<Scalar> scene;
  for (int i = 0; i < 4; ++i) scene.add(collider, Pose<Scalar>::translated({0, 0, static_cast<Scalar>(i) / 64}));
  scene.commit();
  QueryStatistics statistics;
  for (std::size_t i = 0; i < 20; ++i) {
    const Scalar x = random.symmetric<Scalar>() / 2;
    const Scalar y = random.symmetric<Scalar>() / 2;
    const SweptSphere<Scalar> ball{{x, y, 0}, {x, y, 1}, Scalar(0.25)};
    const auto hit = scene.first_hit(ball, {}, &statistics);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->started_touching);
  }
  EXPECT_LT(statistics.candidates, mesh.triangles.size());
  EXPECT_LT(statistics.undecided, 500U);
}

TYPED_TEST(SceneShapes, meet_moving_instances_as_they_see_them) {
  using Scalar = TypeParam;
  std::size_t touched = 0;
  for (std::size_t i = case_count(60); i > 0; --i) {
    this->draw_scene(true);
    for (int k = 0; k < 15; ++k) {
      const auto shape = this->draw_shape();
      std::vector<SceneShapeHit<Scalar>> expected;
      for (const auto& [id, motion, triangles] : this->placed) {
        auto seen = shape;
        std::visit([&, &by = motion](auto& any) { any.end -= by; }, seen);
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
          const auto hit = intersect(seen, triangles[t]);
          if (!hit) continue;
          expected.push_back({*hit, id});
          expected.back().triangle = t;
        }
      }
      std::vector<SceneShapeHit<Scalar>> hits;
      this->scene.all_hits(shape, hits);
      for (std::size_t h = 1; h < hits.size(); ++h) ASSERT_LE(hits[h - 1].t, hits[h].t);
      const auto by_ids = [](const auto& x, const auto& y) {
        return std::tie(x.instance, x.triangle) < std::tie(y.instance, y.triangle);
      };
      auto sorted = hits;
      std::sort(sorted.begin(), sorted.end(), by_ids);
      ASSERT_EQ(sorted, expected) << this->kind_of(shape) << ", scene " << i;
      touched += hits.size();
      ASSERT_NO_FATAL_FAILURE(this->expect_the_same(shape, hits));
    }
  }
  EXPECT_GE(touched, case_count(900));
}

// The corners of such a mesh are off by more than what the square of its size can hold.
TEST(SceneShapesOfDoubles, touch_triangles_whose_size_has_no_square) {
  for (const int exponent : {0, -300, -530, -560, -700, -900}) {
    const double s = std::ldexp(1.0, exponent);
    GeneratedMesh<double> mesh;
    mesh.add({{3 * s, s, -s}, {3 * s, s, s}, {-3 * s, -s, 0}});
    Scene<double> scene;
    Pose<double>::Matrix3 turned;
    turned << 1.0 / 3, -1, 0, 0, 1, 0, 0, 0, 1;
    scene.add(std::make_shared<const Collider<double>>(mesh.view()), Pose<double>{turned, Vector3d::Zero()});
    scene.commit();
    // At y = s / 2, the exact image of the triangle has this x, since 1.0 / 3 is below 1/3.
    const Vector3d centre = {std::ldexp(-s, -55), 0, 0};
    EXPECT_TRUE(scene.any_hit(SweptBox<double>{centre, centre, {0, s, s}})) << exponent;
    EXPECT_TRUE(scene.any_hit(SweptCapsule<double>{centre, centre, {0, s, 0}, 0})) << exponent;
  }
}

}  // namespace
}  // namespace surehit::test::scene_shapes_test
