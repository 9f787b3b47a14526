#pragma once

#include <memory>
#include <new>
#include <vector>

namespace surehit::detail {

/// Leaves numbers as the memory holds them where a vector grows, for those who write all of them anyway.
template <typename T>
struct DefaultInitAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = DefaultInitAllocator<U>;
  };

  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
};

template <typename T>
using UnsetVector = std::vector<T, DefaultInitAllocator<T>>;

}  // namespace surehit::detail
