#include "file/list_check.hpp"

#include <algorithm>
#include <array>
#include <limits>
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
struct Cells {
  CellRange range;       ///< Where they are, counted in cells.
  std::uint32_t size;    ///< Their edge, in finest cells.
  const CellWord* words; ///< Their words.

  /// Returns the position of a cell, counted in cells.
  [[nodiscard]] std::array<std::uint32_t, 3> position(std::uint32_t cell) const {
    const std::uint32_t columns = range.length(0);
    const std::uint32_t rows = range.length(1);
    return {range.low[0] + cell % columns, range.low[1] + cell / columns % rows, range.low[2] + cell / columns / rows};
  }
};

/// Checks the lists of a grid: of the outermost one, or of an inner one.
template <typename Listed>
class FrameCheck {
 public:
  using Kind = ListFault::Kind;

  /// Counts in `listed_so_far`, by list, and adds the triangles of inner grids to `inner_ids`, by grid.
  FrameCheck(const Grid& grid, const GridFrame& frame, const Listed& listed,
             std::vector<std::uint32_t>& listed_so_far, std::vector<std::vector<std::uint32_t>>& inner_ids,
             std::size_t& spare_inner_ids)
      : grid_(grid),
        frame_(frame),
        listed_(listed),
        listed_so_far_(listed_so_far),
        inner_ids_(inner_ids),
        spare_inner_ids_(spare_inner_ids),
        spare_pairs_(max_pairs_share * (grid.entry_count() + listed.count())) {
    for (std::size_t axis = 0; axis < 3; ++axis) padding_[axis] = frame.padding(axis);
  }

  /// Looks for each triangle in the list of each cell that it meets. `first_top` is the index of the first top cell.
  [[nodiscard]] bool has_all(std::size_t first_top) {
    const Cells cells{{{0, 0, 0}, frame_.cells}, frame_.division, grid_.all_top().data() + first_top};
    return has_all_in(cells, listed_.count(), [](std::size_t i) { return static_cast<std::uint32_t>(i); });
  }
  /// Returns the first fault, if `has_all` is false.
  [[nodiscard]] const ListFault& fault() const { return fault_; }

 private:
  /// Divided cells have at most this many times as many triangles as there are entries and triangles in all. More would
  /// need more entries, but for roundings.
  static constexpr std::size_t max_pairs_share = 8;

  /// The same for some triangles, whose numbers ascend: `number(i)` for each i below `count`.
  template <typename Number>
  bool has_all_in(const Cells& cells, std::size_t count, const Number& number) {
    std::vector<std::uint64_t> in_bricks;  // Pairs of a divided cell and a triangle.
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
          in_bricks.push_back(std::uint64_t{cell} << 32 | triangle);
        } else if (!has(word, cells, cell, triangle, boxes[entries_.triangles[i]])) {
          return false;
        }
      }
    }
    return have_bricks_all(cells, in_bricks);
  }

  /// Goes on in the bricks of divided cells.
  bool have_bricks_all(const Cells& cells, std::vector<std::uint64_t>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t first = 0; first < pairs.size();) {
      const auto cell = static_cast<std::uint32_t>(pairs[first] >> 32);
      std::size_t last = first;
      while (last < pairs.size() && pairs[last] >> 32 == cell) ++last;
      constexpr std::uint32_t edge = Grid::brick_edge;
      Cells brick{{}, cells.size / edge,
                  grid_.bricks().data() + std::size_t{cells.words[cell].brick()} * Grid::brick_size};
      const std::array<std::uint32_t, 3> position = cells.position(cell);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        brick.range.low[axis] = position[axis] * edge;
        brick.range.high[axis] = brick.range.low[axis] + edge;
      }
      const auto number = [&](std::size_t i) { return static_cast<std::uint32_t>(pairs[first + i]); };
      if (!has_all_in(brick, last - first, number)) return false;
      first = last;
    }
    return true;
  }

  /// Looks for a triangle in the list of a cell, which is not divided.
  bool has(CellWord word, const Cells& cells, std::uint32_t cell, std::uint32_t triangle, const PaddedBox& box) {
    const std::uint32_t id = listed_.id(triangle);
    if (word.is_empty()) return fail({.kind = Kind::no_list, .triangle = id});
    const std::uint32_t list = word.list();
    if (!holds(grid_.box(word), cells, cell, box)) return fail({Kind::outside_box, list, 0, id});
    if (word.has_inner_grid() && is_small(box, cells.size)) {
      const std::uint32_t inner = grid_.lists()[list + 1].box.bits();
      if (spare_inner_ids_-- == 0) return fail({Kind::inner_share, list, inner, id});
      inner_ids_[inner].push_back(id);
      return true;
    }
    // Triangles come in ascending order, as in the list.
    const std::uint32_t next = listed_so_far_[list];
    if (next == grid_.entry_count(word) || grid_.entries()[grid_.first_entry(word) + next] != id) {
      return fail({Kind::missing, list, 0, id});
    }
    ++listed_so_far_[list];
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
    const Float4 corner =
        to_float(Int4{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z), 0}) *
        edge;
    const Float4 padding = {padding_[0], padding_[1], padding_[2], 0};
    const Float4 from = min(max((box.low - padding - corner) * per_part, all_lanes(0.0F)), all_lanes(parts - 1));
    const Float4 to = min(max((box.high + padding - corner) * per_part, all_lanes(1.0F)), all_lanes(parts));
    const Int4 bits = all_lanes(static_cast<std::int32_t>(stored.bits()));
    const Int4 low = bits >> Int4{0, 10, 20, 30} & Int4{31, 31, 31, 0};
    const Int4 high = (bits >> Int4{5, 15, 25, 30} & Int4{31, 31, 31, 0}) + Int4{1, 1, 1, 64};
    return !any_lane((to_float(low) > from) | (to_float(high) < to));
  }

  bool fail(const ListFault& fault) {
    fault_ = fault;
    return false;
  }

  const Grid& grid_;
  const GridFrame& frame_;
  const Listed& listed_;
  std::vector<std::uint32_t>& listed_so_far_;
  std::vector<std::vector<std::uint32_t>>& inner_ids_;
  std::size_t& spare_inner_ids_;
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
  std::vector<std::uint32_t> listed_so_far(grid.lists().size(), 0);
  std::vector<std::vector<std::uint32_t>> inner_ids(grid.inner_frames().size());
  std::size_t spare_inner_ids = max_inner_share * mesh.triangle_count();
  const Box<Scalar> box = box_of(mesh);
  UnsetVector<PaddedPoint> points;
  ListedTriangles<Scalar> triangles(mesh, box, points);
  const GridFrame frame = finest<Scalar>(grid.frame());
  triangles.compute_points(frame, nullptr);
  FrameCheck outer(grid, frame, triangles, listed_so_far, inner_ids, spare_inner_ids);
  if (!outer.has_all(grid.frame().first_top)) return outer.fault();
  for (std::size_t i = 0; i < inner_ids.size(); ++i) {  // A cell of an inner grid may have one of those after it.
    const std::vector<std::uint32_t> ids = std::move(inner_ids[i]);
    const ListFault wrong_box{.kind = ListFault::Kind::inner_box, .inner_grid = i};
    if (ids.empty()) return wrong_box;
    InnerTriangles<Scalar> some(mesh, ids);
    if (!is_around(grid.inner_frames()[i], some.box())) return wrong_box;
    const GridFrame inner_frame = finest<Scalar>(grid.inner_frames()[i]);
    some.compute_points(inner_frame, nullptr);
    FrameCheck inner(grid, inner_frame, some, listed_so_far, inner_ids, spare_inner_ids);
    if (!inner.has_all(grid.inner_frames()[i].first_top)) return inner.fault();
  }
  for (std::size_t list = 0; list + 1 < grid.lists().size(); ++list) {
    const std::size_t first = grid.lists()[list].first_entry;
    if (first + listed_so_far[list] == grid.lists()[list + 1].first_entry) continue;
    return ListFault{ListFault::Kind::too_many, list, 0, grid.entries()[first + listed_so_far[list]]};
  }
  return std::nullopt;
}

template std::optional<ListFault> find_list_fault(const TriangleMeshView<float>&, const Grid&);
template std::optional<ListFault> find_list_fault(const TriangleMeshView<double>&, const Grid&);

}  // namespace surehit::detail
