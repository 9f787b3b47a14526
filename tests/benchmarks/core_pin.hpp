#pragma once

#include <sched.h>

#include <vector>

namespace surehit::benchmark {

/// Keeps the calling thread on one core for as long as it lives, so that no figure contains a move.
class CorePin {
 public:
  explicit CorePin(int core);
  ~CorePin();
  CorePin(const CorePin&) = delete;
  CorePin& operator=(const CorePin&) = delete;

  /// The cores that the calling thread may run on.
  [[nodiscard]] static std::vector<int> allowed_cores();

 private:
  cpu_set_t before_;
};

}  // namespace surehit::benchmark
