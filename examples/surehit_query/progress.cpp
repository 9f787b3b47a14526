#include "surehit_query/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace surehit::example {

Progress::Progress(const char* doing, std::size_t total)
    : doing_(doing),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + std::chrono::seconds(1)) {}

void Progress::show(std::size_t done) {
  if (!on_terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + std::chrono::milliseconds(100);
  shown_ = true;
  std::fprintf(stderr, "\r%s: %.0f%%", doing_, 100 * static_cast<double>(done) / static_cast<double>(total_));
}

void Progress::hide() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  shown_ = false;
  next_ = {};
}

}  // namespace surehit::example
