#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "temporary_folder.hpp"

namespace surehit::test {

/// Runs the program as it was built, in a folder of the test's own.
class SurehitQueryRun : public testing::Test {
 protected:
  struct Outcome {
    int status;
    std::string output;
    std::string error;
  };

  /// The arguments are for the shell, in the test's folder, and so is what it does before.
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& before = "true") const {
    const std::string command =
        "cd '" + folder_.at("") + "' && " + before + " && '" SUREHIT_QUERY_PROGRAM "' " + arguments;
    const std::string streams = " >'" + streams_.at("output") + "' 2>'" + streams_.at("error") + "'";
    const int status = std::system(("{ " + command + "\n}" + streams).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, streams_.read("output"), streams_.read("error")};
  }

  void expect_output(const std::string& arguments, const std::string& output) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.output, output) << arguments;
    EXPECT_EQ(outcome.error, "") << arguments;
    EXPECT_EQ(outcome.status, 0) << arguments;
  }

  void expect_bad_input(const std::string& arguments, const std::string& error) const {
    const std::size_t files = folder_.file_count();
    const Outcome outcome = run(arguments + " -o answers.csv");
    EXPECT_EQ(outcome.error, "surehit-query: " + error + "\n") << arguments;
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(folder_.file_count(), files) << arguments << " left a file behind";
  }

  void write(const std::string& name, const std::string& text) const { static_cast<void>(folder_.write(name, text)); }

  /// Two unit squares, at z = 0 and z = 1, of two triangles each.
  void write_squares() const {
    write("squares.obj",
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf 5 6 7 8\n");
  }

  TemporaryFolder folder_;
  TemporaryFolder streams_;
};

inline const std::string downwards = "0 0 1  0 0 -1  ";
inline const std::string triangle = "-1 -1 0  1 -1 0  0 1 0";

}  // namespace surehit::test
