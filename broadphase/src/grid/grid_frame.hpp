#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "support/float4.hpp"
#include "surehit/box.hpp"

namespace surehit {

/// Where the cells are. A coordinate x stands at X = (x 2^exponent - origin) scale + margin, counted in the finest
/// cells: the planes between them are the whole numbers from 0 to the resolution. The bounds are derived in
/// grid_frame.cpp.
struct GridFrame {
  int exponent = 0;                          ///< brings the mesh's box to a size of about 1 first
  std::array<double, 2> unit = {1, 1};       ///< 2^exponent, as a product: one double may not hold it
  std::array<double, 3> origin = {0, 0, 0};  ///< the box's low corner, scaled
  std::array<double, 3> scale = {0, 0, 0};   ///< finest cells in a scaled unit of length: a float
  std::array<float, 3> margin = {0, 0, 0};   ///< by which the outer planes stand off the box
  std::array<double, 3> low = {0, 0, 0};     ///< the mesh's box
  std::array<double, 3> high = {0, 0, 0};    //
  /// More than two points of a top cell's box, grown by two paddings, are apart on an axis, but where it is a denormal.
  std::array<double, 3> cell_size = {0, 0, 0};
  std::array<std::uint32_t, 3> cells = {0, 0, 0};  ///< top cells on each axis
  std::uint32_t division = 1;                      ///< finest cells along an edge of a top cell
  /// How the top cells are numbered, as a path of one octant sees them: mirrored so that it rises on every axis.
  struct TopOrder {
    std::array<std::int32_t, 3> pitch = {};  ///< from one cell to the next on an axis
    std::int32_t first = 0;                  ///< the cell at place 0
    std::array<std::int32_t, 8> step = {};   ///< by the axes on which it leads to the next cell (bit k: axis k), in all

    /// In scalars: on x86 a product of vectors of integers takes three times as long, and a walk waits for it.
    [[nodiscard]] std::int32_t index(detail::Int4 cell) const noexcept {
      return cell[0] * pitch[0] + cell[1] * pitch[1] + (cell[2] * pitch[2] + first);
    }
  };
  std::array<TopOrder, 8> top_orders;  ///< by octant
  /// For coordinates in float, X = (x - float_low) float_scale + margin: the same frame, where floats hold its numbers.
  /// The fourth lane moves nothing: its place is 1, between 0 and 2.
  bool has_floats = false;
  detail::Float4 float_low = {0, 0, 0, 0};
  detail::Float4 float_scale = {0, 0, 0, 0};
  detail::Float4 float_margin = {0, 0, 0, 1};
  detail::Float4 float_stop = {0, 0, 0, 2};  ///< the resolution
  // `low`, `high` and `cell_size`, to the nearest float or the largest one.
  detail::Float4 float_box_low = {0, 0, 0, 0};
  detail::Float4 float_box_high = {0, 0, 0, 0};
  detail::Float4 float_cell_size = {0, 0, 0, 0};

  /// Of the grid's width on an axis: by so much is a cell's box grown on each side when triangles are listed.
  static constexpr float padding_share = 0x1p-19F;
  /// The finest cells on an axis are no more than this, so that they are 16 paddings wide or wider.
  static constexpr std::uint32_t max_finest_cells = std::uint32_t{1} << 15;

  /// Around a box that is not empty, with as many top cells on each axis as is wished and the padding allows.
  template <typename Scalar>
  static GridFrame around(const Box<Scalar>& box, const std::array<double, 3>& wished_cells, std::uint32_t division);

  /// x 2^exponent, exactly unless it underflows (by less than 2^-1073) or overflows.
  [[nodiscard]] double scaled(double x) const noexcept { return x * unit[0] * unit[1]; }
  /// Finest cells on an axis.
  [[nodiscard]] std::uint32_t resolution(std::size_t axis) const noexcept { return cells[axis] * division; }
  /// Counts in cells that are 1/factor as many, a power of two.
  void coarsen(std::uint32_t factor) noexcept;
  /// In finest cells.
  [[nodiscard]] float padding(std::size_t axis) const noexcept {
    return padding_share * static_cast<float>(resolution(axis));
  }
  /// X of a scaled coordinate. Three roundings of doubles.
  [[nodiscard]] double to_cells(std::size_t axis, double scaled_coordinate) const noexcept;
};

}  // namespace surehit
