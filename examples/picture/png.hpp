#pragma once

#include <string>

#include "picture/canvas.hpp"

namespace surehit::example {

/// The picture as the bytes of a PNG file.
[[nodiscard]] std::string encode_png(const Canvas& canvas);

}  // namespace surehit::example
