#include "picture/palette.hpp"

#include <gtest/gtest.h>

namespace surehit::example::palette_test {
namespace {

TEST(Palette, keeps_the_colours_of_a_flat_picture) {
  Canvas canvas(20, 20, Colour::hex(0x10141d));
  canvas.draw_rectangle({2, 2}, {8, 8}, Colour::hex(0xc8553d));
  Palette palette;
  palette.count(canvas);
  palette.choose();
  EXPECT_EQ(palette.colours(), (std::vector<Palette::Bytes>{{0x10, 0x14, 0x1d}, {0xc8, 0x55, 0x3d}}));
  EXPECT_EQ(palette.nearest(canvas.at(0, 0)), 0);
  EXPECT_EQ(palette.nearest(canvas.at(4, 4)), 1);
}

TEST(Palette, takes_the_nearest_of_the_most_frequent_colours) {
  Palette palette;
  for (std::uint32_t grey = 0; grey < 256; ++grey) {
    for (std::uint32_t green = 0; green < 256; green += 16) {
      palette.count(Canvas(1, 1 + static_cast<int>(green == 0), Colour::hex(grey << 16 | green << 8 | grey)));
    }
  }
  palette.choose();
  ASSERT_EQ(palette.colours().size(), Palette::max_colours);
  const Palette::Bytes& near = palette.colours()[palette.nearest(Colour::hex(0x800080))];
  EXPECT_NEAR(near[0], 0x80, 8);
  EXPECT_EQ(near[1], 0);
  EXPECT_NEAR(near[2], 0x80, 8);
}

}  // namespace
}  // namespace surehit::example::palette_test
