#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "file/checksum.hpp"
#include "file/file_head.hpp"
#include "surehit/byte_sink.hpp"

namespace surehit::detail {

/// Writes a file to a sink: numbers with the low bytes first, and the checksum at the end. Small pieces are put
/// together.
class FileWriter {
 public:
  /// The sink must outlive the writer.
  explicit FileWriter(const ByteSink& sink) : sink_(sink) {}

  /// Writes the first `head_bytes`. `size` is the number of bytes of the whole file.
  void write_head(FileKind kind, std::size_t scalar_bytes, std::uint64_t size) {
    for (const std::uint8_t byte : file_magic) write(byte);
    write(byte_order_mark);
    write(file_version);
    write(static_cast<std::uint8_t>(kind));
    write(static_cast<std::uint8_t>(scalar_bytes));
    write(size);
  }
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void write(Number number) {
    if (filled_ + sizeof number > buffer_.size()) flush();
    std::memcpy(buffer_.data() + filled_, &number, sizeof number);
    filled_ += sizeof number;
  }
  void write_bytes(std::span<const std::byte> bytes) {
    flush();
    put(bytes);
  }
  /// Completes the file. Returns false if the sink did not take all of it.
  [[nodiscard]] bool finish() {
    flush();
    write(sum_.value());
    flush();
    return takes_more_;
  }

 private:
  void flush() {
    put(std::span(buffer_).first(filled_));
    filled_ = 0;
  }
  void put(std::span<const std::byte> bytes) {
    if (bytes.empty() || !takes_more_) return;
    sum_.add(bytes);
    takes_more_ = sink_(bytes);
  }

  const ByteSink& sink_;
  Checksum sum_;
  std::array<std::byte, std::size_t{1} << 12> buffer_;
  std::size_t filled_ = 0;
  bool takes_more_ = true;
};

}  // namespace surehit::detail
