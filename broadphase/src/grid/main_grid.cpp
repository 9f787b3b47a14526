#include "grid/main_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "grid/grid.hpp"
#include "grid/list_cells.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

/// Returns the number of top cells of a frame.
std::size_t cell_count(const GridFrame& frame) { return std::size_t{frame.cells[0]} * frame.cells[1] * frame.cells[2]; }

constexpr double largest = std::numeric_limits<float>::max();

/// Returns whether the mesh's box is within the range of float.
bool is_among_floats(const GridFrame& frame) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (frame.low[axis] < -largest || frame.high[axis] > largest) return false;
  }
  return true;
}

/// Returns a box that contains the box of a cell's list, but for what is outside of the mesh's box. Each side is moved
/// outward by one padding, and by more than the roundings of double.
MainGrid::OtherBox box_around(const Grid& grid, const detail::ListCell& cell) {
  const GridFrame& frame = grid.frame();
  const CellBox box = grid.box(cell.word);
  MainGrid::OtherBox around = {detail::all_lanes(0.0F), detail::all_lanes(0.0F)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double rounding = 0x1p-48 * (std::fabs(frame.origin[axis]) + 1);
    const auto unscaled = [&](std::uint32_t part, double outward) {
      const double padding = outward * frame.padding(axis);
      const double position = cell.low[axis] + static_cast<double>(part) / CellBox::parts * cell.size + padding;
      const double scaled = (position - double{frame.margin[axis]}) / frame.scale[axis] + frame.origin[axis];
      return (scaled + outward * rounding) / frame.unit[0] / frame.unit[1];
    };
    const double low = std::clamp(unscaled(box.low(axis), -1), frame.low[axis], largest);
    const double high = std::clamp(unscaled(box.high(axis), 1), -largest, frame.high[axis]);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto nearest_low = static_cast<float>(low);
    const auto nearest_high = static_cast<float>(high);
    around.low[axis] = double{nearest_low} > low ? std::nextafter(nearest_low, -infinity) : nearest_low;
    around.high[axis] = double{nearest_high} < high ? std::nextafter(nearest_high, infinity) : nearest_high;
  }
  return around;
}

}  // namespace

MainGrid::MainGrid(const Grid& grid) {
  if (!grid.is_mostly_inner()) return;
  std::size_t max_cells = 0;
  std::size_t lists = 0;
  std::array<detail::ListCell, max_boxes + 1> cells;
  std::size_t main = 0;
  detail::visit_list_cells(grid, grid.frame(), 0, grid.top().size(), [&](const detail::ListCell& cell) {
    if (lists < cells.size()) {
      cells[lists] = cell;
      if (cell.word.has_inner_grid()) {
        const std::size_t count = cell_count(grid.inner_frame(cell.word));
        if (count > max_cells) {
          max_cells = count;
          main = lists;
        }
      }
    }
    ++lists;
  });
  if (max_cells == 0 || lists > cells.size()) return;
  const GridFrame& frame = grid.inner_frame(cells[main].word);
  if (!is_among_floats(grid.frame())) return;
  for (std::size_t i = 0; i < lists; ++i) {
    const bool has_main = i == main;
    if (has_main && grid.entry_count(cells[i].word) == 0) continue;
    if (box_count_ == max_boxes) return;
    boxes_[box_count_++] = box_around(grid, cells[i]);
  }
  frame_index_ = static_cast<std::size_t>(&frame - grid.inner_frames().data());
  exists_ = true;
  takes_floats_ = frame.has_floats;
}

}  // namespace surehit
