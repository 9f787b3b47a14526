#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "surehit/attributes.hpp"
#include "surehit/callable.hpp"

namespace surehit {

namespace detail {
/// A callable that runs tasks, and that does not dangle in an `Executor`.
template <typename Callable, typename Executor>
concept RunsTasks =
    OutlivesItsView<Callable> && !std::same_as<std::remove_cvref_t<Callable>, Executor> &&
    std::is_invocable_v<std::remove_reference_t<Callable>&, std::size_t, const typename Executor::Task&>;
/// One that has a name, to which an `Executor` refers.
template <typename Callable, typename Executor>
concept NamedTaskRunner = RunsTasks<Callable, Executor> && std::is_lvalue_reference_v<Callable>;
/// A temporary one, which an `Executor` copies.
template <typename Callable, typename Executor>
concept TemporaryTaskRunner = RunsTasks<Callable, Executor> && !std::is_lvalue_reference_v<Callable>;
}  // namespace detail

/// Spreads work over threads. It is made of any callable `void(std::size_t count, const Executor::Task& task)`, such as
/// a lambda that starts the jobs of a game. `tbb_executor.hpp` has one for oneTBB.
///
/// The callable calls `task(i)` once for each i in [0, count). It may use any threads and any order. It returns after
/// all calls have returned. It must not throw.
///
/// The executor refers to a callable that has a name, and this callable must outlive it. It copies a temporary one,
/// such as a lambda. This one must be trivially copyable, and at most as large as six pointers. An executor allocates
/// nothing.
class Executor {
 public:
  /// The work of one batch or of one step of a build. It is valid until the callable returns.
  class Task {
   public:
    /// Does part `index` of the work. Several threads may call it at the same time, each with another index.
    void operator()(std::size_t index) const { call_(work_, index); }

   private:
    friend class Executor;
    /// Refers to the work, which must outlive the task.
    template <typename Work>
    explicit Task(const Work& work)
        : work_(std::addressof(work)),
          call_([](const void* target, std::size_t index) { (*static_cast<const Work*>(target))(index); }) {}

    const void* work_;                        ///< The work, without its type.
    void (*call_)(const void*, std::size_t);  ///< Calls the work.
  };

  /// Refers to a callable that has a name.
  template <detail::NamedTaskRunner<Executor> Callable>
  Executor(Callable&& callable SUREHIT_LIFETIMEBOUND) noexcept : callable_(callable), call_(call<Callable>) {}
  /// Copies a temporary callable. A large one, or one that is not trivially copyable, does not compile.
  template <detail::TemporaryTaskRunner<Executor> Callable>
  Executor(Callable&& callable) noexcept : callable_(std::forward<Callable>(callable)), call_(call<Callable>) {}

  /// Calls `work(i)` once for each i in [0, count), and returns after all calls have returned. `work` must allow calls
  /// from several threads at the same time.
  template <typename Work>
  void run(std::size_t count, const Work& work) const {
    call_(callable_, count, Task(work));
  }

 private:
  template <typename Callable>
  static void call(const detail::CallableView& target, std::size_t count, const Task& task) {
    target.get<Callable>()(count, task);
  }

  detail::CallableView callable_;
  void (*call_)(const detail::CallableView&, std::size_t, const Task&);  ///< Calls the callable by its type.
};

}  // namespace surehit
