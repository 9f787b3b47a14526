#include <gtest/gtest.h>

#include <string>

#include "support/program_run.hpp"
#include "support/sanitizer.hpp"

namespace surehit::test::render_program_test {
namespace {

class RenderProgram : public testing::Test {
 protected:
  ProgramRun run_{SUREHIT_RENDER_PROGRAM};
  const std::string small_ = " --width 64 --height 48 --samples 1 ";

  void expect_picture(const std::string& arguments, const std::string& name) {
    const auto outcome = run_.run(arguments + small_ + "-o " + name);
    EXPECT_EQ(outcome.status, 0) << arguments << '\n' << outcome.error;
    EXPECT_EQ(outcome.error, "") << arguments;
    EXPECT_NE(outcome.output.find(name), std::string::npos) << outcome.output;
    EXPECT_GT(run_.folder().read(name).size(), 100u) << arguments;
  }

  void expect_failure(const std::string& arguments, int status, const std::string& error) {
    const std::size_t files = run_.folder().file_count();
    const auto outcome = run_.run(arguments + " -o failed.png");
    EXPECT_EQ(outcome.error, "render: " + error + "\n") << arguments;
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_EQ(run_.folder().file_count(), files) << arguments << " left a file behind";
  }

  void write_tetrahedron() const {
    static_cast<void>(run_.folder().write(
        "tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv .3 .3 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"));
  }
};

TEST_F(RenderProgram, draws_each_mode_and_scene) {
  write_tetrahedron();
  for (const std::string mode : {"shaded", "cost", "ids", "cracks"}) {
    for (const std::string scene : {"--scene exercise", "--scene level", "tetrahedron.obj"}) {
      expect_picture(scene + " --mode " + mode, "picture.png");
    }
  }
  for (const std::string cost : {"cells", "candidates", "exact"}) {
    expect_picture("tetrahedron.obj --mode cost --cost " + cost, "picture.png");
  }
  expect_picture("tetrahedron.obj --material glass --flat --no-floor --unit-directions --culling back", "picture.png");
}

TEST_F(RenderProgram, says_how_many_holes_there_are) {
  const auto outcome = run_.run("--mode cracks --width 96 -o cracks.png");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("surehit: 0 holes"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("plain floats: 0 holes"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find(" 9216 rays"), std::string::npos) << outcome.output;
}

TEST_F(RenderProgram, writes_png_or_ppm) {
  expect_picture("", "picture.png");
  EXPECT_EQ(run_.folder().read("picture.png").substr(1, 3), "PNG");
  expect_picture("", "picture.ppm");
  const std::string ppm = run_.folder().read("picture.ppm");
  EXPECT_EQ(ppm.substr(0, 13), "P6\n64 48\n255\n");
  EXPECT_EQ(ppm.size(), std::size_t{13 + 3 * 64 * 48});
}

TEST_F(RenderProgram, draws_the_same_bytes_on_any_number_of_threads) {
  const auto outcome = run_.run_command(std::string("for i in 1 2 5; do \"$program\" ") +
                                        (has_sanitizer ? "--width 192 --height 108" : "--width 320 --height 180") +
                                        " --threads $i -o $i.ppm || exit 9; done && "
                                        "cmp 1.ppm 2.ppm && cmp 1.ppm 5.ppm");
  EXPECT_EQ(outcome.status, 0) << outcome.error << outcome.output;
}

TEST_F(RenderProgram, has_help) {
  const auto outcome = run_.run("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"--mode", "--scene", "--culling", "Exit status"}) {
    EXPECT_NE(outcome.output.find(word), std::string::npos) << word;
  }
}

TEST_F(RenderProgram, names_what_is_wrong) {
  write_tetrahedron();
  expect_failure("absent.obj", 2, "absent.obj: cannot be read: No such file or directory");
  expect_failure("--eye 1,2", 2, "--eye: three numbers X,Y,Z are needed, not '1,2'");
  expect_failure("--eye 1,2,three", 2, "--eye: 'three' is not a number");
  expect_failure("--eye 1,2,3 --target 1,2,3", 2, "the eye and the target are the same point");
  expect_failure("--eye 0,0,0 --target 1e-30,0,0", 2, "the eye and the target are too near to each other");
  expect_failure("--eye 0,0,0 --target 1e30,0,0", 2, "the eye and the target are too far from each other");
  EXPECT_EQ(run_.run("--degrees nan").status, 2);
  expect_failure("--eye 1,2,3 --target 1,2,8", 2, "the camera looks straight along its upward axis");
  expect_failure("--mode cracks --vertex 9999", 2, "--vertex: there is no vertex 9999, the mesh has 642");
  expect_failure("tetrahedron.obj --mode cracks --vertex 0", 2,
                 "--vertex: the triangles at vertex 0 do not all face upwards");
  expect_failure("--mode cracks --width 4097", 2, "--width: at most 4096 in --mode cracks, which draws two pictures");
  EXPECT_EQ(run_.run("--mode bright").status, 2);
  EXPECT_EQ(run_.run("--mode cost --gpu").status, 2);
  EXPECT_EQ(run_.run("--scene level tetrahedron.obj").status, 2);
}

TEST_F(RenderProgram, writes_a_picture_alone_to_standard_output) {
  const auto outcome = run_.run(small_ + "-o picture.png && \"$program\" " + small_ + "-o - | cmp - picture.png >&2");
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("rays"), std::string::npos) << outcome.error;
}

TEST_F(RenderProgram, says_that_a_picture_cannot_be_written) {
  // Before it renders for hours.
  const auto outcome = run_.run("--width 16384 --height 16384 --samples 16 -o absent/picture.png");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("absent/picture.png"), std::string::npos) << outcome.error;
  if (run_.run_command("test -c /dev/full").status == 0) {
    const auto full = run_.run(small_ + "-o /dev/full");
    EXPECT_EQ(full.status, 1);
    EXPECT_EQ(full.error, "render: /dev/full: cannot be written: No space left on device\n");
  }
}

TEST_F(RenderProgram, stops_cleanly_when_it_is_asked_to) {
  for (const std::string signal : {"INT", "TERM"}) {
    const auto outcome = run_.run_command(
        "\"$program\" --width 4000 --height 4000 --samples 8 -o long.png & child=$!; sleep 1.5; kill -" + signal +
        " $child; wait $child");
    EXPECT_EQ(outcome.status, 130) << signal << ' ' << outcome.error;
    EXPECT_EQ(outcome.error, "render: interrupted\n");
    EXPECT_EQ(run_.folder().file_count(), 0u);
  }
}

}  // namespace
}  // namespace surehit::test::render_program_test
