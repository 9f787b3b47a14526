#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/default_init_allocator.hpp"
#include "support/float4.hpp"

namespace surehit {

namespace detail {

/// A point counted in finest cells, as long as a vector load; its fourth number is 0.
using PaddedPoint = Float4;
struct PaddedBox {
  PaddedPoint low, high;
};

/// Which triangles meet which cells, of all triangles in turn.
struct CellEntries {
  static constexpr std::size_t too_many = std::numeric_limits<std::size_t>::max();

  std::size_t count = 0;             ///< as far as the rest counts; `too_many` if there was no room
  RoomyVector<std::uint32_t> cells;  ///< as many as there is room for
  RoomyVector<std::uint32_t> triangles;

  /// So many of the entries are likely to be.
  void make_room(std::size_t entries, std::size_t likely = 0) {
    if (cells.size() >= entries) return;
    triangles.resize(entries);
    cells.resize(entries);  // last: where that throws, they still tell what room there is
    fault_in(triangles.data(), likely * sizeof(std::uint32_t));
    fault_in(cells.data(), likely * sizeof(std::uint32_t));
  }
};

/// Lists of triangles, one for each of some cells, while they are made.
struct CellLists {
  CellEntries entries;
  UnsetVector<std::uint32_t> offsets;    ///< where each cell's list begins, and one more for the end
  UnsetVector<std::uint32_t> triangles;  ///< the lists, one behind the other
};

}  // namespace detail

/// What a build needs besides the grid. Given to the next build, its memory is used again.
class GridScratch {
 public:
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  template <typename Scalar>
  friend class GridBuild;

  detail::UnsetVector<detail::PaddedPoint> points_;  ///< the vertices
  detail::UnsetVector<detail::PaddedBox> boxes_;     ///< the triangles'
  std::array<detail::CellLists, 3> lists_;    ///< of the top cells, and of the brick of each level that is being made
  std::vector<detail::CellEntries> parts_;    ///< of the top cells, where parts of the mesh are listed at once
  detail::UnsetVector<std::uint32_t> words_;  ///< the top cells' words
  detail::UnsetVector<std::uint8_t> distances_;  ///< through empty cells
};

}  // namespace surehit
