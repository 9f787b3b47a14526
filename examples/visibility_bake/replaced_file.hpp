#pragma once

#include <string>
#include <string_view>

namespace surehit::example {

/// Writes a file to the side, to disk, and renames it then. So the path always has a whole file, the old one or the new
/// one, also if the program or the machine stops meanwhile. What is left at the side is overwritten by the next try.
/// Throws std::system_error, which names the path. The old file is then as before.
void replace_file(const std::string& path, std::string_view bytes);

}  // namespace surehit::example
