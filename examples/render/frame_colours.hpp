#pragma once

#include "picture/canvas.hpp"

namespace surehit::example {

inline constexpr Colour paper = Colour::hex(0x12161f);  ///< where nothing is drawn
inline constexpr Colour ink = Colour::hex(0xe8ebf2);    ///< of captions

}  // namespace surehit::example
