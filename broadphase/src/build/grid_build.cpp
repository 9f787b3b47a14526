#include <algorithm>
#include <cmath>
#include <limits>

#include "build/cell_lister.hpp"
#include "build/empty_space.hpp"
#include "build/grid_resolution.hpp"
#include "build/grid_scratch.hpp"
#include "build/inner_grid_rule.hpp"
#include "build/listed_triangles.hpp"
#include "build/main_part.hpp"
#include "build/triangle_overlap.hpp"
#include "grid/grid.hpp"
#include "support/floating_point_environment.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

/// The budget of the lists: so many entries a triangle. A triangle of the size of a cell takes about 3.
constexpr std::size_t entries_per_triangle = 8;
/// The minimum budget of the lists. It allows any resolution for a small mesh.
constexpr std::size_t free_entries = std::size_t{1} << 18;
/// Most meshes take fewer entries a triangle than this. Room that is not used is not touched.
constexpr std::size_t usual_entries = 4;
/// Most meshes take more entries a triangle than this.
constexpr std::size_t min_entries = 2;
/// The number of triangles in a task of an executor.
constexpr std::size_t triangles_in_a_part = std::size_t{1} << 13;
/// The maximum number of top cells. Cells are counted in float, which is exact up to here.
constexpr double max_cells = 0x1p24;
/// The maximum number of inner grids.
constexpr std::size_t max_inner_grids = std::size_t{1} << 19;
/// 32 bits number all entries. Each inner grid has at least one entry for each of its triangles, so this many are kept
/// for inner grids.
constexpr std::size_t entries_for_inner_grids = std::size_t{1} << 30;
}  // namespace

/// Builds a grid: the outermost one, or an inner one. `Listed` is what it lists, which has boxes and an overlap test,
/// as `ListedTriangles` has. The build sorts the triangles into the lists of the top cells, by counting. Then it emits
/// the lists cell by cell, and divides the crowded cells.
template <typename Listed>
class GridBuild {
 public:
  /// Fills `frame`, and adds to the arrays of `grid`. `depth` is the number of grids around this one.
  GridBuild(Grid& grid, GridFrame& frame, GridScratch& scratch, Listed& listed, const GridOptions& options,
            std::uint32_t depth, const Executor* executor)
      : grid_(grid),
        frame_(frame),
        scratch_(scratch),
        listed_(listed),
        executor_(executor),
        crowded_(options.crowded == 0 ? std::numeric_limits<std::size_t>::max() : options.crowded),
        depth_(depth) {
    scratch.boxes_.resize(listed.count());
    const std::size_t free = depth == 0 ? free_entries : 0;
    const std::size_t budget = std::min(std::max(free, entries_per_triangle * listed.count()), entries_left());
    // Each inner grid has at least one cell.
    const double cells_left = std::max(1.0, max_cells - max_inner_grids - static_cast<double>(grid.top_.size()));
    std::array<double, 3> wished =
        detail::wished_resolution(GridFrame::around(listed.box(), {1, 1, 1}, division), listed, options, cells_left);
    while (!try_list_in(wished, budget)) {
      for (double& cells : wished) cells = std::max(1.0, std::floor(cells / 2));
    }
    const bool may_choose = depth == 0 && options.resolution == std::array<std::uint32_t, 3>{0, 0, 0};
    if (may_choose && crowded_ < listed.count() && listed.count() > many_triangles) {
      const auto& lists = scratch.lists_[0];
      if (const auto few = detail::resolution_around_main_part(frame_, lists, scratch.boxes_, scratch.words_)) {
        // Each triangle is listed about once.
        if (!try_list_in(*few, budget)) static_cast<void>(try_list_in({1, 1, 1}, budget));
      }
    }
    emit_all();
  }

 private:
  static constexpr std::uint32_t division = Grid::brick_edge * Grid::brick_edge;
  static_assert(Grid::max_levels == 2);
  /// A cell is not divided if the lists of its bricks would be more than this many times as long as its own.
  static constexpr std::size_t max_growth = 3;
  /// A cell that lists more than this many times as many triangles as a crowded cell gets an inner grid if it can. Its
  /// bricks would be crowded again.
  static constexpr std::size_t max_divided = 32;
  /// So does a cell that lists more triangles than this, and more than one in so many of all. The resolution of the
  /// grid is far from what these triangles need.
  static constexpr std::size_t many_triangles = 384;
  static constexpr std::size_t large_share = 20;
  /// The minimum number of triangles of an inner grid. For fewer, the way into it would take longer than they do.
  static constexpr std::size_t min_inner_triangles = 64;
  /// The maximum number of cells in bricks. So all cells together have no more lists than a word can number.
  static constexpr std::size_t max_brick_cells = CellWord::max_lists / 2 - static_cast<std::size_t>(max_cells);
  static_assert(max_brick_cells / Grid::brick_size <= CellWord::max_bricks);

  /// Lists all triangles in a frame with as many top cells as wished. Returns false if that takes too many entries.
  bool try_list_in(const std::array<double, 3>& wished, std::size_t budget) {
    frame_ = GridFrame::around(listed_.box(), wished, division);
    listed_.compute_points(frame_, executor_);
    for (std::size_t axis = 0; axis < 3; ++axis) padding_[axis] = frame_.padding(axis);
    return try_list_all(budget);
  }

  /// Finds the cells that the triangles meet: `id(i)` for each i from `first` to below `last`. Returns false if there
  /// are more than `max_entries` entries. Each triangle comes once among the top cells. There its box is stored too.
  template <bool is_top, typename Id>
  bool try_find(std::size_t first, std::size_t last, const Id& id, const detail::CellRange& cells, std::uint32_t size,
                std::size_t max_entries, detail::CellEntries& entries, bool may_grow) const {
    typename Listed::Lister lister(entries, may_grow, cells, size, padding_);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t triangle = id(i);
      const typename Listed::Shape shape = listed_.shape(triangle);
      detail::PaddedBox& box = scratch_.boxes_[triangle];
      if constexpr (is_top) box = Listed::box_of(shape);
      lister.add(triangle, shape, box);
      if (entries.count > max_entries) return false;
    }
    lister.finish();
    return entries.count <= max_entries;
  }

  /// Lists all triangles in top cells. Returns false if that takes more entries than the budget. One cell always fits.
  bool try_list_all(std::size_t budget) {
    const std::array<std::uint32_t, 3>& cells = frame_.cells;
    const std::size_t cell_count = std::size_t{cells[0]} * cells[1] * cells[2];
    if (cell_count == 1) budget = detail::CellEntries::too_many - 1;
    detail::CellLists& lists = scratch_.lists_[0];
    if (executor_ != nullptr && try_find_in_parts(budget)) {
      sort_entries(scratch_.parts_, cell_count, lists);
      return true;
    }
    if (!try_find_top(0, listed_.count(), budget, lists.entries, true)) return false;
    sort_entries({&lists.entries, 1}, cell_count, lists);
    return true;
  }

  /// Finds the top cells that the triangles from `first` to below `last` meet. Returns false if there are too many
  /// entries.
  bool try_find_top(std::size_t first, std::size_t last, std::size_t max_entries, detail::CellEntries& entries,
                    bool may_grow) const {
    entries.make_room(usual_entries * (last - first), min_entries * (last - first));
    const auto id = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
    return try_find<true>(first, last, id, {{0, 0, 0}, frame_.cells}, division, max_entries, entries, may_grow);
  }

  /// Does the same for all triangles, in tasks of the executor. It also returns false if a part takes unusually much
  /// room, because a task cannot allocate more.
  bool try_find_in_parts(std::size_t max_entries) {
    constexpr std::size_t size = triangles_in_a_part;
    auto& parts = scratch_.parts_;
    parts.resize((listed_.count() + size - 1) / size);
    for (detail::CellEntries& part : parts) part.make_room(entries_per_triangle * size, min_entries * size);
    detail::in_parts(executor_, listed_.count(), size, [&](std::size_t first, std::size_t last) {
      static_cast<void>(try_find_top(first, last, max_entries, parts[first / size], false));
    });
    std::size_t entries = 0;
    for (const detail::CellEntries& part : parts) {
      if (part.count > max_entries - entries) return false;
      entries += part.count;
    }
    return true;
  }

  /// Returns the number of entries that may still be added, besides those that are kept for inner grids.
  [[nodiscard]] std::size_t entries_left() const {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() - entries_for_inner_grids;
    return most - std::min(most, grid_.entries_.size());
  }

  /// Makes the words, bricks, lists and entries.
  void emit_all() {
    const auto& cells = frame_.cells;
    const auto& offsets = scratch_.lists_[0].offsets;
    const auto& listed = scratch_.lists_[0].triangles;
    auto& words = scratch_.words_;
    const std::size_t top_count = offsets.size() - 1;
    // Reserves room for lists of bricks of the maximum length, in half of their cells. The second level may need more.
    std::size_t entries = listed.size();
    std::size_t lists = 1;
    for (std::size_t cell = 0; cell < top_count; ++cell) {
      const std::size_t count = offsets[cell + 1] - offsets[cell];
      const bool is_crowded = count > crowded_;
      entries += is_crowded ? (max_growth - 1) * count : 0;
      lists += is_crowded ? Grid::brick_size / 2 : count != 0 ? 1 : 0;
    }
    if (depth_ == 0) {
      grid_.entries_.reserve(entries);
      grid_.lists_.reserve(lists);
      grid_.top_.reserve(top_count + Grid::top_slack);
    }
    spare_entries_ = entries_left() - std::min(entries_left(), listed.size());
    words.assign(top_count, 0);
    std::size_t cell = 0;
    for (std::uint32_t z = 0; z < cells[2]; ++z) {
      for (std::uint32_t y = 0; y < cells[1]; ++y) {
        for (std::uint32_t x = 0; x < cells[0]; ++x, ++cell) {
          const std::span<const std::uint32_t> ids(listed.data() + offsets[cell], offsets[cell + 1] - offsets[cell]);
          if (!ids.empty()) words[cell] = emit(ids, {x, y, z}, division, 0);
        }
      }
    }
    detail::measure_empty_space(words, cells, scratch_.distances_);
    const std::size_t first_top = grid_.top_.size();
    frame_.begin_at(static_cast<std::uint32_t>(first_top));
    grid_.top_.resize(first_top + top_count);
    std::transform(words.begin(), words.end(), grid_.top_.data() + first_top,
                   [](std::uint32_t bits) { return CellWord(bits); });
  }

  /// Emits a cell that is not empty, and returns its word. `cell` is its index, counted in cells of its `size`.
  std::uint32_t emit(std::span<const std::uint32_t> ids, const std::array<std::uint32_t, 3>& cell, std::uint32_t size,
                     std::uint32_t level) {
    if (ids.size() > crowded_) {
      const bool has_large_share = ids.size() > many_triangles && ids.size() > listed_.count() / large_share;
      const bool may_divide = level < Grid::max_levels && ids.size() <= max_divided * crowded_ && !has_large_share;
      if (may_divide) {
        if (const std::uint32_t word = divide(ids, cell, size / Grid::brick_edge, level + 1); word != 0) return word;
      }
      if (const std::uint32_t word = emit_inner(ids, cell, size); word != 0) return word;
      if (!may_divide && level < Grid::max_levels) {
        if (const std::uint32_t word = divide(ids, cell, size / Grid::brick_edge, level + 1); word != 0) return word;
      }
    }
    const std::uint32_t list = begin_list(box_of(ids, cell, size));
    append(ids);
    return CellWord::listing(list).bits();
  }

  /// Appends the ids of triangles, which are given by their numbers.
  void append(std::span<const std::uint32_t> numbers) {
    grid_.entries_.append(numbers, [&](std::uint32_t number) { return listed_.id(number); });
  }

  /// Begins a list, and returns its number.
  std::uint32_t begin_list(CellBox box) {
    grid_.lists_.push_back({box, static_cast<std::uint32_t>(grid_.entries_.size())});
    return static_cast<std::uint32_t>(grid_.lists_.size() - 1);
  }

  /// Emits a cell that gets an inner grid for its small triangles, and returns its word. Returns 0 if too few are
  /// small, or if the inner grid would not be much smaller than this grid.
  std::uint32_t emit_inner(std::span<const std::uint32_t> ids, const std::array<std::uint32_t, 3>& cell,
                           std::uint32_t size) {
    using namespace detail;
    if (depth_ == Grid::max_depth) return 0;
    const auto is_small = [&](std::uint32_t i) { return detail::is_small(scratch_.boxes_[i], size); };
    PaddedBox around = {all_lanes(std::numeric_limits<float>::max()), all_lanes(0.0F)};
    std::size_t count = 0;
    for (const std::uint32_t i : ids) {
      if (!is_small(i)) continue;
      around = {min(around.low, scratch_.boxes_[i].low), max(around.high, scratch_.boxes_[i].high)};
      ++count;
    }
    if (count < min_inner_triangles || count <= crowded_ || !is_much_smaller(around) ||
        scratch_.inner_ids_.size() + count > scratch_.max_inner_ids_ || scratch_.pending_.size() == max_inner_grids) {
      return 0;
    }
    scratch_.pending_.push_back({scratch_.inner_ids_.size(), count, depth_ + 1});
    const std::uint32_t list = begin_list(box_of(ids, cell, size));
    for (const std::uint32_t i : ids) {
      if (is_small(i)) {
        scratch_.inner_ids_.push_back(listed_.id(i));
      } else {
        append({&i, 1});
      }
    }
    begin_list(CellBox(static_cast<std::uint32_t>(scratch_.pending_.size() - 1)));
    return CellWord::with_inner_grid(list).bits();
  }

  /// Returns whether the longest edge of a box is less than half of that of this grid, in mesh units.
  [[nodiscard]] bool is_much_smaller(const detail::PaddedBox& box) const {
    const std::array<double, 3> whole = detail::scaled_extent(frame_, listed_.box().low, listed_.box().high);
    double inner = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inner = std::max(inner, static_cast<double>(box.high[axis] - box.low[axis]) / frame_.scale[axis]);
    }
    const double outer = *std::max_element(whole.begin(), whole.end());
    return inner < outer / 2;
  }

  /// Returns the part of the cell that the triangles' boxes take up. The boxes are padded as in listing, so each meets
  /// the cell (L3 in WALK.md).
  [[nodiscard]] CellBox box_of(std::span<const std::uint32_t> ids, const std::array<std::uint32_t, 3>& cell,
                               std::uint32_t size) const {
    using namespace detail;
    auto [low, high] = scratch_.boxes_[ids.front()];
    for (const std::uint32_t id : ids.subspan(1)) {
      low = min(low, scratch_.boxes_[id].low);
      high = max(high, scratch_.boxes_[id].high);
    }
    constexpr float parts = CellBox::parts;
    const auto edge = static_cast<float>(size);
    const float per_part = parts / edge;  // A power of two.
    const Float4 corner = to_float(Int4{static_cast<std::int32_t>(cell[0]), static_cast<std::int32_t>(cell[1]),
                                        static_cast<std::int32_t>(cell[2]), 0}) *
                          edge;
    const Float4 padding = {padding_[0], padding_[1], padding_[2], 0};
    const Float4 from = (low - padding - corner) * per_part;
    const Float4 to = (high + padding - corner) * per_part;
    const Int4 first_part = to_int(min(max(from, all_lanes(0.0F)), all_lanes(parts - 1)));
    const Float4 last = min(max(to, all_lanes(1.0F)), all_lanes(parts));
    const Int4 whole = to_int(last);
    const Int4 end_part = whole - (to_float(whole) < last);
    std::array<std::uint32_t, 3> first;
    std::array<std::uint32_t, 3> end;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<std::uint32_t>(first_part[axis]);
      end[axis] = static_cast<std::uint32_t>(end_part[axis]);
    }
    return CellBox::around(first, end);
  }

  /// Divides a cell into a brick of cells of `size`, and returns its word. Returns 0 if the lists of the brick would be
  /// too long, or if there would be too many bricks.
  std::uint32_t divide(std::span<const std::uint32_t> ids, const std::array<std::uint32_t, 3>& cell, std::uint32_t size,
                       std::uint32_t level) {
    constexpr std::uint32_t edge = Grid::brick_edge;
    detail::CellRange cells;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells.low[axis] = cell[axis] * edge;
      cells.high[axis] = cells.low[axis] + edge;
    }
    detail::CellLists& lists = scratch_.lists_[level];
    const auto id = [&](std::size_t i) { return ids[i]; };
    // No cell has brick 0, because its word would be 0, and that is the word of an empty cell before it is measured.
    const std::size_t first = std::max<std::size_t>(grid_.bricks_.size(), Grid::brick_size);
    const std::size_t max_entries = std::min(max_growth * ids.size(), ids.size() + spare_entries_);
    if (first >= max_brick_cells ||
        !try_find<false>(0, ids.size(), id, cells, size, max_entries, lists.entries, true)) {
      return 0;
    }
    sort_entries({&lists.entries, 1}, Grid::brick_size, lists);
    spare_entries_ = spare_entries_ + ids.size() - lists.triangles.size();
    grid_.bricks_.resize(first + Grid::brick_size);
    grid_.levels_ = std::max(grid_.levels_, level);

    std::array<std::uint32_t, Grid::brick_size> words = {};
    for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) {
      const std::uint32_t begin = lists.offsets[cell];
      const std::uint32_t end = lists.offsets[cell + 1];
      if (begin == end) continue;
      const std::array<std::uint32_t, 3> part = Grid::position_in_brick(cell);
      words[cell] = emit({lists.triangles.data() + begin, end - begin},
                         {cells.low[0] + part[0], cells.low[1] + part[1], cells.low[2] + part[2]}, size, level);
    }
    detail::measure_empty_space(words);
    for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) grid_.bricks_[first + cell] = CellWord(words[cell]);
    return CellWord::divided(static_cast<std::uint32_t>(first / Grid::brick_size)).bits();
  }

  Grid& grid_;
  GridFrame& frame_;
  GridScratch& scratch_;
  Listed& listed_;
  const Executor* executor_;
  std::size_t crowded_;
  std::size_t spare_entries_ = 0;  ///< The number of entries that divisions may add. 32 bits cannot number more.
  std::uint32_t depth_;
  detail::CellPoint padding_ = {};
};

std::size_t GridScratch::memory_bytes() const noexcept {
  const auto bytes = [](const auto& vector) { return vector.get_allocator().bytes_of(vector.capacity()); };
  const auto few = [](const auto& vector) { return vector.capacity() * sizeof(vector.front()); };
  std::size_t sum = bytes(points_) + bytes(boxes_) + bytes(words_) + bytes(distances_) + few(pending_) +
                    few(inner_ids_) + few(current_ids_);
  const auto add = [&](const detail::CellEntries& entries) { sum += bytes(entries.cells) + bytes(entries.triangles); };
  for (const detail::CellLists& lists : lists_) {
    add(lists.entries);
    sum += bytes(lists.offsets) + bytes(lists.triangles);
  }
  for (const detail::CellEntries& part : parts_) add(part);
  return sum;
}

template <typename Scalar>
Grid::Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
           const Executor* executor) {
  {
    GridScratch scratch;
    rebuild(mesh, box, options, scratch, executor);
  }
  shrink();
}

/// Gives back the memory of arrays that are not nearly full. They are copied, so it pays only for a grid that stays.
void Grid::shrink() {
  const auto shrink = [](auto& vector) {
    constexpr std::size_t small_share = 32;
    if (vector.capacity() - vector.size() > vector.size() / small_share) vector.shrink_to_fit();
  };
  shrink(top_);
  shrink(bricks_);
  shrink(lists_);
  shrink(entries_);
  shrink(inner_frames_);
}

void Grid::complete(std::size_t outer_entries) {
  lists_.push_back({CellBox(), static_cast<std::uint32_t>(entries_.size())});
  top_.resize(top_.size() + top_slack, CellWord());
  // From now on, all is counted in cells of the finest level that there is.
  for (std::uint32_t level = levels_; level < max_levels; ++level) {
    frame_.coarsen(brick_edge);
    for (GridFrame& frame : inner_frames_) frame.coarsen(brick_edge);
  }
  is_mostly_inner_ = outer_entries < entries_.size() / 4;
  is_one_list_ = top_count_ == 1 && lists_.size() == 2 && entries_.size() <= max_unwalked;
  cover_ = GridCover(*this);
  main_grid_ = MainGrid(*this);
}

template <typename Scalar>
void Grid::rebuild(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
                   GridScratch& scratch, const Executor* executor) {
  const FloatingPointEnvironment environment;
  if (mesh.triangle_count() == 0) {
    *this = Grid();
    return;
  }
  top_.clear();
  bricks_.clear();
  lists_.clear();
  entries_.clear(mesh.triangle_count());
  inner_frames_.clear();
  levels_ = 0;
  scratch.pending_.clear();
  scratch.inner_ids_.clear();
  scratch.max_inner_ids_ = std::min(detail::max_inner_share * mesh.triangle_count(), entries_for_inner_grids);
  detail::ListedTriangles<Scalar> triangles(mesh, box, scratch.points_);
  GridBuild<detail::ListedTriangles<Scalar>>(*this, frame_, scratch, triangles, options, 0, executor);
  top_count_ = top_.size();
  const GridOptions inner_options{.cells_per_triangle = options.cells_per_triangle, .crowded = options.crowded};
  const std::size_t outer_entries = entries_.size();
  for (std::size_t i = 0; i < scratch.pending_.size(); ++i) {  // The build of an inner grid may add more of them.
    const detail::PendingGrid pending = scratch.pending_[i];
    const auto first = scratch.inner_ids_.begin() + static_cast<std::ptrdiff_t>(pending.first);
    scratch.current_ids_.assign(first, first + static_cast<std::ptrdiff_t>(pending.count));
    detail::InnerTriangles<Scalar> some(mesh, scratch.current_ids_);
    GridBuild<detail::InnerTriangles<Scalar>>(*this, inner_frames_.emplace_back(), scratch, some, inner_options,
                                              pending.depth, nullptr);
  }
  complete(outer_entries);
}

template Grid::Grid(const TriangleMeshView<float>&, const Box<float>&, const GridOptions&, const Executor*);
template Grid::Grid(const TriangleMeshView<double>&, const Box<double>&, const GridOptions&, const Executor*);
template void Grid::rebuild(const TriangleMeshView<float>&, const Box<float>&, const GridOptions&, GridScratch&,
                            const Executor*);
template void Grid::rebuild(const TriangleMeshView<double>&, const Box<double>&, const GridOptions&, GridScratch&,
                            const Executor*);

}  // namespace surehit
