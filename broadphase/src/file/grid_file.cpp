#include "file/grid_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "build/empty_space.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// What a saved cell is, in one byte.
enum class CellKind : std::uint8_t {
  empty = 0,
  list = 1,   ///< The next list is that of this cell.
  brick = 2,  ///< The cells of its brick come next.
  inner = 3,  ///< The next list is that of this cell, and the next frame is that of its inner grid.
};

CellKind kind_of(CellWord word) {
  if (word.is_empty()) return CellKind::empty;
  if (word.is_divided()) return CellKind::brick;
  return word.has_inner_grid() ? CellKind::inner : CellKind::list;
}

/// Calls `visit(word)` for a cell, and then for all cells of its brick.
template <typename Visit>
void visit_cells(const Grid& grid, CellWord word, const Visit& visit) {
  visit(word);
  if (!word.is_divided()) return;
  const std::span<const CellWord> brick = grid.bricks().subspan(std::size_t{word.brick()} * Grid::brick_size);
  for (std::size_t i = 0; i < Grid::brick_size; ++i) visit_cells(grid, brick[i], visit);
}

/// Returns the sides of a frame as they are saved, the lower ones first. A zero is positive, because which zero is the
/// minimum depends on the processor.
template <typename Scalar>
std::array<Scalar, 6> sides_of(const GridFrame& frame) {
  const FloatingPointEnvironment environment;
  std::array<Scalar, 6> sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sides[axis] = static_cast<Scalar>(frame.low[axis] + 0.0);
    sides[3 + axis] = static_cast<Scalar>(frame.high[axis] + 0.0);
  }
  return sides;
}

}  // namespace

GridCounts GridCounts::of(const Grid& grid) {
  if (grid.is_empty()) return {};
  const std::size_t frames = 1 + grid.inner_frames().size();
  const std::size_t bricks = grid.bricks().size() - std::min(grid.bricks().size(), std::size_t{Grid::brick_size});
  // There is one list more at the end, and one more for each inner grid.
  return {static_cast<std::uint32_t>(frames), grid.all_top().size() + bricks,
          static_cast<std::uint32_t>(grid.lists().size() - frames), grid.entry_count()};
}

template <typename Scalar>
void GridFile::write(const Grid& grid, FileWriter& writer) {
  if (grid.is_empty()) return;
  const auto write_frame = [&](const GridFrame& frame) {
    for (const Scalar side : sides_of<Scalar>(frame)) writer.write(side);
    for (const std::uint32_t cells : frame.cells) writer.write(cells);
  };
  write_frame(grid.frame());
  for (const GridFrame& frame : grid.inner_frames()) write_frame(frame);
  const auto visit_all = [&](const auto& visit) {
    for (const CellWord word : grid.all_top()) visit_cells(grid, word, visit);
  };
  visit_all([&](CellWord word) { writer.write(static_cast<std::uint8_t>(kind_of(word))); });
  visit_all([&](CellWord word) {
    if (word.is_empty() || word.is_divided()) return;
    writer.write(grid.box(word).bits());
    writer.write(grid.entry_count(word));
  });
  writer.write_bytes(std::as_bytes(grid.entries().bytes()));
}

/// Reads a grid, cell by cell, in the order in which a build makes them. So all numbers are those of a build.
class GridReading {
 public:
  using Reason = InvalidFile::Reason;

  GridReading(Grid& grid, const GridCounts& counts, std::uint32_t triangles)
      : grid_(grid), counts_(counts), triangles_(triangles) {}

  template <typename Scalar>
  [[nodiscard]] std::optional<InvalidFile> read(FileReader& reader, GridFile::Offsets& offsets) {
    offsets.frames = reader.offset();
    if (!read_frames<Scalar>(reader)) return error_;
    offsets.cells = reader.offset();
    cells_ = FileReader(reader.take_bytes(counts_.cells), offsets.cells);
    offsets.lists = reader.offset();
    lists_ = FileReader(reader.take_bytes(std::size_t{counts_.lists} * list_bytes), offsets.lists);
    if (!read_cells()) return error_;
    offsets.entries = reader.offset();
    grid_.entries_.assign(reader.take_bytes(counts_.entries * grid_.entries_.width()));
    grid_.complete(outer_entries_);
    return std::nullopt;
  }

 private:
  /// Notes what is wrong. Returns false.
  bool fail(Reason reason, std::size_t offset, const std::string& message) {
    error_.emplace(reason, offset, "byte " + std::to_string(offset) + ": " + message);
    return false;
  }

  template <typename Scalar>
  bool read_frames(FileReader& reader) {
    frames_.reserve(counts_.frames);
    for (std::uint32_t i = 0; i < counts_.frames; ++i) {
      const std::size_t offset = reader.offset();
      const auto named = [&](const std::string& what) { return "grid " + std::to_string(i) + ": " + what; };
      Box<Scalar> box;
      for (Scalar& side : box.low) side = reader.take<Scalar>();
      for (Scalar& side : box.high) side = reader.take<Scalar>();
      std::array<std::uint32_t, 3> cells;
      for (std::uint32_t& on_axis : cells) on_axis = reader.take<std::uint32_t>();
      if (!box.low.allFinite() || !box.high.allFinite() || (box.low.array() > box.high.array()).any()) {
        return fail(Reason::invalid_grid, offset, named("its box is empty or not finite"));
      }
      std::array<double, 3> wished;
      std::copy(cells.begin(), cells.end(), wished.begin());
      frames_.push_back(GridFrame::around(box, wished, division));
      if (frames_.back().cells != cells) {
        return fail(Reason::invalid_grid, offset, named("its box cannot be divided into so many cells"));
      }
    }
    return true;
  }

  bool read_cells() {
    grid_.entries_.clear(triangles_);
    depths_.assign(1, 0);
    grid_.lists_.reserve(std::size_t{counts_.lists} + counts_.frames);
    grid_.top_.reserve(counts_.cells + Grid::top_slack);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (i == depths_.size()) {
        return fail(Reason::invalid_grid, cells_.offset(), "no cell has grid " + std::to_string(i));
      }
      if (!read_top_cells(frames_[i], depths_[i])) return false;
      if (i != 0) continue;
      grid_.top_count_ = grid_.top_.size();
      outer_entries_ = entries_;
    }
    if (cells_.left() != 0) return fail(Reason::wrong_counts, cells_.offset(), "this cell belongs to no grid");
    if (lists_.left() != 0) return fail(Reason::wrong_counts, lists_.offset(), "this list belongs to no cell");
    if (entries_ != counts_.entries) {
      return fail(Reason::wrong_counts, lists_.offset(),
                  "the lists have " + std::to_string(entries_) + " entries, not " + std::to_string(counts_.entries));
    }
    grid_.frame_ = frames_.front();
    grid_.inner_frames_.assign(frames_.begin() + 1, frames_.end());
    return true;
  }

  bool read_top_cells(GridFrame& frame, std::uint32_t depth) {
    const auto& [columns, rows, layers] = frame.cells;
    const std::uint64_t count = std::uint64_t{columns} * rows * layers;  // Each is below 2^11.
    if (count > cells_.left() || grid_.top_.size() + count > max_top_cells) {
      return fail(Reason::wrong_counts, cells_.offset(), "a grid of " + std::to_string(count) + " cells begins here");
    }
    depth_ = depth;
    words_.assign(static_cast<std::size_t>(count), 0);
    for (std::uint32_t& word : words_) {
      if (!read_cell(0, word)) return false;
    }
    measure_empty_space(words_, frame.cells, distances_);
    const std::size_t first = grid_.top_.size();
    frame.begin_at(static_cast<std::uint32_t>(first));
    grid_.top_.resize(first + words_.size());
    std::transform(words_.begin(), words_.end(), grid_.top_.data() + first,
                   [](std::uint32_t bits) { return CellWord(bits); });
    return true;
  }

  /// Reads a cell, and the cells of its brick. `word` becomes its word, or 0 for an empty cell.
  bool read_cell(std::uint32_t level, std::uint32_t& word) {
    word = 0;
    const std::size_t offset = cells_.offset();
    if (cells_.left() == 0) return fail(Reason::wrong_counts, offset, "cells are missing");
    switch (const auto kind = cells_.take<std::uint8_t>(); static_cast<CellKind>(kind)) {
      case CellKind::empty:
        return true;
      case CellKind::list:
        word = CellWord::listing(static_cast<std::uint32_t>(grid_.lists_.size())).bits();
        return read_list(1);
      case CellKind::brick:
        return read_brick(level, offset, word);
      case CellKind::inner: {
        if (depth_ == Grid::max_depth)
          return fail(Reason::invalid_grid, offset, "there are too many grids around this");
        if (depths_.size() == frames_.size()) return fail(Reason::wrong_counts, offset, "the inner grid is missing");
        word = CellWord::with_inner_grid(static_cast<std::uint32_t>(grid_.lists_.size())).bits();
        if (!read_list(0)) return false;
        grid_.lists_.push_back({CellBox(static_cast<std::uint32_t>(depths_.size() - 1)), first_entry()});
        depths_.push_back(depth_ + 1);
        return true;
      }
      default:
        return fail(Reason::invalid_grid, offset, "no cell is of kind " + std::to_string(kind));
    }
  }

  bool read_brick(std::uint32_t level, std::size_t offset, std::uint32_t& word) {
    if (level == Grid::max_levels) return fail(Reason::invalid_grid, offset, "the cell cannot be divided again");
    // As in a build, no cell has brick 0.
    const std::size_t first = std::max<std::size_t>(grid_.bricks_.size(), Grid::brick_size);
    if (first >= max_brick_cells) return fail(Reason::wrong_counts, offset, "there are too many bricks");
    grid_.bricks_.resize(first + Grid::brick_size);
    grid_.levels_ = std::max(grid_.levels_, level + 1);
    std::array<std::uint32_t, Grid::brick_size> words;
    for (std::uint32_t& part : words) {
      if (!read_cell(level + 1, part)) return false;
    }
    measure_empty_space(words);
    std::transform(words.begin(), words.end(), grid_.bricks_.begin() + static_cast<std::ptrdiff_t>(first),
                   [](std::uint32_t bits) { return CellWord(bits); });
    word = CellWord::divided(static_cast<std::uint32_t>(first / Grid::brick_size)).bits();
    return true;
  }

  bool read_list(std::uint32_t min_count) {
    const std::size_t offset = lists_.offset();
    if (lists_.left() == 0) return fail(Reason::wrong_counts, offset, "lists are missing");
    if (grid_.lists_.size() + 2 >= CellWord::max_lists) {
      return fail(Reason::wrong_counts, offset, "there are too many lists");
    }
    const CellBox box(lists_.take<std::uint32_t>());
    const auto count = lists_.take<std::uint32_t>();
    bool is_box = box.bits() >> 30 == 0;
    for (std::size_t axis = 0; axis < 3; ++axis) is_box &= box.low(axis) < box.high(axis);
    if (!is_box) return fail(Reason::invalid_list, offset, "the box of the list is not one");
    if (count < min_count || count > triangles_ || count > counts_.entries - entries_) {
      return fail(Reason::invalid_list, offset, "the list cannot have " + std::to_string(count) + " entries");
    }
    grid_.lists_.push_back({box, first_entry()});
    entries_ += count;
    return true;
  }

  [[nodiscard]] std::uint32_t first_entry() const { return static_cast<std::uint32_t>(entries_); }

  static constexpr std::uint32_t division = Grid::brick_edge * Grid::brick_edge;
  // The limits of a build.
  static constexpr std::size_t max_top_cells = std::size_t{1} << 24;
  static constexpr std::size_t max_brick_cells = CellWord::max_lists / 2 - max_top_cells;

  Grid& grid_;
  const GridCounts& counts_;
  std::uint32_t triangles_;
  std::optional<InvalidFile> error_;
  std::vector<GridFrame> frames_;
  std::vector<std::uint32_t> depths_;  ///< The number of grids around each grid that a cell has named so far.
  std::uint32_t depth_ = 0;            ///< The number of grids around the one that is read.
  FileReader cells_{{}};
  FileReader lists_{{}};
  std::size_t entries_ = 0;        ///< The number of entries of the lists so far.
  std::size_t outer_entries_ = 0;  ///< The number of entries of the outermost grid.
  std::vector<std::uint32_t> words_;
  ScratchVector<std::uint8_t> distances_;
};

template <typename Scalar>
std::optional<InvalidFile> GridFile::read(FileReader& reader, const GridCounts& counts, std::uint32_t triangles,
                                          Grid& grid, Offsets& offsets) {
  return GridReading(grid, counts, triangles).read<Scalar>(reader, offsets);
}

std::optional<InvalidFile> GridFile::find_disorder(const Grid& grid, std::uint32_t triangles, const Offsets& offsets) {
  const std::span<const CellList> lists = grid.lists();
  const PackedIds& ids = grid.entries();
  for (std::size_t list = 0; list + 1 < lists.size(); ++list) {
    std::uint64_t lowest = 0;
    for (std::size_t i = lists[list].first_entry; i < lists[list + 1].first_entry; ++i) {
      const std::uint32_t id = ids[i];
      if (id < lowest || id >= triangles) {
        const std::size_t offset = offsets.entries + i * ids.width();
        return InvalidFile(InvalidFile::Reason::invalid_list, offset,
                           "byte " + std::to_string(offset) + ": triangle " + std::to_string(id) +
                               (id < triangles ? " is not after the one before it" : " does not exist"));
      }
      lowest = std::uint64_t{id} + 1;
    }
  }
  return std::nullopt;
}

template void GridFile::write<float>(const Grid&, FileWriter&);
template void GridFile::write<double>(const Grid&, FileWriter&);
template std::optional<InvalidFile> GridFile::read<float>(FileReader&, const GridCounts&, std::uint32_t, Grid&,
                                                          Offsets&);
template std::optional<InvalidFile> GridFile::read<double>(FileReader&, const GridCounts&, std::uint32_t, Grid&,
                                                           Offsets&);

}  // namespace surehit::detail
