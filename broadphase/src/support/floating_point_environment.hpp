#pragma once

#include <cstdint>

namespace surehit {

/// Holds the floating-point environment that the library's proofs rest on, for as long as it lives: rounding to
/// nearest, no flush-to-zero, no traps. Where the caller's environment is that already, it costs one read of the
/// control word; where it is not, the environment is set, and the caller's put back at the end, its sticky flags
/// included.
///
/// Every entry point of the library makes one, a batch makes one for all of its paths.
class FloatingPointEnvironment {
 public:
  FloatingPointEnvironment() noexcept;
  ~FloatingPointEnvironment() {
    if (restore_) restore();
  }
  FloatingPointEnvironment(const FloatingPointEnvironment&) = delete;
  FloatingPointEnvironment& operator=(const FloatingPointEnvironment&) = delete;

 private:
  void restore() noexcept;

  std::uint64_t caller_ = 0;
  bool restore_ = false;
};

}  // namespace surehit
