#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "surehit/callable_address.hpp"

namespace surehit {

/// A reference to whatever spreads work over threads: any callable `void(std::size_t count, const Executor::Task&
/// task)` that calls `task(i)` once for each i in [0, count), from any threads and in any order, and returns when all
/// calls have. A game's job system fits in a lambda; `tbb_executor.hpp` has one for oneTBB. It owns nothing: the
/// callable must outlive the query or the build, which a lambda written in the call does. It must not throw.
class Executor {
 public:
  /// One batch's or build's work. It lives as long as the callable runs.
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

  template <typename Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, Executor> &&
           std::is_invocable_v<Callable&, std::size_t, const Task&>) Executor(Callable&& callable)
  noexcept
      : callable_(detail::callable_address(callable)), call_([](void* target, std::size_t count, const Task& task) {
          (*reinterpret_cast<std::remove_reference_t<Callable>*>(target))(count, task);
        }) {}

  /// Calls `work(i)` for each i in [0, count).
  template <typename Work>
  void run(std::size_t count, const Work& work) const {
    call_(callable_, count, Task(work));
  }

 private:
  void* callable_;
  void (*call_)(void*, std::size_t, const Task&);
};

}  // namespace surehit
