#include "file/file_reader.hpp"

#include <algorithm>
#include <string>

#include "file/checksum.hpp"

namespace surehit::detail {
namespace {

std::string name_of(FileKind kind) { return kind == FileKind::collider ? "a collider" : "a scene"; }

std::string name_of_scalar(std::size_t bytes) { return bytes == sizeof(float) ? "floats" : "doubles"; }

}  // namespace

std::optional<InvalidFile> find_invalid_head(std::span<const std::byte> bytes, FileKind kind, std::size_t scalar_bytes,
                                             std::size_t base) {
  using Reason = InvalidFile::Reason;
  const auto fault = [&](Reason reason, std::size_t offset, const std::string& message) {
    return InvalidFile(reason, base + offset, "byte " + std::to_string(base + offset) + ": " + message);
  };
  const std::size_t compared = std::min(bytes.size(), file_magic.size());
  for (std::size_t i = 0; i < compared; ++i) {
    if (std::to_integer<std::uint8_t>(bytes[i]) == file_magic[i]) continue;
    return fault(Reason::not_saved, i, "no saved collider or scene begins so");
  }
  if (bytes.size() < head_bytes + checksum_bytes) {
    return fault(Reason::wrong_size, bytes.size(), "the file ends before its head does");
  }
  FileReader head(bytes);
  static_cast<void>(head.take_bytes(file_magic.size()));
  if (head.take<std::uint32_t>() != byte_order_mark) {
    return fault(Reason::wrong_byte_order, file_magic.size(), "the bytes of numbers are not in the order 4, 3, 2, 1");
  }
  const std::size_t at_version = head.offset();
  const auto version = head.take<std::uint16_t>();
  if (version == 0) return fault(Reason::not_saved, at_version, "no version of the format has the number 0");
  if (version > file_version) {
    return fault(Reason::newer_version, at_version,
                 "the format has version " + std::to_string(version) + ", and this library reads version " +
                     std::to_string(file_version));
  }
  const std::size_t at_kind = head.offset();
  const auto held = head.take<std::uint8_t>();
  if (held != static_cast<std::uint8_t>(kind)) {
    return fault(Reason::wrong_kind, at_kind, "the file does not hold " + name_of(kind));
  }
  const std::size_t at_scalar = head.offset();
  if (head.take<std::uint8_t>() != scalar_bytes) {
    return fault(Reason::wrong_scalar, at_scalar, "the file does not hold " + name_of_scalar(scalar_bytes));
  }
  const std::size_t at_size = head.offset();
  if (const auto size = head.take<std::uint64_t>(); size != bytes.size()) {
    return fault(
        Reason::wrong_size, at_size,
        "the file says that it has " + std::to_string(size) + " bytes, but it has " + std::to_string(bytes.size()));
  }
  const std::size_t end = bytes.size() - checksum_bytes;
  Checksum sum;
  sum.add(bytes.first(end));
  FileReader stored(bytes.subspan(end));
  if (stored.take<std::uint64_t>() != sum.value()) {
    return fault(Reason::wrong_checksum, end, "the checksum is not that of the bytes, so the file is damaged");
  }
  return std::nullopt;
}

}  // namespace surehit::detail
