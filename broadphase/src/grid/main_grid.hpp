#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "support/float4.hpp"

namespace surehit {

class Grid;

/// An inner grid that lists nearly all triangles of a mesh, beside a few that lie far away or are much larger. A path
/// that misses the boxes around the others can be walked through this grid alone (L18 in WALK.md).
class MainGrid {
 public:
  /// The maximum number of boxes. To test more of them would cost more than it saves.
  static constexpr std::size_t max_boxes = 4;

  /// The corners of a box, in mesh units. The fourth lanes are 0.
  struct OtherBox {
    detail::Float4 low, high;
  };

  /// There is no such grid.
  MainGrid() = default;
  /// Looks for the main grid among the inner grids. Takes time linear in the cells of the outermost grid.
  explicit MainGrid(const Grid& grid);

  [[nodiscard]] bool exists() const noexcept { return exists_; }
  /// Returns whether it exists and paths of floats can be clipped to it in float.
  [[nodiscard]] bool takes_floats() const noexcept { return takes_floats_; }
  /// Returns the index of its frame among the inner frames.
  [[nodiscard]] std::size_t frame_index() const noexcept { return frame_index_; }
  /// Returns the boxes around all that the cells of the outermost grid list, and that is not in the main grid.
  [[nodiscard]] std::span<const OtherBox> boxes() const noexcept { return std::span(boxes_).first(box_count_); }

 private:
  bool exists_ = false;
  bool takes_floats_ = false;
  std::size_t frame_index_ = 0;
  std::size_t box_count_ = 0;
  std::array<OtherBox, max_boxes> boxes_ = {};
};

}  // namespace surehit
