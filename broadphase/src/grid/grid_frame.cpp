#include "grid/grid_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/rounding_flags.hpp"

namespace surehit {

// The padding must cover all roundings between a triangle and a path. R is the resolution of an axis in finest cells,
// and eps is the unit roundoff 2^-24. Everything that is counted in cells is rounded to float.
//
// - A vertex is off by 3 eps R: its difference to the origin, the product and the sum with the margin are rounded. None
//   of them exceeds R. For other frames and for double, it is off by eps R, because it is rounded to float only once.
// - The tests of `TriangleOverlap` and `find_overlaps` are off by less than 8 eps R.
// - A path that walks is off by less than 16 eps R (L8 and L9 in WALK.md). A path that visits all its cells at once is
//   off by less than 19 eps R (L5).
//
// In sum that is less than 32 eps R = 2^-19 R, which is the padding. So a cell grown by the padding lists every
// triangle that a path exactly meets while its walk visits the cell.

namespace {

/// The outer planes are this share of the grid's width away from the box. So a path that touches the box is in the
/// grid, even with roundings (L2).
constexpr double margin_share = 2 * double{GridFrame::padding_share};

/// An axis on which the scaled box is less wide than this is not divided. So a scaled coordinate that is off by 2^-42
/// is off by at most 2^-22 of the grid's width (L9 and L10 in WALK.md).
constexpr double min_width = 0x1p-20;

/// Returns x, rounded down to a float. So a product in float and a product in double have the same factor.
double float_below(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded > x ? std::nextafter(rounded, 0.0F) : rounded;
}

float nearest_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -largest, largest));
}

}  // namespace

template <typename Scalar>
GridFrame GridFrame::around(const Box<Scalar>& box, const std::array<double, 3>& wished_cells, std::uint32_t division) {
  GridFrame frame;
  frame.division = division;
  // The exponent of the maximum extent, or of the maximum coordinate if the box is a point.
  int largest = std::numeric_limits<int>::min();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis];
    const double high = box.high[axis];
    const double half_extent = high / 2 - low / 2;  // The whole extent may overflow.
    if (half_extent > 0) largest = std::max(largest, std::ilogb(half_extent) + 2);
  }
  const double coordinate = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  if (largest == std::numeric_limits<int>::min()) largest = coordinate > 0 ? std::ilogb(coordinate) + 1 : 0;
  frame.exponent = -largest;
  // A mesh may be extremely small for its distance from the origin. It is left small, in one cell, so that nothing
  // overflows.
  if (coordinate > 0) frame.exponent = std::min(frame.exponent, 1000 - std::ilogb(coordinate));

  frame.unit = {std::ldexp(1.0, frame.exponent / 2), std::ldexp(1.0, frame.exponent - frame.exponent / 2)};

  const auto max_cells = static_cast<double>(std::uint32_t{max_finest_cells / division});
  double finest = 0;
  std::array<double, 3> width = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    frame.origin[axis] = frame.scaled(box.low[i]);
    width[axis] = frame.scaled(box.high[i]) - frame.origin[axis];
    frame.cells[axis] = static_cast<std::uint32_t>(std::clamp(std::floor(wished_cells[axis]), 1.0, max_cells));
    const double resolution = frame.resolution(axis);
    frame.margin[axis] = static_cast<float>(margin_share * resolution);
    const double scale = (resolution - 2 * double{frame.margin[axis]}) / width[axis];
    frame.scale[axis] = scale;
    if (width[axis] >= min_width) finest = std::max(finest, scale);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (width[axis] >= min_width) continue;
    frame.cells[axis] = 1;
    const double resolution = division;
    frame.margin[axis] = static_cast<float>(margin_share * resolution);
    frame.scale[axis] = std::min(finest > 0 ? finest : 1.0, resolution / 2);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    frame.scale[axis] = float_below(frame.scale[axis]);
    frame.low[axis] = box.low[i];
    frame.high[axis] = box.high[i];
    // Two paddings on either side are at most a quarter of a finest cell.
    frame.cell_size[axis] = 1.25 * division / frame.scale[axis] / frame.unit[0] / frame.unit[1];
    frame.float_box_low[axis] = nearest_float(frame.low[axis]);
    frame.float_box_high[axis] = nearest_float(frame.high[axis]);
    frame.float_cell_size[axis] = nearest_float(frame.cell_size[axis]);
  }
  frame.begin_at(0);
  frame.coarsen(1);
  return frame;
}

void GridFrame::begin_at(std::uint32_t top) noexcept {
  first_top = top;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    TopOrder& order = top_orders[octant];
    order = {};
    std::uint32_t pitch = 1;
    std::uint32_t first = top;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const bool is_mirrored = (octant >> axis & 1) != 0;
      order.pitch[axis] = static_cast<std::int32_t>(is_mirrored ? -pitch : pitch);
      if (is_mirrored) first += pitch * (cells[axis] - 1);
      pitch *= cells[axis];
    }
    order.first = static_cast<std::int32_t>(first);
    for (std::uint32_t axes = 0; axes < 8; ++axes) {
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        if ((axes >> axis & 1) != 0) order.step[axes] += order.pitch[axis];
      }
    }
  }
}

void GridFrame::coarsen(std::uint32_t factor) noexcept {
  division /= factor;
  has_floats = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scale[axis] /= factor;
    margin[axis] /= static_cast<float>(factor);
    float_margin[axis] = margin[axis];
    float_stop[axis] = static_cast<float>(resolution(axis));
    const double unit_scale = scale[axis] * unit[0] * unit[1];
    const double low = origin[axis] / unit[0] / unit[1];
    float_scale[axis] = static_cast<float>(unit_scale);
    float_low[axis] = static_cast<float>(low);
    has_floats &= double{float_scale[axis]} == unit_scale && double{float_low[axis]} == low &&
                  scaled(low) == origin[axis] && unit_scale > 0x1p-60 && unit_scale < 0x1p60;
  }
}

template GridFrame GridFrame::around(const Box<float>&, const std::array<double, 3>&, std::uint32_t);
template GridFrame GridFrame::around(const Box<double>&, const std::array<double, 3>&, std::uint32_t);

}  // namespace surehit
