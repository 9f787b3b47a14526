#include "peak_memory.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

std::ptrdiff_t now = 0;
std::ptrdiff_t most = 0;

}  // namespace

// Not inlined, or GCC sees memory of malloc given to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  void* const block = std::malloc(bytes == 0 ? 1 : bytes);
  if (block == nullptr) return nullptr;
  now += static_cast<std::ptrdiff_t>(malloc_usable_size(block));
  most = std::max(most, now);
  return block;
}
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (void* const block = operator new(bytes, std::nothrow)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept {
  if (block != nullptr) now -= static_cast<std::ptrdiff_t>(malloc_usable_size(block));
  std::free(block);
}
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { operator delete(block); }

namespace surehit::test {

void begin_peak_memory() { now = most = 0; }

std::size_t peak_memory() { return static_cast<std::size_t>(most); }

}  // namespace surehit::test
