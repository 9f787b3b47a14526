#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/default_init_allocator.hpp"
#include "support/float4.hpp"
#include "support/scratch_vector.hpp"

namespace surehit {

namespace detail {

/// A point counted in finest cells, in the lanes of a vector. The fourth lane is 0.
using PaddedPoint = Float4;
/// A box counted in finest cells.
struct PaddedBox {
  PaddedPoint low, high;
};

/// Pairs of a cell and a triangle that meet, triangle after triangle.
struct CellEntries {
  static constexpr std::size_t too_many = std::numeric_limits<std::size_t>::max();

  std::size_t count = 0;                        ///< The number of pairs, or `too_many` if there was no room.
  RoomyScratchVector<std::uint32_t> cells;      ///< The cell of each pair. Its size is the room.
  RoomyScratchVector<std::uint32_t> triangles;  ///< The triangle of each pair.

  /// Makes room for this many entries. The likely ones get their memory pages at once.
  void make_room(std::size_t entries, std::size_t likely = 0) {
    if (cells.size() >= entries) return;
    triangles.resize(entries);
    cells.resize(entries);  // Last: if it throws, its size still tells the room.
    fault_in(triangles.data(), likely * sizeof(std::uint32_t));
    fault_in(cells.data(), likely * sizeof(std::uint32_t));
  }
};

/// The triangle lists of some cells during a build.
struct CellLists {
  CellEntries entries;                     ///< The entries that are sorted into the lists.
  ScratchVector<std::uint32_t> offsets;    ///< The index where each cell's list begins, and one more for the end.
  ScratchVector<std::uint32_t> triangles;  ///< The lists, one after the other.
};

/// An inner grid that is still to be built.
struct PendingGrid {
  std::size_t first;    ///< The index of its first triangle in `GridScratch::inner_ids_`.
  std::size_t count;    ///< The number of its triangles.
  std::uint32_t depth;  ///< The number of grids around it.
};

}  // namespace detail

/// The memory that a build needs besides the grid. The next build can use it again.
class GridScratch {
 public:
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  template <typename Listed>
  friend class GridBuild;
  friend class Grid;

  detail::ScratchVector<detail::PaddedPoint> points_;  ///< The vertices.
  detail::ScratchVector<detail::PaddedBox> boxes_;     ///< The boxes of the triangles.
  std::array<detail::CellLists, 3>
      lists_;  ///< The lists of the top cells, and those of the current brick of each level.
  std::vector<detail::CellEntries> parts_;      ///< The entries of the top cells that each task of an executor found.
  detail::ScratchVector<std::uint32_t> words_;  ///< The words of the top cells.
  detail::ScratchVector<std::uint8_t> distances_;  ///< The distances through empty cells.
  std::vector<detail::PendingGrid> pending_;       ///< All inner grids, in the order in which they are built.
  std::vector<std::uint32_t> inner_ids_;           ///< The ids of the triangles of all inner grids.
  std::vector<std::uint32_t> current_ids_;         ///< Those of the inner grid that is built.
  std::size_t max_inner_ids_ = 0;                  ///< The maximum number of `inner_ids_`.
};

}  // namespace surehit
