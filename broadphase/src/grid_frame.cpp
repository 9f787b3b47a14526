#include <algorithm>
#include <cmath>

#include "surehit/grid.hpp"

namespace surehit {

// The padding. In the frame, the mesh's box is [0, w] with w <= 1 on each axis; u = 2^-53. A point of a triangle and
// the place where a path is taken to be may each be off:
//  - a vertex by u (its difference to the origin is rounded; the scaling is exact), and by 2^-1074 if the scaling
//  underflows;
//  - what is left of a triangle after a cut by 5 u more: the weight of a crossing has three roundings, its place two.
//  There are
//    four cuts: with the vertices, below 32 u = 2^-48 in all;
//  - a path by up to `path_error` of grid_traversal.cpp, which is held below 2^-33.
// Together they are below 2^-32 = `padding`: a cell grown by it lists every triangle that a path, walking through that
// cell by rounded numbers, truly meets there. Cells are wider than 16 paddings.

constexpr double least_cell = 32 * GridFrame::padding;

template <typename Scalar>
GridFrame GridFrame::around(const Box<Scalar>& box, const std::array<double, 3>& wished_resolution) {
  GridFrame frame;
  // Exponent of the greatest extent; of the greatest coordinate if the box is a point.
  int largest = std::numeric_limits<int>::min();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis];
    const double high = box.high[axis];
    const double half_extent = high / 2 - low / 2;  // the whole one may overflow
    if (half_extent > 0) largest = std::max(largest, std::ilogb(half_extent) + 2);
  }
  const double coordinate = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  if (largest == std::numeric_limits<int>::min()) largest = coordinate > 0 ? std::ilogb(coordinate) + 1 : 0;
  frame.exponent = -largest;
  // A mesh that is thin beyond measure for where it stands is left small in its frame, in one cell, so that nothing
  // overflows.
  if (coordinate > 0) frame.exponent = std::min(frame.exponent, 1000 - std::ilogb(coordinate));

  // So that a path that touches the box walks inside the grid by rounded numbers too.
  constexpr double margin = 2 * padding;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    frame.origin[axis] = frame.scaled(box.low[i]);
    const double width = std::max((frame.scaled(box.high[i]) - frame.origin[axis]) + 2 * margin, least_cell);
    const double cells = std::clamp(std::floor(wished_resolution[axis]), 1.0, std::floor(width / least_cell));
    frame.low[axis] = -margin;
    frame.resolution[axis] = static_cast<std::uint32_t>(cells);
    frame.cell_size[axis] = width / cells;
  }
  return frame;
}

double GridFrame::scaled(double x) const noexcept { return std::ldexp(x, exponent); }

double GridFrame::plane(std::size_t axis, std::uint32_t index) const noexcept {
  return low[axis] + cell_size[axis] * index;
}

std::uint32_t GridFrame::cell_at(std::size_t axis, double x) const noexcept {
  const std::uint32_t last = resolution[axis] - 1;
  // Compared before it is converted: an out-of-range conversion to integer is undefined.
  const double guess = (x - low[axis]) / cell_size[axis];
  std::uint32_t index = guess < last ? (guess > 0 ? static_cast<std::uint32_t>(guess) : 0) : last;
  // The quotient may round up to the next cell. It never ends a cell too low: if x > plane(k), then fl(x - low) >=
  // fl(k cell_size), and that over cell_size rounds to k or more.
  while (index > 0 && x < plane(axis, index)) --index;
  return index;
}

template GridFrame GridFrame::around(const Box<float>&, const std::array<double, 3>&);
template GridFrame GridFrame::around(const Box<double>&, const std::array<double, 3>&);

}  // namespace surehit
