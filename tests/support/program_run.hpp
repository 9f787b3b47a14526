#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "examples/temporary_folder.hpp"

namespace surehit::test {

/// Runs a program as it was built, in a folder of the test's own.
class ProgramRun {
 public:
  struct Outcome {
    int status;
    std::string output;
    std::string error;
  };

  explicit ProgramRun(std::string program) : program_(std::move(program)) {}

  /// Runs the program with arguments for the shell. `$program` in `command` is the program.
  [[nodiscard]] Outcome run(const std::string& arguments) const { return run_command("\"$program\" " + arguments); }
  [[nodiscard]] Outcome run_command(const std::string& command) const {
    const std::string all = "cd '" + folder_.at("") + "' && program='" + program_ + "' && { " + command + "\n} >'" +
                            streams_.at("output") + "' 2>'" + streams_.at("error") + "'";
    const int status = std::system(all.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, streams_.read("output"), streams_.read("error")};
  }

  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

 private:
  std::string program_;
  TemporaryFolder folder_;
  TemporaryFolder streams_;
};

}  // namespace surehit::test
