#pragma once

#include <cstdlib>
#include <string>

#include "support/inlining.hpp"
#include "surehit/instance.hpp"

namespace surehit::detail {

/// Returns the error of an id that is that of no instance.
[[nodiscard]] inline InvalidInstance stale_id(InstanceId id) {
  return {InvalidInstance::Reason::stale_id, id.index,
          "there is no instance with index " + std::to_string(id.index) + " and generation " +
              std::to_string(id.generation)};
}

/// Throws this error. Without exceptions, the program ends: no instance may answer for another one.
[[noreturn]] SUREHIT_NOINLINE inline void refuse_stale_id([[maybe_unused]] InstanceId id) {
#if defined(__cpp_exceptions)
  throw stale_id(id);
#else
  std::abort();
#endif
}

/// Returns the instance that was found for an id. It is null if the id is stale, which is an error.
template <typename Instance>
[[nodiscard]] const Instance& known_instance(const Instance* found, InstanceId id) {
  if (found == nullptr) refuse_stale_id(id);
  return *found;
}

}  // namespace surehit::detail
