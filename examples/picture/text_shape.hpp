#pragma once

#include <string_view>
#include <vector>

namespace surehit::example {

/// One bar of a letter.
struct TextStroke {
  float low_x, low_y, high_x, high_y;
};

/// The bars that make up a line of ASCII text, y down, from (0, 0) on; capitals are 7 high.
[[nodiscard]] std::vector<TextStroke> text_shape(std::string_view text);

}  // namespace surehit::example
