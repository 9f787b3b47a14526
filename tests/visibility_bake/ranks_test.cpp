#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "support/sanitizer.hpp"
#include "visibility_bake_run.hpp"

namespace surehit::test::ranks_test {
namespace {

/// Runs the program with mpirun on this machine, with more ranks than it may have cores.
class RanksTest : public VisibilityBakeRun {
 protected:
  /// Open MPI leaves memory behind, and warns of machines that are tests.
  const std::string surroundings_ =
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_btl_vader_single_copy_mechanism=none ASAN_OPTIONS=detect_leaks=0; ";

  [[nodiscard]] ProgramRun::Outcome run_ranks(int ranks, const std::string& arguments,
                                              const std::string& after = "") const {
    return run_.run_command(surroundings_ + "'" SUREHIT_MPIRUN "' -n " + std::to_string(ranks) + " \"$program\" " +
                            arguments + after);
  }
};

TEST_F(RanksTest, write_the_same_bytes_as_one_process) {
  ASSERT_EQ(run_.run("--spacing 2" + files("alone")).status, 0);
  for (const auto& [ranks, threads] : {std::pair{1, 1}, {2, 1}, {4, 2}}) {
    const auto outcome = run_ranks(ranks, "--spacing 2 --threads " + std::to_string(threads) + files("together"));
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_NE(outcome.output.find("by " + std::to_string(ranks) + " process"), std::string::npos) << outcome.output;
    expect_same_files("alone", "together");
  }
}

TEST_F(RanksTest, go_on_after_they_were_killed) {
  const std::string arguments = "--spacing 2 " + samples_of_a_long_run() + "--checkpoint-seconds 0.02 ";
  ASSERT_EQ(run_.run(arguments + files("whole")).status, 0);
  // The child is mpirun, whose children are the ranks.
  const auto killed =
      run_ranks(4, arguments + files("killed"),
                wait_for_checkpoint("killed") + "kill -KILL $(cat /proc/$child/task/$child/children); wait $child");
  ASSERT_NE(killed.status, 0) << "it was too quick to be killed";
  const auto outcome = run_ranks(2, arguments + files("killed"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.output.find("goes on with"), std::string::npos) << outcome.output;
  expect_same_files("whole", "killed");
  EXPECT_FALSE(std::filesystem::exists(run_.folder().at("killed.pvs.checkpoint")));
}

TEST_F(RanksTest, say_once_what_is_wrong) {
  const auto outcome = run_ranks(3, "absent.obj" + files("none"));
  EXPECT_EQ(outcome.status, 2);
  const std::string error = "visibility_bake: absent.obj: cannot be read: No such file or directory";
  const std::size_t first = outcome.error.find(error);
  ASSERT_NE(first, std::string::npos) << outcome.error;
  EXPECT_EQ(outcome.error.find(error, first + 1), std::string::npos) << outcome.error;
}

TEST_F(RanksTest, notice_that_one_has_another_mesh) {
  write_wall_and_places();
  static_cast<void>(run_.folder().write("other.obj", "v 0 -9 -9\nv 0 9 -9\nv 0 0 8\nf 1 2 3\n"));
  const auto outcome = run_ranks(1, "wall.obj --places places.txt" + files("mixed"),
                                 ": -n 1 \"$program\" other.obj --places places.txt" + files("mixed"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("rank 1 has another mesh, other cells or other options than rank 0"), std::string::npos)
      << outcome.error;
}

TEST_F(RanksTest, all_end_if_one_fails_at_work) {
  if (has_sanitizer) GTEST_SKIP() << "a sanitizer takes more addresses than the limit allows";
  // Rank 1 has no room for the stacks of so many threads. It starts them with its first unit.
  const std::string limited = ": -n 1 bash -c 'ulimit -v 3000000; exec \"$0\" \"$@\"' \"$program\" --threads 1024 ";
  const auto outcome =
      run_.run_command(surroundings_ + "timeout 60 '" SUREHIT_MPIRUN "' -n 1 \"$program\" --spacing 2" + files("some") +
                       limited + "--spacing 2" + files("some"));
  EXPECT_EQ(outcome.status, 1) << "124 is that of a timeout";
  EXPECT_NE(outcome.error.find("visibility_bake: rank 1: "), std::string::npos) << outcome.error;
  EXPECT_FALSE(std::filesystem::exists(run_.folder().at("some.pvs")));
}

TEST_F(RanksTest, stop_if_the_disk_is_full) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no disk that is always full";
  std::filesystem::create_symlink("/dev/full", run_.folder().at("some.pvs.checkpoint.partial"));
  const auto outcome = run_ranks(3, "--spacing 3 --checkpoint-seconds 0" + files("some"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("some.pvs.checkpoint: cannot be written: No space left on device"), std::string::npos)
      << outcome.error;
}

/// A run of many seconds. Each rank tells its process id, and rank 0 what it says.
const std::string long_run =
    "bash -c 'echo $$ >pid$OMPI_COMM_WORLD_RANK; exec \"$0\" --samples 255 --checkpoint-seconds 100000 -o stopped.pvs "
    "--csv stopped.csv --picture stopped.png >output$OMPI_COMM_WORLD_RANK' \"$program\" & mpirun=$!; "
    "until grep -q cells output0; do sleep 0.01; done; sleep 0.2; ";

TEST_F(RanksTest, keep_a_checkpoint_when_they_are_asked_to_stop) {
  const auto stopped =
      run_.run_command(surroundings_ + "'" SUREHIT_MPIRUN "' -n 3 " + long_run + "kill -TERM $mpirun; wait $mpirun");
  ASSERT_NE(stopped.status, 0) << "it was too quick to be stopped";
  EXPECT_TRUE(std::filesystem::exists(run_.folder().at("stopped.pvs.checkpoint")));
}

TEST_F(RanksTest, stop_when_one_is_asked_to) {
  const auto stopped = run_.run_command(surroundings_ + "timeout 60 '" SUREHIT_MPIRUN "' -n 3 " + long_run +
                                        "kill -TERM $(cat pid2); wait $mpirun");
  EXPECT_EQ(stopped.status, 130);
  EXPECT_NE(stopped.error.find("visibility_bake: interrupted"), std::string::npos) << stopped.error;
  EXPECT_TRUE(std::filesystem::exists(run_.folder().at("stopped.pvs.checkpoint")));
  EXPECT_FALSE(std::filesystem::exists(run_.folder().at("stopped.pvs")));
}

TEST_F(RanksTest, keep_a_checkpoint_before_all_have_stopped) {
  // Rank 1 never brings its unit. It gets no time to end, as if what started it were impatient.
  const auto stopped = run_.run_command(
      surroundings_ + "'" SUREHIT_MPIRUN "' -n 2 " + long_run +
      "kill -STOP $(cat pid1); kill -TERM $(cat pid0); for i in $(seq 300); do [ -e stopped.pvs.checkpoint ] && break; "
      "sleep 0.05; done; ls *.checkpoint; kill -KILL $(cat pid0 pid1); wait $mpirun");
  EXPECT_NE(stopped.status, 0);
  EXPECT_EQ(stopped.output.substr(0, 23), "stopped.pvs.checkpoint\n") << stopped.error;
}

}  // namespace
}  // namespace surehit::test::ranks_test
