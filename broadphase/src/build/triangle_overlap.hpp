#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit::detail {

/// A point counted in finest cells.
using CellPoint = std::array<float, 3>;

/// A range of cells on each axis, from `low` to below `high`.
struct CellRange {
  std::array<std::uint32_t, 3> low;
  std::array<std::uint32_t, 3> high;

  [[nodiscard]] std::uint32_t length(std::size_t axis) const { return high[axis] - low[axis]; }
};

/// A triangle, made ready to be asked which padded boxes it meets: the test of separating axes (Akenine-Möller 2001),
/// with every rounding on the side of an overlap.
class TriangleOverlap {
 public:
  /// Corners within [0, 2^15] on each axis; boxes grow by `padding` on each side.
  TriangleOverlap(const std::array<CellPoint, 3>& corners, const CellPoint& padding);

  /// Whether it meets the padded box from `low` to `high`, which must overlap the triangle's own. Never false if it
  /// does; true for others only if they miss it by rounding.
  [[nodiscard]] bool meets(const CellPoint& low, const CellPoint& high) const;

 private:
  /// What the triangle covers of an axis that is square to an edge and to a coordinate axis k; the axis has the
  /// components `l` on k + 1 and `m` on k + 2.
  struct Shadow {
    float l, m;
    float low, high;
  };

  CellPoint padding_;
  std::array<Shadow, 9> shadows_;
  CellPoint normal_ = {};
  float height_ = 0;        ///< of the triangle's plane along the normal
  float height_slack_ = 0;  ///< by which that may be off
};

}  // namespace surehit::detail
