#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

/// Walks down a text line by line.
///
/// A line ends in \n, \r\n or a lone \r; the last one may end in nothing. A byte order mark at the start is skipped.
/// So is a closing Ctrl-Z, with which DOS programs mark the end of a text.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  /// Goes to the next line. Returns false where there is none, and stays on the last one.
  bool next();
  [[nodiscard]] std::string_view line() const { return line_; }
  /// What ends the line: \n, \r\n, \r or nothing.
  [[nodiscard]] std::string_view line_end() const { return line_end_; }
  /// The number of the line, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// All that follows the line and its end, the closing Ctrl-Z included.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t closing_size_;  ///< bytes at the end of `rest_` that belong to no line
  std::string_view line_;
  std::string_view line_end_;
  std::size_t number_ = 0;
};

inline constexpr std::string_view white_space = " \t\r\v\f";

/// The parts of a line between white space.
void split(std::string_view line, std::vector<std::string_view>& fields);

/// The line without its comment. A # begins one at the line's start or after white space; inside a word it does not,
/// since `1.#QNAN` is how some programs spell a number that is none.
[[nodiscard]] std::string_view without_comment(std::string_view line);

/// The error with the line's number before it. Line 0 is no line.
[[nodiscard]] InputError at_line(const InputError& error, std::size_t number);

/// Does the work. Any InputError that comes out of it names the line that `lines` is at.
template <typename Work>
auto naming_the_line(const TextLines& lines, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw at_line(error, lines.number());
  }
}

}  // namespace surehit::example
