#pragma once

#include <memory>
#include <type_traits>

namespace surehit::detail {

/// Of a function or of an object that can be called, for those who keep it without its type.
template <typename Callable>
[[nodiscard]] void* callable_address(Callable& callable) noexcept {
  if constexpr (std::is_function_v<Callable>) {
    return reinterpret_cast<void*>(&callable);
  } else {
    return const_cast<void*>(static_cast<const void*>(std::addressof(callable)));
  }
}

}  // namespace surehit::detail
