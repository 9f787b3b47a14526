#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "overlap_lanes.hpp"
#include "surehit/grid.hpp"
#include "triangle_overlap.hpp"

namespace surehit::detail {

/// Finds which cells of a box triangles meet, which come one by one. Their boxes are cut into blocks of cells, many of
/// which are asked at once whether they meet their triangle.
class CellLister {
 public:
  using Corners = std::array<PaddedPoint, 3>;

  /// Of `cells` that are `size` finest cells long. The entries, which outlive this, are complete once it is finished;
  /// if they may not grow, they are too many as soon as there is no room.
  CellLister(CellEntries& entries, bool may_grow, const CellRange& cells, std::uint32_t size, const CellPoint& padding);

  /// A triangle whose box, once it is padded, overlaps some of the cells. Entries keep the order in which triangles are
  /// added.
  void add(std::uint32_t triangle, const Corners& corners, const PaddedBox& box) {
    const Cell first = cell_of(box.low - padding_).max(first_);
    const Cell last = cell_of(box.high + padding_).min(last_);
    const Cell more = last - first;
    assert(more.minCoeff() >= 0);
    if (more.maxCoeff() > 1) {
      add_range(triangle, corners, first, last);
    } else {
      add_block(triangle, corners, first, more);
    }
  }

  void finish() { ask(); }

 private:
  /// Whole numbers.
  using Cell = PaddedPoint;

  /// Rounded towards 0, where it is not floor that counts: no cell lies below.
  [[nodiscard]] Cell cell_of(const PaddedPoint& point) const {
    Cell cell = point * per_size_;
    for (Eigen::Index k = 0; k < 4; ++k) cell[k] = static_cast<float>(static_cast<std::int32_t>(cell[k]));
    return cell;
  }

  /// Of one more cell on some axes, or none.
  void add_block(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& more) {
    for (std::size_t i = 0; i < 3; ++i) lanes_.corners[i][filled_] = corners[i];
    lanes_.low[filled_] = first;
    lanes_.more[filled_] = more;
    triangles_[filled_] = triangle;
    if (++filled_ == OverlapLanes::count) ask();
  }

  void add_range(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  void add_parts(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last,
                 const TriangleOverlap& overlap);
  void add_blocks(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  /// Asks what is in the lanes, and makes entries of the answers.
  void ask();

  OverlapLanes lanes_;
  OverlapLanes::Row<std::uint32_t> triangles_;
  std::size_t filled_ = 0;
  CellEntries& entries_;
  bool may_grow_;
  float size_;
  float per_size_;
  CellPoint cell_padding_;
  PaddedPoint padding_;
  Cell first_;
  Cell last_;
  CellOrder order_;
};

/// Sorts the entries of so many cells into lists, by counting.
void sort_entries(std::span<const CellEntries> parts, std::size_t cell_count, CellLists& lists);

}  // namespace surehit::detail
