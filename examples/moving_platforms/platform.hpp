#pragma once

#include <cstdint>
#include <surehit/box.hpp>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// A solid that slides to and fro on a straight way, and waits at both ends. It consists of boxes.
///
/// Corners and ways are multiples of 1/1024. So each position is exact in float, and so is each difference of two.
struct Platform {
  enum class Kind : std::uint8_t { lift, door, train };

  Kind kind;
  std::vector<Boxf> boxes;  ///< about the platform's own origin
  Vector3f home;            ///< where this origin is at the first end
  Vector3f way;             ///< from there to the other end
  std::uint32_t steps;      ///< from one end to the other
  std::uint32_t pause;      ///< steps that it waits at an end
  std::uint32_t ahead;      ///< how many steps it is ahead of the others

  /// Where the origin is at the beginning of a step.
  [[nodiscard]] Vector3f position(std::uint32_t step) const;
  /// How far it moves during a step. The next position is exactly this position plus the motion.
  [[nodiscard]] Vector3f motion(std::uint32_t step) const { return position(step + 1) - position(step); }
  /// The boxes as triangles, normals outwards.
  [[nodiscard]] Mesh<float> mesh() const;
};

}  // namespace surehit::example
