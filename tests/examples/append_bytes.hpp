#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace surehit::test {

/// Appends the bytes of a number, the least significant one first.
template <typename Number>
void append_little_endian(Number number, std::string& bytes) {
  auto in_order = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (std::endian::native == std::endian::big) std::reverse(in_order.begin(), in_order.end());
  bytes.append(in_order.data(), in_order.size());
}

template <typename Number>
void append_big_endian(Number number, std::string& bytes) {
  append_little_endian(number, bytes);
  std::reverse(bytes.end() - sizeof(Number), bytes.end());
}

/// The same two as objects, which a test may take as an argument.
inline constexpr auto little_endian = [](auto number, std::string& bytes) { append_little_endian(number, bytes); };
inline constexpr auto big_endian = [](auto number, std::string& bytes) { append_big_endian(number, bytes); };

}  // namespace surehit::test
