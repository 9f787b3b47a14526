#include "picture/animation.hpp"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/palette.hpp"

namespace surehit::example {
namespace {

/// The index behind those of a palette. Such a pixel shows what was there before.
constexpr std::uint8_t unchanged = Palette::max_colours;

/// A number as PNG writes it: the highest byte first.
std::string bytes_of(std::uint64_t value, int count) {
  std::string bytes;
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// The checksum of a chunk.
std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string chunk(std::string_view type, std::string_view data) {
  const std::string content = std::string(type) + std::string(data);
  return bytes_of(data.size(), 4) + content + bytes_of(crc_of(content), 4);
}

/// A part of a frame. Its pixels are indices into the palette.
struct Part {
  std::size_t x = 0;
  std::size_t y = 0;
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> pixels;

  [[nodiscard]] std::uint8_t at(std::size_t column, std::size_t row) const { return pixels[row * width + column]; }
};

Part indexed(const Canvas& canvas, const Palette& palette) {
  Part part{0, 0, static_cast<std::size_t>(canvas.width()), static_cast<std::size_t>(canvas.height()), {}};
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) part.pixels.push_back(palette.nearest(canvas.at(x, y)));
  }
  return part;
}

/// The smallest part of a frame that has all changes since another one.
Part changed_part(const Part& before, const Part& after) {
  std::size_t low_x = after.width;
  std::size_t low_y = after.height;
  std::size_t high_x = 0;
  std::size_t high_y = 0;
  for (std::size_t y = 0; y < after.height; ++y) {
    for (std::size_t x = 0; x < after.width; ++x) {
      if (before.at(x, y) == after.at(x, y)) continue;
      low_x = std::min(low_x, x);
      high_x = std::max(high_x, x + 1);
      low_y = std::min(low_y, y);
      high_y = std::max(high_y, y + 1);
    }
  }
  if (low_x >= high_x) return {0, 0, 1, 1, {unchanged}};
  Part part{low_x, low_y, high_x - low_x, high_y - low_y, {}};
  for (std::size_t y = low_y; y < high_y; ++y) {
    for (std::size_t x = low_x; x < high_x; ++x) {
      part.pixels.push_back(before.at(x, y) == after.at(x, y) ? unchanged : after.at(x, y));
    }
  }
  return part;
}

/// The compressed pixels, as they are in a PNG file. For a file, indices are the same bytes as greys.
std::string compressed(const Part& part) {
  std::string png;
  const auto append = [](void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  // Differences of indices mean nothing, and a longer search makes the file a good deal smaller.
  const int filter = std::exchange(stbi_write_force_png_filter, 0);
  const int level = std::exchange(stbi_write_png_compression_level, 512);
  const int width = static_cast<int>(part.width);
  const int height = static_cast<int>(part.height);
  const int written = stbi_write_png_to_func(append, &png, width, height, 1, part.pixels.data(), width);
  stbi_write_force_png_filter = filter;
  stbi_write_png_compression_level = level;
  if (written == 0) {
    throw std::runtime_error("a frame of an animation cannot be encoded");
  }
  const std::size_t type = png.find("IDAT");
  std::size_t size = 0;
  for (std::size_t i = type - 4; i < type; ++i) size = size << 8 | static_cast<std::uint8_t>(png[i]);
  return png.substr(type + 4, size);
}

std::string header(const Canvas& canvas, std::size_t frames, const Palette& palette) {
  constexpr std::uint64_t indexed_in_bytes = 0x0803000000;
  std::string colours;
  for (const Palette::Bytes& colour : palette.colours()) {
    for (const std::uint8_t part : colour) colours += static_cast<char>(part);
  }
  colours.resize(3 * (Palette::max_colours + 1));
  std::string opacities(Palette::max_colours, '\xff');
  opacities += '\0';
  const auto size = [](int pixels) { return bytes_of(static_cast<std::uint64_t>(pixels), 4); };
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", size(canvas.width()) + size(canvas.height()) + bytes_of(indexed_in_bytes, 5)) +
         chunk("acTL", bytes_of(frames, 4) + bytes_of(0, 4)) + chunk("PLTE", colours) + chunk("tRNS", opacities);
}

/// Says where a part of a frame is, and that it is drawn over the frame before.
std::string frame_control(std::uint32_t sequence, const Part& part, std::uint16_t milliseconds) {
  constexpr std::uint64_t keep_and_draw_over = 1;
  return chunk("fcTL", bytes_of(sequence, 4) + bytes_of(part.width, 4) + bytes_of(part.height, 4) +
                           bytes_of(part.x, 4) + bytes_of(part.y, 4) + bytes_of(milliseconds, 2) + bytes_of(1000, 2) +
                           bytes_of(keep_and_draw_over, 2));
}

}  // namespace

std::string encode_animation(std::span<const Canvas> frames, std::uint16_t milliseconds) {
  if (frames.empty()) throw std::invalid_argument("an animation needs a frame");
  Palette palette;
  for (const Canvas& frame : frames) palette.count(frame);
  palette.choose();
  std::string file = header(frames.front(), frames.size(), palette);
  Part before = indexed(frames.front(), palette);
  file += frame_control(0, before, milliseconds) + chunk("IDAT", compressed(before));
  std::uint32_t sequence = 1;
  for (const Canvas& frame : frames.subspan(1)) {
    Part after = indexed(frame, palette);
    const Part part = changed_part(before, after);
    file += frame_control(sequence, part, milliseconds);
    file += chunk("fdAT", bytes_of(sequence + 1, 4) + compressed(part));
    sequence += 2;
    before = std::move(after);
  }
  return file + chunk("IEND", {});
}

}  // namespace surehit::example
