#pragma once

#include <cstdint>

namespace surehit {

/// Sets the floating-point environment that the library's proofs need, as long as it lives: rounding to nearest, no
/// flush-to-zero, no traps. At the end it restores the caller's environment, with its sticky flags. If the caller's
/// environment is already right, it only reads the control word.
///
/// Every entry point of the library makes one. A batch makes one for all its paths.
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
