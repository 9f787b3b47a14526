#pragma once

#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "surehit/box.hpp"
#include "surehit/collider.hpp"

namespace surehit::detail {

/// What a collider holds behind its pointer.
template <FloatOrDouble Scalar>
struct ColliderState {
  /// What a rebuild is made in. Then it takes the place of what was.
  struct Spare {
    MeshBlocks<Scalar> mesh;
    Grid grid;
    GridScratch scratch;
  };

  MeshBlocks<Scalar> mesh;
  std::vector<std::uint32_t> masks;  ///< one a triangle, or none if all bits are set for all
  Box<Scalar> box;
  Grid grid;
  GridOptions grid_options;
  Spare spare;

  /// The state of a collider, for tests and benchmarks of its parts.
  [[nodiscard]] static const ColliderState& of(const Collider<Scalar>& collider) noexcept { return collider.state(); }
};

}  // namespace surehit::detail
