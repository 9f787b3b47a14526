#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace surehit::detail {

/// Asks the system to use large pages for large memory, if it takes such hints. Page faults take much of the time of a
/// first build. Paths that jump between lists also miss fewer large pages in the TLB.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

/// Asks the system for all pages of the memory at once, if it takes such hints. That costs less than a fault for each
/// page when it is first written.
void fault_in(void* memory, std::size_t bytes) noexcept;

/// An allocator for vectors whose owner writes all elements. New elements are not set, so a vector grows without
/// clearing memory. If `is_filled`, the owner writes all that is allocated, so all pages are requested at once.
template <typename T, bool is_filled = true>
struct DefaultInitAllocator : std::allocator<T> {
  // NOLINTBEGIN(readability-identifier-naming): what allocators are asked for
  template <typename U>
  struct rebind {
    using other = DefaultInitAllocator<U, is_filled>;
  };
  // NOLINTEND(readability-identifier-naming)

  [[nodiscard]] T* allocate(std::size_t count) {
    T* memory = std::allocator<T>::allocate(count);
    prefer_large_pages(memory, count * sizeof(T));
    if constexpr (is_filled) fault_in(memory, count * sizeof(T));
    return memory;
  }

  /// A vector in C++23 would call that of `std::allocator`, which allocates other memory.
  void allocate_at_least(std::size_t count) = delete;

  template <typename U>
  void construct(U* address) noexcept {
    ::new (static_cast<void*>(address)) U;
  }
};

/// A vector whose new elements are not set. Its owner fills all that it reserves.
template <typename T>
using UnsetVector = std::vector<T, DefaultInitAllocator<T>>;
/// A vector whose new elements are not set. It may have more room than its owner uses.
template <typename T>
using RoomyVector = std::vector<T, DefaultInitAllocator<T, false>>;

}  // namespace surehit::detail
