#pragma once

#include <array>
#include <cfenv>
#include <cstdint>
#include <ostream>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace surehit::test {

/// A floating-point environment that some program might call the library in. Flushing applies where the machine has
/// SSE.
struct FloatingPointMode {
  const char* name;
  int rounding = FE_TONEAREST;
  bool flushes_denormals = false;
};

inline void PrintTo(const FloatingPointMode& mode, std::ostream* out) { *out << mode.name; }

/// All modes that differ in what an answer could come from.
inline constexpr std::array floating_point_modes = {
    FloatingPointMode{"to_nearest"},
    FloatingPointMode{"upward", FE_UPWARD, false},
    FloatingPointMode{"downward", FE_DOWNWARD, false},
    FloatingPointMode{"toward_zero", FE_TOWARDZERO, false},
    FloatingPointMode{"flush", FE_TONEAREST, true},
    FloatingPointMode{"upward_and_flush", FE_UPWARD, true},
};

/// Holds a mode for as long as it lives.
class FloatingPointModeScope {
 public:
  explicit FloatingPointModeScope(const FloatingPointMode& mode) {
    std::fegetenv(&before_);
    std::fesetround(mode.rounding);
#if defined(__SSE2__)
    if (mode.flushes_denormals) {
      _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
      _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
#endif
  }
  ~FloatingPointModeScope() { std::fesetenv(&before_); }
  FloatingPointModeScope(const FloatingPointModeScope&) = delete;
  FloatingPointModeScope& operator=(const FloatingPointModeScope&) = delete;

 private:
  std::fenv_t before_;
};

/// All that a program can see of its environment: rounding, flushing, masks and sticky flags.
inline std::uint64_t control_word() {
#if defined(__SSE2__)
  return (static_cast<std::uint64_t>(std::fegetround()) << 32) | _mm_getcsr();
#else
  return (static_cast<std::uint64_t>(std::fegetround()) << 32) |
         static_cast<std::uint64_t>(std::fetestexcept(FE_ALL_EXCEPT));
#endif
}

}  // namespace surehit::test
