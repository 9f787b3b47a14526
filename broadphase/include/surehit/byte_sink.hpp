#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "surehit/attributes.hpp"
#include "surehit/callable.hpp"

namespace surehit {

namespace detail {
/// A callable that takes bytes, and that does not dangle in a `ByteSink`.
template <typename Callable, typename Sink>
concept TakesBytes = OutlivesItsView<Callable> && !std::same_as<std::remove_cvref_t<Callable>, Sink> &&
                     requires(std::remove_reference_t<Callable> & callable, std::span<const std::byte> bytes) {
  { callable(bytes) } -> std::convertible_to<bool>;
};
/// One that has a name, to which a `ByteSink` refers.
template <typename Callable, typename Sink>
concept NamedByteTaker = TakesBytes<Callable, Sink> && std::is_lvalue_reference_v<Callable>;
/// A temporary one, which a `ByteSink` copies.
template <typename Callable, typename Sink>
concept TemporaryByteTaker = TakesBytes<Callable, Sink> && !std::is_lvalue_reference_v<Callable>;
}  // namespace detail

/// Takes the bytes of a file, one piece after the other. It is made of any callable `bool(std::span<const std::byte>)`.
/// The callable returns false if it cannot take a piece, such as for a full disk. It gets no more pieces then.
///
/// The sink refers to a callable that has a name, and this callable must outlive it. It copies a temporary one, such as
/// a lambda. This one must be trivially copyable, and at most as large as six pointers. A sink allocates nothing.
class ByteSink {
 public:
  /// Refers to a callable that has a name.
  template <detail::NamedByteTaker<ByteSink> Callable>
  ByteSink(Callable&& callable SUREHIT_LIFETIMEBOUND) noexcept : callable_(callable), call_(call<Callable>) {}
  /// Copies a temporary callable. A large one, or one that is not trivially copyable, does not compile.
  template <detail::TemporaryByteTaker<ByteSink> Callable>
  ByteSink(Callable&& callable) noexcept : callable_(std::forward<Callable>(callable)), call_(call<Callable>) {}

  /// Gives the callable a piece. Returns what it returns.
  bool operator()(std::span<const std::byte> bytes) const { return call_(callable_, bytes); }

 private:
  template <typename Callable>
  static bool call(const detail::CallableView& target, std::span<const std::byte> bytes) {
    return target.get<Callable>()(bytes);
  }

  detail::CallableView callable_;
  bool (*call_)(const detail::CallableView&, std::span<const std::byte>);  ///< Calls the callable by its type.
};

}  // namespace surehit
