#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace surehit::detail {

/// The memory for a lambda that captures up to six pointers or references.
struct CallableStorage {
  static constexpr std::size_t size = 6 * sizeof(void*);  ///< The maximum size of a callable.
  alignas(void*) unsigned char bytes[size];               ///< The bytes of the callable.
};

/// A temporary callable that can be copied byte by byte into `CallableStorage`.
template <typename Callable>
concept SmallCallable = std::is_trivially_copyable_v<Callable> && std::is_copy_constructible_v<Callable> &&
                            sizeof(Callable) <= CallableStorage::size
                        && alignof(Callable) <= alignof(void*);

/// A callable from which a `CallableView` can be made: one that has a name, or a small temporary one, which is copied.
/// Any other callable would dangle, so it does not compile. Give it a name first.
template <typename Callable>
concept OutlivesItsView = std::is_lvalue_reference_v<Callable> || SmallCallable<std::remove_cvref_t<Callable>>;

/// A callable without its type. It refers to a callable that has a name. It holds a copy of a temporary one. It
/// allocates nothing.
class CallableView {
 public:
  /// Refers to a callable that has a name, or copies a temporary one.
  template <OutlivesItsView Callable>
  explicit CallableView(Callable&& callable) noexcept {
    using Target = std::remove_reference_t<Callable>;
    if constexpr (std::is_function_v<Target>) {
      store(&callable);
    } else if constexpr (std::is_lvalue_reference_v<Callable>) {
      store(std::addressof(callable));
    } else {
      store(callable);
    }
  }

  /// Returns the callable. `Callable` must be the type that the constructor deduced.
  template <typename Callable>
  [[nodiscard]] decltype(auto) get() const noexcept {
    using Target = std::remove_reference_t<Callable>;
    if constexpr (std::is_lvalue_reference_v<Callable>) {
      Target* address;
      std::memcpy(&address, storage_.bytes, sizeof address);
      return static_cast<Target&>(*address);
    } else {
      return static_cast<Target&>(*std::launder(reinterpret_cast<Target*>(storage_.bytes)));
    }
  }

 private:
  /// Copies the bytes of a callable or of a pointer.
  template <typename T>
  void store(const T& stored) noexcept {
    std::memcpy(storage_.bytes, std::addressof(stored), sizeof stored);
  }

  mutable CallableStorage storage_;  ///< The callable, or the address of one that has a name.
};

}  // namespace surehit::detail
