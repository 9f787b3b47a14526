#include "render/camera.hpp"

#include <gtest/gtest.h>

#include "mesh_io/input_error.hpp"

namespace surehit::example::camera_test {
namespace {

TEST(Camera, rays_follow_the_formula) {
  CameraOptions options;
  options.width = 8;
  options.height = 4;
  options.tangent_of_half_view = 0.5f;
  const Camera camera(options);
  // All numbers are exact. The aspect is 2.
  EXPECT_EQ(camera.ray(0, 0).direction, Vector3f(-0.875f, 0.375f, -1));
  EXPECT_EQ(camera.ray(7, 0).direction, Vector3f(0.875f, 0.375f, -1));
  EXPECT_EQ(camera.ray(4, 3).direction, Vector3f(0.125f, -0.375f, -1));
  EXPECT_EQ(camera.ray(4, 3).origin, options.eye);
}

TEST(Camera, looks_from_the_eye_to_the_target_with_up_upright) {
  CameraOptions options;
  options.eye = {10, 20, 30};
  options.target = {10, 25, 30};
  options.up = {0, 3, 2};
  options.width = options.height = 2;
  options.tangent_of_half_view = 1;
  const Camera camera(options);
  EXPECT_EQ(camera.ray(0, 0).origin, Vector3f(10, 20, 30));
  EXPECT_EQ(camera.ray(0, 0).direction, Vector3f(-0.5f, 1, 0.5f));
  EXPECT_EQ(camera.ray(1, 1).direction, Vector3f(0.5f, 1, -0.5f));
}

TEST(Camera, directions_have_length_1_if_asked) {
  CameraOptions options{.eye = {1, 2, 3}, .target = {4, -5, 6}, .up = {0, 0, 1}, .width = 7, .height = 5};
  const Camera as_is(options);
  options.length = DirectionLength::unit;
  const Camera unit(options);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 7; ++i) {
      const Vector3f direction = as_is.ray(i, j).direction;
      EXPECT_NEAR(unit.ray(i, j).direction.norm(), 1, 1e-6);
      EXPECT_GE(direction.norm(), 1 - 1e-6f);
      EXPECT_LT((unit.ray(i, j).direction - direction / direction.norm()).norm(), 1e-6f);
    }
  }
}

TEST(Camera, tells_the_place_of_a_point) {
  const Camera camera({.eye = {1, 2, 3}, .target = {4, -5, 6}, .up = {0, 0, 1}, .width = 70, .height = 50});
  for (const auto& [i, j] : {std::pair{0, 0}, {69, 3}, {31, 49}}) {
    const Rayf ray = camera.ray(i, j);
    const Eigen::Vector2f place = camera.place_of(ray.origin + 7 * ray.direction);
    EXPECT_NEAR(place.x(), static_cast<float>(i) + 0.5f, 1e-3);
    EXPECT_NEAR(place.y(), static_cast<float>(j) + 0.5f, 1e-3);
  }
}

TEST(Camera, knows_half_of_an_angle) {
  EXPECT_FLOAT_EQ(tangent_of_half(90), 1);
  EXPECT_FLOAT_EQ(tangent_of_half(60), 0.57735027f);
}

TEST(Camera, refuses_views_that_have_no_direction) {
  const auto make = [](const Vector3f& target, const Vector3f& up) { Camera({.target = target, .up = up}); };
  EXPECT_THROW(make({0, 0, 0}, {0, 1, 0}), InputError);
  EXPECT_THROW(make({0, 5, 0}, {0, 1, 0}), InputError);
  EXPECT_THROW(make({0, 5, 0}, {0, 0, 0}), InputError);
}

}  // namespace
}  // namespace surehit::example::camera_test
