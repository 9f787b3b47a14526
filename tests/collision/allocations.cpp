#include "allocations.hpp"

#include <cstdlib>
#include <new>

namespace {

// A thread that works for the test, such as one of a driver, has memory.
thread_local std::size_t count = 0;
thread_local std::size_t successes_left = 0;
thread_local std::size_t failures_left = 0;
thread_local bool failed = false;

bool succeeds() {
  if (failures_left == 0) return true;
  if (successes_left > 0) {
    --successes_left;
    return true;
  }
  if (failures_left != surehit::test::ScarceMemory::all) --failures_left;
  failed = true;
  return false;
}

}  // namespace

// Not inlined, or GCC sees memory of malloc given to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (!succeeds()) throw std::bad_alloc();
  ++count;
  if (void* block = std::malloc(bytes == 0 ? 1 : bytes)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  if (!succeeds()) return nullptr;
  ++count;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace surehit::test {

std::size_t allocation_count() { return count; }

ScarceMemory::ScarceMemory(std::size_t successes, std::size_t failures) {
  successes_left = successes;
  failures_left = failures;
  failed = false;
}

ScarceMemory::~ScarceMemory() { failures_left = 0; }

bool ScarceMemory::has_failed() { return failed; }

}  // namespace surehit::test
