#pragma once

#include <cstddef>

namespace surehit::test {

/// How often this thread has called operator new.
[[nodiscard]] std::size_t allocation_count();

template <typename Call>
[[nodiscard]] std::size_t allocations_of(Call&& call) {
  const std::size_t before = allocation_count();
  call();
  return allocation_count() - before;
}

/// While it lives, operator new throws std::bad_alloc in this thread, but for the first `successes` calls. After some
/// failures it succeeds again.
class ScarceMemory {
 public:
  static constexpr std::size_t all = static_cast<std::size_t>(-1);

  explicit ScarceMemory(std::size_t successes, std::size_t failures = all);
  ~ScarceMemory();
  /// Returns true if a call has failed.
  [[nodiscard]] static bool has_failed();
  ScarceMemory(const ScarceMemory&) = delete;
  ScarceMemory& operator=(const ScarceMemory&) = delete;
};

}  // namespace surehit::test
