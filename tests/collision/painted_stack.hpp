#pragma once

#include <ucontext.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// How much stack a function takes is the compiler's doing: promises are for optimized builds, and sanitizers keep their
// own red zones there. Tests of promises ask for SUREHIT_TEST_PROMISES_STACK.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // GCC
#define SUREHIT_TEST_SANITIZED 1
#elif defined(__has_feature)  // Clang, and what other headers define in its place
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SUREHIT_TEST_SANITIZED 1
#endif
#endif
#if defined(__OPTIMIZE__) && !defined(SUREHIT_TEST_SANITIZED)
#define SUREHIT_TEST_PROMISES_STACK 1
#endif

namespace surehit::test {

/// A stack of its own for a call, painted so that one sees how deep the call went.
class PaintedStack {
 public:
  std::size_t bytes_used_by(const std::function<void()>& call) {
    call();  // the dynamic linker takes stack of its own when it first binds a symbol
    const std::size_t around = used_by([] {});
    return used_by(call) - around;
  }

 private:
  std::size_t used_by(const std::function<void()>& call) {
    std::fill(stack_.begin(), stack_.end(), paint);
    ucontext_t caller;
    ucontext_t callee;
    getcontext(&callee);
    callee.uc_stack.ss_sp = stack_.data();
    callee.uc_stack.ss_size = stack_.size() * sizeof paint;
    callee.uc_link = &caller;
    current = &call;
    makecontext(&callee, run, 0);
    swapcontext(&caller, &callee);
    const auto touched = std::find_if(stack_.begin(), stack_.end(), [](std::uint64_t word) { return word != paint; });
    return static_cast<std::size_t>(stack_.end() - touched) * sizeof paint;
  }

  static void run() { (*current)(); }

  static constexpr std::uint64_t paint = 0x5aa5c33c0ff0a55a;
  static inline const std::function<void()>* current = nullptr;
  std::vector<std::uint64_t> stack_ = std::vector<std::uint64_t>(1024 * 1024 / sizeof paint);
};

}  // namespace surehit::test
