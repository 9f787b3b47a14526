#include "visibility_bake/visibility.hpp"

namespace surehit::example {
namespace {

void set_bit(std::vector<std::uint8_t>& bits, std::size_t bit) {
  bits[bit / 8] |= static_cast<std::uint8_t>(1 << bit % 8);
}

}  // namespace

Visibility::Visibility(std::uint32_t cells) : figures_(cells), bits_(cells * bytes_of_a_row()), has_row_(cells) {
  for (std::uint32_t cell = 0; cell < cells; ++cell) set_bit(bits_, bit_at(cell, cell));
}

void Visibility::add(const RowOfPairs& row) {
  has_row_[row.cell] = 1;
  ++row_count_;
  Figures& own = figures_[row.cell];
  for (std::size_t i = 0; i < row.partners.size(); ++i) {
    const std::uint32_t partner = row.partners[i];
    const std::uint32_t clear = row.clear[i];
    for (Figures* figures : {&own, &figures_[partner]}) {
      ++figures->cells_in_range;
      figures->cells_seen += clear > 0 ? 1 : 0;
      figures->clear_segments += clear;
    }
    if (clear > 0) set_bit(bits_, bit_at(row.cell, partner));
  }
}

std::vector<std::uint8_t> Visibility::matrix() const {
  std::vector<std::uint8_t> both = bits_;
  for (std::uint32_t a = 0; a < cell_count(); ++a) {
    for (std::uint32_t b = 0; b < cell_count(); ++b) {
      if (has(a, b)) set_bit(both, bit_at(b, a));
    }
  }
  return both;
}

}  // namespace surehit::example
