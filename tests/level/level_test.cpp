#include "level/level.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <surehit/collider.hpp>

namespace surehit::example::level_test {
namespace {

/// FNV-1a over the bits of all vertices and triangles.
std::uint64_t hash_of(const Mesh<float>& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto take = [&hash](std::uint32_t bits) { hash = (hash ^ bits) * 0x100000001b3u; };
  for (const auto& vertex : mesh.vertices) {
    for (const float x : vertex) take(std::bit_cast<std::uint32_t>(x));
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) take(corner);
  }
  return hash;
}

TEST(Level, is_the_same_on_every_platform) { EXPECT_EQ(hash_of(build_level().mesh), 0xfe826125160626d2u); }

TEST(Level, is_valid_and_of_the_size_asked_for) {
  const auto triangles_at = [](float detail) {
    const Level level = build_level({detail});
    EXPECT_FALSE(find_invalid(level.mesh.view())) << detail;
    return level.mesh.triangles.size();
  };
  EXPECT_NEAR(static_cast<double>(triangles_at(0.01f)), 1'000, 100);
  EXPECT_GE(triangles_at(1), 50'000u);
  EXPECT_GE(triangles_at(3), 700'000u);
}

TEST(Level, has_no_triangle_without_area) {
  const Level level = build_level();
  const TriangleMeshViewf view = level.mesh.view();
  for (std::uint32_t i = 0; i < view.triangle_count(); ++i) {
    ASSERT_NE(normal(view, i), Vector3f::Zero()) << "triangle " << i;
  }
}

TEST(Level, eye_stands_in_the_hall) {
  const Level level = build_level();
  const Colliderf collider(level.mesh.view());
  const Vector3f eye(level.eye[0], level.eye[1], level.eye[2]);
  const auto floor = collider.first_hit(Rayf{eye, {0, 0, -1}});
  const auto ceiling = collider.first_hit(Rayf{eye, {0, 0, 1}});
  ASSERT_TRUE(floor && ceiling);
  EXPECT_EQ(floor->t, level.eye[2]);
  EXPECT_EQ(floor->side, Side::front);
  EXPECT_EQ(ceiling->t, 4 - level.eye[2]);
}

TEST(Level, walls_are_solid) {
  const Level level = build_level();
  const Colliderf collider(level.mesh.view());
  const auto below_eye_height = [&](float x, float y) {
    return collider.first_hit(Rayf{{x, y, level.eye[2]}, {0, 0, -1}});
  };
  EXPECT_EQ(below_eye_height(14, 18.5f)->side, Side::back) << "in the western wall";
  EXPECT_EQ(below_eye_height(36, 10)->side, Side::front) << "in the main door";
  EXPECT_EQ(below_eye_height(14, 22)->t, level.eye[2] - 0.875f) << "on a western windowsill";
}

}  // namespace
}  // namespace surehit::example::level_test
