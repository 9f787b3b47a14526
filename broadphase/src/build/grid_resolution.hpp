#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "build/listed_triangles.hpp"
#include "grid/grid.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/grid_options.hpp"

namespace surehit::detail {

/// The maximum number of top cells a triangle.
inline constexpr double cells_per_triangle_limit = 8;
/// A mesh of any size may have so many top cells.
inline constexpr double free_cells = 0x1p20;
/// The maximum number of top cells on an axis.
inline constexpr double max_cells_on_an_axis = 0x1p11;
/// Cells are cubes unless the triangles' mean box is longer on one axis than on another by more than this factor. A
/// lower factor would follow the error of the sample.
inline constexpr double min_stretch = 1.5;
/// The maximum factor between an edge of a cell and the mean of its edges.
inline constexpr double max_stretch = 2;
/// The minimum width of a cell, counted in the triangles' mean boxes. Below it, the number of cells is lowered in
/// proportion. More cells would be faster to walk, but fewer save memory.
inline constexpr double wide_cell = 2.55;
/// The number of triangles in the sample for their mean box.
inline constexpr std::size_t samples = 256;

/// Returns the mean edges of the boxes in the scaled frame. The sample is spread over all that is listed. It has no
/// period, because a mesh may have one.
template <typename Listed>
std::array<double, 3> mean_extent(const GridFrame& frame, const Listed& listed) {
  const std::size_t listed_count = listed.count();
  const std::size_t count = std::min(listed_count, samples);
  constexpr std::uint32_t golden_ratio = 0x9e3779b9;
  std::array<double, 3> mean = {0, 0, 0};
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t fraction = static_cast<std::uint32_t>(k) * golden_ratio;
    const std::size_t i =
        listed_count == count ? k : static_cast<std::size_t>(std::uint64_t{fraction} * listed_count >> 32);
    const std::array<double, 3> extent = listed.extent(frame, i);
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += extent[axis] / static_cast<double>(count);
  }
  return mean;
}

/// Returns the cube root of a number that is not below 0. It has the same bits on every platform. `std::cbrt` and
/// `std::pow` do not promise that.
inline double cube_root(double x) {
  if (!(x > 0) || std::isinf(x)) return x;
  int exponent = 0;
  std::frexp(x, &exponent);
  const int third = (exponent - (exponent % 3 + 3) % 3) / 3;
  const double scaled = std::ldexp(x, -3 * third);  // From 1/2 to below 4.
  double root = 1;
  for (int step = 0; step < 8; ++step) root -= (root - scaled / (root * root)) / 3;  // Newton's method.
  return std::ldexp(root, third);
}

/// Returns a resolution of cubic cells, at most `cells` of them. An axis that is thinner than a cell has one cell.
inline std::array<double, 3> cubic_resolution(const std::array<double, 3>& width, double cells) {
  std::array<double, 3> resolution = {1, 1, 1};
  std::array<bool, 3> divided = {true, true, true};
  for (int pass = 0; pass < 3; ++pass) {
    double volume = 1;
    int dimensions = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!divided[axis]) continue;
      volume *= width[axis];
      ++dimensions;
    }
    if (dimensions == 0) break;
    const double share = volume / cells;
    const double size = dimensions == 1 ? share : dimensions == 2 ? std::sqrt(share) : cube_root(share);
    bool is_final = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!divided[axis]) continue;
      resolution[axis] = width[axis] / size;
      if (!(resolution[axis] >= 1)) {  // NaN if all widths are 0.
        resolution[axis] = 1;
        divided[axis] = false;
        is_final = false;
      }
    }
    if (is_final) break;
  }
  return resolution;
}

/// Returns the resolution that the options wish for. Cells have the shape of the triangles' mean box: of all cells of
/// the same volume, triangles cross these least often. This holds because the sum of extent / edge over the axes has
/// its minimum where all quotients are equal. If cells are narrow for the triangles, each triangle is in many lists.
/// Then there are fewer cells.
template <typename Listed>
std::array<double, 3> wished_resolution(const GridFrame& frame, const Listed& listed, const GridOptions& options,
                                        double cells_left) {
  const std::array<double, 3> extent = mean_extent(frame, listed);
  const auto [shortest, longest] = std::minmax({extent[0], extent[1], extent[2]});
  const double mean = (extent[0] + extent[1] + extent[2]) / 3;
  const bool are_stretched = mean > 0 && longest > min_stretch * shortest;
  std::array<double, 3> width = scaled_extent(frame, listed.box().low, listed.box().high);
  for (std::size_t axis = 0; axis < 3; ++axis) {  // Stretched so that cells are cubes.
    if (are_stretched) width[axis] /= std::clamp(extent[axis] / mean, 1 / max_stretch, max_stretch);
  }
  const auto count = static_cast<double>(listed.count());
  const double usual_cells = std::max(1.0, GridOptions().cells_per_triangle * count);
  const std::array<double, 3> usual = cubic_resolution(width, usual_cells);
  const double usual_edge = *std::max_element(width.begin(), width.end()) /  // The edge on an axis that is divided.
                            *std::max_element(usual.begin(), usual.end());
  const double share = mean > 0 ? std::min(1.0, usual_edge / (wide_cell * mean)) : 1;
  double cells = std::max(1.0, share * options.cells_per_triangle * count);
  if (listed.count() <= Grid::max_unwalked && cells <= Grid::max_unwalked) cells = 1;
  std::array<double, 3> wished = cubic_resolution(width, cells);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (options.resolution[axis] != 0) wished[axis] = options.resolution[axis];
    wished[axis] = std::clamp(std::floor(wished[axis]), 1.0, max_cells_on_an_axis);
  }
  const double limit = std::min(std::max(free_cells, cells_per_triangle_limit * count), cells_left);
  while (wished[0] * wished[1] * wished[2] > limit) {
    double& finest = *std::max_element(wished.begin(), wished.end());
    finest = std::floor(finest / 2);
  }
  return wished;
}

}  // namespace surehit::detail
