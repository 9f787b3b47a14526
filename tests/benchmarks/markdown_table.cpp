#include "markdown_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace surehit::benchmark {

MarkdownTable::MarkdownTable(std::vector<std::string> header, std::size_t text_columns) : text_columns_(text_columns) {
  rows_.push_back(std::move(header));
}

void MarkdownTable::add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

std::string MarkdownTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 3);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  const auto add_line = [&](const auto& cell) {
    for (std::size_t i = 0; i < widths.size(); ++i) text += (i == 0 ? "| " : " ") + cell(i) + " |";
    text += '\n';
  };
  for (std::size_t line = 0; line < rows_.size(); ++line) {
    add_line([&](std::size_t i) {
      const std::string& cell = rows_[line][i];
      const std::string space(widths[i] - cell.size(), ' ');
      return i < text_columns_ ? cell + space : space + cell;
    });
    if (line > 0) continue;
    add_line([&](std::size_t i) {
      return i < text_columns_ ? std::string(widths[i], '-') : std::string(widths[i] - 1, '-') + ':';
    });
  }
  return text;
}

std::string short_number(double number) {
  const double size = std::abs(number);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", size < 10 ? 2 : size < 100 ? 1 : 0, number);
  return text;
}

}  // namespace surehit::benchmark
