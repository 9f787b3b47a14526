#include "allocations.hpp"

#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

std::size_t count = 0;
std::size_t limit = unlimited;

}  // namespace

// Not inlined, or GCC sees memory of malloc given to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (count >= limit) throw std::bad_alloc();
  ++count;
  if (void* block = std::malloc(bytes == 0 ? 1 : bytes)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace surehit::test {

std::size_t allocation_count() { return count; }

ScarceMemory::ScarceMemory(std::size_t successes) { limit = count + successes; }

ScarceMemory::~ScarceMemory() { limit = unlimited; }

}  // namespace surehit::test
