#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

/// Walks down a text line by line. Lines end in \n or \r\n, the last one also without; a byte order mark is no part of
/// them.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  /// Goes to the next line; stays on the last one and answers false where there is none.
  bool next();
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Of the line, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// All that follows the line.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
};

inline constexpr std::string_view white_space = " \t\r\v\f";

/// The parts of a line between white space.
void split(std::string_view line, std::vector<std::string_view>& fields);

/// A line without the comment that a # begins.
[[nodiscard]] inline std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

/// Does the work, and names the line where `lines` stand in any InputError that comes out of it.
template <typename Work>
auto naming_the_line(const TextLines& lines, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw error.at("line " + std::to_string(lines.number()));
  }
}

}  // namespace surehit::example
