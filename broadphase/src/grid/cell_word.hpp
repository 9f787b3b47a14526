#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit {

/// What a cell holds, in 32 bits.
///
/// An empty cell has a distance of 4 bits for each octant of directions: the edge, in cells, of a cube of empty cells
/// that begins with this cell. A path of that octant may leap over the whole cube. In any other cell the first 4 bits
/// are 0. The fifth bit is 1 for a list and 0 for a brick. The rest of a brick's word is its number. The sixth bit of a
/// list is 1 if the cell also has an inner grid. The rest of its word is the number of the list.
class CellWord {
 public:
  CellWord() = default;
  explicit CellWord(std::uint32_t bits) : bits_(bits) {}

  static constexpr std::uint32_t max_lists = std::uint32_t{1} << 26;   ///< The maximum number of lists.
  static constexpr std::uint32_t max_bricks = std::uint32_t{1} << 27;  ///< The maximum number of bricks.
  static constexpr std::uint32_t max_distance = 15;                    ///< The largest number that 4 bits can hold.
  static constexpr std::uint32_t divided_bits = 0x1f;  ///< These bits are all 0 in the word of a divided cell.
  static constexpr std::uint32_t inner_bit = 1U << 5;  ///< This bit of a list's word is set if there is an inner grid.
  static constexpr int list_shift = 6;                 ///< The bits below the number of a list.
  static constexpr int brick_shift = 5;                ///< The bits below the number of a brick.

  /// Returns the word of a cell with a list.
  static CellWord listing(std::uint32_t list) { return CellWord(list << list_shift | list_bit); }
  /// Returns the word of a cell with a list and an inner grid.
  static CellWord with_inner_grid(std::uint32_t list) { return CellWord(list << list_shift | inner_bit | list_bit); }
  /// Returns the word of a cell that is divided into a brick.
  static CellWord divided(std::uint32_t brick) { return CellWord(brick << brick_shift); }

  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] bool is_empty() const { return (bits_ & 15) != 0; }
  [[nodiscard]] bool is_divided() const { return (bits_ & divided_bits) == 0; }
  /// Returns true if a cell with a list also has an inner grid.
  [[nodiscard]] bool has_inner_grid() const { return (bits_ & inner_bit) != 0; }
  /// Returns the number of the list of a cell that has one.
  [[nodiscard]] std::uint32_t list() const { return bits_ >> list_shift; }
  /// Returns the number of the brick of a divided cell.
  [[nodiscard]] std::uint32_t brick() const { return bits_ >> brick_shift; }
  /// Returns the edge of the cube of empty cells that begins with this empty cell.
  [[nodiscard]] std::uint32_t distance(std::uint32_t octant) const { return bits_ >> 4 * octant & 15; }

 private:
  static constexpr std::uint32_t list_bit = 1U << 4;

  std::uint32_t bits_ = 0;
};

/// A box around the part of a cell that the triangles of its list take up, in 32 bits. Its sides are counted in parts
/// of the cell's edge. Each axis has 5 bits for the low side and 5 for the high side. The box is rounded outward, but
/// not beyond the cell.
class CellBox {
 public:
  static constexpr std::uint32_t parts = 32;  ///< The number of parts along an edge of the cell.

  CellBox() = default;
  explicit CellBox(std::uint32_t bits) : bits_(bits) {}

  /// Returns the box with these sides. They are counted in parts from the cell's low corner, and lie in [0, parts].
  /// Each low side must be below the high side.
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

/// Two parallel planes, in 32 bits. All points where a path may meet the list's triangles in the cell lie between them
/// (L4 in WALK.md).
///
/// Each component of the normal is a whole number of 5 bits. The two heights along the normal have 8 bits each. They
/// are counted from the cell's centre, in steps of 3/16 of the cell's edge. No point of the cell, grown by half a
/// padding, is more than 127.5 steps from the centre. So the lowest and the highest height are used for all heights
/// beyond them.
class CellSlab {
 public:
  static constexpr std::int32_t longest = 15;   ///< The maximum component of a normal.
  static constexpr std::int32_t lowest = -128;  ///< The minimum height, in steps.
  static constexpr std::int32_t highest = 127;  ///< The maximum height, in steps.
  static constexpr float step = 3.0F / 16;      ///< The length of a step, in edges of the cell.

  /// A slab that holds the whole cell.
  CellSlab() = default;
  explicit CellSlab(std::uint32_t bits) : bits_(bits) {}

  /// Returns the slab between the heights `low` and `high` + 1.
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

/// What a grid knows about a list besides its triangles. A list ends where the next list begins.
struct CellList {
  CellBox box;                ///< The part of the cell that the triangles take up.
  std::uint32_t first_entry;  ///< The index of the list's first entry among all entries of the grid.
};

}  // namespace surehit
