#pragma once

#include <string>

#include "mesh_io/input_error.hpp"

namespace surehit::test {

/// What an InputError thrown by the work says.
template <typename Work>
std::string error_of(Work work) {
  try {
    static_cast<void>(work());
  } catch (const example::InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace surehit::test
