#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "visibility_bake_run.hpp"

namespace surehit::test::visibility_bake_program_test {
namespace {

class VisibilityBakeProgram : public VisibilityBakeRun {
 protected:
  const std::string long_run_ = "--spacing 2 " + samples_of_a_long_run() + "--threads 1 --checkpoint-seconds 0.02 ";

  void expect_bad_input(const std::string& arguments, const std::string& error) {
    const auto outcome = run_.run(arguments);
    EXPECT_EQ(outcome.error, "visibility_bake: " + error + "\n") << arguments;
    EXPECT_EQ(outcome.status, 2) << arguments;
  }
};

TEST_F(VisibilityBakeProgram, goes_on_after_it_was_killed) {
  ASSERT_EQ(run_.run(long_run_ + files("whole")).status, 0);
  for (int kills = 0; kills < 3; ++kills) {
    const auto outcome = run_.run_command("\"$program\" " + long_run_ + files("killed") +
                                          wait_for_checkpoint("killed") + "kill -KILL $child; wait $child");
    ASSERT_NE(outcome.status, 0) << "it was too quick to be killed";
    EXPECT_EQ(outcome.output.find("goes on with") != std::string::npos, kills > 0) << outcome.output;
  }
  const auto outcome = run_.run(long_run_ + files("killed"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.output.find("goes on with"), std::string::npos) << outcome.output;
  expect_same_files("whole", "killed");
  EXPECT_EQ(run_.folder().file_count(), 7u) << "neither a checkpoint nor a part of one is left";
}

TEST_F(VisibilityBakeProgram, goes_on_after_control_c) {
  ASSERT_EQ(run_.run(long_run_ + files("whole")).status, 0);
  const auto stopped = run_.run_command("\"$program\" " + long_run_ + files("stopped") +
                                        wait_for_checkpoint("stopped") + "kill -INT $child; wait $child");
  ASSERT_EQ(stopped.status, 130) << stopped.error;
  EXPECT_EQ(stopped.error, "visibility_bake: interrupted\n");
  const auto outcome = run_.run(long_run_ + files("stopped"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.output.find("goes on with"), std::string::npos) << outcome.output;
  expect_same_files("whole", "stopped");
}

TEST_F(VisibilityBakeProgram, writes_the_same_bytes_on_any_number_of_threads) {
  for (const std::string threads : {"1", "2", "5"}) {
    const auto outcome = run_.run("--spacing 3 --threads " + threads + files(threads));
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_NE(outcome.output.find("of " + threads + " thread"), std::string::npos) << outcome.output;
  }
  expect_same_files("1", "2");
  expect_same_files("1", "5");
}

TEST_F(VisibilityBakeProgram, takes_a_mesh_and_places) {
  write_wall_and_places();
  const auto outcome = run_.run("wall.obj --places places.txt" + files("wall"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.output.find("3 pairs in range, 1 of them see each other"), std::string::npos) << outcome.output;
  EXPECT_EQ(run_.folder().read("wall.csv"),
            "cell,x,y,z,cells_in_range,cells_seen,segments,clear_segments\n"
            "0,-2,0,0,2,1,16,8\n1,-1,0,0,2,1,16,8\n2,1,0,0,2,0,16,0\n");
}

TEST_F(VisibilityBakeProgram, refuses_checkpoints_that_do_not_fit) {
  write_wall_and_places();
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no disk that is always full";
  // The figures cannot be written, so the checkpoint stays.
  const std::string keep = "ln -s /dev/full some.csv && ";
  const auto stopped =
      run_.run_command(keep + "\"$program\" wall.obj --places places.txt --checkpoint-seconds 0" + files("some"));
  EXPECT_EQ(stopped.status, 1);
  EXPECT_NE(stopped.error.find("some.csv: cannot be written"), std::string::npos) << stopped.error;
  ASSERT_TRUE(std::filesystem::exists(run_.folder().at("some.pvs.checkpoint")));

  expect_bad_input("wall.obj --places places.txt --samples 9" + files("some"),
                   "some.pvs.checkpoint: is of another mesh, of other cells or of other options; remove it, or begin "
                   "again with --restart");
  std::string bytes = run_.folder().read("some.pvs.checkpoint");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  static_cast<void>(run_.folder().write("some.pvs.checkpoint", bytes));
  expect_bad_input("wall.obj --places places.txt" + files("some"),
                   "some.pvs.checkpoint: is damaged: its checksum is not that of its bytes; remove it, or begin again "
                   "with --restart");
  EXPECT_EQ(run_.run_command("rm some.csv").status, 0);
  const auto again = run_.run("wall.obj --places places.txt --restart" + files("some"));
  EXPECT_EQ(again.status, 0) << again.error;
  EXPECT_FALSE(std::filesystem::exists(run_.folder().at("some.pvs.checkpoint")));
}

TEST_F(VisibilityBakeProgram, says_that_the_disk_is_full) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no disk that is always full";
  const auto outcome = run_.run_command(
      "ln -s /dev/full some.pvs.checkpoint.partial && \"$program\" --spacing 3 --checkpoint-seconds 0" + files("some"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.error, "visibility_bake: some.pvs.checkpoint: cannot be written: No space left on device\n");
  EXPECT_FALSE(std::filesystem::exists(run_.folder().at("some.pvs")));
}

TEST_F(VisibilityBakeProgram, writes_one_file_and_no_text_to_standard_output) {
  write_wall_and_places();
  const std::string arguments = "wall.obj --places places.txt";
  ASSERT_EQ(run_.run(arguments + files("wall")).status, 0);
  const std::array<std::array<std::string, 2>, 3> outputs = {
      {{"-o -", ".pvs"}, {"--csv -", ".csv"}, {"--picture -", ".png"}}};
  for (const auto& [option, ending] : outputs) {
    const auto outcome = run_.run(arguments + " " + option);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_TRUE(outcome.output == run_.folder().read("wall" + ending)) << option;
    EXPECT_NE(outcome.error.find("3 pairs in range"), std::string::npos) << outcome.error;
  }
  expect_bad_input(arguments + " -o - --csv -", "-o and --csv are the same file, -");
  // An interrupted run goes on from what the default name says.
  const auto stopped = run_.run_command("ln -s /dev/full full.csv && \"$program\" " + arguments +
                                        " -o - --csv full.csv --checkpoint-seconds 0 >sets");
  EXPECT_EQ(stopped.status, 1);
  EXPECT_TRUE(std::filesystem::exists(run_.folder().at("visibility.pvs.checkpoint"))) << stopped.error;
}

TEST_F(VisibilityBakeProgram, writes_to_what_is_no_regular_file_and_through_links) {
  write_wall_and_places();
  const auto outcome = run_.run_command(
      "mkfifo pipe; touch old.pvs; ln -s old.pvs link.pvs; cat pipe >piped.csv & \"$program\" wall.obj --places "
      "places.txt -o link.pvs --csv pipe && wait && [ -p pipe ] && [ -L link.pvs ]");
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_TRUE(run_.folder().read("old.pvs").starts_with("surehit potentially visible sets"));
  EXPECT_TRUE(run_.folder().read("piped.csv").starts_with("cell,x,y,z"));
}

TEST_F(VisibilityBakeProgram, says_before_it_bakes_what_cannot_be_written) {
  for (const std::string option : {"-o", "--csv", "--picture"}) {
    const auto outcome = run_.run("--spacing 8 " + option + " absent/file");
    EXPECT_EQ(outcome.status, 1) << option;
    EXPECT_EQ(outcome.error, "visibility_bake: absent/file: cannot be written: No such file or directory\n");
    EXPECT_EQ(outcome.output, "") << "it has not begun";
  }
  EXPECT_EQ(run_.folder().file_count(), 0u);
}

TEST_F(VisibilityBakeProgram, refuses_one_file_for_two_outputs) {
  expect_bad_input("-o a --csv b --picture ./a", "-o and --picture are the same file, ./a");
  expect_bad_input("-o a --csv a", "-o and --csv are the same file, a");
  expect_bad_input("--csv visibility.png", "--csv and --picture are the same file, visibility.png");
}

TEST_F(VisibilityBakeProgram, names_what_is_wrong) {
  write_wall_and_places();
  static_cast<void>(run_.folder().write("empty.txt", "# nothing\n"));
  expect_bad_input("absent.obj", "absent.obj: cannot be read: No such file or directory");
  expect_bad_input("wall.obj", "the mesh has no walkable place: --up or --headroom may be wrong");
  expect_bad_input("wall.obj --places empty.txt", "empty.txt: there is no place in it");
  expect_bad_input("--start 1,2", "--start: three numbers X,Y,Z are needed, not '1,2'");
  expect_bad_input("--start 1000,2,3", "--start: there is no walkable place near it");
  expect_bad_input("--eye-height 1.9", "--eye-height: it must not be above --headroom");
  expect_bad_input("--spacing 8 --cell 100000", "--cell: there is no cell 100000, there are 75");
  static_cast<void>(run_.folder().write("far.txt", "0 0 0\n3e38 0 0\n-3e38 0 0\n"));
  expect_bad_input("wall.obj --places far.txt", "cell 1 is too far away: coordinates may be up to 1e9");
  for (const std::string option : {"--range", "--eye-height", "--checkpoint-seconds", "--spacing"}) {
    const auto outcome = run_.run(option + " nan");
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_NE(outcome.error.find(option + ": nan is not a number"), std::string::npos) << outcome.error;
  }
  EXPECT_EQ(run_.run("--samples 0").status, 2);
  EXPECT_EQ(run_.run("--places a --start 1,2,3").status, 2);
}

TEST_F(VisibilityBakeProgram, refuses_more_cells_than_it_has_memory_for) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (memory > 250e9) GTEST_SKIP() << "as many cells as there may be fit into the memory";
  write_wall_and_places();
  std::string places;
  for (int i = 0; i < 1 << 20; ++i) places += std::to_string(i) + " 0 0\n";
  static_cast<void>(run_.folder().write("places.txt", places));
  const auto outcome = run_.run("wall.obj --places places.txt");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("1048576 cells need 275 GB of memory, and the machine has "), std::string::npos)
      << outcome.error;
}

#ifdef SUREHIT_WITHOUT_MPI
TEST_F(VisibilityBakeProgram, is_not_one_of_several_without_MPI) {
  const auto outcome = run_.run_command("OMPI_COMM_WORLD_SIZE=2 \"$program\" --spacing 8");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.error, "visibility_bake: this build is without MPI, and cannot be one of 2 processes\n");
  EXPECT_EQ(run_.run_command("OMPI_COMM_WORLD_SIZE=1 \"$program\" --spacing 8").status, 0);
}
#endif

TEST_F(VisibilityBakeProgram, has_help) {
  const auto outcome = run_.run("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"--places", "--range", "--restart", "Exit status"}) {
    EXPECT_NE(outcome.output.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace surehit::test::visibility_bake_program_test
