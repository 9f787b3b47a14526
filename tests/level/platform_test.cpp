#include "moving_platforms/platform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "moving_platforms/hall.hpp"

namespace surehit::example::platform_test {
namespace {

bool is_on_lattice(const Vector3f& v) {
  return std::all_of(v.begin(), v.end(),
                     [](float x) { return 1024 * x == static_cast<float>(static_cast<int>(1024 * x)); });
}

TEST(Platform, moves_from_one_end_to_the_other_and_back) {
  const Platform lift{Platform::Kind::lift, {{{0, 0, 0}, {1, 1, 1}}}, {40, 40, 40}, {0, 0, 5}, 10, 3, 0};
  EXPECT_EQ(lift.position(0), Vector3f(40, 40, 40));
  EXPECT_EQ(lift.position(5), Vector3f(40, 40, 42.5f));
  for (const std::uint32_t step : {10u, 11u, 12u, 13u}) EXPECT_EQ(lift.position(step), Vector3f(40, 40, 45)) << step;
  EXPECT_EQ(lift.motion(11), Vector3f::Zero());
  EXPECT_EQ(lift.position(18), Vector3f(40, 40, 42.5f));
  EXPECT_EQ(lift.position(26), lift.position(0));
}

TEST(Platform, motions_are_exact) {
  for (const Platform& platform : build_hall().platforms) {
    for (std::uint32_t step = 0; step < Hall::period; ++step) {
      ASSERT_TRUE(is_on_lattice(platform.position(step)));
      ASSERT_EQ(platform.position(step) + platform.motion(step), platform.position(step + 1));
    }
    EXPECT_EQ(platform.position(Hall::period), platform.position(0));
    EXPECT_NE(platform.motion(10), platform.motion(30)) << "it moves";
  }
}

TEST(Platform, mesh_has_the_corners_of_its_boxes) {
  using Corner = std::array<float, 3>;
  for (const Platform& platform : build_hall().platforms) {
    std::set<Corner> corners;
    for (const Boxf& box : platform.boxes) {
      ASSERT_TRUE(is_on_lattice(box.low) && is_on_lattice(box.high));
      for (const float x : {box.low.x(), box.high.x()}) {
        for (const float y : {box.low.y(), box.high.y()}) {
          for (const float z : {box.low.z(), box.high.z()}) corners.insert({x, y, z});
        }
      }
    }
    const Mesh<float> mesh = platform.mesh();
    EXPECT_EQ(std::set<Corner>(mesh.vertices.begin(), mesh.vertices.end()), corners);
    EXPECT_EQ(mesh.triangles.size(), 12 * platform.boxes.size());
  }
}

/// The box around a platform on its way through a step, as another one sees it that moves meanwhile.
Boxf passed(const Platform& platform, std::uint32_t step, const Vector3f& motion_of_other) {
  const Vector3f from = platform.position(step);
  const Vector3f to = from + platform.motion(step) - motion_of_other;
  Boxf passed;
  for (const Boxf& box : platform.boxes) {
    for (const Vector3f& position : {from, to}) {
      passed.extend(box.low + position);
      passed.extend(box.high + position);
    }
  }
  return passed;
}

/// So there is always room for what is between two platforms.
TEST(Hall, no_platform_meets_another) {
  const Hall hall = build_hall();
  for (std::uint32_t step = 0; step < Hall::period; ++step) {
    for (std::size_t i = 0; i < hall.platforms.size(); ++i) {
      const Vector3f motion = hall.platforms[i].motion(step);
      const Boxf one = passed(hall.platforms[i], step, motion);
      for (std::size_t j = 0; j < i; ++j) {
        const Boxf other = passed(hall.platforms[j], step, motion);
        ASSERT_TRUE((one.high.array() < other.low.array()).any() || (other.high.array() < one.low.array()).any())
            << "step " << step << ", platforms " << i << " and " << j;
      }
    }
  }
}

}  // namespace
}  // namespace surehit::example::platform_test
