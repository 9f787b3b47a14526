#include "picture/pixel_bytes.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::example {

std::string pixel_bytes(const Canvas& canvas) {
  std::string bytes;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const Colour& pixel = canvas.at(x, y);
      for (const float part : {pixel.red, pixel.green, pixel.blue}) {
        bytes += static_cast<char>(std::lround(255 * std::clamp(part, 0.0f, 1.0f)));
      }
    }
  }
  return bytes;
}

}  // namespace surehit::example
