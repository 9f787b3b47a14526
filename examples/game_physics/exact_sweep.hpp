#pragma once

#include <surehit/collider.hpp>

#include "game_physics/sweep.hpp"
#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Asks the library: the exact first hit, and the last point before it that is exactly free.
class ExactSweep : public Sweep {
 public:
  explicit ExactSweep(const Mesh<float>& walls) : collider_(walls.view()) {}
  [[nodiscard]] std::optional<Contact> first_contact(const Segmentf& move) const override;

 private:
  Colliderf collider_;
};

}  // namespace surehit::example
