#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit {

/// What a cell holds, in 32 bits. An empty cell has a nibble for each octant of directions: how many cells a path of
/// that octant may cross at once on every axis, this one included, since all of them are empty. The first nibble of any
/// other cell is 0, the fifth bit tells a list from a brick, and the rest is its number.
class CellWord {
 public:
  CellWord() = default;
  explicit CellWord(std::uint32_t bits) : bits_(bits) {}

  static constexpr std::uint32_t max_numbers = std::uint32_t{1} << 27;
  static constexpr std::uint32_t max_distance = 15;    ///< a nibble's
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

}  // namespace surehit
