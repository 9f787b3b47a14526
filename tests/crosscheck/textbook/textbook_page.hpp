#pragma once

#include <map>
#include <string>

namespace surehit::test {

/// Judges everything, and returns the blocks of the pages by their names. All of it is the same on each run and
/// machine.
[[nodiscard]] std::map<std::string, std::string> textbook_blocks();

/// Returns the page with what the blocks say between its markers. Throws std::runtime_error for a block that is
/// unknown, a marker without an end, and a page without markers.
[[nodiscard]] std::string with_textbook_blocks(const std::string& page,
                                               const std::map<std::string, std::string>& blocks);

}  // namespace surehit::test
