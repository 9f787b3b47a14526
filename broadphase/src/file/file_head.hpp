#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit::detail {

/// What a file holds.
enum class FileKind : std::uint8_t { collider = 'c', scene = 's' };

/// Each file begins with these bytes. A transfer as text would change some of them.
inline constexpr std::array<std::uint8_t, 8> file_magic = {0x89, 's', 'r', 'h', 't', '\r', '\n', 0x1a};
/// Its bytes are 4, 3, 2, 1 in the file.
inline constexpr std::uint32_t byte_order_mark = 0x01020304;
/// The version of the format.
inline constexpr std::uint16_t file_version = 1;
/// The number of bytes before what is of a collider or of a scene alone.
inline constexpr std::size_t head_bytes = 24;
/// The number of bytes of the checksum at the end.
inline constexpr std::size_t checksum_bytes = 8;

}  // namespace surehit::detail
