#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game_physics/arena.hpp"

namespace surehit::example {

/// Tells exactly whether a course goes through a wall, and knows nothing of the library's queries.
///
/// In [32, 64] every float is an integer times 2^-18. So the signs of integer determinants say on which side of a plane
/// or of an edge a point lies, without rounding and without a tolerance.
class WallCheck {
 public:
  explicit WallCheck(const Arena& arena);

  /// Whether the straight way from one point to another, both ends included, touches a wall or leaves the room.
  [[nodiscard]] bool is_breach(const Vector3f& from, const Vector3f& to) const;

  /// The first piece of a course that is one: piece i leads from position i to position i + 1.
  [[nodiscard]] std::optional<std::size_t> first_breach(std::span<const Vector3f> positions) const;

 private:
  using Lattice = std::array<std::int64_t, 3>;

  struct Wall {
    std::array<Lattice, 3> corners;
    Lattice low;
    Lattice high;
  };

  static Lattice on_lattice(const Vector3f& point);
  static int side(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d);
  static bool touches(const Wall& wall, const Lattice& from, const Lattice& to);
  static bool touches_in_plane(const Wall& wall, const Lattice& from, const Lattice& to);

  Boxf room_;
  std::vector<Wall> walls_;
};

}  // namespace surehit::example
