#pragma once

#include <string>

#include "picture/canvas.hpp"

namespace surehit::example {

/// The pixels row by row: a byte each for red, green and blue.
[[nodiscard]] std::string pixel_bytes(const Canvas& canvas);

}  // namespace surehit::example
