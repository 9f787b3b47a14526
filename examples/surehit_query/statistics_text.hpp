#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <surehit/query_statistics.hpp>
#include <utility>

namespace surehit::example {

/// Appends `,` and how many they are in a million of the whole; of nothing, only the comma.
inline void append_per_million(std::uint64_t count, std::uint64_t whole, std::string& text) {
  text += ',';
  if (whole == 0) return;
  std::array<char, 32> digits;
  const double per_million = 1e6 * static_cast<double>(count) / static_cast<double>(whole);
  const char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), per_million, std::chars_format::fixed, 3).ptr;
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

/// As CSV, with a header.
[[nodiscard]] inline std::string text_of(const QueryStatistics& statistics) {
  const std::array<std::pair<const char*, std::uint64_t>, 8> counts = {{
      {"paths", statistics.paths},
      {"cells", statistics.cells},
      {"candidates", statistics.candidates},
      {"undecided", statistics.undecided},
      {"exact_decisions", statistics.exact_decisions},
      {"exact_orders", statistics.exact_orders},
      {"exact_roundings", statistics.exact_roundings},
      {"unclipped", statistics.unclipped},
  }};
  std::string text = "statistic,count,per_million_paths,per_million_candidates\n";
  for (const auto& [name, count] : counts) {
    text += name;
    text += ',' + std::to_string(count);
    append_per_million(count, statistics.paths, text);
    append_per_million(count, statistics.candidates, text);
    text += '\n';
  }
  return text;
}

}  // namespace surehit::example
