#include "command_line/progress_bar.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace surehit::example {

ProgressBar::ProgressBar(std::string title, std::size_t total)
    : title_(std::move(title)),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      begin_(Clock::now()),
      next_(begin_ + std::chrono::seconds(1)) {}

void ProgressBar::show(std::size_t done, const std::string& rate) {
  if (!on_terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + std::chrono::milliseconds(100);
  shown_ = true;
  constexpr std::size_t width = 40;
  std::string bar(width * done / total_, '#');
  bar.resize(width, '.');
  std::fprintf(stderr, "\r%s [%s] %3zu%%", title_.c_str(), bar.c_str(), 100 * done / total_);
  if (!rate.empty()) std::fprintf(stderr, " %s,", rate.c_str());
  if (done > 0) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    std::fprintf(stderr, " %.0f s left\x1b[K",
                 seconds * static_cast<double>(total_ - done) / static_cast<double>(done));
  }
}

void ProgressBar::hide() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  shown_ = false;
  next_ = {};
}

}  // namespace surehit::example
