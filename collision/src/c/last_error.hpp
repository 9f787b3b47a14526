#pragma once

#include <cstddef>

#include "surehit/c/status.h"

namespace surehit::c {

/// What `surehit_last_error` and its like return. It has no memory of its own to run out of.
struct LastError {
  static constexpr std::size_t max_length = 255;  ///< A longer message is cut.

  surehit_status status = SUREHIT_OK;  ///< The status of the last failure.
  std::size_t element = 0;             ///< The element at fault.
  char message[max_length + 1] = {};   ///< A line that ends with 0.
};

/// Returns the last error of this thread.
[[nodiscard]] LastError& last_error() noexcept;

}  // namespace surehit::c
