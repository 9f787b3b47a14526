#pragma once

// What compilers are told in ways of their own: which functions to inline, which ones are rare or take a format, and
// which memory is read soon.

#if defined(_MSC_VER) && !defined(__clang__)

/// The function is inlined wherever it is called.
#define SUREHIT_ALWAYS_INLINE [[msvc::forceinline]]
/// The function is rarely called, so it is kept out of its callers.
#define SUREHIT_NOINLINE [[msvc::noinline]]
/// The function is called only where something has failed.
#define SUREHIT_COLD

#elif defined(__GNUC__) && !defined(SUREHIT_PORTABLE_CODE)

#define SUREHIT_ALWAYS_INLINE [[gnu::always_inline]]
#define SUREHIT_NOINLINE [[gnu::noinline]]
#define SUREHIT_COLD [[gnu::cold]]

#else

#define SUREHIT_ALWAYS_INLINE
#define SUREHIT_NOINLINE
#define SUREHIT_COLD

#endif

/// Lets the compiler compare the format in parameter `text` with the arguments from parameter `first` on. Windows has
/// formats of its own.
#if defined(__GNUC__) && !defined(SUREHIT_PORTABLE_CODE) && !defined(_WIN32)
#define SUREHIT_FORMAT(text, first) [[gnu::format(printf, text, first)]]
#else
#define SUREHIT_FORMAT(text, first)
#endif

namespace surehit::detail {

/// Says that the memory is read soon. It may be said of any address.
SUREHIT_ALWAYS_INLINE inline void prefetch([[maybe_unused]] const void* memory) {
#if defined(__GNUC__) && !defined(SUREHIT_PORTABLE_CODE)
  __builtin_prefetch(memory);
#endif
}

}  // namespace surehit::detail
