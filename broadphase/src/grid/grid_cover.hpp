#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "support/float4.hpp"
#include "support/inlining.hpp"

namespace surehit {

class Grid;

/// A few boxes around all that a grid lists (L7 in WALK.md). They help if they leave out much of the mesh's box. This
/// is so in a level with a prop far from the rest, and for a mesh that is turned against the axes. A long path that
/// misses all boxes meets nothing. Any other path is walked from the first box that it enters to the last box that it
/// leaves. If the boxes leave out little, to test them costs more than it saves.
class GridCover {
 public:
  static constexpr std::size_t max_boxes = 8;
  /// Use the cover only if the occupied cells' silhouette, and the boxes' surface, are below this share of the grid's.
  /// Random lines hit a box in proportion to its surface.
  static constexpr float useful_share = 0.7F;

  /// A cover that is not useful.
  GridCover() = default;
  /// Takes time linear in the grid's cells.
  explicit GridCover(const Grid& grid);

  /// Returns false if the boxes leave out too little of the grid.
  [[nodiscard]] bool is_useful() const noexcept { return is_useful_; }

  /// The part of a path outside which it meets no box, from one tau to another. The part is empty if `enters` is
  /// greater than `leaves`.
  struct Part {
    float enters, leaves;
  };
  /// Returns the part of a path that runs from tau = 0 to `end`. The path is mirrored as `octant` says.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] Part part_of(const detail::Float4& start, const detail::Float4& inverse_rate,
                                                   std::uint32_t octant, float end) const noexcept {
    using namespace detail;
    const Sides& x = sides_[0][octant & 1];
    const Sides& y = sides_[1][octant >> 1 & 1];
    const Sides& z = sides_[2][octant >> 2 & 1];
    Float4 first = all_lanes(never);
    Float4 last = all_lanes(-never);
    for (std::size_t i = 0; i < max_boxes / 4; ++i) {
      const auto crosses = [&](const Float4& sides, std::size_t axis) {
        return (sides - start[axis]) * inverse_rate[axis];
      };
      const Float4 enters =
          max(max(crosses(x.near[i], 0), crosses(y.near[i], 1)), max(crosses(z.near[i], 2), all_lanes(0.0F)));
      const Float4 leaves =
          min(min(crosses(x.far[i], 0), crosses(y.far[i], 1)), min(crosses(z.far[i], 2), all_lanes(end)));
      const Int4 is_met = enters <= leaves;
      first = min(first, choose(is_met, enters, first));
      last = max(last, choose(is_met, leaves, last));
    }
    return {min_lane(first)[0], -min_lane(-last)[0]};
  }

 private:
  static constexpr float never =
      0x1p120F;  ///< Lies beyond every tau. It is the near side of a box that does not exist.

  /// The sides of all boxes on an axis, in finest cells. They are moved outward by one padding.
  struct Sides {
    std::array<detail::Float4, max_boxes / 4> near;
    std::array<detail::Float4, max_boxes / 4> far;
  };
  std::array<std::array<Sides, 2>, 3> sides_ =
      {};  ///< On each axis: the sides for a path that rises, then for one that falls.
  bool is_useful_ = false;
};

}  // namespace surehit
