#include "mesh_io/text_lines.hpp"

#include <algorithm>

namespace surehit::example {

TextLines::TextLines(std::string_view text) : rest_(text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

bool TextLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(white_space, end);
    if (begin == std::string_view::npos) return;
    end = std::min(line.find_first_of(white_space, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
  }
}

}  // namespace surehit::example
