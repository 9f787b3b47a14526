#include "picture/text_shape.hpp"

#include <stb/stb_easy_font.h>

#include <string>

namespace surehit::example {

std::vector<TextStroke> text_shape(std::string_view text) {
  struct Corner {
    float x, y, z;
    unsigned char colour[4];
  };
  struct Quad {
    Corner corners[4];
  };
  // stb promises about 270 bytes a letter on average; a letter has 12 bars at most.
  constexpr std::size_t bars_per_letter = 12;
  std::vector<Quad> quads(bars_per_letter * text.size() + 1);
  std::string line(text);
  const int count =
      stb_easy_font_print(0, 0, line.data(), nullptr, quads.data(), static_cast<int>(quads.size() * sizeof(Quad)));
  std::vector<TextStroke> strokes;
  for (int i = 0; i < count; ++i) {
    const Quad& quad = quads[static_cast<std::size_t>(i)];
    strokes.push_back({quad.corners[0].x, quad.corners[0].y, quad.corners[2].x, quad.corners[2].y});
  }
  return strokes;
}

}  // namespace surehit::example
