#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "file/checksum.hpp"

namespace surehit::test {

using Bytes = std::vector<std::byte>;

/// The bytes of a saved collider or scene.
template <typename T>
[[nodiscard]] Bytes saved(const T& collider) {
  Bytes bytes;
  const auto append = [&](std::span<const std::byte> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return true;
  };
  if (!collider.save(append)) bytes.clear();
  return bytes;
}

template <typename Number>
[[nodiscard]] Number number_at(const Bytes& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

template <typename Number>
void set_number(Bytes& bytes, std::size_t offset, Number number) {
  std::memcpy(bytes.data() + offset, &number, sizeof number);
}

/// Makes the size and the checksum right, as someone does who damages a file on purpose.
inline void repair(Bytes& bytes) {
  constexpr std::size_t size_at = 16;
  if (bytes.size() < size_at + 16) return;
  set_number(bytes, size_at, std::uint64_t{bytes.size()});
  detail::Checksum sum;
  sum.add(std::span(bytes).first(bytes.size() - 8));
  set_number(bytes, bytes.size() - 8, sum.value());
}

/// Where the parts of a saved collider are, as FORMAT.md says.
struct ColliderParts {
  explicit ColliderParts(const Bytes& bytes) {
    const std::size_t scalar = number_at<std::uint8_t>(bytes, 15);
    const auto count = [&](std::size_t offset) {
      return static_cast<std::size_t>(number_at<std::uint64_t>(bytes, offset));
    };
    triangle_count = count(32);
    frame_count = number_at<std::uint32_t>(bytes, 72);
    list_count = number_at<std::uint32_t>(bytes, 76);
    cell_count = count(80);
    entry_count = count(88);
    index_width = count(24) <= 65536 ? 2 : 4;
    entry_width = triangle_count <= 65536 ? 2 : triangle_count <= 16777216 ? 3 : 4;
    frame_width = 6 * scalar + 12;
    vertices = 96;
    triangles = vertices + count(24) * 3 * scalar;
    masks = triangles + triangle_count * 3 * index_width;
    frames = masks + count(40) * 4;
    cells = frames + frame_count * frame_width;
    lists = cells + cell_count;
    entries = lists + list_count * 8;
    checksum = entries + entry_count * entry_width;
  }

  static constexpr std::size_t counts = 24;
  std::size_t triangle_count, frame_count, list_count, cell_count, entry_count;
  std::size_t index_width, entry_width, frame_width;
  std::size_t vertices, triangles, masks, frames, cells, lists, entries, checksum;
};

}  // namespace surehit::test
