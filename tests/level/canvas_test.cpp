#include "picture/canvas.hpp"

#include <gtest/gtest.h>

#include "picture/png.hpp"

namespace surehit::example::canvas_test {
namespace {

constexpr Colour black = Colour::hex(0x000000);
constexpr Colour white = Colour::hex(0xffffff);

/// All light on the canvas, in pixels.
float light(const Canvas& canvas) {
  float sum = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) sum += canvas.at(x, y).green;
  }
  return sum;
}

TEST(Canvas, shapes_cover_their_area) {
  Canvas line(100, 100, black);
  line.draw_line({10, 20}, {90, 80}, 3, white);
  EXPECT_NEAR(light(line), 100 * 3, 15);

  Canvas disc(100, 100, black);
  disc.draw_disc({50, 50}, 20, white);
  EXPECT_NEAR(light(disc), 1257, 15);

  Canvas rectangle(100, 100, black);
  rectangle.draw_rectangle({10, 20}, {30, 25}, white);
  EXPECT_FLOAT_EQ(light(rectangle), 100);
}

TEST(Canvas, cuts_off_what_lies_outside) {
  Canvas canvas(10, 10, black);
  canvas.draw_line({-1e4f, 5}, {1e4f, 5}, 2, white);
  canvas.draw_disc({1e9f, -1e9f}, 3, white);
  canvas.draw_rectangle({-5, -5}, {-1, 20}, white);
  EXPECT_NEAR(light(canvas), 20, 0.01);
}

TEST(Canvas, png_names_its_size) {
  const std::string png = encode_png(Canvas(300, 2, white));
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\1\x2c\0\0\0\2", 8));
}

}  // namespace
}  // namespace surehit::example::canvas_test
