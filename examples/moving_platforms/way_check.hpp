#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "moving_platforms/hall.hpp"

namespace surehit::example {

/// Tells exactly whether a piece that goes straight through a step touches a platform that moves meanwhile, and knows
/// nothing of the library's queries.
///
/// In [32, 64] every float is an integer times 2^-18. Seen from a platform, the way of a piece is straight, and the
/// boxes stand still. So a comparison of fractions of integers decides: no rounding, no tolerance.
class WayCheck {
 public:
  /// Throws std::invalid_argument if the hall cannot be checked in this way.
  explicit WayCheck(const Hall& hall);

  /// Looks at all platforms during this step.
  void set_step(std::uint32_t step);

  /// Whether the way through the step touches a platform, both ends included, or leaves the room.
  [[nodiscard]] bool is_breach(const Vector3f& from, const Vector3f& to) const;

 private:
  using Lattice = std::array<std::int64_t, 3>;

  struct MovingBox {
    Lattice low;
    Lattice high;
    Lattice motion;
  };

  static Lattice on_lattice(const Vector3f& point);
  [[nodiscard]] bool is_in_room(const Lattice& point) const;
  static bool touches(const MovingBox& box, const Lattice& from, const Lattice& to);

  const Hall& hall_;
  Lattice low_;
  Lattice high_;
  std::vector<MovingBox> boxes_;
};

}  // namespace surehit::example
