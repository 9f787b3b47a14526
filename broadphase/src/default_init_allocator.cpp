#include "surehit/default_init_allocator.hpp"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace surehit::detail {

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__)
  // Only pages that lie within the memory, so that it takes up no more than before.
  constexpr std::uintptr_t large_page = std::uintptr_t{1} << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + large_page - 1) & -large_page;
  const std::uintptr_t last = (begin + bytes) & -large_page;
  if (bytes < large_page || first >= last) return;
  char* const pages = static_cast<char*>(memory) + (first - begin);
  madvise(pages, last - first, MADV_HUGEPAGE);  // where it is refused, nothing is lost
#endif
}

}  // namespace surehit::detail
