#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "build/grid_scratch.hpp"
#include "grid/cell_word.hpp"
#include "grid/grid_cover.hpp"
#include "grid/grid_frame.hpp"
#include "support/default_init_allocator.hpp"
#include "surehit/box.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// A uniform grid over a mesh's box, in which crowded cells hold a brick of 4 × 4 × 4 cells of their own, and so on for
/// `levels` levels. Each undivided cell lists the triangles that meet the cell's box grown by `GridFrame::padding`.
///
/// Listing is conservative and about as tight as clipping each triangle to the cell: it never misses one that meets the
/// grown box, and is at most rounding wider.
class Grid {
 public:
  static constexpr std::uint32_t brick_edge = 4;
  static constexpr std::uint32_t brick_size = brick_edge * brick_edge * brick_edge;
  static constexpr std::uint32_t max_levels = 2;

  /// No cells.
  Grid() = default;

  /// Of a valid mesh (see `find_invalid`) and its box. Time and memory are linear in the triangles, for the resolution
  /// is lowered until the lists fit their budget. The grid is the same with an executor as without. May throw
  /// std::bad_alloc.
  template <typename Scalar>
  Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
       const Executor* executor = nullptr);
  /// Becomes the grid of another mesh, in the memory that it has. If that throws,
  /// the grid is good for another rebuild only.
  template <typename Scalar>
  void rebuild(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
               GridScratch& scratch, const Executor* executor = nullptr);

  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  /// Boxes around all lists.
  [[nodiscard]] const GridCover& cover() const noexcept { return cover_; }
  /// Top cells on each axis.
  [[nodiscard]] const std::array<std::uint32_t, 3>& resolution() const noexcept { return frame_.cells; }
  [[nodiscard]] bool is_empty() const noexcept { return entries_.empty(); }
  /// Levels of bricks below the top cells, 0 if none is divided.
  [[nodiscard]] std::uint32_t levels() const noexcept { return levels_; }
  /// Top cells, and the cells of all bricks.
  [[nodiscard]] std::size_t cell_count() const noexcept { return top_count_ + bricks_.size(); }
  /// Entries of all cells' lists together, repetitions included.
  [[nodiscard]] std::size_t entry_count() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return (top_.capacity() + bricks_.capacity()) * sizeof(CellWord) + lists_.capacity() * sizeof(CellList) +
           entries_.capacity() * sizeof(std::uint32_t);
  }

  /// Words of the top cells, x fastest, then y, then z.
  [[nodiscard]] std::span<const CellWord> top() const noexcept { return {top_.data(), top_count_}; }
  /// Words of the bricks' cells, `brick_size` a brick in the same order.
  [[nodiscard]] std::span<const CellWord> bricks() const noexcept { return bricks_; }
  /// All lists, one behind the other.
  [[nodiscard]] std::span<const std::uint32_t> entries() const noexcept { return entries_; }

  /// By their numbers, and one more that begins where the last one ends. None where there are no triangles.
  [[nodiscard]] std::span<const CellList> lists() const noexcept { return lists_; }
  /// Where a cell's list begins among the entries.
  [[nodiscard]] std::size_t first_entry(CellWord word) const noexcept { return lists_[word.number()].first_entry; }
  [[nodiscard]] std::uint32_t entry_count(CellWord word) const noexcept {
    const CellList* list = lists_.data() + word.number();
    return list[1].first_entry - list[0].first_entry;
  }
  [[nodiscard]] CellBox box(CellWord word) const noexcept { return lists_[word.number()].box; }
  /// Ids of the triangles that a cell lists, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles(CellWord word) const noexcept {
    return {entries_.data() + first_entry(word), entry_count(word)};
  }

 private:
  template <typename Scalar>
  friend class GridBuild;

  GridFrame frame_;
  GridCover cover_;
  std::uint32_t levels_ = 0;
  std::size_t top_count_ = 0;
  detail::UnsetVector<CellWord> top_;  ///< and as many more as one vector load may read beyond the last
  std::vector<CellWord> bricks_;
  detail::UnsetVector<CellList> lists_;
  detail::UnsetVector<std::uint32_t> entries_;
};

}  // namespace surehit
