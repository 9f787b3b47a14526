#include "walk/swept_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "grid/list_cells.hpp"
#include "support/inlining.hpp"

namespace surehit {
namespace {

/// The walk of one box, and how far it has come.
class Walk {
 public:
  explicit Walk(const SweptWalk& walk)
      : grid_(walk.grid), swept_(walk.swept), slabs_(walk.slabs), visitor_(walk.visitor), limit_(walk.limit) {}

  /// Walks through a grid and its inner grids. Returns false if the numbers are too large. Then nothing was visited.
  bool walk_frame(const GridFrame& frame) {
    std::array<Axis, 3> axes;
    if (!find_axes(frame, axes)) return false;
    walk_top(frame, axes);
    return true;
  }

  void walk_top_cell(const std::array<std::uint32_t, 3>& cell, CellWord word) {
    const GridFrame& frame = grid_.frame();
    std::array<Axis, 3> axes;
    if (!find_axes(frame, axes)) return;
    std::array<double, 3> low = {};
    Times times;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = static_cast<double>(cell[i]) * frame.division;
      times = axes[i].during(low[i], low[i] + frame.division).within(times);
    }
    if (!is_late(times)) walk_cell(axes, word, low, frame.division, times);
  }

  [[nodiscard]] std::uint64_t cells() const { return cells_; }

 private:
  static constexpr double too_large = 0x1p300;

  /// The times t during which the box meets something.
  struct Times {
    double enters = 0;  ///< The first t.
    double leaves = 1;  ///< The last t.
    [[nodiscard]] bool is_empty() const { return !(enters <= leaves); }
    [[nodiscard]] Times within(const Times& other) const {
      return {std::max(enters, other.enters), std::min(leaves, other.leaves)};
    }
  };

  /// The first and the last of some cells on one axis.
  using Range = std::array<std::int64_t, 2>;

  /// The way of the box on one axis, in finest cells.
  struct Axis {
    double start = 0;         ///< The centre at t = 0.
    double way = 0;           ///< The centre at t = 1 less that at t = 0.
    double inverse = 0;       ///< One over the way.
    double reach = 0;         ///< The half extent, and an allowance for all roundings (W1).
    std::uint32_t cells = 0;  ///< The number of top cells.
    std::uint32_t pitch = 0;  ///< The index of a top cell grows by this to the next cell.

    /// Returns the times during which the box meets the interval from `low` to `high` (W2).
    SUREHIT_ALWAYS_INLINE [[nodiscard]] Times during(double low, double high) const {
      const double first = (low - reach) - start;
      const double last = (high + reach) - start;
      if (std::fabs(way) < 0x1p-300) return first <= 0 && last >= 0 ? Times{} : Times{1, 0};
      const double s = first * inverse;
      const double t = last * inverse;
      return {std::max(0.0, std::min(s, t)), std::min(1.0, std::max(s, t))};
    }
    /// Returns the times during which the box meets a top cell, which has so many finest cells on an edge.
    [[nodiscard]] Times during_cell(std::int64_t cell, double size) const {
      return during(static_cast<double>(cell) * size, static_cast<double>(cell + 1) * size);
    }
    /// Returns a cell of a range, counted along the way.
    [[nodiscard]] std::int64_t cell(const Range& range, std::int64_t number) const {
      return way < 0 ? range[1] - number : range[0] + number;
    }
    /// Returns the number of a cell, counted along the way from the first one of a range.
    [[nodiscard]] std::int64_t number(const Range& range, std::int64_t cell) const {
      return way < 0 ? range[1] - cell : cell - range[0];
    }
    /// Returns so many cells, from the first one of a range along the way.
    [[nodiscard]] Range first_cells(const Range& range, std::int64_t count) const {
      return way < 0 ? Range{range[1] - count + 1, range[1]} : Range{range[0], range[0] + count - 1};
    }
    /// Returns when the box comes beyond a block, which begins with the first cell along the way (W5). On an axis
    /// without a way, that is never if the block has all cells that the box meets.
    [[nodiscard]] double comes_beyond(const Range& block, const Range& met, double size) const {
      if (std::fabs(way) < 0x1p-300) {
        return block[0] <= met[0] && met[1] <= block[1] ? std::numeric_limits<double>::infinity() : 0;
      }
      if (way < 0) return (static_cast<double>(block[0]) * size + reach - start) * inverse;
      return (static_cast<double>(block[1] + 1) * size - reach - start) * inverse;
    }
    /// Returns the first and the last top cell that the box meets during some times. `inverse_size` is one over the
    /// number of finest cells along a top cell, which is a power of two.
    SUREHIT_ALWAYS_INLINE [[nodiscard]] Range range(const Times& times, double inverse_size) const {
      const double a = start + way * times.enters;
      const double b = start + way * times.leaves;
      // Numbers below -1 count as -1, so the conversion, which cuts off, rounds down.
      const auto to_cell = [&](double x) {
        return static_cast<std::int64_t>(std::clamp(x * inverse_size, -1.0, static_cast<double>(cells)) + 1) - 1;
      };
      return {std::max<std::int64_t>(0, to_cell(std::min(a, b) - reach)),
              std::min<std::int64_t>(std::int64_t{cells} - 1, to_cell(std::max(a, b) + reach))};
    }
  };

  /// Sets the ways of the box in a frame. Returns false if the numbers are too large.
  [[nodiscard]] bool find_axes(const GridFrame& frame, std::array<Axis, 3>& axes) const {
    std::uint32_t pitch = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      Axis& axis = axes[i];
      axis.start = frame.to_cells(i, frame.scaled(swept_.start[i]));
      const double end = frame.to_cells(i, frame.scaled(swept_.end[i]));
      const double extent = frame.scaled(swept_.half_extents[i]) * frame.scale[i];
      const double largest = std::fabs(axis.start) + std::fabs(end) + extent + frame.resolution(i);
      if (!(largest < too_large)) return false;
      axis.way = end - axis.start;
      axis.inverse = 1 / axis.way;
      axis.reach = extent + double{frame.padding(i)} + largest * 0x1p-48;
      axis.cells = frame.cells[i];
      axis.pitch = pitch;
      pitch *= frame.cells[i];
    }
    return true;
  }

  /// Returns the octant of the way. There is no branch for a direction, because a processor cannot predict it.
  static std::uint32_t octant_of(const std::array<Axis, 3>& axes) {
    std::uint32_t octant = 0;
    for (std::size_t i = 0; i < 3; ++i) octant |= std::uint32_t{axes[i].way < 0} << i;
    return octant;
  }

  /// The axes in the order in which the walk goes through the top cells of a frame. It goes along the way on each axis.
  struct TopOrder {
    TopOrder(const GridFrame& frame, const std::array<Axis, 3>& axes)
        : frame(frame), axes(axes), octant(octant_of(axes)) {
      for (std::size_t i = 1; i < 3; ++i) {
        if (std::fabs(axes[order[i]].way) > std::fabs(axes[order[0]].way)) std::swap(order[0], order[i]);
      }
    }
    [[nodiscard]] const Axis& outer() const { return axes[order[0]]; }   ///< It goes from slab to slab on this axis.
    [[nodiscard]] const Axis& middle() const { return axes[order[1]]; }  ///< It goes from row to row.
    [[nodiscard]] const Axis& inner() const { return axes[order[2]]; }   ///< It goes along a row.

    const GridFrame& frame;
    const std::array<Axis, 3>& axes;
    std::array<std::size_t, 3> order = {2, 1, 0};
    std::uint32_t octant;  ///< The octant of the way.
  };

  /// A block of top cells.
  struct Block {
    Range slabs = {0, -1};
    Range rows = {0, -1};
    Range columns = {0, -1};

    [[nodiscard]] bool has_no_cells() const {
      return slabs[0] > slabs[1] || rows[0] > rows[1] || columns[0] > columns[1];
    }
    /// Returns true if another block is a part of this one.
    [[nodiscard]] bool has(const Block& other) const {
      const auto has_range = [](const Range& range, const Range& part) {
        return range[0] <= part[0] && part[1] <= range[1];
      };
      return has_range(slabs, other.slabs) && has_range(rows, other.rows) && has_range(columns, other.columns);
    }
  };

  /// Goes through the top cells, slab by slab along the longest way. Leaves out slabs in which all cells that the box
  /// meets are empty (W5).
  void walk_top(const GridFrame& frame, const std::array<Axis, 3>& axes) {
    if (stays_in_empty_cube(frame, axes)) return;
    const TopOrder top(frame, axes);
    const Axis& outer = top.outer();
    const double size = frame.division;
    const double inverse_size = 1 / size;
    const Range slabs = outer.range(until_limit(), inverse_size);
    Block empty;  // The last block of empty cells.
    for (std::int64_t step = 0; step <= slabs[1] - slabs[0] && !is_done(); ++step) {
      const std::int64_t slab = outer.cell(slabs, step);
      const Times in_slab = outer.during_cell(slab, size).within(until_limit());
      if (in_slab.is_empty()) continue;
      const Block met = {
          {slab, slab}, top.middle().range(in_slab, inverse_size), top.inner().range(in_slab, inverse_size)};
      if (met.has_no_cells() || empty.has(met)) continue;
      empty = walk_slab(top, met, in_slab);
      if (empty.has_no_cells()) continue;
      const double until =
          std::min({outer.comes_beyond(empty.slabs, slabs, size), top.middle().comes_beyond(empty.rows, met.rows, size),
                    top.inner().comes_beyond(empty.columns, met.columns, size)});
      if (until > until_limit().leaves) return;
      const std::int64_t next = outer.cell(outer.range({until, until}, inverse_size), 0);
      step = std::max(step, outer.number(slabs, next) - 1);
    }
  }

  /// Returns true if one cube of empty cells has all top cells that the box meets (W5). Most small steps are such.
  [[nodiscard]] bool stays_in_empty_cube(const GridFrame& frame, const std::array<Axis, 3>& axes) {
    const double inverse_size = 1.0 / frame.division;
    std::size_t first = frame.first_top;
    std::int64_t longest = 0;
    for (const Axis& axis : axes) {
      const Range range = axis.range(until_limit(), inverse_size);
      if (range[0] > range[1]) return true;
      first += static_cast<std::size_t>(axis.cell(range, 0)) * axis.pitch;
      longest = std::max(longest, range[1] - range[0] + 1);
    }
    const CellWord word = grid_.all_top()[first];
    if (!word.is_empty() || word.distance(octant_of(axes)) < longest) return false;
    ++cells_;
    return true;
  }

  /// Goes through a slab of top cells, row by row. The box meets its cells `met` during some times. If all of them are
  /// empty, returns a block of empty cells that begins with the first of them along the way and has them all. Else it
  /// returns a block without cells (W5).
  Block walk_slab(const TopOrder& top, const Block& met, const Times& in_slab) {
    std::int64_t depth = CellWord::max_distance;
    std::int64_t row = 0;
    std::int64_t columns = std::numeric_limits<std::int64_t>::max();
    while (row <= met.rows[1] - met.rows[0]) {
      const std::int64_t index = top.middle().cell(met.rows, row);
      const Times in_row = top.middle().during_cell(index, top.frame.division).within(in_slab);
      EmptyRow empty = {0, 0};
      if (!is_late(in_row)) empty = walk_row(top, {met.slabs[0], index}, in_row, met.columns);
      if (is_done()) return {};
      // The next rows are empty, too, where the cubes of this one are.
      row += std::max<std::int64_t>(empty.edge, 1);
      depth = std::min(depth, empty.edge);
      columns = std::min(columns, empty.columns);
    }
    if (depth == 0) return {};
    return {top.outer().first_cells(met.slabs, depth), top.middle().first_cells(met.rows, row),
            top.inner().first_cells(met.columns, columns)};
  }

  /// What is known of the cells of a row, if all that the box meets are empty.
  struct EmptyRow {
    std::int64_t edge;  ///< The minimum edge of the cubes of empty cells in the row. It is 0 if some cell is not empty.
    std::int64_t columns;  ///< The number of columns that these cubes have along the way.
  };

  /// Goes through a row of top cells. The row has a slab and a number in the slab.
  EmptyRow walk_row(const TopOrder& top, const std::array<std::int64_t, 2>& row, const Times& in_row,
                    const Range& columns) {
    const auto& [frame, axes, order, octant] = top;
    const CellWord* const words = grid_.all_top().data() + frame.first_top;
    const auto base =
        static_cast<std::size_t>(row[0]) * top.outer().pitch + static_cast<std::size_t>(row[1]) * top.middle().pitch;
    EmptyRow empty = {CellWord::max_distance, 0};
    while (empty.columns <= columns[1] - columns[0]) {
      const std::int64_t column = top.inner().cell(columns, empty.columns);
      ++cells_;
      const CellWord word = words[base + static_cast<std::size_t>(column) * top.inner().pitch];
      const std::int64_t edge = word.is_empty() ? word.distance(octant) : 0;
      empty.edge = std::min(empty.edge, edge);
      empty.columns += std::max<std::int64_t>(edge, 1);
      if (word.is_empty()) continue;
      std::array<double, 3> low = {};
      low[order[0]] = static_cast<double>(row[0]) * frame.division;
      low[order[1]] = static_cast<double>(row[1]) * frame.division;
      low[order[2]] = static_cast<double>(column) * frame.division;
      const Times times = top.inner().during_cell(column, frame.division).within(in_row);
      if (is_late(times)) continue;
      walk_cell(axes, word, low, frame.division, times);
      if (is_done()) break;
    }
    return empty;
  }

  /// Goes through a cell that is not empty, from the low corner on.
  void walk_cell(const std::array<Axis, 3>& axes, CellWord word, const std::array<double, 3>& low, double size,
                 const Times& times) {
    if (word.is_divided()) {
      walk_brick(axes, word, low, size / Grid::brick_edge, times);
      return;
    }
    const CellBox box = grid_.box(word);
    const double part = size / CellBox::parts;
    Times in_box = times;
    for (std::size_t i = 0; i < 3; ++i) {
      in_box = axes[i].during(low[i] + part * box.low(i), low[i] + part * box.high(i)).within(in_box);
    }
    if (!is_late(in_box) && meets_slab(axes, word, low, size, in_box)) visit_list(word);
    if (!word.has_inner_grid() || is_done()) return;
    if (!walk_frame(grid_.inner_frame(word))) visit_all_lists(grid_.inner_frame(word));
  }

  /// Returns false if the box does not come to the slab of a list during some times (W4).
  [[nodiscard]] bool meets_slab(const std::array<Axis, 3>& axes, CellWord word, const std::array<double, 3>& low,
                                double size, const Times& times) const {
    if (slabs_ == nullptr) return true;
    const CellSlab slab = slabs_[word.list()];
    double height = 0;
    double rate = 0;
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double normal = slab.normal(i);
      height += normal * (axes[i].start - (low[i] + size / 2));
      rate += normal * axes[i].way;
      reach += std::fabs(normal) * axes[i].reach;
    }
    const double enters = height + times.enters * rate;
    const double leaves = height + times.leaves * rate;
    const double step = CellSlab::step * size;
    return std::max(enters, leaves) >= slab.low() * step - reach &&
           std::min(enters, leaves) <= (slab.high() + 1) * step + reach;
  }

  /// Visits all lists of an inner grid in whose cells the box cannot be counted.
  void visit_all_lists(const GridFrame& frame) {
    const std::size_t tops = std::size_t{frame.cells[0]} * frame.cells[1] * frame.cells[2];
    detail::visit_list_cells(grid_, frame, 0, tops, [&](const detail::ListCell& cell) {
      if (!is_done()) visit_list(cell.word);
      if (cell.word.has_inner_grid() && !is_done()) visit_all_lists(grid_.inner_frame(cell.word));
    });
  }

  /// Goes through the cells of a brick. Each is met during the times of its column, row and layer.
  void walk_brick(const std::array<Axis, 3>& axes, CellWord word, const std::array<double, 3>& low, double size,
                  const Times& times) {
    const std::size_t first = std::size_t{word.brick()} * Grid::brick_size;
    std::array<std::array<Times, Grid::brick_edge>, 3> slabs;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::uint32_t k = 0; k < Grid::brick_edge; ++k) {
        slabs[i][k] = axes[i].during(low[i] + k * size, low[i] + (k + 1) * size);
      }
    }
    const auto turned = [&](std::size_t i, std::uint32_t k) { return axes[i].way < 0 ? Grid::brick_edge - 1 - k : k; };
    for (std::uint32_t c = 0; c < Grid::brick_edge; ++c) {
      const std::uint32_t z = turned(2, c);
      const Times in_layer = slabs[2][z].within(times);
      if (is_late(in_layer)) continue;
      for (std::uint32_t b = 0; b < Grid::brick_edge; ++b) {
        const std::uint32_t y = turned(1, b);
        const Times in_row = slabs[1][y].within(in_layer);
        if (is_late(in_row)) continue;
        for (std::uint32_t a = 0; a < Grid::brick_edge; ++a) {
          const std::uint32_t x = turned(0, a);
          const CellWord cell = grid_.bricks()[first + x + Grid::brick_edge * (y + Grid::brick_edge * z)];
          ++cells_;
          if (cell.is_empty()) continue;
          const Times in_cell = slabs[0][x].within(in_row);
          if (is_late(in_cell)) continue;
          walk_cell(axes, cell, {low[0] + x * size, low[1] + y * size, low[2] + z * size}, size, in_cell);
          if (is_done()) return;
        }
      }
    }
  }

  /// Returns the times that count.
  [[nodiscard]] Times until_limit() const { return {0, std::min(1.0, limit_)}; }
  /// Returns true if the box comes too late, or never. What it enters after the limit does not count (W3).
  [[nodiscard]] bool is_late(const Times& times) const { return times.is_empty() || times.enters > limit_; }

  void visit_list(CellWord word) { limit_ = visitor_.visit_list(word); }
  [[nodiscard]] bool is_done() const { return limit_ < 0; }

  const Grid& grid_;
  const SweptExtents& swept_;
  const CellSlab* const slabs_;
  SweptVisitor& visitor_;
  std::uint64_t cells_ = 0;  ///< The number of cells that were looked at.
  double limit_;             ///< Nothing counts beyond this t. It is negative if the visitor wants no more.
};

}  // namespace

bool SweptWalk::walk() const {
  Walk walk(*this);
  const bool could_walk = walk.walk_frame(grid.frame());
  cells += walk.cells();
  return could_walk;
}

void SweptWalk::walk_top_cell(const std::array<std::uint32_t, 3>& cell, CellWord word) const {
  Walk walk(*this);
  walk.walk_top_cell(cell, word);
  cells += walk.cells();
}

}  // namespace surehit
