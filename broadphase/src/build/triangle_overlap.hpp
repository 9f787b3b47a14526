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

/// A triangle that is prepared for tests against padded boxes. This is the test of separating axes (Akenine-Möller
/// 2001). Roundings may only cause an overlap too many.
class TriangleOverlap {
 public:
  /// Corners must lie in [0, 2^15] on each axis. Boxes grow by `padding` on each side.
  TriangleOverlap(const std::array<CellPoint, 3>& corners, const CellPoint& padding);

  /// Returns whether the triangle meets the padded box from `low` to `high`. The box must overlap the triangle's own
  /// box. The result is never false if they meet. It is true for a box that is missed only because of rounding.
  [[nodiscard]] bool meets(const CellPoint& low, const CellPoint& high) const;

 private:
  /// The interval that the triangle covers on an axis. This axis is normal to an edge and to a coordinate axis k.
  struct Shadow {
    float l, m;       ///< The components of the axis on k + 1 and k + 2.
    float low, high;  ///< The interval.
  };

  CellPoint padding_;
  std::array<Shadow, 9> shadows_;
  CellPoint normal_ = {};
  float height_ = 0;        ///< The height of the triangle's plane along the normal.
  float height_slack_ = 0;  ///< A bound on the error of that height.
};

}  // namespace surehit::detail
