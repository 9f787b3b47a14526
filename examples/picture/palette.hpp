#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "picture/canvas.hpp"

namespace surehit::example {

/// The colours that some canvases need most, at most 63 of them. Colours that differ little are taken as one.
class Palette {
 public:
  using Bytes = std::array<std::uint8_t, 3>;
  static constexpr std::size_t max_colours = 63;

  /// Counts the colours of a canvas.
  void count(const Canvas& canvas);
  /// Chooses the colours, once all are counted.
  void choose();

  [[nodiscard]] const std::vector<Bytes>& colours() const { return colours_; }
  /// The index of the nearest colour of the palette.
  [[nodiscard]] std::uint8_t nearest(const Colour& colour) const { return nearest_[cell_of(bytes_of(colour))]; }

 private:
  static constexpr int bits = 5;  ///< of each part of a colour, which tell one from another

  struct Cell {
    std::uint64_t pixels = 0;
    std::array<std::uint64_t, 3> sums = {};
  };

  static Bytes bytes_of(const Colour& colour);
  static std::size_t cell_of(const Bytes& bytes);

  std::vector<Cell> cells_ = std::vector<Cell>(std::size_t{1} << (3 * bits));
  std::vector<Bytes> colours_;
  std::vector<std::uint8_t> nearest_;
};

}  // namespace surehit::example
