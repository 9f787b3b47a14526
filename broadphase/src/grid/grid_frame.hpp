#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "support/float4.hpp"
#include "surehit/box.hpp"

namespace surehit {

/// Maps coordinates to cells. A coordinate x has the position X = (x 2^exponent - origin) scale + margin, counted in
/// finest cells. The planes between cells are the whole numbers from 0 to the resolution. grid_frame.cpp derives the
/// padding.
struct GridFrame {
  int exponent = 0;                          ///< 2^exponent scales the mesh's box to a size of about 1.
  std::array<double, 2> unit = {1, 1};       ///< Their product is 2^exponent. One double may not hold it.
  std::array<double, 3> origin = {0, 0, 0};  ///< The box's low corner, scaled.
  std::array<double, 3> scale = {0, 0, 0};   ///< The number of finest cells in a scaled unit. Each fits a float.
  std::array<float, 3> margin = {0, 0, 0};   ///< The distance from the box to the outer planes, in finest cells.
  std::array<double, 3> low = {0, 0, 0};     ///< The low corner of the mesh's box.
  std::array<double, 3> high = {0, 0, 0};    ///< The high corner of the mesh's box.
  /// An upper bound on the extent of a padded top cell, in mesh units (no bound if it is denormal).
  std::array<double, 3> cell_size = {0, 0, 0};
  std::array<std::uint32_t, 3> cells = {0, 0, 0};  ///< The number of top cells on each axis.
  std::uint32_t division = 1;                      ///< The number of finest cells along an edge of a top cell.
  std::uint32_t first_top = 0;                     ///< The index of top cell (0, 0, 0) among those of all frames.
  /// The indices of top cells for a path of one octant. Cells are mirrored, so that the path rises on every axis.
  struct TopOrder {
    std::array<std::int32_t, 3> pitch = {};  ///< The index grows by this to the next cell on an axis.
    std::int32_t first = 0;                  ///< The index of cell (0, 0, 0).
    /// The index grows by step[b] to the next cell on each axis k whose bit k is set in b.
    std::array<std::int32_t, 8> step = {};

    /// Returns the index of a mirrored cell. It uses scalars, because a vector product of integers is slow on x86.
    [[nodiscard]] std::int32_t index(detail::Int4 cell) const noexcept {
      return cell[0] * pitch[0] + cell[1] * pitch[1] + (cell[2] * pitch[2] + first);
    }
  };
  std::array<TopOrder, 8> top_orders;  ///< The order of each octant.
  /// If true, floats hold the numbers of the frame exactly. Then X = (x - float_low) float_scale + float_margin.
  bool has_floats = false;
  // In each vector below, the fourth lane is chosen so that it never stops a walk: its position is 1, between 0 and 2.
  detail::Float4 float_low = {0, 0, 0, 0};        ///< The box's low corner, in mesh units.
  detail::Float4 float_scale = {0, 0, 0, 0};      ///< The number of finest cells in a mesh unit.
  detail::Float4 float_margin = {0, 0, 0, 1};     ///< The same as `margin`.
  detail::Float4 float_stop = {0, 0, 0, 2};       ///< The resolution.
  detail::Float4 float_box_low = {0, 0, 0, 0};    ///< The nearest finite float to `low`.
  detail::Float4 float_box_high = {0, 0, 0, 0};   ///< The nearest finite float to `high`.
  detail::Float4 float_cell_size = {0, 0, 0, 0};  ///< The nearest finite float to `cell_size`.

  /// A cell's box is grown by this share of the grid's width, on each side, when triangles are listed.
  static constexpr float padding_share = 0x1p-19F;
  /// The maximum number of finest cells on an axis. So a finest cell is at least 16 paddings wide.
  static constexpr std::uint32_t max_finest_cells = std::uint32_t{1} << 15;

  /// Returns a frame around a box that is not empty. It has as many top cells on each axis as wished, if the padding
  /// allows it.
  template <typename Scalar>
  static GridFrame around(const Box<Scalar>& box, const std::array<double, 3>& wished_cells, std::uint32_t division);

  /// Returns x 2^exponent. It is exact, unless it overflows or underflows (by less than 2^-1073).
  [[nodiscard]] double scaled(double x) const noexcept { return x * unit[0] * unit[1]; }
  /// Returns the number of finest cells on an axis.
  [[nodiscard]] std::uint32_t resolution(std::size_t axis) const noexcept { return cells[axis] * division; }
  /// Sets `first_top`.
  void begin_at(std::uint32_t top) noexcept;
  /// Counts in cells that are longer by this factor, a power of two.
  void coarsen(std::uint32_t factor) noexcept;
  /// Returns the padding on an axis, in finest cells.
  [[nodiscard]] float padding(std::size_t axis) const noexcept {
    return padding_share * static_cast<float>(resolution(axis));
  }
  /// Returns X of a scaled coordinate, with three roundings of double.
  [[nodiscard]] double to_cells(std::size_t axis, double scaled_coordinate) const noexcept {
    return (scaled_coordinate - origin[axis]) * scale[axis] + double{margin[axis]};
  }
};

}  // namespace surehit
