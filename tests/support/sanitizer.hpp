#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // GCC
#define SUREHIT_HAS_SANITIZER true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SUREHIT_HAS_SANITIZER true
#endif
#endif
#ifndef SUREHIT_HAS_SANITIZER
#define SUREHIT_HAS_SANITIZER false
#endif

namespace surehit::test {

/// Whether AddressSanitizer or ThreadSanitizer watches, which takes several times as long.
constexpr bool has_sanitizer = SUREHIT_HAS_SANITIZER;

}  // namespace surehit::test
