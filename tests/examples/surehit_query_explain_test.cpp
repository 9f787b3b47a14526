#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesh_io/read_mesh.hpp"
#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_explain_test {
namespace {

class SurehitQueryExplain : public SurehitQueryRun {
 protected:
  /// Steps through 7 by 7 squares at z = 0, for which a grid is worth while.
  void write_floor() const {
    std::string text;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) text += "v " + std::to_string(x) + ' ' + std::to_string(y) + " 0\n";
    }
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 7; ++x) {
        const int i = 8 * y + x + 1;
        for (const int corner : {i, i + 1, i + 9, i + 8}) text += (corner == i ? "f " : " ") + std::to_string(corner);
        text += '\n';
      }
    }
    write("floor.obj", text);
  }

  void expect_lines(const std::string& arguments, const std::vector<std::string>& lines) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.status, 0);
    for (const std::string& line : lines) {
      EXPECT_NE(('\n' + outcome.output).find('\n' + line + '\n'), std::string::npos) << line << "\n\n"
                                                                                     << outcome.output;
    }
  }
};

TEST_F(SurehitQueryExplain, tells_the_way_of_a_path) {
  write_squares();
  write("path", "0.5 0.25 3  0.5 0.25 -1\n");
  expect_output("explain squares.obj path",
                "segment from 0.5 0.25 3 to 0.5 0.25 -1, in float\n"
                "\n"
                "walk: none: a small mesh is one list\n"
                "cell 0, t 0.5 to 0.75, x 0 to 1, y 0 to 1, z 0 to 1: asks 4 triangles\n"
                "  triangle 0: hit, by the filter\n"
                "    det 4 +- 1.57e-05, T 3 +- 1.57e-05\n"
                "    U 1 +- 0.000142, V 1 +- 0.000142, W 2 +- 0.000142\n"
                "  triangle 1: miss, by the filter\n"
                "    det 4 +- 1.57e-05, T 3 +- 1.57e-05\n"
                "    U 2 +- 0.000142, V -1 +- 0.000142, W 3 +- 0.000142\n"
                "  triangle 2: hit, by the filter\n"
                "    det 4 +- 1.57e-05, T 2 +- 1.57e-05\n"
                "    U 1 +- 0.000142, V 1 +- 0.000142, W 2 +- 0.000142\n"
                "  triangle 3: miss, by the filter\n"
                "    det 4 +- 1.57e-05, T 2 +- 1.57e-05\n"
                "    U 2 +- 0.000142, V -1 +- 0.000142, W 3 +- 0.000142\n"
                "\n"
                "order: 2 hits\n"
                "  triangle 2: first; t is from 0.5 to 0.5\n"
                "  triangle 0: later by the bounds of t; t is from 0.75 to 0.75\n"
                "\n"
                "rounding: by doubles, whose bounds leave one number for each\n"
                "\n"
                "answer: triangle 2, t = 0.5, u = 0.25, v = 0.25, front\n");
}

TEST_F(SurehitQueryExplain, tells_stages_and_ties_and_what_is_left_out) {
  write_squares();
  write("edge", "0.5 0.5 3  0.5 0.5 -1\n");
  expect_lines("explain squares.obj edge", {"  triangle 2: hit, by exact integers; the filter is undecided",
                                            "  triangle 3: at the same exact t, with a larger id; t is from 0.5 to 0.5",
                                            "answer: triangle 2, t = 0.5, u = 0, v = 0.5, front"});
  expect_lines("explain squares.obj edge --ignore-triangle 2 --cull front --max-t 0.7",
               {"t up to 0.7", "  triangle 2: left out, by its mask or id",
                "  triangle 3: hit, but left out by an option, by exact integers; the filter is undecided",
                "order: no hit", "answer: no hit"});
  expect_lines("explain squares.obj edge --scalar double --path ray",
               {"ray from 0.5 0.5 3 along 0.5 0.5 -1, in double", "answer: no hit"});
}

TEST_F(SurehitQueryExplain, tells_the_cells_that_the_path_walks_through) {
  write_floor();
  write("path", "0.4 0.3 1  6.4 6.1 -1\n");
  const Outcome outcome = run("explain floor.obj path");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("\nwalk: "), std::string::npos);
  EXPECT_NE(outcome.output.find(" steps\ncell 0, t "), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("\nanswer: triangle 48, t = 0.5, u = 0.2"), std::string::npos) << outcome.output;
  write("beside", "20 20 1  20 20 -1\n");
  expect_lines("explain floor.obj beside",
               {"walk: no cell: the path comes to no part of the grid that has triangles", "answer: no hit"});
}

TEST_F(SurehitQueryExplain, answers_as_first_does) {
  write_floor();
  std::string paths;
  for (int i = 0; i < 12; ++i) {
    paths +=
        std::to_string(0.61 * i) + " 0.5 " + std::to_string(i % 3) + " " + std::to_string(7 - 0.5 * i) + " 6.25 -1\n";
  }
  write("paths", paths);
  const Outcome first = run("first floor.obj paths");
  std::string expected;
  for (int i = 0; i < 12; ++i) {
    const std::string output = run("explain floor.obj paths --index " + std::to_string(i)).output;
    std::string answer = output.substr(output.rfind("answer: ") + 8);
    answer.pop_back();
    if (answer == "no hit") answer = "-1,,,,";
    for (const char* word : {"triangle ", " t = ", " u = ", " v = ", " "}) {
      if (const auto place = answer.find(word); place != std::string::npos)
        answer.erase(place, std::string(word).size());
    }
    expected += answer + '\n';
  }
  EXPECT_EQ(first.output, "triangle,t,u,v,side\n" + expected);
}

TEST_F(SurehitQueryExplain, draws_what_readers_of_meshes_read) {
  write_squares();
  write("edge", "0.5 0.5 3  0.5 0.5 -1\n");
  const std::string text = run("explain squares.obj edge").output;
  expect_output("explain squares.obj edge --draw way.ply --draw way.obj --draw way.png", text);
  for (const char* name : {"way.ply", "way.obj"}) {
    const auto mesh = example::read_mesh<float>(folder_.at(name));
    EXPECT_EQ(mesh.triangles.size(), 4u) << name;                    // The candidates.
    EXPECT_EQ(mesh.vertices.size(), 4u * 3 + 2 * (12 + 2)) << name;  // They, a box and both parts of the path.
  }
  // The first hit is red, and the path ends at it.
  EXPECT_NE(folder_.read("way.ply").find("\n0 0 1 229 56 59\n"), std::string::npos);
  EXPECT_NE(folder_.read("way.ply").find("\n0.5 0.5 1 255 209 102\n"), std::string::npos);
  EXPECT_NE(folder_.read("way.obj").find("\nl 25 26\n"), std::string::npos);
  EXPECT_TRUE(folder_.read("way.png").starts_with("\x89PNG\r\n"));
}

TEST_F(SurehitQueryExplain, draws_anything_that_is_finite) {
  write("large.obj", "v -1e38 0 0\nv 1e38 0 0\nv 0 3e38 0\nf 1 2 3\n");
  write("path", "0 1e38 3e38  0 1e38 -3e38\n");
  write("point", "0 0 0  0 0 0\n");
  write("none.obj", "v 0 0 0\n");
  for (const std::string arguments : {"large.obj path", "large.obj point", "large.obj point --path line",
                                      "large.obj path --scalar double", "none.obj path", "none.obj path --path ray"}) {
    const Outcome outcome = run("explain " + arguments + " --draw way.ply --draw way.png");
    EXPECT_EQ(outcome.status, 0) << arguments << '\n' << outcome.error;
    EXPECT_EQ(folder_.read("way.ply").find("nan"), std::string::npos);
    EXPECT_EQ(folder_.read("way.ply").find("inf"), std::string::npos);
  }
}

TEST_F(SurehitQueryExplain, says_what_is_wrong) {
  write_squares();
  write("paths", "0 0 1 0 0 -1\n0 0 1 0 0 -1\n");
  write("none", "# none\n");
  expect_bad_input("explain squares.obj paths", "paths: there are 2 paths instead of one; --index tells which");
  expect_bad_input("explain squares.obj none", "none: there are 0 paths instead of one; --index tells which");
  expect_bad_input("explain squares.obj paths --index 2", "--index: there is no path 2 among 2, which count from 0");
  expect_bad_input("explain squares.obj paths --index 0 --draw way.stl",
                   "--draw: way.stl ends in none of .ply, .obj and .png (see surehit-query --help)");
  expect_bad_input("explain squares.obj paths --index 0 --draw way.png --draw way.png",
                   "--draw and --draw are the same file, way.png");
  const std::size_t files = folder_.file_count();
  const Outcome outcome = run("explain squares.obj paths --index 0 --draw way.ply --draw nowhere/way.png -o way.txt");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("nowhere/way.png"), std::string::npos) << outcome.error;
  EXPECT_EQ(folder_.file_count(), files);
  EXPECT_EQ(run("explain squares.obj paths --index 0 --draw way.ply -o ./way.ply").error,
            "surehit-query: -o and --draw are the same file, way.ply\n");
  EXPECT_EQ(folder_.file_count(), files);
}

}  // namespace
}  // namespace surehit::test::surehit_query_explain_test
