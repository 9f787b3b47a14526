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

  /// Returns the edge of the largest empty cube, up to `limit`, that begins with the cell and extends in an octant of
  /// directions. It extends downwards on axis k if bit k is set.
  [[nodiscard]] std::uint32_t largest(std::size_t cell, std::uint32_t octant, std::uint32_t limit) const {
    const Place corner = {static_cast<std::int64_t>(cell % cells_[0]),
                          static_cast<std::int64_t>(cell / cells_[0] % cells_[1]),
                          static_cast<std::int64_t>(cell / cells_[0] / cells_[1])};
    const Place step = {(octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1, (octant & 4) != 0 ? -1 : 1};
    std::uint32_t edge = 0;
    while (edge < limit && is_empty_shell(corner, step, edge)) ++edge;
    return edge;
  }

 private:
  using Place = std::array<std::int64_t, 3>;

  /// What a cube has more than one of this edge.
  [[nodiscard]] bool is_empty_shell(const Place& corner, const Place& step, std::int64_t edge) const {
    for (std::int64_t z = 0; z <= edge; ++z) {
      for (std::int64_t y = 0; y <= edge; ++y) {
        for (std::int64_t x = y == edge || z == edge ? 0 : edge; x <= edge; ++x) {
          if (!is_empty(corner[0] + x * step[0], corner[1] + y * step[1], corner[2] + z * step[2])) return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool is_empty(std::int64_t x, std::int64_t y, std::int64_t z) const {
    if (x < 0 || y < 0 || z < 0 || x >= cells_[0] || y >= cells_[1] || z >= cells_[2]) return empty_beyond_;
    return empty_[static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x)];
  }

  std::vector<bool> empty_;
  std::array<std::uint32_t, 3> cells_;
  bool empty_beyond_;
};

}  // namespace surehit::test
