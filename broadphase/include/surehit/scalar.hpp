#pragma once

#if !defined(__cpp_concepts) || __cpp_concepts < 201907L
#error "surehit needs C++20: compile with -std=c++20 or later"
#else
#include <concepts>

namespace surehit {

/// A number type in which surehit answers: float or double. `Collider<int>` and the like do not compile.
template <typename T>
concept FloatOrDouble = std::same_as<T, float> || std::same_as<T, double>;

}  // namespace surehit

#endif
