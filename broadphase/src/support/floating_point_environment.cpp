#include "support/floating_point_environment.hpp"

#include "support/rounding_flags.hpp"

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#elif defined(_M_ARM64)
#include <intrin.h>
#elif !defined(__aarch64__)
#include <cfenv>
#endif

namespace surehit {

// The compiler does not know that arithmetic depends on the control word. It must not move arithmetic across a change
// of this word. It cannot do so, because it does not see these functions where the arithmetic is.

#if defined(__SSE2__) || defined(_M_X64)

namespace {
constexpr unsigned sticky_flags = 0x003f;
/// All exceptions are masked; rounding to nearest, no flush-to-zero, no denormals-are-zero.
constexpr unsigned default_control = 0x1f80;
}  // namespace

FloatingPointEnvironment::FloatingPointEnvironment() noexcept {
  const unsigned control = _mm_getcsr();
  if ((control & ~sticky_flags) == default_control) return;
  caller_ = control;
  restore_ = true;
  _mm_setcsr(default_control);
}

void FloatingPointEnvironment::restore() noexcept { _mm_setcsr(static_cast<unsigned>(caller_)); }

#elif defined(__aarch64__) || defined(_M_ARM64)

namespace {

std::uint64_t read_control() {
#if defined(_MSC_VER) && !defined(__clang__)
  return static_cast<std::uint64_t>(_ReadStatusReg(ARM64_FPCR));
#else
  std::uint64_t control = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return control;
#endif
}

void write_control(std::uint64_t control) {
#if defined(_MSC_VER) && !defined(__clang__)
  _WriteStatusReg(ARM64_FPCR, static_cast<__int64>(control));
#else
  __asm__ volatile("msr fpcr, %0" : : "r"(control));
#endif
}

}  // namespace

FloatingPointEnvironment::FloatingPointEnvironment() noexcept {
  const std::uint64_t control = read_control();
  if (control == 0) return;  // Zero means: to nearest, no flush-to-zero, no traps.
  caller_ = control;
  restore_ = true;
  write_control(0);
}

void FloatingPointEnvironment::restore() noexcept { write_control(caller_); }

#else

FloatingPointEnvironment::FloatingPointEnvironment() noexcept {
  const int rounding = std::fegetround();
  if (rounding == FE_TONEAREST) return;
  caller_ = static_cast<std::uint64_t>(rounding);
  restore_ = true;
  std::fesetround(FE_TONEAREST);
}

void FloatingPointEnvironment::restore() noexcept { std::fesetround(static_cast<int>(caller_)); }

#endif

}  // namespace surehit
