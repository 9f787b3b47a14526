#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "support/default_init_allocator.hpp"

namespace surehit::detail {

/// The bytes of a large page.
inline constexpr std::size_t large_page = std::size_t{1} << 21;

/// An allocator for the memory of a build. Large memory consists of whole large pages, because faults of small pages
/// take much of the time. The last page may be used in part. Otherwise, it is a `DefaultInitAllocator`.
template <typename T, bool is_filled = true>
struct ScratchAllocator : DefaultInitAllocator<T, is_filled> {
  using Small = DefaultInitAllocator<T, is_filled>;
  // NOLINTBEGIN(readability-identifier-naming): what allocators are asked for
  template <typename U>
  struct rebind {
    using other = ScratchAllocator<U, is_filled>;
  };
  // NOLINTEND(readability-identifier-naming)

  [[nodiscard]] T* allocate(std::size_t count) {
    if (!is_large(count) || count > max_bytes / sizeof(T)) return Small::allocate(count);  // Too large a size throws.
    T* const memory = static_cast<T*>(::operator new (pages_of(count), std::align_val_t{large_page}));
    prefer_large_pages(memory, pages_of(count));
    if constexpr (is_filled) fault_in(memory, count * sizeof(T));
    return memory;
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (is_large(count)) {
      ::operator delete (memory, std::align_val_t{large_page});
    } else {
      Small::deallocate(memory, count);
    }
  }

  /// Returns how many bytes memory for these elements takes.
  [[nodiscard]] static std::size_t bytes_of(std::size_t count) {
    return is_large(count) ? pages_of(count) : count * sizeof(T);
  }
  /// Returns whether memory for these elements consists of large pages. They are at least half full.
  [[nodiscard]] static bool is_large([[maybe_unused]] std::size_t count) {
#if defined(__linux__)
    return count >= large_page / 2 / sizeof(T);
#else
    return false;
#endif
  }

 private:
  static constexpr std::size_t max_bytes = std::numeric_limits<std::ptrdiff_t>::max() - large_page;

  /// Returns the bytes of whole large pages for these elements.
  static std::size_t pages_of(std::size_t count) { return (count * sizeof(T) + large_page - 1) & -large_page; }
};

/// A vector for a build, whose new elements are not set. Its owner fills all that it reserves.
template <typename T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;
/// A vector for a build, whose new elements are not set. It may have more room than its owner uses.
template <typename T>
using RoomyScratchVector = std::vector<T, ScratchAllocator<T, false>>;

}  // namespace surehit::detail
