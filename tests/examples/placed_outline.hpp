#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "outlines.hpp"
#include "support/random.hpp"

namespace surehit::test {

template <typename Scalar>
using Vertices = std::vector<std::array<Scalar, 3>>;
using Vector = std::array<double, 3>;

[[nodiscard]] inline double length_of(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// A plane in space. A place (x, y) goes to x u + y v + origin.
struct Plane {
  Vector u;
  Vector v;
  Vector origin;

  [[nodiscard]] Vector normal() const {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }
  [[nodiscard]] Vector at(const Place& place) const {
    Vector result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = static_cast<double>(place[0]) * u[i] + static_cast<double>(place[1]) * v[i] + origin[i];
    }
    return result;
  }
};

/// Returns a plane perpendicular to an axis, looked at from either side.
[[nodiscard]] Plane draw_axis_plane(Random& random);

/// Returns a plane in whole numbers, so that nothing is rounded.
[[nodiscard]] Plane draw_whole_plane(Random& random);

/// Returns any plane in which angles do not become too sharp.
[[nodiscard]] Plane draw_plane(Random& random);

/// Returns the outline in a plane, rounded where the plane makes it necessary.
template <typename Scalar>
[[nodiscard]] Vertices<Scalar> placed(const Outline& outline, const Plane& plane, int exponent = 0) {
  Vertices<Scalar> vertices;
  for (const Place& place : outline) {
    const Vector at = plane.at(place);
    vertices.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      vertices.back()[i] = std::scalbn(static_cast<Scalar>(at[i]), exponent);
    }
  }
  return vertices;
}

/// Returns the same with corners moved off the plane, by less than `height`. Those that coincide stay together.
template <typename Scalar>
[[nodiscard]] Vertices<Scalar> bent(const Outline& outline, const Plane& plane, double height, Random& random,
                                    int exponent = 0) {
  const Vector normal = plane.normal();
  const double length = length_of(normal);
  std::map<Place, double> heights;
  Vertices<Scalar> vertices;
  for (const Place& place : outline) {
    const double up = heights.try_emplace(place, height / length * random.symmetric<double>()).first->second;
    const Vector at = plane.at(place);
    vertices.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      vertices.back()[i] = std::scalbn(static_cast<Scalar>(at[i] + up * normal[i]), exponent);
    }
  }
  return vertices;
}

}  // namespace surehit::test
