#pragma once

#include <chrono>
#include <cstddef>

namespace surehit::example {

/// A line on standard error that says how far the work is: only on a terminal, and only once it has taken a second.
class Progress {
 public:
  /// `doing` says what is being done, and outlives this.
  Progress(const char* doing, std::size_t total);
  ~Progress() { hide(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done);
  /// Wipes the line until the next `show`, so that output to the same terminal does not run into it.
  void hide();

 private:
  using Clock = std::chrono::steady_clock;

  const char* doing_;
  std::size_t total_;
  bool on_terminal_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace surehit::example
