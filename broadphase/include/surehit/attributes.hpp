#pragma once

/// Marks what a shared library exports. Everything else in it is hidden, and so is all of a static library.
/// `SUREHIT_SHARED` is set by the targets of CMake and by surehit.pc where the library is shared.
#if defined(SUREHIT_SHARED)
#define SUREHIT_API __attribute__((visibility("default")))
#else
#define SUREHIT_API
#endif

/// Marks a parameter that the result refers to, so that Clang warns where it would dangle.
#if defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::lifetimebound)
#define SUREHIT_LIFETIMEBOUND [[clang::lifetimebound]]
#endif
#endif
#if !defined(SUREHIT_LIFETIMEBOUND)
#define SUREHIT_LIFETIMEBOUND
#endif
