#pragma once

#include <cstdint>
#include <optional>
#include <surehit/path.hpp>
#include <surehit/triangle.hpp>

namespace surehit::example {

/// What doubles say of a body on its way and a triangle.
enum class Verdict : std::uint8_t { free, touching, unsure };

struct CoreDistance {
  Verdict verdict = Verdict::unsure;
  double upper =
      0;  ///< The distance between two points of core and triangle: not below the true one, but for rounding.
};

/// Bounds the distance between a triangle and the parallelogram over which the core of a body sweeps. All numbers must
/// be finite and below 2^100 in size.
[[nodiscard]] CoreDistance core_distance(const Vector3f& from, const Vector3f& to, const Trianglef& triangle);

/// Decides the same in rational numbers: whether the distance is at most the radius. Returns nothing if the program was
/// built without GMP.
[[nodiscard]] std::optional<bool> touches_exactly(const Vector3f& from, const Vector3f& to, const Trianglef& triangle);

}  // namespace surehit::example
