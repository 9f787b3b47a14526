#pragma once

#include <surehit/path.hpp>

namespace surehit::example {

/// How long the directions of rays are.
enum class DirectionLength {
  to_image_plane,  ///< The direction leads to the plane at distance 1, so t counts along the axis of view.
  unit,            ///< t is the distance.
};

struct CameraOptions {
  Vector3f eye = {0, 0, 0};
  Vector3f target = {0, 0, -1};       ///< the point in the middle of the picture
  Vector3f up = {0, 1, 0};            ///< is upright in the picture, and need not be square to the view
  float tangent_of_half_view = 0.5f;  ///< half of the image plane's height, at distance 1
  int width = 640;
  int height = 480;
  DirectionLength length = DirectionLength::to_image_plane;
};

/// The tangent of half of an angle of view, which is given in degrees. For half of 2 arctan(1/2), it is 1/2.
[[nodiscard]] float tangent_of_half(float degrees);

/// A pinhole camera.
///
/// In the camera's own frame, the eye is at the origin, x is to the right and y is up. The ray of the pixel in column i
/// and row j goes through a point of the plane z = -1. Its x is (2 (i + 0.5) / width - 1) aspect scale, and its y is
/// (1 - 2 (j + 0.5) / height) scale. `scale` is the tangent of half of the angle of view.
class Camera {
 public:
  /// Throws InputError if the eye is at the target, if their distance is beyond float, or if `up` is along the view.
  explicit Camera(const CameraOptions& options);

  [[nodiscard]] int width() const { return options_.width; }
  [[nodiscard]] int height() const { return options_.height; }
  [[nodiscard]] Rayf ray(int column, int row) const;
  /// Where a point is in the picture, in pixels: its x to the right and its y down. The point must be in front of the
  /// eye.
  [[nodiscard]] Eigen::Vector2f place_of(const Vector3f& point) const;

 private:
  CameraOptions options_;
  float aspect_;
  Vector3f right_;
  Vector3f up_;
  Vector3f forward_;
};

}  // namespace surehit::example
