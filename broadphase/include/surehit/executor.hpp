#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "surehit/callable.hpp"

namespace surehit {

namespace detail {
template <typename Callable, typename Executor>
concept RunsTasks =
    OutlivesItsView<Callable> && !std::same_as<std::remove_cvref_t<Callable>, Executor> &&
    std::is_invocable_v<std::remove_reference_t<Callable>&, std::size_t, const typename Executor::Task&>;
}  // namespace detail

/// Spreads work over threads: any callable `void(std::size_t count, const Executor::Task& task)`. It calls `task(i)`
/// once for each i in [0, count), from any threads and in any order, and returns when all calls have returned. A game's
/// job system fits in a lambda; `tbb_executor.hpp` has one for oneTBB.
///
/// A callable that has a name is referred to and must outlive the executor. A temporary one, such as a lambda, is
/// copied in; it must be trivially copyable and hold at most six pointers. The callable must not throw.
class Executor {
 public:
  /// The work of one batch or one build. It is valid until the callable returns.
  class Task {
   public:
    void operator()(std::size_t index) const { call_(work_, index); }

   private:
    friend class Executor;
    template <typename Work>
    explicit Task(const Work& work)
        : work_(std::addressof(work)),
          call_([](const void* target, std::size_t index) { (*static_cast<const Work*>(target))(index); }) {}

    const void* work_;
    void (*call_)(const void*, std::size_t);
  };

  template <detail::RunsTasks<Executor> Callable>
  Executor(Callable&& callable) noexcept
      : callable_(std::forward<Callable>(callable)),
        call_([](const detail::CallableView& target, std::size_t count, const Task& task) {
          target.get<Callable>()(count, task);
        }) {}

  /// Calls `work(i)` for each i in [0, count).
  template <typename Work>
  void run(std::size_t count, const Work& work) const {
    call_(callable_, count, Task(work));
  }

 private:
  detail::CallableView callable_;
  void (*call_)(const detail::CallableView&, std::size_t, const Task&);
};

}  // namespace surehit
