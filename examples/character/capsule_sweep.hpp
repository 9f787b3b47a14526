#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <surehit/path.hpp>

namespace surehit::example {

/// The body of a character: an upright capsule, half a metre wide and one and a half metres high.
struct Body {
  static constexpr float radius = 0.25f;
  static constexpr float half_height = 0.5f;  ///< From the centre to an end of the capsule's core.

  [[nodiscard]] static Vector3f half_axis() { return {0, 0, half_height}; }
};

/// What ends a way of a body early.
struct Stop {
  Vector3f position;        ///< Where the body stops.
  Vector3f normal;          ///< The unit normal at the touched point, from the level towards the body.
  bool is_on_edge = false;  ///< True if the normal is not that of the touched triangle, as on the edge of a stair.
};

/// Whether the normal of a contact is more than some degrees off that of the triangle.
[[nodiscard]] inline bool is_off_face(const Vector3f& contact_normal, const Vector3f& face_normal) {
  return std::abs(contact_normal.dot(face_normal)) < 0.999f;
}

/// A way to find out how far a body can go.
class CapsuleSweep {
 public:
  virtual ~CapsuleSweep() = default;
  /// Returns what stops the body on its straight way, or nothing if it arrives at `to`. Adds its queries to `queries`.
  [[nodiscard]] virtual std::optional<Stop> find_stop(const Vector3f& from, const Vector3f& to,
                                                      std::size_t& queries) const = 0;
};

}  // namespace surehit::example
