#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>

#include "file/file_head.hpp"
#include "surehit/invalid_file.hpp"

namespace surehit::detail {

/// Reads the numbers of a file, one after the other.
class FileReader {
 public:
  /// `offset` is the index of the first byte in the whole file.
  explicit FileReader(std::span<const std::byte> bytes, std::size_t offset = 0) : bytes_(bytes), base_(offset) {}

  /// Returns the index of the next byte in the whole file.
  [[nodiscard]] std::size_t offset() const { return base_ + at_; }
  /// Returns the number of bytes that are left.
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  /// Returns true if so many elements of this size are left. No product overflows.
  [[nodiscard]] bool has(std::size_t count, std::size_t size) const { return count <= left() / size; }
  /// Returns the next number. It must be left, here and below.
  template <typename Number>
  [[nodiscard]] Number take() {
    static_assert(std::endian::native == std::endian::little);
    Number number;
    std::memcpy(&number, take_bytes(sizeof number).data(), sizeof number);
    return number;
  }
  /// Returns the next count of 64 bits. A count that is too large for this machine stays too large for any file.
  [[nodiscard]] std::size_t take_count() {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(take<std::uint64_t>(), std::numeric_limits<std::size_t>::max()));
  }
  [[nodiscard]] std::span<const std::byte> take_bytes(std::size_t count) {
    assert(count <= left());
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t base_;
  std::size_t at_ = 0;
};

/// Reads the head of a file, and checks the checksum. Returns what is wrong, or nothing. `base` is the index of the
/// first byte in the whole file, if the bytes are a part of it.
[[nodiscard]] std::optional<InvalidFile> find_invalid_head(std::span<const std::byte> bytes, FileKind kind,
                                                           std::size_t scalar_bytes, std::size_t base = 0);

/// Returns what is between the head and the checksum. The head must be valid.
[[nodiscard]] inline FileReader body_of(std::span<const std::byte> bytes, std::size_t base = 0) {
  return FileReader(bytes.subspan(head_bytes, bytes.size() - head_bytes - checksum_bytes), base + head_bytes);
}

}  // namespace surehit::detail
