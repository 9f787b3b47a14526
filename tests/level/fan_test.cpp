#include "moving_platforms/fan.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace surehit::example::fan_test {
namespace {

constexpr float tangent_of_half = 0.1f;

TEST(Fan, turns_about_its_axis) {
  const Fan fan{{40, 36, 38}, 2, tangent_of_half};
  FanTurn turn;
  EXPECT_TRUE(turn.pose(fan).linear.isIdentity(0));
  const Vector3f point(1.5f, 0.25f, 0.5f);
  for (int step = 0; step < 1000; ++step) {
    const Posef before = turn.pose(fan);
    turn.advance(fan);
    const Posef after = turn.pose(fan);
    EXPECT_NEAR(after.linear.determinant(), 1, 1e-5);
    const Vector3f from = before.linear * point + before.translation;
    const Vector3f to = after.linear * point + after.translation;
    EXPECT_EQ(from.y(), to.y());
    EXPECT_LT((fan.motion_at(from) - (to - from)).norm(), 1e-4f) << step;
  }
}

TEST(Fan, has_four_blades_within_its_radius) {
  const Fan fan{{40, 36, 38}, 2, tangent_of_half};
  const Mesh<float> mesh = fan.mesh();
  EXPECT_EQ(mesh.triangles.size(), 8u);
  for (const auto& [x, y, z] : mesh.vertices) EXPECT_LE(Vector3f(x, 0, z).norm(), 2.05f);
}

}  // namespace
}  // namespace surehit::example::fan_test
