#pragma once

#include <cstdint>
#include <optional>
#include <surehit/hit.hpp>
#include <surehit/path.hpp>

namespace surehit::example {

/// What ends a straight move early.
struct Contact {
  std::uint32_t wall;  ///< the triangle
  Side side;           ///< from where the point arrived
  float t;             ///< the share of the move done
  Vector3f stop;       ///< where the point is to stop
};

/// A way to find out what a moving point runs into.
class Sweep {
 public:
  virtual ~Sweep() = default;
  [[nodiscard]] virtual std::optional<Contact> first_contact(const Segmentf& move) const = 0;
};

}  // namespace surehit::example
