#include "mesh_io/input_error.hpp"

#include <algorithm>

namespace surehit::example {

InputError InputError::at(std::string_view place) const { return InputError(std::string(place) + ": " + what()); }

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > longest ? shown + "…" : shown;
}

std::string quoted(std::string_view text) { return std::string("'").append(printable(text)).append("'"); }

}  // namespace surehit::example
