#pragma once

#include <cmath>
#include <surehit/path.hpp>

namespace surehit::example {

/// The direction in which a mirror reflects a ray. The normal has length 1.
[[nodiscard]] inline Vector3f reflected(const Vector3f& direction, const Vector3f& normal) {
  return direction - 2 * direction.dot(normal) * normal;
}

/// What becomes of a ray at a surface of glass.
struct Refraction {
  float reflected_share = 1;  ///< Fresnel's share of the light, for light that is not polarized; 1 for total reflection
  Vector3f direction = {0, 0, 0};  ///< of the light that goes through, of length 1; zero for total reflection
};

/// Snell's law and Fresnel's equations. Direction and normal have length 1, and the normal points against the ray.
/// `ratio` is the index of refraction before the surface, divided by the one behind it.
[[nodiscard]] inline Refraction refracted(const Vector3f& direction, const Vector3f& normal, float ratio) {
  const float cosine = -direction.dot(normal);
  const float squared_sine = ratio * ratio * (1 - cosine * cosine);
  if (squared_sine >= 1) return {};
  const float cosine_behind = std::sqrt(1 - squared_sine);
  const float across = (ratio * cosine - cosine_behind) / (ratio * cosine + cosine_behind);
  const float along = (cosine - ratio * cosine_behind) / (cosine + ratio * cosine_behind);
  const Vector3f behind = ratio * direction + (ratio * cosine - cosine_behind) * normal;
  return {(across * across + along * along) / 2, behind / behind.norm()};
}

/// Schlick's approximation of the share that a polished surface reflects, from the share at a right angle.
[[nodiscard]] inline float polished_share(float straight_share, float cosine) {
  const float rest = 1 - cosine;
  return straight_share + (1 - straight_share) * (rest * rest) * (rest * rest) * rest;
}

/// A number to the power of a whole number above 0. Platforms differ in `pow`, and do not in products.
[[nodiscard]] inline float whole_power(float base, int exponent) {
  float result = 1;
  for (; exponent > 0; exponent >>= 1, base *= base) {
    if ((exponent & 1) != 0) result *= base;
  }
  return result;
}

}  // namespace surehit::example
