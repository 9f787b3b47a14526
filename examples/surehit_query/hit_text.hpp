#pragma once

#include <array>
#include <charconv>
#include <string>
#include <surehit/hit.hpp>

namespace surehit::example {

/// Appends a number so that it reads back to the same bits.
template <typename Number>
void append_number(Number number, std::string& text) {
  std::array<char, 32> digits;
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

[[nodiscard]] inline const char* name_of(Side side) {
  switch (side) {
    case Side::front:
      return "front";
    case Side::back:
      return "back";
    case Side::edge_on:
      break;
  }
  return "edge_on";
}

/// Appends `,t,u,v,side` and ends the line.
template <typename Scalar>
void append_contact(const Hit<Scalar>& hit, std::string& text) {
  for (const Scalar number : {hit.t, hit.u, hit.v}) {
    text += ',';
    append_number(number, text);
  }
  text += ',';
  text += name_of(hit.side);
  text += '\n';
}

}  // namespace surehit::example
