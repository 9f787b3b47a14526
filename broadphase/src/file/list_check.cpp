#include "file/list_check.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "build/cell_lister.hpp"
#include "build/inner_grid_rule.hpp"
#include "build/listed_triangles.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The number of triangles whose cells are found before they are looked for in the lists. Their entries stay in the
/// cache.
constexpr std::size_t triangles_at_once = 512;

/// The cells of a grid, or those of a brick.
class Cells {
 public:
  Cells(const CellRange& cells, std::uint32_t edge, const CellWord* first)
      : range(cells),
        size(edge),
        words(first),
        columns_(static_cast<std::int32_t>(cells.length(0))),
        rows_(static_cast<std::int32_t>(cells.length(1))),
        per_column_(1.0 / columns_),
        per_row_(1.0 / rows_) {}

  CellRange range;        ///< Where they are, counted in cells.
  std::uint32_t size;     ///< Their edge, in finest cells.
  const CellWord* words;  ///< Their words.

  /// Returns the position of a cell, counted in cells. There are less than 2^25 cells, so a quotient is at least 2^-26
  /// away from the next whole number, and its rounding does not matter. Integers would be divided much slower.
  [[nodiscard]] std::array<std::int32_t, 3> position(std::uint32_t cell) const {
    const auto index = static_cast<std::int32_t>(cell);
    const auto row = static_cast<std::int32_t>((index + 0.5) * per_column_);
    const auto layer = static_cast<std::int32_t>((row + 0.5) * per_row_);
    return {static_cast<std::int32_t>(range.low[0]) + index - row * columns_,
            static_cast<std::int32_t>(range.low[1]) + row - layer * rows_,
            static_cast<std::int32_t>(range.low[2]) + layer};
  }

 private:
  std::int32_t columns_;
  std::int32_t rows_;
  double per_column_;
  double per_row_;
};

/// What was found so far in a grid and its inner grids.
struct Found {
  std::vector<std::uint32_t> counts;                  ///< For each list, the number of its entries.
  UnsetVector<PaddedBox> boxes;                       ///< For each list, the box around their triangles.
  std::vector<std::vector<std::uint32_t>> inner_ids;  ///< For each inner grid, its triangles.
  std::size_t spare_inner_ids;                        ///< The number of these that there may still be.
};

/// Checks the lists of a grid: of the outermost one, or of an inner one.
template <typename Listed>
class FrameCheck {
 public:
  using Kind = ListFault::Kind;

  FrameCheck(const Grid& grid, const GridFrame& frame, const Listed& listed, Found& found)
      : grid_(grid),
        frame_(frame),
        listed_(listed),
        found_(found),
        spare_pairs_(max_pairs_share * (grid.entry_count() + listed.count())) {
    for (std::size_t axis = 0; axis < 3; ++axis) padding_[axis] = frame.padding(axis);
  }

  /// Looks for each triangle in the list of each cell that it meets. `first_top` is the index of the first top cell.
  [[nodiscard]] bool has_all(std::size_t first_top) {
    const Cells cells({{0, 0, 0}, frame_.cells}, frame_.division, grid_.all_top().data() + first_top);
    return has_all_in(cells, listed_.count(), [](std::size_t i) { return static_cast<std::uint32_t>(i); });
  }
  /// Returns the first fault, if `has_all` is false.
  [[nodiscard]] const ListFault& fault() const { return fault_; }

 private:
  /// A triangle that meets a divided cell.
  struct Pair {
    std::uint32_t cell;
    std::uint32_t triangle;
  };
  /// Divided cells have at most this many times as many triangles as there are entries and triangles in all. More would
  /// need more entries, but for roundings.
  static constexpr std::size_t max_pairs_share = 8;

  /// The same for some triangles, whose numbers ascend: `number(i)` for each i below `count`.
  template <typename Number>
  bool has_all_in(const Cells& cells, std::size_t count, const Number& number) {
    std::vector<Pair> in_bricks;
    std::array<PaddedBox, triangles_at_once> boxes;
    for (std::size_t first = 0; first < count; first += triangles_at_once) {
      const std::size_t some = std::min(triangles_at_once, count - first);
      typename Listed::Lister lister(entries_, true, cells.range, cells.size, padding_);
      for (std::size_t i = 0; i < some; ++i) {
        const typename Listed::Shape shape = listed_.shape(number(first + i));
        boxes[i] = Listed::box_of(shape);
        lister.add(static_cast<std::uint32_t>(i), shape, boxes[i]);
        // More entries than the lists can have are not all found. So the memory is bounded.
        if (entries_.count > grid_.entry_count() + spare_pairs_) break;
      }
      lister.finish();
      for (std::size_t i = 0; i < entries_.count; ++i) {
        const std::uint32_t cell = entries_.cells[i];
        const std::uint32_t triangle = number(first + entries_.triangles[i]);
        const CellWord word = cells.words[cell];
        if (word.is_divided()) {
          if (spare_pairs_-- == 0) return fail({.kind = Kind::no_list, .triangle = listed_.id(triangle)});
          in_bricks.push_back({cell, triangle});
        } else if (!has(word, cells, cell, triangle, boxes[entries_.triangles[i]])) {
          return false;
        }
      }
    }
    return have_bricks_all(cells, std::move(in_bricks));
  }

  /// Goes on in the bricks of divided cells.
  bool have_bricks_all(const Cells& cells, std::vector<Pair> pairs) {
    // Sorted by bricks, which a build numbers in the order of their cells.
    const auto brick_of = [&](const Pair& pair) { return cells.words[pair.cell].brick(); };
    if (pairs.empty()) return true;
    const std::uint32_t first_brick = brick_of(*std::min_element(
        pairs.begin(), pairs.end(), [](const Pair& left, const Pair& right) { return left.cell < right.cell; }));
    std::vector<std::uint32_t> ends;
    for (const Pair& pair : pairs) {
      const std::size_t brick = brick_of(pair) - first_brick;
      if (brick >= ends.size()) ends.resize(brick + 1, 0);
      ++ends[brick];
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Pair> sorted(pairs.size());
    for (std::size_t i = pairs.size(); i-- > 0;) sorted[--ends[brick_of(pairs[i]) - first_brick]] = pairs[i];
    pairs = {};
    for (std::size_t first = 0; first < sorted.size();) {
      const std::uint32_t cell = sorted[first].cell;
      std::size_t last = first;
      while (last < sorted.size() && sorted[last].cell == cell) ++last;
      constexpr std::uint32_t edge = Grid::brick_edge;
      const std::array<std::int32_t, 3> position = cells.position(cell);
      CellRange range;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        range.low[axis] = static_cast<std::uint32_t>(position[axis]) * edge;
        range.high[axis] = range.low[axis] + edge;
      }
      const CellWord* const words = grid_.bricks().data() + std::size_t{cells.words[cell].brick()} * Grid::brick_size;
      const Cells brick(range, cells.size / edge, words);
      const auto number = [&](std::size_t i) { return sorted[first + i].triangle; };
      if (!has_all_in(brick, last - first, number)) return false;
      first = last;
    }
    return true;
  }

  /// Looks for a triangle in the list of a cell, which is not divided.
  bool has(CellWord word, const Cells& cells, std::uint32_t cell, std::uint32_t triangle, const PaddedBox& box) {
    const std::uint32_t id = listed_.id(triangle);
    if (word.is_empty()) return fail({.kind = Kind::no_list, .triangle = id});
    if (word.has_inner_grid()) {
      if (!holds(grid_.box(word), cells, cell, box)) return fail_at(Kind::outside_box, word, id);
      if (is_small(box, cells.size)) return add_inner(word, id);
    }
    // Triangles come in ascending order, as in the list.
    const std::uint32_t list = word.list();
    const std::uint32_t before = found_.counts[list];
    const std::uint32_t count = grid_.entry_count(word);
    if (before == count || grid_.entries()[grid_.first_entry(word) + before] != id) {
      return fail_at(Kind::missing, word, id);
    }
    PaddedBox& around = found_.boxes[list];
    around = before == 0 ? box : PaddedBox{min(around.low, box.low), max(around.high, box.high)};
    if (before + 1 == count && !holds(grid_.box(word), cells, cell, around))
      return fail_at(Kind::outside_box, word, id);
    found_.counts[list] = before + 1;
    return true;
  }

  /// Keeps a triangle for the inner grid of its cell.
  bool add_inner(CellWord word, std::uint32_t id) {
    if (found_.spare_inner_ids-- == 0) return fail_at(Kind::inner_share, word, id);
    found_.inner_ids[grid_.lists()[std::size_t{word.list()} + 1].box.bits()].push_back(id);
    return true;
  }

  /// Returns whether the box of a list holds the padded box of a triangle, as far as it is in the cell. A build rounds
  /// a side down to a whole part, and this compares the whole part with what was rounded. Both are the same, as no
  /// whole number is between a number and its whole part.
  [[nodiscard]] bool holds(CellBox stored, const Cells& cells, std::uint32_t cell, const PaddedBox& box) const {
    const auto [x, y, z] = cells.position(cell);
    const auto edge = static_cast<float>(cells.size);
    constexpr float parts = CellBox::parts;
    const float per_part = parts / edge;  // A power of two.
    const Float4 corner = to_float(Int4{x, y, z, 0}) * edge;
    const Float4 padding = {padding_[0], padding_[1], padding_[2], 0};
    const Float4 from = min(max((box.low - padding - corner) * per_part, all_lanes(0.0F)), all_lanes(parts - 1));
    const Float4 to = min(max((box.high + padding - corner) * per_part, all_lanes(1.0F)), all_lanes(parts));
    const Int4 bits = all_lanes(static_cast<std::int32_t>(stored.bits()));
    const Int4 low = bits >> Int4{0, 10, 20, 30} & Int4{31, 31, 31, 0};
    const Int4 high = (bits >> Int4{5, 15, 25, 30} & Int4{31, 31, 31, 0}) + Int4{1, 1, 1, 64};
    return !any_lane((to_float(low) > from) | (to_float(high) < to));
  }

  bool fail_at(Kind kind, CellWord word, std::uint32_t id) {
    return fail({.kind = kind, .entry = grid_.first_entry(word) + found_.counts[word.list()], .triangle = id});
  }
  bool fail(const ListFault& fault) {
    fault_ = fault;
    return false;
  }

  const Grid& grid_;
  const GridFrame& frame_;
  const Listed& listed_;
  Found& found_;
  std::size_t spare_pairs_;  ///< The number of pairs of a divided cell and a triangle that there may still be.
  CellPoint padding_ = {};
  CellEntries entries_;
  ListFault fault_;
};

/// Returns the frame again as it is while triangles are listed, in cells of the finest level that there may be.
template <typename Scalar>
GridFrame finest(const GridFrame& frame) {
  Box<Scalar> box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(frame.low[axis]);
    box.high[static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(frame.high[axis]);
  }
  std::array<double, 3> cells;
  std::copy(frame.cells.begin(), frame.cells.end(), cells.begin());
  return GridFrame::around(box, cells, Grid::brick_edge * Grid::brick_edge);
}

template <typename Scalar>
bool is_around(const GridFrame& frame, const Box<Scalar>& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    if (frame.low[axis] != double{box.low[k]} || frame.high[axis] != double{box.high[k]}) return false;
  }
  return true;
}

}  // namespace

template <typename Scalar>
std::optional<ListFault> find_list_fault(const TriangleMeshView<Scalar>& mesh, const Grid& grid) {
  const FloatingPointEnvironment environment;
  if (mesh.triangle_count() == 0) return std::nullopt;
  Found found{std::vector<std::uint32_t>(grid.lists().size(), 0), UnsetVector<PaddedBox>(grid.lists().size()),
              std::vector<std::vector<std::uint32_t>>(grid.inner_frames().size()),
              max_inner_share * mesh.triangle_count()};
  const Box<Scalar> box;  // Only a build needs it.
  ScratchVector<PaddedPoint> points;
  ListedTriangles<Scalar> triangles(mesh, box, points);
  const GridFrame frame = finest<Scalar>(grid.frame());
  triangles.compute_points(frame, nullptr);
  FrameCheck outer(grid, frame, triangles, found);
  if (!outer.has_all(grid.frame().first_top)) return outer.fault();
  for (std::size_t i = 0; i < found.inner_ids.size(); ++i) {  // A cell of an inner grid may have one of those after it.
    const std::vector<std::uint32_t> ids = std::move(found.inner_ids[i]);
    const ListFault wrong_box{.kind = ListFault::Kind::inner_box, .inner_grid = i};
    if (ids.empty()) return wrong_box;
    InnerTriangles<Scalar> some(mesh, ids);
    if (!is_around(grid.inner_frames()[i], some.box())) return wrong_box;
    const GridFrame inner_frame = finest<Scalar>(grid.inner_frames()[i]);
    some.compute_points(inner_frame, nullptr);
    FrameCheck inner(grid, inner_frame, some, found);
    if (!inner.has_all(grid.inner_frames()[i].first_top)) return inner.fault();
  }
  for (std::size_t list = 0; list + 1 < grid.lists().size(); ++list) {
    const std::size_t next = grid.lists()[list].first_entry + found.counts[list];
    if (next == grid.lists()[list + 1].first_entry) continue;
    return ListFault{.kind = ListFault::Kind::too_many, .entry = next, .triangle = grid.entries()[next]};
  }
  return std::nullopt;
}

template std::optional<ListFault> find_list_fault(const TriangleMeshView<float>&, const Grid&);
template std::optional<ListFault> find_list_fault(const TriangleMeshView<double>&, const Grid&);

}  // namespace surehit::detail
