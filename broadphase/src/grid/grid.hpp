#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/cell_word.hpp"
#include "grid/grid_cover.hpp"
#include "grid/grid_frame.hpp"
#include "grid/main_grid.hpp"
#include "grid/packed_ids.hpp"
#include "support/default_init_allocator.hpp"
#include "support/inlining.hpp"
#include "surehit/box.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

class GridScratch;

namespace detail {
class GridReading;
}  // namespace detail

/// A uniform grid over a mesh's box. A crowded cell is divided into a brick of 4 × 4 × 4 cells. A crowded cell of a
/// brick is divided in the same way. Each undivided cell lists the triangles that meet its box, grown by
/// `GridFrame::padding`.
///
/// A list never misses a triangle that meets the grown box. It has a triangle too many only because of rounding.
///
/// A cell may hold thousands of triangles that are much smaller than it: a prop in a level. They have an inner grid,
/// with a frame of its own around them. The list of the cell has the other triangles. An inner grid may have inner
/// grids too. The cells, bricks, lists and entries of all these grids lie in the same arrays.
class Grid {
 public:
  static constexpr std::uint32_t brick_edge = 4;
  static constexpr std::uint32_t brick_size = brick_edge * brick_edge * brick_edge;
  /// Returns the position of a brick's cell in the brick. x counts first in the order of the cells.
  [[nodiscard]] static constexpr std::array<std::uint32_t, 3> position_in_brick(std::uint32_t cell) noexcept {
    return {cell % brick_edge, cell / brick_edge % brick_edge, cell / (brick_edge * brick_edge)};
  }
  static constexpr std::uint32_t max_levels = 2;
  static constexpr std::uint32_t max_unwalked = 32;
  static constexpr std::uint32_t max_depth = 4;  ///< The maximum number of inner grids that lie in each other.

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

  /// Returns the frame of the outermost grid.
  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  /// Returns the frames of all inner grids.
  [[nodiscard]] std::span<const GridFrame> inner_frames() const noexcept { return inner_frames_; }
  /// Returns the frame of the inner grid of a cell that has one.
  [[nodiscard]] const GridFrame& inner_frame(CellWord word) const noexcept {
    return inner_frames_[lists_[std::size_t{word.list()} + 1].box.bits()];
  }
  /// Returns the frame of a top cell, by its index in `all_top`.
  [[nodiscard]] const GridFrame& frame_of_top(std::size_t top) const noexcept {
    const auto next = std::partition_point(inner_frames_.begin(), inner_frames_.end(),
                                           [&](const GridFrame& frame) { return frame.first_top <= top; });
    return next == inner_frames_.begin() ? frame_ : *(next - 1);
  }
  /// Returns a few boxes around all lists of the outermost grid.
  [[nodiscard]] const GridCover& cover() const noexcept { return cover_; }
  /// Returns the inner grid that lists nearly all triangles, if there is one.
  [[nodiscard]] const MainGrid& main_grid() const noexcept { return main_grid_; }
  /// Returns its frame.
  [[nodiscard]] const GridFrame& main_frame() const noexcept { return inner_frames_[main_grid_.frame_index()]; }
  /// Returns the number of top cells of the outermost grid on each axis.
  [[nodiscard]] const std::array<std::uint32_t, 3>& resolution() const noexcept { return frame_.cells; }
  [[nodiscard]] bool is_empty() const noexcept { return entries_.empty(); }
  /// Returns true if there is one cell, which lists at most `max_unwalked` triangles. A path can ask them all in the
  /// time of a walk.
  [[nodiscard]] bool is_one_list() const noexcept { return is_one_list_; }
  /// Returns true if inner grids have more than three in four of all entries. Then the outermost grid is nearly empty,
  /// and a path goes through it in a few leaps.
  [[nodiscard]] bool is_mostly_inner() const noexcept { return is_mostly_inner_; }
  /// Returns the number of levels of bricks below the top cells. It is 0 if no cell is divided.
  [[nodiscard]] std::uint32_t levels() const noexcept { return levels_; }
  /// Returns the number of top cells and of cells in bricks.
  [[nodiscard]] std::size_t cell_count() const noexcept { return all_top().size() + bricks_.size(); }
  /// Returns the number of entries of all lists, repetitions included.
  [[nodiscard]] std::size_t entry_count() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return (top_.capacity() + bricks_.capacity()) * sizeof(CellWord) + lists_.capacity() * sizeof(CellList) +
           entries_.memory_bytes() + inner_frames_.capacity() * sizeof(GridFrame);
  }

  /// Returns the words of the top cells of the outermost grid. x runs fastest, then y, then z.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] std::span<const CellWord> top() const noexcept {
    return {top_.data(), top_count_};
  }
  /// Returns the words of the top cells of all grids. Those of a frame begin at its `first_top`.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] std::span<const CellWord> all_top() const noexcept {
    return {top_.data(), top_.empty() ? 0 : top_.size() - top_slack};
  }
  /// Returns the words of the cells of all bricks. Each brick has `brick_size` words, in the same order.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] std::span<const CellWord> bricks() const noexcept { return bricks_; }
  /// Returns the triangle ids of all lists, one list after the other.
  [[nodiscard]] const detail::PackedIds& entries() const noexcept { return entries_; }

  /// Returns all lists by their numbers, and one more that begins where the last list ends. Returns nothing if the mesh
  /// has no triangles. After the list of a cell with an inner grid comes an empty list. The bits of its box are the
  /// index of the inner grid's frame.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] std::span<const CellList> lists() const noexcept { return lists_; }
  /// Returns the index of the first entry of a cell's list.
  [[nodiscard]] std::size_t first_entry(CellWord word) const noexcept { return lists_[word.list()].first_entry; }
  /// Returns the number of triangles in a cell's list.
  [[nodiscard]] std::uint32_t entry_count(CellWord word) const noexcept {
    const CellList* list = lists_.data() + word.list();
    return list[1].first_entry - list[0].first_entry;
  }
  /// Returns the box of a cell's list.
  [[nodiscard]] CellBox box(CellWord word) const noexcept { return lists_[word.list()].box; }
  /// Returns the ids of the triangles that a cell lists, in ascending order.
  [[nodiscard]] detail::PackedIds::Range triangles(CellWord word) const noexcept {
    return entries_.between(first_entry(word), first_entry(word) + entry_count(word));
  }

 private:
  template <typename Listed>
  friend class GridBuild;
  friend class detail::GridReading;
  /// A vector load may read so many words beyond the last top cell.
  static constexpr std::size_t top_slack = 64;

  void shrink();
  /// Sets what follows from the frames, the cells, the lists and the entries. The outermost grid has so many entries.
  void complete(std::size_t outer_entries);

  GridFrame frame_;
  std::vector<GridFrame> inner_frames_;
  GridCover cover_;
  MainGrid main_grid_;
  std::uint32_t levels_ = 0;
  bool is_one_list_ = false;
  bool is_mostly_inner_ = false;
  std::size_t top_count_ = 0;
  detail::UnsetVector<CellWord> top_;  ///< Longer by `top_slack` than all top cells.
  std::vector<CellWord> bricks_;
  detail::UnsetVector<CellList> lists_;
  detail::PackedIds entries_;
};

}  // namespace surehit
