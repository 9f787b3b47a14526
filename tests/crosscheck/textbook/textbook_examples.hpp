#pragma once

#include <span>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// A pair of small numbers about which a variant is wrong in float. A reader can check it by hand.
struct TextbookExample {
  const char* letter;  ///< The variant's.
  Trianglef triangle;
  Pathf path;
};

/// Returns at least one pair for each variant besides surehit.
[[nodiscard]] std::span<const TextbookExample> textbook_examples();

}  // namespace surehit::test
