#include "picture/png.hpp"

#include <stb/stb_image_write.h>

#include <stdexcept>

#include "picture/pixel_bytes.hpp"

namespace surehit::example {

std::string encode_png(const Canvas& canvas) {
  const std::string bytes = pixel_bytes(canvas);
  std::string png;
  const auto append = [](void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &png, canvas.width(), canvas.height(), 3, bytes.data(), 3 * canvas.width()) == 0) {
    throw std::runtime_error("a picture of " + std::to_string(canvas.width()) + " x " +
                             std::to_string(canvas.height()) + " pixels cannot be encoded");
  }
  return png;
}

}  // namespace surehit::example
