#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace surehit::test {

/// Empty space among cells, by looking at all of them.
class EmptyCubes {
 public:
  /// Cells of x lie side by side, then y, then z. Beyond the outermost all is empty, or all is not.
  EmptyCubes(std::vector<bool> empty, const std::array<std::uint32_t, 3>& cells, bool empty_beyond)
      : empty_(std::move(empty)), cells_(cells), empty_beyond_(empty_beyond) {}

  /// The edge of the largest empty cube up to `limit` that begins with the cell and extends in an octant of directions,
  /// downwards on axis k where bit k is set.
  [[nodiscard]] std::uint32_t largest(std::size_t cell, std::uint32_t octant, std::uint32_t limit) const {
    std::uint32_t edge = 0;
    while (edge < limit && is_empty_shell(cell, octant, edge)) ++edge;
    return edge;
  }

 private:
  /// What a cube has more than one of this edge.
  [[nodiscard]] bool is_empty_shell(std::size_t cell, std::uint32_t octant, std::uint32_t edge) const {
    const auto place = [&](std::uint32_t axis, std::size_t corner, std::uint32_t step) {
      const auto at = static_cast<std::int64_t>(corner);
      return (octant >> axis & 1) != 0 ? at - step : at + step;
    };
    for (std::uint32_t z = 0; z <= edge; ++z) {
      for (std::uint32_t y = 0; y <= edge; ++y) {
        for (std::uint32_t x = y == edge || z == edge ? 0 : edge; x <= edge; ++x) {
          if (!is_empty({place(0, cell % cells_[0], x), place(1, cell / cells_[0] % cells_[1], y),
                         place(2, cell / cells_[0] / cells_[1], z)})) {
            return false;
          }
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool is_empty(const std::array<std::int64_t, 3>& place) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (place[axis] < 0 || place[axis] >= cells_[axis]) return empty_beyond_;
    }
    return empty_[static_cast<std::size_t>((place[2] * cells_[1] + place[1]) * cells_[0] + place[0])];
  }

  std::vector<bool> empty_;
  std::array<std::uint32_t, 3> cells_;
  bool empty_beyond_;
};

}  // namespace surehit::test
