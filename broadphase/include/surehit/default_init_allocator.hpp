#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace surehit::detail {

/// Asks the system, where it takes such hints, to hold what lies in large memory in large pages: half the time of a
/// fresh build goes into small ones, and paths that jump about in the lists miss fewer of them.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

/// Leaves numbers as the memory holds them where a vector grows, for those who write all of them anyway.
template <typename T>
struct DefaultInitAllocator : std::allocator<T> {
  // NOLINTBEGIN(readability-identifier-naming): what allocators are asked for
  template <typename U>
  struct rebind {
    using other = DefaultInitAllocator<U>;
  };
  // NOLINTEND(readability-identifier-naming)

  [[nodiscard]] T* allocate(std::size_t count) {
    T* memory = std::allocator<T>::allocate(count);
    prefer_large_pages(memory, count * sizeof(T));
    return memory;
  }

  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
};

template <typename T>
using UnsetVector = std::vector<T, DefaultInitAllocator<T>>;

}  // namespace surehit::detail
