#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/program_run.hpp"
#include "support/sanitizer.hpp"

namespace surehit::test {

/// Runs visibility_bake in a folder of the test's own, and looks at what it has written.
class VisibilityBakeRun : public testing::Test {
 protected:
  ProgramRun run_{SUREHIT_VISIBILITY_BAKE_PROGRAM};

  /// The options for all three files.
  [[nodiscard]] static std::string files(const std::string& name) {
    return " -o " + name + ".pvs --csv " + name + ".csv --picture " + name + ".png ";
  }

  /// Seconds of work: a program is still far from its end when its first checkpoint is seen.
  [[nodiscard]] static std::string samples_of_a_long_run() {
    return has_sanitizer ? "--samples 60 " : "--samples 255 ";
  }

  /// Lets what was started as `child` go on in the background until it has written a checkpoint.
  [[nodiscard]] static std::string wait_for_checkpoint(const std::string& name) {
    return "& child=$!; touch start; sleep 0.01; until [ " + name +
           ".pvs.checkpoint -nt start ] || ! kill -0 $child; do sleep 0.01; done; ";
  }

  /// A wall across x = 0 and three places beside it.
  void write_wall_and_places() const {
    static_cast<void>(run_.folder().write("wall.obj", "v 0 -9 -9\nv 0 9 -9\nv 0 0 9\nf 1 2 3\n"));
    static_cast<void>(run_.folder().write("places.txt", "-2 0 0\n-1 0 0\n1 0 0\n"));
  }

  void expect_same_files(const std::string& one, const std::string& other) const {
    for (const std::string ending : {".pvs", ".csv", ".png"}) {
      const std::string bytes = run_.folder().read(one + ending);
      EXPECT_GT(bytes.size(), 100u) << one << ending;
      EXPECT_TRUE(bytes == run_.folder().read(other + ending)) << ending;
    }
  }
};

}  // namespace surehit::test
