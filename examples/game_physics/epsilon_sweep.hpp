#pragma once

#include <vector>

#include "game_physics/sweep.hpp"
#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Does what games commonly do, for contrast. It uses Möller and Trumbore's test in plain float arithmetic, with the
/// epsilon of the paper's code. A stop is pushed off the wall by a skin, so the next move does not meet it again.
class EpsilonSweep : public Sweep {
 public:
  EpsilonSweep(const Mesh<float>& walls, float skin);
  [[nodiscard]] std::optional<Contact> first_contact(const Segmentf& move) const override;

 private:
  struct Wall {
    Vector3f a;
    Vector3f edge1;
    Vector3f edge2;
    Vector3f normal;
  };

  float skin_;
  std::vector<Wall> walls_;
};

}  // namespace surehit::example
