#pragma once

#include <stdexcept>

namespace surehit::example {

/// What `stop_if_interrupted` throws. `run_program` makes it an exit status of its own.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on, Ctrl-C and SIGTERM end the program at the next `stop_if_interrupted`. A second one ends it at once.
void stop_when_asked();

/// Throws Interrupted if the user has asked the program to stop. Threads call it between two pieces of work.
void stop_if_interrupted();

}  // namespace surehit::example
