#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace surehit::example {

/// A bar on standard error that says how far the work is, and how long it will take: only on a terminal, and only once
/// it has taken a second.
class ProgressBar {
 public:
  ProgressBar(std::string title, std::size_t total);
  ~ProgressBar() { hide(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `rate` says how fast the work is, such as "2.1 M rays/s".
  void show(std::size_t done, const std::string& rate = "");
  /// Wipes the bar until the next `show`, so that output to the same terminal does not run into it.
  void hide();

 private:
  using Clock = std::chrono::steady_clock;

  std::string title_;
  std::size_t total_;
  bool on_terminal_;
  Clock::time_point begin_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace surehit::example
