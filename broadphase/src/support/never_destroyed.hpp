#pragma once

namespace surehit::detail {

/// Returns a T that all callers share, made by its default constructor. It is never destroyed, because it may be asked
/// until the program ends.
template <typename T>
[[nodiscard]] const T& never_destroyed() noexcept {
  union Kept {
    Kept() : value() {}
    ~Kept() {}
    T value;
  };
  static const Kept kept;
  return kept.value;
}

}  // namespace surehit::detail
