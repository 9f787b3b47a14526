#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace surehit::detail {

/// Room for a lambda that captures up to six pointers or references.
struct CallableStorage {
  static constexpr std::size_t size = 6 * sizeof(void*);
  alignas(void*) unsigned char bytes[size];
};

/// A temporary that can be copied in, byte by byte.
template <typename Callable>
concept SmallCallable = std::is_trivially_copyable_v<Callable> && std::is_copy_constructible_v<Callable> &&
                        sizeof(Callable) <= CallableStorage::size && alignof(Callable) <= alignof(void*);

/// What a `CallableView` may be made from: a callable that has a name, or one that is copied in. Anything else would
/// dangle, so it does not compile: give the callable a name first.
template <typename Callable>
concept OutlivesItsView = std::is_lvalue_reference_v<Callable> || SmallCallable<std::remove_cvref_t<Callable>>;

/// A callable without its type. It refers to a callable that has a name, and holds a copy of a temporary one. It
/// allocates nothing.
class CallableView {
 public:
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

  /// The callable that was given as a `Callable&&`.
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
  template <typename T>
  void store(const T& stored) noexcept {
    std::memcpy(storage_.bytes, std::addressof(stored), sizeof stored);
  }

  mutable CallableStorage storage_;
};

}  // namespace surehit::detail
