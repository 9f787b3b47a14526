#pragma once

#include <string>
#include <surehit/path.hpp>

namespace surehit::example {

/// Reads X,Y,Z, the argument of an option. Throws InputError, which names the option.
[[nodiscard]] Vector3f parse_point(const std::string& option, const std::string& text);

}  // namespace surehit::example
