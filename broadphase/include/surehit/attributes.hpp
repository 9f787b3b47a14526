#pragma once

/// Marks a symbol that a shared library exports. All other symbols are hidden, and so are all of a static library. The
/// CMake targets and surehit.pc define `SUREHIT_SHARED` if the library is shared. On Windows, a shared library exports
/// all symbols.
#if defined(SUREHIT_SHARED) && !defined(_WIN32)
#define SUREHIT_API __attribute__((visibility("default")))
#else
#define SUREHIT_API
#endif

/// Marks a parameter or an object that the result refers to. Clang then warns if the result outlives it. Other
/// compilers ignore the mark.
#if defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::lifetimebound)
#define SUREHIT_LIFETIMEBOUND [[clang::lifetimebound]]
#endif
#endif
#if !defined(SUREHIT_LIFETIMEBOUND)
#define SUREHIT_LIFETIMEBOUND
#endif
