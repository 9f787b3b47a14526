#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace surehit::benchmark {

/// A table that is as legible before it is rendered as after.
class MarkdownTable {
 public:
  /// The first `text_columns` are aligned to the left, those of numbers to the right.
  MarkdownTable(std::vector<std::string> header, std::size_t text_columns);

  void add_row(std::vector<std::string> cells);
  [[nodiscard]] std::string text() const;

 private:
  std::size_t text_columns_;
  std::vector<std::vector<std::string>> rows_;  ///< the header first
};

/// Three significant digits, more where the whole part has them, no exponent.
[[nodiscard]] std::string short_number(double number);

}  // namespace surehit::benchmark
