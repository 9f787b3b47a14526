#include "command_line/parse_point.hpp"

#include <string_view>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"

namespace surehit::example {

Vector3f parse_point(const std::string& option, const std::string& text) {
  Vector3f point;
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? text.find(',', begin) : text.size();
    if (end == std::string::npos) {
      throw InputError(option + ": three numbers X,Y,Z are needed, not " + example::quoted(text));
    }
    try {
      point[axis] = parse_number<float>(std::string_view(text).substr(begin, end - begin));
    } catch (const InputError& error) {
      throw error.at(option);
    }
    begin = end + 1;
  }
  return point;
}

}  // namespace surehit::example
