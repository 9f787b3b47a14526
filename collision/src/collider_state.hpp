#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "build/grid_scratch.hpp"
#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "query/query.hpp"
#include "surehit/box.hpp"
#include "surehit/collider.hpp"

namespace surehit::detail {

/// The state of a collider. The collider has a pointer to it.
template <FloatOrDouble Scalar>
struct ColliderState {
  /// The memory of a rebuild. It makes the new mesh and the new grid here. At the end it exchanges them with those in
  /// use.
  struct Spare {
    MeshBlocks<Scalar> mesh;  ///< The next mesh.
    Grid grid;                ///< The next grid.
    GridScratch scratch;      ///< Other memory that the build of a grid needs.
  };

  MeshBlocks<Scalar> mesh;           ///< The collider's copy of the mesh.
  std::vector<std::uint32_t> masks;  ///< The mask of each triangle. It is empty if all masks have all bits.
  Box<Scalar> box;                   ///< The box of the mesh.
  Grid grid;                         ///< The grid of the mesh.
  GridOptions grid_options;          ///< The options that the grid was built with.
  Spare spare;                       ///< The memory of a rebuild.
  std::uint64_t version = 0;         ///< Differs for each build of any collider. It is 0 before a build.
  std::uint64_t mask_version = 0;    ///< Differs for each change of masks between builds. It is 0 before a change.
  /// The searches for the best instruction set. They are chosen when the collider is made.
  const Searches<Scalar>* searches = best_searches<Scalar>();

  /// Returns another number with each call.
  [[nodiscard]] static std::uint64_t next_version() noexcept;
  /// Loads a collider, which is as before after a failure. Returns what is wrong, or nothing. `base` is the index of
  /// the first byte in the whole file, if the collider is a part of it.
  [[nodiscard]] static std::optional<InvalidFile> load_into(Collider<Scalar>& collider,
                                                            std::span<const std::byte> bytes, std::size_t base,
                                                            const LoadOptions& options);
  /// Returns the state of a collider. Tests and benchmarks of its parts use it.
  [[nodiscard]] static const ColliderState& of(const Collider<Scalar>& collider) noexcept { return collider.state(); }
};

}  // namespace surehit::detail
