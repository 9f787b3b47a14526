#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace surehit::test {

/// Reads a fuzzer's bytes as choices and numbers. Every input is one: behind the last byte there are zeros.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] bool is_empty() const { return rest_.empty(); }

  template <std::integral Integer>
  Integer take() {
    Integer value = 0;
    const std::size_t count = std::min(sizeof value, rest_.size());
    if (count > 0) std::memcpy(&value, rest_.data(), count);
    rest_ = rest_.subspan(count);
    return value;
  }

  /// 0 … count - 1 from one byte, for a count of 256 at most.
  std::size_t below(std::size_t count) { return take<std::uint8_t>() % count; }

  bool one_in(std::size_t count) { return below(count) == count - 1; }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace surehit::test
