#include "command_line/interruption.hpp"

#include <atomic>
#include <csignal>

namespace surehit::example {
namespace {

std::atomic<bool> is_asked_to_stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may store it");

extern "C" void ask_to_stop(int signal) {
  is_asked_to_stop = true;
  static_cast<void>(std::signal(signal, SIG_DFL));
}

}  // namespace

void stop_when_asked() {
  static_cast<void>(std::signal(SIGINT, ask_to_stop));
  static_cast<void>(std::signal(SIGTERM, ask_to_stop));
}

void stop_if_interrupted() {
  if (is_asked_to_stop) throw Interrupted();
}

}  // namespace surehit::example
