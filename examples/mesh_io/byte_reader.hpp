#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace surehit::example {

/// Takes numbers from the front of bytes, in either order of bytes. Throws InputError where the bytes end too early.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::endian order) : rest_(bytes), order_(order) {}

  template <typename Number>
  Number take() {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), take_bytes(sizeof(Number)).data(), sizeof(Number));
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  void skip(std::uint64_t count) { take_bytes(count); }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view take_bytes(std::uint64_t count);

  std::string_view rest_;
  std::endian order_;
};

}  // namespace surehit::example
