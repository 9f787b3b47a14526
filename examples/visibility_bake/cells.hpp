#pragma once

#include <string>
#include <surehit/collider.hpp>
#include <vector>

namespace surehit::example {

/// How walkable places are found.
struct WalkOptions {
  float spacing = 1;      ///< The distance between the columns of places, along x and y.
  float headroom = 1.8f;  ///< What is free above a place.
  float max_slope = 1;    ///< A step from one column to the next rises or falls by up to this share of the spacing.
};

/// The floors of a mesh with z up, at the middle of each square of a grid in its plan. A floor faces upwards, is not
/// inside of a solid, and has headroom. The order is by row, by column, and then from top to bottom.
[[nodiscard]] std::vector<Vector3f> find_floors(const Colliderf& collider, const WalkOptions& options);

/// The floors that somebody who starts near a place can walk to: from column to column, not too steep, and with nothing
/// in the way. The order stays. Nothing is returned if there is no floor near the start.
[[nodiscard]] std::vector<Vector3f> reachable_floors(const Colliderf& collider, const std::vector<Vector3f>& floors,
                                                     const Vector3f& start, const WalkOptions& options);

/// Reads places from a text file: x, y and z in each line. Comments begin with #. Throws InputError, which names the
/// file and the line.
[[nodiscard]] std::vector<Vector3f> read_places(const std::string& path);

}  // namespace surehit::example
