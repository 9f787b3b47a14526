#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "surehit/box.hpp"
#include "surehit/default_init_allocator.hpp"
#include "surehit/executor.hpp"
#include "surehit/float4.hpp"
#include "surehit/grid_cover.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// How finely a grid divides the mesh's box. No setting changes an answer, only time and memory.
struct GridOptions {
  /// Cells along x, y and z, before crowded ones are divided again; 0 leaves that axis to the grid, which aims at
  /// `cells_per_triangle` cells in all, cubes or in the shape of the triangles' mean box where that is far from one,
  /// and at fewer where they would be narrow for the triangles. Whatever is asked for is made coarser where it would
  /// break the grid's budget of memory or its bound on rounding.
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};
  double cells_per_triangle = 1;
  /// Cells that list more triangles than this are divided into 4 × 4 × 4, if that parts the triangles. 0: never.
  std::uint32_t crowded = 192;
};

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
    [[nodiscard]] std::int32_t index(detail::Int4 place) const noexcept {
      return place[0] * pitch[0] + place[1] * pitch[1] + (place[2] * pitch[2] + first);
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
  static constexpr std::uint32_t most_finest_cells = std::uint32_t{1} << 15;

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
  [[nodiscard]] double place(std::size_t axis, double scaled_coordinate) const noexcept;
};

/// What a cell holds, in 32 bits. An empty cell has a nibble for each octant of directions: how many cells a path of
/// that octant may cross at once on every axis, this one included, since all of them are empty. The first nibble of any
/// other cell is 0, the fifth bit tells a list from a brick, and the rest is its number.
class CellWord {
 public:
  CellWord() = default;
  explicit CellWord(std::uint32_t bits) : bits_(bits) {}

  static constexpr std::uint32_t most_numbers = std::uint32_t{1} << 27;
  static constexpr std::uint32_t farthest = 15;        ///< a nibble's
  static constexpr std::uint32_t divided_bits = 0x1f;  ///< all 0 in the word of a divided cell

  static CellWord listing(std::uint32_t list) { return CellWord(list << 5 | 1U << 4); }
  static CellWord divided(std::uint32_t brick) { return CellWord(brick << 5); }

  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] bool is_empty() const { return (bits_ & 15) != 0; }
  [[nodiscard]] bool is_divided() const { return (bits_ & divided_bits) == 0; }
  /// Of the list; of a divided cell, of its brick.
  [[nodiscard]] std::uint32_t number() const { return bits_ >> 5; }
  [[nodiscard]] std::uint32_t distance(std::uint32_t octant) const { return bits_ >> 4 * octant & 15; }

 private:
  std::uint32_t bits_ = 0;
};

/// The box of what a list's triangles take up of their cell, in 32nds of the cell's edge, in 32 bits: on each axis five
/// bits for the low side and five for the high one. Rounded outward, and to the cell where they reach beyond it.
class CellBox {
 public:
  static constexpr std::uint32_t parts = 32;  ///< of an edge

  CellBox() = default;
  explicit CellBox(std::uint32_t bits) : bits_(bits) {}

  /// Of a box in such parts, above the cell's low corner: sides in [0, parts], low ones below high ones.
  static CellBox around(const std::array<std::uint32_t, 3>& low, const std::array<std::uint32_t, 3>& high) {
    std::uint32_t bits = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) bits |= (low[axis] | (high[axis] - 1) << 5) << 10 * axis;
    return CellBox(bits);
  }

  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] std::uint32_t low(std::size_t axis) const { return bits_ >> 10 * axis & (parts - 1); }
  [[nodiscard]] std::uint32_t high(std::size_t axis) const { return (bits_ >> (10 * axis + 5) & (parts - 1)) + 1; }

 private:
  std::uint32_t bits_ = 0;
};

/// Two parallel planes that have between them what of a list's triangles may be met in its cell, in 32 bits: their
/// normal in whole numbers, five bits for each component, and two places along it, eight bits for each, in steps of
/// 3/16 of the cell's edge from the cell's centre. No point of the cell grown by half a padding, 1/32 of its edge or
/// less, is more than 127.5 steps from there; so the last places hold all beyond them too.
class CellSlab {
 public:
  static constexpr std::int32_t longest = 15;   ///< component of a normal
  static constexpr std::int32_t lowest = -128;  ///< place,
  static constexpr std::int32_t highest = 127;  //
  static constexpr float step = 3.0F / 16;      ///< from one to the next, in edges of the cell

  /// All of the cell.
  CellSlab() = default;
  explicit CellSlab(std::uint32_t bits) : bits_(bits) {}

  /// The upper plane is at the place after `high`.
  static CellSlab between(const std::array<std::int32_t, 3>& normal, std::int32_t low, std::int32_t high) {
    std::uint32_t bits = (static_cast<std::uint32_t>(low) & 0xff) << 16 | static_cast<std::uint32_t>(high) << 24;
    for (std::size_t axis = 0; axis < 3; ++axis) bits |= (static_cast<std::uint32_t>(normal[axis]) & 31) << 5 * axis;
    return CellSlab(bits);
  }

  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] std::int32_t normal(std::size_t axis) const {
    return static_cast<std::int32_t>(bits_ << (27 - 5 * axis)) >> 27;
  }
  [[nodiscard]] std::int32_t low() const { return static_cast<std::int32_t>(bits_ << 8) >> 24; }
  [[nodiscard]] std::int32_t high() const { return static_cast<std::int32_t>(bits_) >> 24; }

 private:
  std::uint32_t bits_ = 0x7f800000;
};

/// What a grid knows of a list beside its triangles. It ends where the next one begins.
struct CellList {
  CellBox box;                ///< the part of the cell that the triangles take up
  std::uint32_t first_entry;  ///< among the grid's
};

namespace detail {

/// A point counted in finest cells, as long as a vector load; its fourth number is 0.
using PaddedPoint = Float4;
struct PaddedBox {
  PaddedPoint low, high;
};

/// Which triangles meet which cells, of all triangles in turn.
struct CellEntries {
  static constexpr std::size_t too_many = std::numeric_limits<std::size_t>::max();

  std::size_t count = 0;             ///< as far as the rest counts; `too_many` if there was no room
  RoomyVector<std::uint32_t> cells;  ///< as many as there is room for
  RoomyVector<std::uint32_t> triangles;

  /// So many of the entries are likely to be.
  void make_room(std::size_t entries, std::size_t likely = 0) {
    if (cells.size() >= entries) return;
    triangles.resize(entries);
    cells.resize(entries);  // last: where that throws, they still tell what room there is
    fault_in(triangles.data(), likely * sizeof(std::uint32_t));
    fault_in(cells.data(), likely * sizeof(std::uint32_t));
  }
};

/// Lists of triangles, one for each of some cells, while they are made.
struct CellLists {
  CellEntries entries;
  UnsetVector<std::uint32_t> offsets;    ///< where each cell's list begins, and one more for the end
  UnsetVector<std::uint32_t> triangles;  ///< the lists, one behind the other
};

}  // namespace detail

/// What a build needs besides the grid. Given to the next build, its memory is used again.
class GridScratch {
 public:
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  template <typename Scalar>
  friend class GridBuild;

  detail::UnsetVector<detail::PaddedPoint> points_;  ///< the vertices
  detail::UnsetVector<detail::PaddedBox> boxes_;     ///< the triangles'
  std::array<detail::CellLists, 3> lists_;    ///< of the top cells, and of the brick of each level that is being made
  std::vector<detail::CellEntries> parts_;    ///< of the top cells, where parts of the mesh are listed at once
  detail::UnsetVector<std::uint32_t> words_;  ///< the top cells' words
  detail::UnsetVector<std::uint8_t> distances_;  ///< through empty cells
};

/// A uniform grid over a mesh's box, in which crowded cells hold a brick of 4 × 4 × 4 cells of their own, and so on for
/// `levels` levels. Each undivided cell lists the triangles that meet the cell's box grown by `GridFrame::padding`.
///
/// Listing is conservative and about as tight as clipping each triangle to the cell: it never misses one that meets the
/// grown box, and is at most rounding wider.
class Grid {
 public:
  static constexpr std::uint32_t brick_edge = 4;
  static constexpr std::uint32_t brick_size = brick_edge * brick_edge * brick_edge;
  static constexpr std::uint32_t most_levels = 2;

  /// No cells.
  Grid() = default;

  /// Of a valid mesh (see `find_invalid`) and its box. Time and memory are linear in the triangles, for the resolution
  /// is lowered until the lists fit their budget. The grid is the same with an executor as without. May throw
  /// std::bad_alloc.
  template <typename Scalar>
  Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
       const Executor* executor = nullptr);
  /// Becomes the grid of another mesh, in the memory that it has. If that throws,
  /// the grid is good for another rebuild only.
  template <typename Scalar>
  void rebuild(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options,
               GridScratch& scratch, const Executor* executor = nullptr);

  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  /// Boxes around all lists.
  [[nodiscard]] const GridCover& cover() const noexcept { return cover_; }
  /// Top cells on each axis.
  [[nodiscard]] const std::array<std::uint32_t, 3>& resolution() const noexcept { return frame_.cells; }
  [[nodiscard]] bool is_empty() const noexcept { return entries_.empty(); }
  /// Levels of bricks below the top cells, 0 if none is divided.
  [[nodiscard]] std::uint32_t levels() const noexcept { return levels_; }
  /// Top cells, and the cells of all bricks.
  [[nodiscard]] std::size_t cell_count() const noexcept { return top_count_ + bricks_.size(); }
  /// Entries of all cells' lists together, repetitions included.
  [[nodiscard]] std::size_t entry_count() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return (top_.capacity() + bricks_.capacity()) * sizeof(CellWord) + lists_.capacity() * sizeof(CellList) +
           entries_.capacity() * sizeof(std::uint32_t);
  }

  /// Words of the top cells, x fastest, then y, then z.
  [[nodiscard]] std::span<const CellWord> top() const noexcept { return {top_.data(), top_count_}; }
  /// Words of the bricks' cells, `brick_size` a brick in the same order.
  [[nodiscard]] std::span<const CellWord> bricks() const noexcept { return bricks_; }
  /// All lists, one behind the other.
  [[nodiscard]] std::span<const std::uint32_t> entries() const noexcept { return entries_; }

  /// By their numbers, and one more that begins where the last one ends. None where there are no triangles.
  [[nodiscard]] std::span<const CellList> lists() const noexcept { return lists_; }
  /// Where a cell's list begins among the entries.
  [[nodiscard]] std::size_t first_entry(CellWord word) const noexcept { return lists_[word.number()].first_entry; }
  [[nodiscard]] std::uint32_t entry_count(CellWord word) const noexcept {
    const CellList* list = lists_.data() + word.number();
    return list[1].first_entry - list[0].first_entry;
  }
  [[nodiscard]] CellBox box(CellWord word) const noexcept { return lists_[word.number()].box; }
  /// Ids of the triangles that a cell lists, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles(CellWord word) const noexcept {
    return {entries_.data() + first_entry(word), entry_count(word)};
  }

 private:
  template <typename Scalar>
  friend class GridBuild;

  GridFrame frame_;
  GridCover cover_;
  std::uint32_t levels_ = 0;
  std::size_t top_count_ = 0;
  detail::UnsetVector<CellWord> top_;  ///< and as many more as one vector load may read beyond the last
  std::vector<CellWord> bricks_;
  detail::UnsetVector<CellList> lists_;
  detail::UnsetVector<std::uint32_t> entries_;
};

}  // namespace surehit
