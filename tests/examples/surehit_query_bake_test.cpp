#include <gtest/gtest.h>

#include <string>

#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_bake_test {
namespace {

/// Saved colliders in place of meshes.
class SurehitQueryBake : public SurehitQueryRun {
 protected:
  void bake(const std::string& arguments) const { expect_output("bake " + arguments, ""); }

  /// Expects the answers that the mesh gets.
  void expect_same(const std::string& command, const std::string& file, const std::string& options = "") const {
    const Outcome expected = run(command + " squares.obj paths " + options);
    EXPECT_EQ(expected.status, 0) << expected.error;
    expect_output(command + ' ' + file + " paths " + options, expected.output);
  }
};

TEST_F(SurehitQueryBake, every_command_takes_the_file) {
  write_squares();
  write("paths", ".5 .5 2  .5 .5 -1\n0 0 2  0 0 .5\n3 3 2  3 3 -1\n.25 .75 1  .25 .75 0\n");
  bake("squares.obj -o squares.any");
  bake("squares.obj -o doubles.any --scalar double");
  for (const char* const command : {"first", "any", "all"}) {
    expect_same(command, "squares.any");
    expect_same(command, "squares.any", "--path ray --ignore-triangle 2");
    expect_same(command, "doubles.any", "--scalar double");
  }
  expect_same("explain", "squares.any", "--index 1");
}

TEST_F(SurehitQueryBake, masks_are_saved_and_replaced) {
  write_squares();
  write("paths", ".5 .25 2  .5 .25 -1\n");
  write("masks", "1\n2\n4\n8\n");
  write("fewer", "1\n2\n4\n");
  bake("squares.obj -o saved --masks masks");
  expect_output("all saved paths --mask 4", "path,triangle,t,u,v,side,tie\n0,2,0.33333334,0.25,0.25,front,0\n");
  expect_output("any saved paths --mask 10", "hit\n0\n");
  expect_output("any saved paths --mask 10 --masks masks", "hit\n0\n");
  write("masks", "2\n2\n2\n2\n");
  expect_output("any saved paths --mask 2 --masks masks", "hit\n1\n");
  expect_bad_input("any saved paths --masks fewer", "fewer: 3 masks for 4 triangles");
}

TEST_F(SurehitQueryBake, scenes_place_the_file) {
  write_squares();
  write("paths", ".5 .5 9  .5 .5 -9\n");
  bake("squares.obj -o saved");
  write("baked.txt", "saved 1 0 0 0 0 1 0 0 0 0 1 5\n");
  write("scene.txt", "squares.obj 1 0 0 0 0 1 0 0 0 0 1 5\n");
  const Outcome expected = run("all --scene scene.txt paths");
  EXPECT_EQ(expected.status, 0);
  expect_output("all --scene baked.txt paths", expected.output);
}

TEST_F(SurehitQueryBake, bytes_are_the_same_on_standard_output) {
  write_squares();
  bake("squares.obj -o saved");
  const Outcome outcome = run("bake saved -o -");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, folder_.read("saved"));
}

TEST_F(SurehitQueryBake, what_cannot_be_asked_is_an_error) {
  write_squares();
  write("paths", downwards);
  bake("squares.obj -o saved");
  expect_bad_input("first saved paths --scalar double", "saved: byte 15: the file does not hold doubles");
  expect_bad_input("first saved paths --ids face", "saved: a saved collider has no faces, only triangles");
  expect_bad_input("first saved paths --ignore-face 0", "saved: a saved collider has no faces, only triangles");
  expect_bad_input("first saved paths --ignore-triangle 4",
                   "--ignore-triangle: there is no triangle 4 among 4, which count from 0");
  std::string bytes = folder_.read("saved");
  bytes[100] ^= 1;
  write("saved", bytes);
  expect_bad_input("first saved paths", "saved: byte " + std::to_string(bytes.size() - 8) +
                                            ": the checksum is not that of the bytes, so the file is damaged");
  write("saved", bytes.substr(0, 8));
  expect_bad_input("first saved paths", "saved: byte 8: the file ends before its head does");
  EXPECT_EQ(run("bake squares.obj").status, 2);
  EXPECT_EQ(run("bake squares.obj -o /dev/full").status, 1);
}

}  // namespace
}  // namespace surehit::test::surehit_query_bake_test
