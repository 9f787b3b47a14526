#include <gmpxx.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_text.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::placed_triangle_test {
namespace {

using Corner = std::array<mpq_class, 3>;

/// Returns the unit vector along (b - a) × (c - a) to many digits, or zero.
std::array<mpf_class, 3> precise_normal(const std::array<Corner, 3>& corners) {
  constexpr mp_bitcnt_t digits = 400;
  const auto& [a, b, c] = corners;
  std::array<mpq_class, 3> cross;
  for (std::size_t x = 0; x < 3; ++x) {
    const std::size_t y = (x + 1) % 3;
    const std::size_t z = (x + 2) % 3;
    cross[x] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
  }
  const mpf_class length =
      sqrt(mpf_class(mpq_class(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]), digits));
  std::array<mpf_class, 3> normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    normal[axis].set_prec(digits);
    if (length != 0) normal[axis] = mpf_class(cross[axis], digits) / length;
  }
  return normal;
}

/// Where the triangles of a scene are, as the scene says.
template <typename Scalar>
class PlacedTriangleOf : public testing::Test {
 protected:
  static constexpr double ulp = double{std::numeric_limits<Scalar>::epsilon()};

  /// Calls `visit(judged, id, triangle)` for the triangles of random scenes.
  template <typename Visit>
  static void visit_triangles(std::size_t scenes, const Visit& visit) {
    Random random(31);
    for (std::size_t i = case_count(scenes); i > 0; --i) {
      for (const SceneFamily family : all_scene_families) {
        const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
        const JudgedScene<Scalar> judged(drawn);
        for (std::size_t instance = 0; instance < judged.ids.size(); ++instance) {
          const std::size_t count = drawn.meshes[drawn.instances[instance].mesh].triangles.size();
          ASSERT_EQ(judged.scene.triangle_count(judged.ids[instance]), count);
          for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
            visit(judged, judged.ids[instance], triangle);
          }
        }
      }
    }
  }

  static bool is_same(const Vector3<Scalar>& left, const Vector3<Scalar>& right) {
    return same_bits(left[0], right[0]) && same_bits(left[1], right[1]) && same_bits(left[2], right[2]);
  }
};
TYPED_TEST_SUITE(PlacedTriangleOf, Scalars, ScalarNames);

TYPED_TEST(PlacedTriangleOf, corners_are_exact_and_rounded_once) {
  this->visit_triangles(30, [](const auto& judged, InstanceId id, std::uint32_t triangle) {
    const Triangle<TypeParam> placed = judged.scene.triangle(id, triangle);
    const Triangle<TypeParam> expected = judged.oracle.triangle(id, triangle);
    ASSERT_TRUE(TestFixture::is_same(placed.a, expected.a) && TestFixture::is_same(placed.b, expected.b) &&
                TestFixture::is_same(placed.c, expected.c))
        << hex_text(placed) << " is not " << hex_text(expected);
  });
}

TYPED_TEST(PlacedTriangleOf, normal_is_within_two_ulps) {
  this->visit_triangles(10, [](const auto& judged, InstanceId id, std::uint32_t triangle) {
    const Vector3<TypeParam> normal = judged.scene.normal(id, triangle);
    const auto precise = precise_normal(judged.oracle.corners(id, triangle));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mpf_class error = precise[axis] - double{normal[static_cast<Eigen::Index>(axis)]};
      ASSERT_LE(std::abs(error.get_d()), 2 * TestFixture::ulp) << hex_text(normal);
    }
  });
}

TYPED_TEST(PlacedTriangleOf, pose_that_was_set_last_places_it) {
  Scene<TypeParam> scene;
  const auto id = scene.add(stack_collider<TypeParam>(1));
  scene.set_motion(id, {1, 1, 1});
  EXPECT_EQ(scene.triangle(id, 0).b, (Vector3<TypeParam>{1, 0, 0}));
  scene.commit();
  auto pose = with_rows<TypeParam>({0, 0, 3}, {2, 0, 0}, {0, 1, 0});
  pose.translation = {4, 5, 6};
  scene.set_pose(id, pose);
  EXPECT_EQ(scene.triangle(id, 0).a, (Vector3<TypeParam>{4, 5, 6}));
  EXPECT_EQ(scene.triangle(id, 0).b, (Vector3<TypeParam>{4, 7, 6}));
  EXPECT_EQ(scene.triangle(id, 0).c, (Vector3<TypeParam>{4, 5, 7}));
  EXPECT_EQ(scene.normal(id, 0), (Vector3<TypeParam>{1, 0, 0}));
}

TYPED_TEST(PlacedTriangleOf, normal_of_a_mirrored_triangle_is_that_of_its_placed_corners) {
  Scene<TypeParam> scene;
  const auto id = scene.add(stack_collider<TypeParam>(1), with_rows<TypeParam>({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(scene.normal(id, 0), (Vector3<TypeParam>{0, 0, -1}));
}

TYPED_TEST(PlacedTriangleOf, normal_is_that_of_the_image_before_it_is_rounded) {
  // Far away, all corners round to the same point.
  const auto far = std::ldexp(TypeParam{1}, std::numeric_limits<TypeParam>::digits + 4);
  Scene<TypeParam> scene;
  const auto id = scene.add(stack_collider<TypeParam>(1), Pose<TypeParam>::translated({far, far, far}));
  EXPECT_EQ(scene.triangle(id, 0).a, scene.triangle(id, 0).b);
  EXPECT_EQ(scene.normal(id, 0), (Vector3<TypeParam>{0, 0, 1}));
}

TYPED_TEST(PlacedTriangleOf, box_contains_all_on_their_ways) {
  this->visit_triangles(10, [](const auto& judged, InstanceId id, std::uint32_t triangle) {
    const Box<TypeParam> box = judged.scene.box();
    const auto corners = judged.oracle.corners(id, triangle);
    const Vector3<TypeParam> motion = judged.scene.motion(id);
    for (const Corner& corner : corners) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const TypeParam way : {TypeParam{0}, motion[axis]}) {
          const mpq_class x = corner[static_cast<std::size_t>(axis)] + mpq_class(double{way});
          // An end of the box may be infinite, if no number is far enough.
          ASSERT_TRUE(!std::isfinite(box.low[axis]) || mpq_class(double{box.low[axis]}) <= x);
          ASSERT_TRUE(!std::isfinite(box.high[axis]) || mpq_class(double{box.high[axis]}) >= x);
        }
      }
    }
  });
}

TYPED_TEST(PlacedTriangleOf, box_of_translated_instances_is_the_smallest) {
  Scene<TypeParam> scene;
  const auto collider = stack_collider<TypeParam>(3);
  scene.add(collider, Pose<TypeParam>::translated({10, 20, 30}));
  const auto moving = scene.add(collider, Pose<TypeParam>::translated({-5, 0, 0}));
  scene.set_motion(moving, {0, -7, 100});
  scene.commit();
  const TypeParam few = 256 * std::numeric_limits<TypeParam>::epsilon();
  const auto box = scene.box();
  EXPECT_TRUE(box.low.isApprox(Vector3<TypeParam>{-5, -7, 0}, few)) << box.low;
  EXPECT_TRUE(box.high.isApprox(Vector3<TypeParam>{11, 21, 102}, few)) << box.high;
}

TYPED_TEST(PlacedTriangleOf, box_is_that_of_the_last_commit) {
  Scene<TypeParam> scene;
  const auto id = scene.add(stack_collider<TypeParam>(1));
  EXPECT_TRUE(scene.box().is_empty());
  scene.commit();
  scene.set_pose(id, at_height<TypeParam>(5));
  EXPECT_NEAR(scene.box().high[2], 0, 1e-6);
  scene.remove(id);
  scene.commit();
  EXPECT_TRUE(scene.box().is_empty());
}

template <typename Scalar>
class PoseOf : public testing::Test {};
TYPED_TEST_SUITE(PoseOf, Scalars, ScalarNames);

TYPED_TEST(PoseOf, default_one_moves_nothing) {
  const Pose<TypeParam> pose;
  EXPECT_EQ(pose.linear, Pose<TypeParam>::Matrix3::Identity());
  EXPECT_EQ(pose.translation, (Vector3<TypeParam>{0, 0, 0}));
}

TYPED_TEST(PoseOf, rigid_one_turns_as_its_quaternion_does) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    Eigen::Quaternion<double> q(random.symmetric<double>() + 2, random.symmetric<double>(), random.symmetric<double>(),
                                random.symmetric<double>());
    q.normalize();
    const Eigen::Quaternion<TypeParam> given = q.cast<TypeParam>();
    const auto pose = Pose<TypeParam>::rigid(given, {1, 2, 3});
    EXPECT_EQ(pose.translation, (Vector3<TypeParam>{1, 2, 3}));
    const Eigen::Matrix3d error = pose.linear.template cast<double>() - q.toRotationMatrix();
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 8 * double{std::numeric_limits<TypeParam>::epsilon()});
    const auto same =
        Pose<TypeParam>::rigid(std::array<TypeParam, 4>{given.x(), given.y(), given.z(), given.w()}, {1, 2, 3});
    EXPECT_EQ(same.linear, pose.linear);
  }
}

TYPED_TEST(PoseOf, half_turn_is_exact) {
  const auto pose = Pose<TypeParam>::rigid({0, 0, 1, 0}, {0, 0, 0});
  EXPECT_EQ(pose.linear, with_rows<TypeParam>({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}).linear);
}

/// A body that comes to rest has such rotations. Their true entries are 0, or as good as 0.
TYPED_TEST(PoseOf, rotations_that_are_nearly_none_are_valid) {
  const auto collider = std::make_shared<const Collider<TypeParam>>();
  Scene<TypeParam> scene;
  const auto expect_valid = [&](const Pose<TypeParam>& pose) {
    const InstanceResult added = scene.try_add(collider, pose);
    EXPECT_TRUE(added) << added.error().what();
  };
  for (const double size : {1e-3, 1e-9, 1e-10, 1e-15, 1e-17, 1e-20, 1e-30}) {
    const auto tiny = static_cast<TypeParam>(size);
    for (const std::array<TypeParam, 4>& q : {std::array<TypeParam, 4>{tiny, 0, 0, 1},
                                              {tiny, -tiny, 0, 1},
                                              {tiny, -tiny / 3, tiny * 3, 1},
                                              {1, tiny, 0, 0},
                                              {tiny, 1, tiny, tiny}}) {
      const auto pose = Pose<TypeParam>::rigid(q, {0, 0, 0});
      expect_valid(pose);
      expect_valid(pose.scaled(TypeParam(0.001)));
    }
    // Two quarter turns of computed sines and cosines.
    const Pose<TypeParam> turned = {with_rows<TypeParam>({tiny * tiny, -1, tiny}, {1, tiny, 0}, {0, 0, 1}).linear};
    expect_valid(turned.without_tiny_entries());
  }
}

TYPED_TEST(PoseOf, only_tiny_entries_become_0) {
  const TypeParam least = 0x1p-64;
  const TypeParam less = std::nextafter(least, TypeParam{0});
  const auto pose = with_rows<TypeParam>({1, least, less}, {-less, 1, -least}, {0, -0x1p-30, -1});
  EXPECT_EQ(pose.without_tiny_entries().linear,
            with_rows<TypeParam>({1, least, 0}, {0, 1, -least}, {0, -0x1p-30, -1}).linear);
}

TYPED_TEST(PoseOf, scaled_one_stretches_the_mesh_before_it_is_turned) {
  auto pose = with_rows<TypeParam>({0, -1, 0}, {1, 0, 0}, {0, 0, 1});
  pose.translation = {1, 2, 3};
  const auto scaled = pose.scaled({2, -3, TypeParam(0.1)});
  EXPECT_EQ(scaled.linear, with_rows<TypeParam>({0, 3, 0}, {2, 0, 0}, {0, 0, TypeParam(0.1)}).linear);
  EXPECT_EQ(scaled.translation, pose.translation);
  EXPECT_EQ(pose.scaled(4).linear, 4 * pose.linear);
}

}  // namespace
}  // namespace surehit::test::placed_triangle_test
