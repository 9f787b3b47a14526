#pragma once

#include <string>

#include "picture/canvas.hpp"

namespace surehit::example {

/// The picture as the bytes of a binary PPM file.
[[nodiscard]] std::string encode_ppm(const Canvas& canvas);

}  // namespace surehit::example
