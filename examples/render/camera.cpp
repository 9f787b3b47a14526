#include "render/camera.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

float tangent_of_half(float degrees) {
  return static_cast<float>(std::tan(double{degrees} * (std::numbers::pi / 360)));
}

Camera::Camera(const CameraOptions& options)
    : options_(options), aspect_(static_cast<float>(options.width) / static_cast<float>(options.height)) {
  const Vector3f view = options.target - options.eye;
  if (options.target == options.eye) throw InputError("the eye and the target are the same point");
  if (!(view.norm() > 0)) throw InputError("the eye and the target are too near to each other");
  if (!std::isfinite(view.norm())) throw InputError("the eye and the target are too far from each other");
  forward_ = view / view.norm();
  const Vector3f right = forward_.cross(options.up);
  if (!(right.norm() > 1e-6f * options.up.norm())) throw InputError("the camera looks straight along its upward axis");
  right_ = right / right.norm();
  up_ = right_.cross(forward_);
}

Rayf Camera::ray(int column, int row) const {
  const auto half_way = [](int pixel, int pixels) {
    return 2 * (static_cast<float>(pixel) + 0.5f) / static_cast<float>(pixels);
  };
  const float scale = options_.tangent_of_half_view;
  const float x = (half_way(column, options_.width) - 1) * aspect_ * scale;
  const float y = (1 - half_way(row, options_.height)) * scale;
  const Vector3f direction = x * right_ + y * up_ + forward_;
  const bool is_unit = options_.length == DirectionLength::unit;
  return {options_.eye, is_unit ? Vector3f(direction / direction.norm()) : direction};
}

Eigen::Vector2f Camera::place_of(const Vector3f& point) const {
  const Vector3f way = point - options_.eye;
  const float scale = options_.tangent_of_half_view * way.dot(forward_);
  const float x = way.dot(right_) / (aspect_ * scale);
  const float y = way.dot(up_) / scale;
  return {(x + 1) / 2 * static_cast<float>(options_.width), (1 - y) / 2 * static_cast<float>(options_.height)};
}

}  // namespace surehit::example
