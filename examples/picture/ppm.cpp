#include "picture/ppm.hpp"

#include "picture/pixel_bytes.hpp"

namespace surehit::example {

std::string encode_ppm(const Canvas& canvas) {
  return "P6\n" + std::to_string(canvas.width()) + " " + std::to_string(canvas.height()) + "\n255\n" +
         pixel_bytes(canvas);
}

}  // namespace surehit::example
