#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "picture/canvas.hpp"

namespace surehit::example {

/// Frames of equal size as the bytes of an animated PNG file, which plays them again and again. Each frame is shown for
/// the same time. A viewer that knows no animated files shows the first frame.
///
/// The frames share a palette of 63 colours. After the first one, a frame has only the pixels that change.
[[nodiscard]] std::string encode_animation(std::span<const Canvas> frames, std::uint16_t milliseconds);

}  // namespace surehit::example
