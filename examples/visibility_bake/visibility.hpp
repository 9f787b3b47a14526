#pragma once

#include <cstdint>
#include <vector>

namespace surehit::example {

/// What was found out in the row of a cell.
struct RowOfPairs {
  std::uint32_t cell = 0;
  std::vector<std::uint32_t> partners;
  std::vector<std::uint32_t> clear;  ///< how many segments of each pair meet nothing
};

/// Which cells see which, as far as it is known. The order in which rows come does not matter.
class Visibility {
 public:
  /// The figures of a cell.
  struct Figures {
    std::uint64_t cells_in_range = 0;
    std::uint64_t cells_seen = 0;
    std::uint64_t clear_segments = 0;

    friend bool operator==(const Figures&, const Figures&) = default;
  };

  explicit Visibility(std::uint32_t cells);

  [[nodiscard]] std::uint32_t cell_count() const { return static_cast<std::uint32_t>(figures_.size()); }
  /// Adds a row, which is not there yet.
  void add(const RowOfPairs& row);
  [[nodiscard]] bool has_row(std::uint32_t cell) const { return has_row_[cell]; }
  [[nodiscard]] std::uint32_t row_count() const { return row_count_; }

  /// Whether any segment between the two cells meets nothing. A cell sees itself.
  [[nodiscard]] bool sees(std::uint32_t a, std::uint32_t b) const { return has(a, b) || has(b, a); }
  [[nodiscard]] const Figures& figures(std::uint32_t cell) const { return figures_[cell]; }
  /// The matrix row by row. A row is whole bytes. Bit i % 8 of byte i / 8 is for cell i. Row i has what cell i sees.
  [[nodiscard]] std::vector<std::uint8_t> matrix() const;
  [[nodiscard]] std::size_t bytes_of_a_row() const { return (figures_.size() + 7) / 8; }

  friend bool operator==(const Visibility&, const Visibility&) = default;

 private:
  friend class Checkpoint;

  [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const {
    return (bits_[bit_at(a, b) / 8] >> (bit_at(a, b) % 8) & 1) != 0;
  }
  [[nodiscard]] std::size_t bit_at(std::uint32_t a, std::uint32_t b) const { return 8 * (a * bytes_of_a_row()) + b; }
  std::vector<Figures> figures_;
  /// Each pair is in the row in which it was asked about. To set it in both, whoever adds rows would wait for memory.
  std::vector<std::uint8_t> bits_;
  std::vector<std::uint8_t> has_row_;
  std::uint32_t row_count_ = 0;
};

}  // namespace surehit::example
