#include "mesh_io/text_lines.hpp"

#include <algorithm>

namespace surehit::example {
namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
constexpr std::string_view closing_bytes = "\x1a\n \t\r\v\f";
constexpr char control_z = '\x1a';

std::string_view closing(std::string_view text) {
  const std::string_view tail = text.substr(text.find_last_not_of(closing_bytes) + 1);
  return tail.substr(std::min(tail.find(control_z), tail.size()));
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_(text), closing_size_(closing(text).size()) {
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

bool TextLines::next() {
  if (rest_.size() <= closing_size_) return false;
  const std::string_view text = rest_.substr(0, rest_.size() - closing_size_);
  const auto* const end = std::find_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
  const auto size = static_cast<std::size_t>(end - text.begin());
  line_ = text.substr(0, size);
  line_end_ = text.substr(size, text.substr(size).starts_with("\r\n") ? 2 : 1);
  rest_.remove_prefix(size + line_end_.size());
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

std::string_view without_comment(std::string_view line) {
  std::size_t mark = line.find('#');
  while (mark != std::string_view::npos && mark > 0 && white_space.find(line[mark - 1]) == std::string_view::npos) {
    mark = line.find('#', mark + 1);
  }
  return line.substr(0, mark);
}

InputError at_line(const InputError& error, std::size_t number) {
  return number == 0 ? error : error.at("line " + std::to_string(number));
}

}  // namespace surehit::example
