#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace surehit::example {

/// Rows of as many numbers each.
template <typename Scalar>
struct NumberTable {
  std::size_t columns = 1;
  std::vector<Scalar> numbers;

  [[nodiscard]] std::size_t rows() const { return numbers.size() / columns; }
  [[nodiscard]] const Scalar* row(std::size_t index) const { return numbers.data() + index * columns; }
};

/// Splits a line at white space and at commas. Throws InputError where there is nothing on one side of a comma. `part`
/// is room for the work, so that lines need no new one.
void split_at_commas(std::string_view line, std::vector<std::string_view>& part, std::vector<std::string_view>& fields);

/// Reads a row from each line of a file, or of standard input if it is `-`. White space, or a comma with or without it,
/// separates numbers. Lines that begin with # and blank lines are skipped. `check` may refuse a row by an InputError.
/// Throws InputError, which names the file and the line.
template <typename Scalar>
[[nodiscard]] NumberTable<Scalar> read_number_table(const std::string& path, std::size_t columns,
                                                    const std::function<void(const Scalar* row)>& check = {});

}  // namespace surehit::example
