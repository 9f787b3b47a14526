#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace surehit::example {

/// Numbers as bytes, the lowest byte first, and at the end a checksum of all that is before it.
class ByteWriter {
 public:
  /// Each file begins with a text that says what it is.
  explicit ByteWriter(std::string_view title) : bytes_(title) {}

  void add(std::uint64_t number, int count) {
    for (int i = 0; i < count; ++i) bytes_ += static_cast<char>(number >> (8 * i) & 255);
  }
  void add(float number) { add(std::bit_cast<std::uint32_t>(number), 4); }
  void add(std::string_view bytes) { bytes_ += bytes; }

  /// All bytes, with the checksum.
  [[nodiscard]] std::string finish();

 private:
  std::string bytes_;
};

/// The bytes between the title and the checksum. Throws InputError if either is not right.
[[nodiscard]] std::string_view checked_content(std::string_view file, std::string_view title);

/// Compressed bytes, the same for the same bytes on one machine.
[[nodiscard]] std::string compressed_bytes(std::string_view bytes);
/// Throws InputError if the result does not have `size` bytes.
[[nodiscard]] std::string decompressed_bytes(std::string_view bytes, std::size_t size);

}  // namespace surehit::example
