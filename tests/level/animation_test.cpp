#include "picture/animation.hpp"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace surehit::example::animation_test {
namespace {

constexpr Colour black = Colour::hex(0x000000);
constexpr Colour red = Colour::hex(0xff0000);

struct Chunk {
  std::string type;
  std::string data;
};

std::size_t number_at(const std::string& bytes, std::size_t offset) {
  std::size_t number = 0;
  for (std::size_t i = offset; i < offset + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

std::vector<Chunk> chunks_of(const std::string& file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number_at(file, at);
    chunks.push_back({file.substr(at + 4, 4), file.substr(at + 8, size)});
    at += size + 12;
  }
  return chunks;
}

/// Frames of a square that moves and then waits.
std::vector<Canvas> frames() {
  std::vector<Canvas> frames;
  for (const float x : {10.0f, 14.0f, 14.0f}) {
    frames.emplace_back(100, 50, black);
    frames.back().draw_rectangle({x, 20}, {x + 10, 30}, red);
  }
  return frames;
}

TEST(Animation, first_frame_is_a_picture) {
  const std::string file = encode_animation(frames(), 50);
  int width = 0;
  int height = 0;
  int parts = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()), &width,
                            &height, &parts, 3),
      stbi_image_free);
  ASSERT_NE(pixels, nullptr) << stbi_failure_reason();
  EXPECT_EQ(width, 100);
  EXPECT_EQ(height, 50);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_red = x >= 10 && x < 20 && y >= 20 && y < 30;
      ASSERT_EQ(pixels.get()[3 * (y * width + x)], is_red ? 255 : 0) << x << ' ' << y;
    }
  }
}

TEST(Animation, later_frames_have_what_changes) {
  const std::string file = encode_animation(frames(), 50);
  std::vector<std::string> types;
  std::vector<std::string> controls;
  std::size_t sequence = 0;
  for (const Chunk& chunk : chunks_of(file)) {
    types.push_back(chunk.type);
    if (chunk.type == "acTL") {
      EXPECT_EQ(number_at(chunk.data, 0), 3u);
      EXPECT_EQ(number_at(chunk.data, 4), 0u) << "again and again";
    }
    if (chunk.type == "fcTL" || chunk.type == "fdAT") {
      EXPECT_EQ(number_at(chunk.data, 0), sequence++);
    }
    if (chunk.type == "fcTL") controls.push_back(chunk.data);
  }
  EXPECT_EQ(types, (std::vector<std::string>{"IHDR", "acTL", "PLTE", "tRNS", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL",
                                             "fdAT", "IEND"}));
  const auto expect_part = [&](std::size_t frame, std::size_t width, std::size_t height, std::size_t x, std::size_t y) {
    EXPECT_EQ(number_at(controls[frame], 4), width);
    EXPECT_EQ(number_at(controls[frame], 8), height);
    EXPECT_EQ(number_at(controls[frame], 12), x);
    EXPECT_EQ(number_at(controls[frame], 16), y);
  };
  ASSERT_EQ(controls.size(), 3u);
  expect_part(0, 100, 50, 0, 0);
  expect_part(1, 14, 10, 10, 20);
  expect_part(2, 1, 1, 0, 0);
}

TEST(Animation, chunks_end_with_their_checksums) {
  const std::string file = encode_animation(frames(), 50);
  EXPECT_EQ(file.substr(file.size() - 12), std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
}

TEST(Animation, needs_a_frame) { EXPECT_THROW((void)encode_animation({}, 50), std::invalid_argument); }

}  // namespace
}  // namespace surehit::example::animation_test
