#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/cell_word.hpp"
#include "grid/grid_cover.hpp"
#include "grid/grid_frame.hpp"
#include "support/default_init_allocator.hpp"
#include "surehit/box.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

class GridScratch;

/// A uniform grid over a mesh's box. A crowded cell is divided into a brick of 4 × 4 × 4 cells. A crowded cell of a
/// brick is divided in the same way. Each undivided cell lists the triangles that meet its box, grown by
/// `GridFrame::padding`.
///
/// A list never misses a triangle that meets the grown box. It has a triangle too many only because of rounding.
class Grid {
 public:
  static constexpr std::uint32_t brick_edge = 4;
  static constexpr std::uint32_t brick_size = brick_edge * brick_edge * brick_edge;
  /// Returns the position of a brick's cell in the brick. x counts first in the order of the cells.
  [[nodiscard]] static constexpr std::array<std::uint32_t, 3> position_in_brick(std::uint32_t cell) noexcept {
    return {cell % brick_edge, cell / brick_edge % brick_edge, cell / (brick_edge * brick_edge)};
  }
  static constexpr std::uint32_t max_levels = 2;

  /// A grid without cells.
  Grid() = default;

  /// Builds the grid of a valid mesh (see `find_invalid`) and its box. Time and memory are linear in the triangles,
  /// because the resolution is lowered until the lists fit a budget. The grid is the same with an executor as without.
  /// May throw std::bad_alloc.
  template <typename Scalar>
  Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
       const Executor* executor = nullptr);
  /// Becomes the grid of another mesh, and uses its memory again. If this throws, the grid can only be rebuilt or
  /// destroyed.
  template <typename Scalar>
  void rebuild(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
               GridScratch& scratch, const Executor* executor = nullptr);

  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  /// Returns a few boxes around all lists.
  [[nodiscard]] const GridCover& cover() const noexcept { return cover_; }
  /// Returns the number of top cells on each axis.
  [[nodiscard]] const std::array<std::uint32_t, 3>& resolution() const noexcept { return frame_.cells; }
  [[nodiscard]] bool is_empty() const noexcept { return entries_.empty(); }
  /// Returns the number of levels of bricks below the top cells. It is 0 if no cell is divided.
  [[nodiscard]] std::uint32_t levels() const noexcept { return levels_; }
  /// Returns the number of top cells and of cells in bricks.
  [[nodiscard]] std::size_t cell_count() const noexcept { return top_count_ + bricks_.size(); }
  /// Returns the number of entries of all lists, repetitions included.
  [[nodiscard]] std::size_t entry_count() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return (top_.capacity() + bricks_.capacity()) * sizeof(CellWord) + lists_.capacity() * sizeof(CellList) +
           entries_.capacity() * sizeof(std::uint32_t);
  }

  /// Returns the words of the top cells. x runs fastest, then y, then z.
  [[nodiscard]] std::span<const CellWord> top() const noexcept { return {top_.data(), top_count_}; }
  /// Returns the words of the cells of all bricks. Each brick has `brick_size` words, in the same order.
  [[nodiscard]] std::span<const CellWord> bricks() const noexcept { return bricks_; }
  /// Returns the triangle ids of all lists, one list after the other.
  [[nodiscard]] std::span<const std::uint32_t> entries() const noexcept { return entries_; }

  /// Returns all lists by their numbers, and one more that begins where the last list ends. Returns nothing if the mesh
  /// has no triangles.
  [[nodiscard]] std::span<const CellList> lists() const noexcept { return lists_; }
  /// Returns the index of the first entry of a cell's list.
  [[nodiscard]] std::size_t first_entry(CellWord word) const noexcept { return lists_[word.number()].first_entry; }
  /// Returns the number of triangles in a cell's list.
  [[nodiscard]] std::uint32_t entry_count(CellWord word) const noexcept {
    const CellList* list = lists_.data() + word.number();
    return list[1].first_entry - list[0].first_entry;
  }
  /// Returns the box of a cell's list.
  [[nodiscard]] CellBox box(CellWord word) const noexcept { return lists_[word.number()].box; }
  /// Returns the ids of the triangles that a cell lists, in ascending order.
  [[nodiscard]] std::span<const std::uint32_t> triangles(CellWord word) const noexcept {
    return {entries_.data() + first_entry(word), entry_count(word)};
  }

 private:
  template <typename Listed>
  friend class GridBuild;

  GridFrame frame_;
  GridCover cover_;
  std::uint32_t levels_ = 0;
  std::size_t top_count_ = 0;
  detail::UnsetVector<CellWord> top_;  ///< Longer than `top_count_`: a vector load may read beyond the last cell.
  std::vector<CellWord> bricks_;
  detail::UnsetVector<CellList> lists_;
  detail::UnsetVector<std::uint32_t> entries_;
};

}  // namespace surehit
