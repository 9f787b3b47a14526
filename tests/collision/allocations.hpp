#pragma once

#include <cstddef>

namespace surehit::test {

/// How often this program, which has but one thread, has called operator new.
[[nodiscard]] std::size_t allocation_count();

template <typename Call>
[[nodiscard]] std::size_t allocations_of(Call&& call) {
  const std::size_t before = allocation_count();
  call();
  return allocation_count() - before;
}

/// While it lives, operator new throws std::bad_alloc, but for the first `successes` calls.
class ScarceMemory {
 public:
  explicit ScarceMemory(std::size_t successes);
  ~ScarceMemory();
  ScarceMemory(const ScarceMemory&) = delete;
  ScarceMemory& operator=(const ScarceMemory&) = delete;
};

}  // namespace surehit::test
