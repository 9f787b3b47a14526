#pragma once

#include <string>

namespace surehit::example {

/// All bytes of a file; `-` is standard input. Throws InputError, without the name, where it cannot be read.
[[nodiscard]] std::string read_file(const std::string& path);

}  // namespace surehit::example
