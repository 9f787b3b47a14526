#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_scene_test {
namespace {

/// Queries of scenes.
class SurehitQueryScene : public SurehitQueryRun {
 protected:
  /// A square is at z = 0 and at z = 1 in its mesh. One instance has it there, and a turned one has it at x = 5 and 6.
  void write_scene() const {
    write_squares();
    write("scene.txt", "# two\nsquares.obj " + identity + "\n\nsquares.obj " + onto_x + "\n");
  }

  static inline const std::string identity = "1 0 0 0  0 1 0 0  0 0 1 0";
  static inline const std::string onto_x = "0 0 1 5  1 0 0 0  0 1 0 0";
};

TEST_F(SurehitQueryScene, answers_with_the_number_of_the_instance) {
  write_scene();
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n7 0.25 0.75  3 0.25 0.75\n9 9 9  8 8 8\n");
  expect_output("first --scene scene.txt paths",
                "instance,triangle,t,u,v,side\n0,2,0.5,0.25,0.25,front\n1,3,0.25,0.25,0.5,front\n-1,-1,,,,\n");
  expect_output("any paths --scene scene.txt", "hit\n1\n1\n0\n");
  expect_output("all --scene=scene.txt paths",
                "path,instance,triangle,t,u,v,side,tie\n0,0,2,0.5,0.25,0.25,front,0\n0,0,0,0.75,0.25,0.25,front,0\n"
                "1,1,3,0.25,0.25,0.5,front,0\n1,1,1,0.5,0.25,0.5,front,0\n");
}

TEST_F(SurehitQueryScene, answers_nothing_with_a_header) {
  write_scene();
  expect_output("first --scene scene.txt /dev/null", "instance,triangle,t,u,v,side\n");
  expect_output("any --scene scene.txt /dev/null", "hit\n");
  expect_output("all --scene scene.txt /dev/null --ids face", "path,instance,face,t,u,v,side,tie\n");
}

TEST_F(SurehitQueryScene, answers_as_for_a_mesh_in_its_own_place) {
  write_squares();
  write("scene.txt", "squares.obj " + identity + "\n");
  write(
      "paths",
      "0.5 0.25 -1  0.5 0.25 3\n0.5 0.5 3  0.5 0.5 -1\n0 0 0.5  1 1 1\n0.5 -0.5 1  1.5 0.5 1\n0.3 0.7 2  0.3 0.7 -1\n");
  for (const std::string path : {"segment", "ray", "line"}) {
    for (const std::string question : {"first", "all"}) {
      const std::string options = " paths --points --normals --path " + path;
      const Outcome of_mesh = run(question + " squares.obj" + options);
      std::string of_scene = run(question + " --scene scene.txt" + options).output;
      // Each triangle has its instance before it.
      std::string expected;
      std::size_t line = 0;
      for (std::size_t begin = 0; begin < of_mesh.output.size(); ++line) {
        const std::size_t end = of_mesh.output.find('\n', begin) + 1;
        const std::string text = of_mesh.output.substr(begin, end - begin);
        const std::size_t place = question == "all" ? text.find(',') + 1 : 0;
        const std::string ids = line == 0 ? "instance," : text.starts_with("-1") ? "-1," : "0,";
        expected += text.substr(0, place) + ids + text.substr(place);
        begin = end;
      }
      EXPECT_GT(line, 3u);
      EXPECT_EQ(of_scene, expected) << question << path;
    }
  }
}

TEST_F(SurehitQueryScene, moves_instances_along_segments_alone) {
  write_squares();
  write("scene.txt", "squares.obj " + identity + " motion 0 0 2\n");
  // The point comes down by 4 while the upper square goes up by 2.
  write("paths", "0.5 0.25 4  0.5 0.25 0\n");
  expect_output("first --scene scene.txt paths --points",
                "instance,triangle,t,u,v,side,x,y,z\n0,2,0.5,0.25,0.25,front,0.5,0.25,2\n");
  // It does not touch the square on its way to the free point.
  expect_output("first --scene scene.txt paths --free-points",
                "instance,triangle,t,u,v,side,free_x,free_y,free_z\n0,2,0.5,0.25,0.25,front,0.5,0.25,2.0000002\n");
  write("away", "0.5 0.25 2  0.5 0.25 2.5\n0.5 0.25 3  0.5 0.25 2.75\n");
  expect_output("any --scene scene.txt away", "hit\n1\n1\n");
  write("direction", "0.5 0.25 4  0 0 -4\n");
  expect_output("first --scene scene.txt direction --path ray",
                "instance,triangle,t,u,v,side\n0,2,0.75,0.25,0.25,front\n");
}

TEST_F(SurehitQueryScene, tells_points_and_normals_of_the_scene) {
  write_squares();
  // Turned over by a mirror, and 2 times as large.
  write("scene.txt", "squares.obj 0 2 0 10  2 0 0 0  0 0 2 0\n");
  write("paths", "10.5 0.25 8  10.5 0.25 0\n");
  expect_output("first --scene scene.txt paths --points --normals",
                "instance,triangle,t,u,v,side,x,y,z,nx,ny,nz\n0,3,0.75,0.125,0.125,back,10.5,0.25,2,0,0,-1\n");
}

TEST_F(SurehitQueryScene, keeps_out_masked_and_ignored_instances) {
  write_squares();
  write("scene.txt", "squares.obj " + identity + " mask 1\nsquares.obj 1 0 0 0  0 1 0 0  0 0 1 2 mask 0x6\n");
  write("paths", "0.5 0.25 4  0.5 0.25 0\n");
  const std::string header = "instance,triangle,t,u,v,side\n";
  const std::string upper = header + "1,2,0.25,0.25,0.25,front\n";
  const std::string lower = header + "0,2,0.75,0.25,0.25,front\n";
  expect_output("first --scene scene.txt paths", upper);
  expect_output("first --scene scene.txt paths --mask 1", lower);
  expect_output("first --scene scene.txt paths --mask 4", upper);
  expect_output("any --scene scene.txt paths --mask 8", "hit\n0\n");
  expect_output("first --scene scene.txt paths --ignore-instance 1", lower);
  expect_output("first --scene scene.txt paths --ignore-instance 0", upper);
  expect_output("first --scene scene.txt paths --ignore-instance 1 --ignore-triangle 2",
                header + "1,0,0.5,0.25,0.25,front\n");
  expect_output("first --scene scene.txt paths --ignore-instance 1 --ignore-triangle 1", upper);
  expect_output("first --scene scene.txt paths --ids face", "instance,face,t,u,v,side\n1,1,0.25,0.25,0.25,front\n");
  expect_bad_input("first --scene scene.txt paths --ignore-instance 2",
                   "--ignore-instance: there is no instance 2 among 2, which count from 0");
  expect_bad_input("first --scene scene.txt paths --ignore-instance 0 --ignore-triangle 4",
                   "--ignore-triangle: there is no triangle 4 among 4, which count from 0");
}

TEST_F(SurehitQueryScene, tells_ties_by_the_exact_t) {
  // Placed triangles are met at t = 1/3 as floats have it, but the second one exactly is 2^-30 higher: met first.
  write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("scene.txt", "triangle.obj " + identity + "\ntriangle.obj 1 0 0 0  0 1 0 0  0 0 1 0x1p-30\ntriangle.obj " +
                         identity + " motion 0x1p-120 0 0\n");
  write("paths", "0.25 0.25 1  0.25 0.25 -2\n");
  expect_output("all --scene scene.txt paths",
                "path,instance,triangle,t,u,v,side,tie\n0,1,0,0.33333334,0.25,0.25,front,0\n"
                "0,0,0,0.33333334,0.25,0.25,front,1\n0,2,0,0.33333334,0.25,0.25,front,1\n");
}

TEST_F(SurehitQueryScene, rounds_to_the_scalar_asked_for) {
  write_squares();
  write("scene.txt", "squares.obj 1 0 0 0.1  0 1 0 0  0 0 1 0.1\n");
  write("paths", "0.6 0.25 3.1  0.6 0.25 -1\n");
  const Outcome in_double = run("first --scene scene.txt paths --scalar double");
  const Outcome in_float = run("first --scene scene.txt paths");
  EXPECT_TRUE(in_double.output.starts_with("instance,triangle,t,u,v,side\n0,2,0.48780487804878")) << in_double.output;
  EXPECT_TRUE(in_float.output.starts_with("instance,triangle,t,u,v,side\n0,2,0.4878048")) << in_float.output;
  EXPECT_NE(in_float.output, in_double.output);
  write("far.txt", "squares.obj 1 0 0 1e300  0 1 0 0  0 0 1 0\n");
  EXPECT_EQ(run("first --scene far.txt paths --scalar double").status, 0);
  expect_bad_input("first --scene far.txt paths", "far.txt: line 1: '1e300' is beyond the largest float");
}

TEST_F(SurehitQueryScene, finds_meshes_beside_the_scene) {
  write_squares();
  ASSERT_EQ(run("--help", "mkdir folder && mv squares.obj 'folder/two squares.obj'").status, 0);
  write("folder/scene.txt", "\"two squares.obj\" " + identity + "\r\n");
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n");
  expect_output("any --scene folder/scene.txt paths", "hit\n1\n");
  write("scene.txt", "\"folder/two squares.obj\" " + identity + "\r\n");
  expect_output("any --scene scene.txt paths", "hit\n1\n");
  expect_output("any --scene - paths <scene.txt", "hit\n1\n");
  expect_output("any --scene scene.txt - <paths", "hit\n1\n");
}

TEST_F(SurehitQueryScene, reads_each_mesh_once) {
  write("empty.obj", "v 0 0 0\n");
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n");
  std::string scene;
  for (int i = 0; i < 100; ++i) scene += (i % 2 == 0 ? "empty.obj " : "./empty.obj ") + identity + "\n";
  write("scene.txt", scene);
  const Outcome outcome = run("any --scene scene.txt paths");
  EXPECT_EQ(outcome.output, "hit\n0\n");
  EXPECT_EQ(outcome.error, "surehit-query: warning: empty.obj: the mesh has no triangles, so nothing is ever hit\n");
}

TEST_F(SurehitQueryScene, warns_of_an_empty_scene) {
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n");
  write("scene.txt", "# nothing\n");
  const Outcome outcome = run("first --scene scene.txt paths");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, "instance,triangle,t,u,v,side\n-1,-1,,,,\n");
  EXPECT_EQ(outcome.error, "surehit-query: warning: scene.txt: the scene has no instances, so nothing is ever hit\n");
}

TEST_F(SurehitQueryScene, says_what_its_queries_did) {
  write_scene();
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n9 9 9  8 8 8\n");
  const Outcome outcome = run("any --scene scene.txt paths --statistics");
  EXPECT_TRUE(
      outcome.error.starts_with("statistic,count,per_million_paths,per_million_candidates\npaths,2,1000000.000,"))
      << outcome.error;
}

TEST_F(SurehitQueryScene, writes_the_same_for_any_number_of_threads) {
  write_scene();
  std::string paths;
  for (int i = 0; i < 10000; ++i) {
    const std::string offset = "0." + std::to_string(i + 10000);
    paths += offset + " 0." + std::to_string(99999 - i) + " 3  " + offset + " 0.5 -1\n";
  }
  write("paths", paths);
  for (const std::string question : {"first", "any", "all"}) {
    const std::string arguments = question + " --scene scene.txt paths --threads ";
    const Outcome one = run(arguments + "1");
    EXPECT_EQ(one.status, 0) << one.error;
    EXPECT_GT(one.output.size(), 20000u);
    EXPECT_EQ(run(arguments + "3").output, one.output) << question;
  }
}

TEST_F(SurehitQueryScene, names_the_line_of_a_bad_scene) {
  write_squares();
  write("bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  const std::pair<std::string, std::string> lines[] = {
      {"missing.obj " + identity, "missing.obj: cannot be read: No such file or directory"},
      {"folder/missing.ply " + identity, "folder/missing.ply: cannot be read: No such file or directory"},
      {"squares.mesh " + identity, "squares.mesh: a mesh file's name ends in .obj, .ply, .stl or .off"},
      {"bad.obj " + identity, "bad.obj: line 3: vertex index 3 is out of range, there are 2 vertices"},
      {"squares.obj 1 0 0 0  0 1 0 0", "a pose has 12 numbers, not 8"},
      {"squares.obj " + identity + " motion 1 2", "motion needs 3 numbers"},
      {"squares.obj " + identity + " mask x", "'x' is no mask of 32 bits"},
  };
  for (const auto& [line, error] : lines) {
    write("scene.txt", "# a scene\r\nsquares.obj " + identity + "\r\n" + line + "\r\n");
    expect_bad_input("any --scene scene.txt /dev/null", "scene.txt: line 3: " + error);
  }
  expect_bad_input("any --scene - /dev/null <scene.txt", "standard input: line 3: 'x' is no mask of 32 bits");
  expect_bad_input("any --scene none /dev/null", "none: cannot be read: No such file or directory");
}

TEST_F(SurehitQueryScene, names_the_line_of_an_invalid_pose) {
  write_squares();
  for (const char* pose : {"1 2 3 0  2 4 6 0  0 0 1 0", "0 0 0 0 0 0 0 0 0 0 0 0", "1e30 0 0 0  0 1 0 0  0 0 1 0",
                           "1 0 0 0  0 1e-30 0 0  0 0 1 0"}) {
    write("scene.txt", "squares.obj " + identity + "\nsquares.obj " + pose + "\n");
    const Outcome outcome = run("first --scene scene.txt /dev/null");
    EXPECT_EQ(outcome.status, 2) << pose;
    EXPECT_EQ(outcome.output, "") << pose;
    EXPECT_TRUE(outcome.error.starts_with("surehit-query: scene.txt: line 2: ")) << outcome.error;
    EXPECT_EQ(outcome.error.find('\n'), outcome.error.size() - 1) << outcome.error;
  }
}

TEST_F(SurehitQueryScene, refuses_what_does_not_fit_a_scene) {
  write_scene();
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n");
  for (const char* arguments :
       {"first --scene", "first --scene scene.txt", "first --scene scene.txt squares.obj paths",
        "first squares.obj paths --scene scene.txt", "pair paths --scene scene.txt",
        "any --scene scene.txt paths --masks paths", "any --scene scene.txt paths --ignore-face 0",
        "any --scene scene.txt paths --ignore-triangle 0", "any squares.obj paths --ignore-instance 0",
        "any --scene - -", "first --scene scene.txt paths --free-points --path ray"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.output, "") << arguments;
    EXPECT_EQ(outcome.error.find('\n'), outcome.error.size() - 1) << outcome.error;
  }
}

TEST_F(SurehitQueryScene, helps_with_scenes) {
  for (const char* arguments : {"first --help", "any --help", "all --help"}) {
    const std::string help = run(arguments).output;
    EXPECT_NE(help.find("--scene SCENE"), std::string::npos) << arguments;
    EXPECT_NE(help.find("m00 m01 m02 m0"), std::string::npos) << arguments;
  }
  EXPECT_EQ(run("pair --help").output.find("--scene"), std::string::npos);
}

}  // namespace
}  // namespace surehit::test::surehit_query_scene_test
