#include <gtest/gtest.h>

#include <string>

#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_shapes_test {
namespace {

/// Paths that are moving shapes.
class SurehitQueryShapes : public SurehitQueryRun {
 protected:
  static inline const std::string columns = "t,u,v,feature,started_touching\n";
};

TEST_F(SurehitQueryShapes, answers_pairs) {
  write("spheres", "0 0 3  0 0 -1  1  " + triangle + "\n0 1.5 3  0 1.5 -1  0.5  " + triangle + "\n0 0 0.5  0 0 3  1  " +
                       triangle + "\n0 0 3  0 0 1.5  1  " + triangle + "\n");
  expect_output("pair spheres --path sphere",
                "hit," + columns + "1,0.5,0.25,0.5,face,0\n1,0.75,0,1,corner_c,0\n1,0,0.25,0.5,face,1\n0,,,,,\n");
  write("boxes", "0 0 3  0 0 -1  0.5 0.5 1  " + triangle + "\n9 0 3  9 0 -1  0.5 0.5 1  " + triangle + "\n");
  expect_output("pair boxes --path box", "hit," + columns + "1,0.5,0.25,0.5,face,0\n0,,,,,\n");
  write("capsules", "0 0 3  0 0 -1  0 0 0.5  0.5  " + triangle + "\n9 0 3  9 0 -1  0 0 0.5  0.5  " + triangle + "\n");
  expect_output("pair capsules --path capsule", "hit," + columns + "1,0.5,0.25,0.5,face,0\n0,,,,,\n");
}

TEST_F(SurehitQueryShapes, answers_about_meshes) {
  write_squares();
  write("spheres", "0.75 0.25 -1  0.75 0.25 3  0.25\n9 9 9  8 8 8  1\n");
  write("boxes", "0.75 0.25 -1  0.75 0.25 3  0.125 0.125 0.25\n9 9 9  8 8 8  1 1 1\n");
  write("capsules", "0.75 0.25 -1  0.75 0.25 3  0 0 0.125  0.125\n9 9 9  8 8 8  1 0 0  1\n");
  for (const std::string shape : {"sphere", "box", "capsule"}) {
    const std::string arguments = " squares.obj " + shape + (shape == "box" ? "es" : "s") + " --path " + shape;
    expect_output("first" + arguments, "triangle," + columns + "0,0.1875,0.5,0.25,face,0\n-1,,,,,\n");
    expect_output("any" + arguments, "hit\n1\n0\n");
    expect_output("all" + arguments,
                  "path,triangle," + columns + "0,0,0.1875,0.5,0.25,face,0\n0,2,0.4375,0.5,0.25,face,0\n");
    expect_output("all" + arguments + " --ids face --scalar double --threads 2",
                  "path,face," + columns + "0,0,0.1875,0.5,0.25,face,0\n0,1,0.4375,0.5,0.25,face,0\n");
  }
}

TEST_F(SurehitQueryShapes, answers_about_scenes) {
  write_squares();
  // The second instance lies 2 above the first, and is twice as large. The balls stay as they are.
  write("scene.txt", "squares.obj 1 0 0 0  0 1 0 0  0 0 1 0\nsquares.obj 2 0 0 0  0 2 0 0  0 0 2 3 mask 2\n");
  write("spheres", "0.75 0.25 -1  0.75 0.25 7  0.25\n0.75 0.25 7  0.75 0.25 -1  0.25\n9 9 9  8 8 8  1\n");
  write("boxes",
        "0.75 0.25 -1  0.75 0.25 7  0.125 0.125 0.25\n0.75 0.25 7  0.75 0.25 -1  0.125 0.125 0.25\n"
        "9 9 9  8 8 8  1 1 1\n");
  write("capsules",
        "0.75 0.25 -1  0.75 0.25 7  0 0 0.125  0.125\n0.75 0.25 7  0.75 0.25 -1  0 0 0.125  0.125\n"
        "9 9 9  8 8 8  1 0 0  1\n");
  for (const std::string shape : {"sphere", "box", "capsule"}) {
    const std::string arguments = " --scene scene.txt " + shape + (shape == "box" ? "es" : "s") + " --path " + shape;
    expect_output("first" + arguments, "instance,triangle," + columns +
                                           "0,0,0.09375,0.5,0.25,face,0\n1,2,0.21875,0.25,0.125,face,0\n-1,-1,,,,,\n");
    expect_output("any" + arguments, "hit\n1\n1\n0\n");
    expect_output("any" + arguments + " --mask 4 --threads 2", "hit\n1\n1\n0\n");
    expect_output("all" + arguments + " --ids face --scalar double --ignore-instance 0 --ignore-triangle 0",
                  "path,instance,face," + columns +
                      "0,0,1,0.21875,0.5,0.25,face,0\n0,1,0,0.46875,0.25,0.125,face,0\n"
                      "0,1,1,0.71875,0.25,0.125,face,0\n1,1,1,0.21875,0.25,0.125,face,0\n"
                      "1,1,0,0.46875,0.25,0.125,face,0\n1,0,1,0.71875,0.5,0.25,face,0\n");
  }
  const std::string first = "first --scene scene.txt spheres --path sphere ";
  const std::string header = "instance,triangle," + columns;
  expect_output(first + "--ignore-instance 1 --max-t 0.5",
                header + "0,0,0.09375,0.5,0.25,face,0\n-1,-1,,,,,\n-1,-1,,,,,\n");
  expect_output(first + "--mask 4", header + "0,0,0.09375,0.5,0.25,face,0\n0,2,0.71875,0.5,0.25,face,0\n-1,-1,,,,,\n");
  write("scene.txt", "squares.obj 1 0 0 0  0 1 0 0  0 0 1 0 motion 0 0 -2\n");
  write("resting", "0.75 0.25 -1  0.75 0.25 -1  0.25\n");
  expect_output("first --scene scene.txt resting --path sphere", header + "0,0,0.375,0.5,0.25,face,0\n");
  expect_bad_input("first --scene scene.txt spheres --path box", "spheres: line 1: expected 9 numbers, not 7");
}

TEST_F(SurehitQueryShapes, narrows_queries) {
  write_squares();
  write("spheres", "0.75 0.25 -1  0.75 0.25 3  0.25\n");
  const std::string first = "first squares.obj spheres --path sphere ";
  const std::string header = "triangle," + columns;
  const std::string upper = header + "2,0.4375,0.5,0.25,face,0\n";
  const std::string miss = header + "-1,,,,,\n";
  expect_output(first + "--max-t 0.1875", header + "0,0.1875,0.5,0.25,face,0\n");
  expect_output(first + "--max-t 0.1874", miss);
  expect_output(first + "--ignore-triangle 0", upper);
  expect_output(first + "--ignore-face 0", upper);
  expect_output(first + "--cull back", miss);
  write("masks", "1\n2\n");
  expect_output(first + "--masks masks --mask 2", upper);
  write("resting", "0.75 0.25 0.25  0.75 0.25 3  0.25\n");
  expect_output("first squares.obj resting --path sphere", header + "0,0,0.5,0.25,face,1\n");
  expect_output("any squares.obj resting --path sphere --ignore-start-contact --max-t 0.1", "hit\n0\n");
  const Outcome counted = run(first + "--statistics");
  EXPECT_TRUE(counted.error.starts_with("statistic,count,")) << counted.error;
}

TEST_F(SurehitQueryShapes, names_the_line_of_bad_shapes) {
  write_squares();
  const auto expect_bad = [&](const std::string& shape, const std::string& line, const std::string& error) {
    write("shapes", "# shapes\n\n" + line + "\n");
    for (const std::string question : {"first", "any", "all"}) {
      expect_bad_input(question + " squares.obj shapes --path " + shape, "shapes: line 3: " + error);
    }
  };
  expect_bad("sphere", "1 2 3 4 5 6", "expected 7 numbers, not 6");
  expect_bad("box", "1 2 3 4 5 6 7", "expected 9 numbers, not 7");
  expect_bad("capsule", "1 2 3 4 5 6 7 8 9", "expected 10 numbers, not 9");
  expect_bad("sphere", "1 2 3 4 5 6 -0.5", "number 7 is a length below 0: -0.5");
  expect_bad("box", "1 2 3 4 5 6 1 -2 1", "number 8 is a length below 0: -2");
  expect_bad("capsule", "1 2 3 4 5 6 -1 -1 -1 -2", "number 10 is a length below 0: -2");
  expect_bad("sphere", "1 2 3 4 5 6 inf", "'inf' is not a number");
  write("pairs", "0 0 3  0 0 -1  " + triangle + "\n");
  expect_bad_input("pair pairs --path sphere", "pairs: line 1: expected 16 numbers, not 15");
}

TEST_F(SurehitQueryShapes, refuses_what_only_straight_paths_have) {
  write_squares();
  write("spheres", "0 0 0 1 1 1 1\n");
  const auto expect_refused = [&](const std::string& arguments, const std::string& option) {
    expect_bad_input(arguments + " --path sphere", option + ": only straight paths have it (see surehit-query --help)");
  };
  expect_refused("first squares.obj spheres --min-t 0", "--min-t");
  expect_refused("first squares.obj spheres --ignore-end-contact", "--ignore-end-contact");
  expect_refused("first squares.obj spheres --points", "--points");
  expect_refused("first squares.obj spheres --normals", "--normals");
  expect_bad_input("first squares.obj spheres --free-points --path box",
                   "--free-points: only a segment has them (see surehit-query --help)");
  EXPECT_EQ(run("explain squares.obj spheres --path sphere").status, 2);
}

}  // namespace
}  // namespace surehit::test::surehit_query_shapes_test
