#include "surehit/c/status.h"

#include <cstdint>

#include "c/arguments.hpp"
#include "c/last_error.hpp"
#include "surehit/c/version.h"

namespace surehit::c {

LastError& last_error() noexcept {
  static thread_local LastError error;
  return error;
}

extern "C" {

SUREHIT_C_API const char* surehit_last_error() { return last_error().message; }

SUREHIT_C_API surehit_status surehit_last_error_status() { return last_error().status; }

SUREHIT_C_API std::size_t surehit_last_error_element() { return last_error().element; }

SUREHIT_C_API std::uint32_t surehit_version() {
  return 1'000'000 * SUREHIT_VERSION_MAJOR + 1'000 * SUREHIT_VERSION_MINOR + SUREHIT_VERSION_PATCH;
}

SUREHIT_C_API surehit_status surehit_check_abi(std::uint32_t abi) {
  Arguments arguments(__func__);
  if (abi != SUREHIT_C_ABI) {
    arguments.refuse(SUREHIT_WRONG_ABI, SUREHIT_C_ABI, "the program has ABI %u, and the library has ABI %u", abi,
                     unsigned{SUREHIT_C_ABI});
  }
  return arguments.status();
}

}  // extern "C"

}  // namespace surehit::c
