#include "support/default_init_allocator.hpp"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace surehit::detail {

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__)
  // Only whole large pages within the memory, so that it does not grow.
  constexpr std::uintptr_t large_page = std::uintptr_t{1} << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + large_page - 1) & -large_page;
  const std::uintptr_t last = (begin + bytes) & -large_page;
  if (bytes < large_page || first >= last) return;
  char* const pages = static_cast<char*>(memory) + (first - begin);
  madvise(pages, last - first, MADV_HUGEPAGE);  // If the system refuses, nothing is lost.
#endif
}

void fault_in([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  // For fewer bytes the call costs as much as it saves.
  constexpr std::size_t min_bytes = std::size_t{1} << 16;
  constexpr std::uintptr_t page = std::uintptr_t{1} << 12;
  if (bytes < min_bytes) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = begin & -page;
  const std::uintptr_t last = (begin + bytes + page - 1) & -page;
  char* const pages = static_cast<char*>(memory) - (begin - first);
  // Memory that was used before has its pages. To save time, only the page in the middle is looked at.
  unsigned char is_there = 0;
  if (mincore(pages + ((last - first) / 2 & -page), page, &is_there) == 0 && (is_there & 1) != 0) return;
  madvise(pages, last - first, MADV_POPULATE_WRITE);  // If the system refuses, nothing is lost.
#endif
}

}  // namespace surehit::detail
