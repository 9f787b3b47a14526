#pragma once

#include <array>
#include <string>
#include <string_view>

namespace surehit::test {

inline constexpr std::array<std::string_view, 3> line_ends = {"\n", "\r\n", "\r"};

/// The text with another end for each \n.
inline std::string with_line_ends(std::string_view text, std::string_view end) {
  std::string changed;
  for (const char c : text) {
    if (c == '\n') {
      changed += end;
    } else {
      changed += c;
    }
  }
  return changed;
}

/// The text with ends of all kinds, one after the other. No \r comes before a \n, which would make one end of two.
inline std::string with_mixed_line_ends(std::string_view text) {
  std::string changed;
  std::size_t next = 0;
  for (const char c : text) {
    if (c != '\n') {
      changed += c;
      continue;
    }
    if (changed.ends_with('\r') && line_ends[next] == "\n") next = 1;
    changed += line_ends[next];
    next = (next + 1) % line_ends.size();
  }
  return changed;
}

/// What may close a text of DOS: a Ctrl-Z or several, on a line of their own or not.
inline constexpr std::array<std::string_view, 8> closing_control_z = {
    "\x1a", "\x1a\x1a\x1a", "\x1a\n", "\x1a\r\n", "\n\x1a", "\r\n\x1a\r\n", "\r\x1a\r", " \x1a \x1a\n\n"};

}  // namespace surehit::test
