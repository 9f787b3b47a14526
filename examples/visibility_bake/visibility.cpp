#include "visibility_bake/visibility.hpp"

namespace surehit::example {

Visibility::Visibility(std::uint32_t cells) : figures_(cells), bits_(cells * bytes_of_a_row()), has_row_(cells) {
  for (std::uint32_t cell = 0; cell < cells; ++cell) set(cell, cell);
}

void Visibility::add(const RowOfPairs& row) {
  has_row_[row.cell] = 1;
  ++row_count_;
  for (std::size_t i = 0; i < row.partners.size(); ++i) {
    const std::uint32_t partner = row.partners[i];
    for (const std::uint32_t cell : {row.cell, partner}) {
      Figures& figures = figures_[cell];
      ++figures.cells_in_range;
      figures.cells_seen += row.clear[i] > 0 ? 1 : 0;
      figures.clear_segments += row.clear[i];
    }
    if (row.clear[i] == 0) continue;
    set(row.cell, partner);
    set(partner, row.cell);
  }
}

}  // namespace surehit::example
