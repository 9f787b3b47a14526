#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/random.hpp"
#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_test {
namespace {

namespace fs = std::filesystem;

class SurehitQuery : public SurehitQueryRun {
 protected:
  static std::string random_paths(std::size_t count) {
    Random random(5);
    std::string text;
    for (std::size_t i = 0; i < 6 * count; ++i) {
      text += std::to_string(random.between(-8, 24)) + (random.one_in(2) ? "e-1" : "p-4");
      if (text.ends_with("p-4")) {
        const std::size_t begin = text.find_last_of(" \n") + 1;
        text.insert(begin + (text[begin] == '-' ? 1 : 0), "0x");
      }
      text += i % 6 == 5 ? '\n' : ' ';
    }
    return text;
  }

  struct Statistic {
    std::string name;
    std::uint64_t count;
    std::string per_million_paths;
    std::string per_million_candidates;
  };

  /// The lines below the header.
  static std::vector<Statistic> statistics_of(const std::string& csv) {
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "statistic,count,per_million_paths,per_million_candidates");
    std::vector<Statistic> statistics;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      Statistic statistic;
      std::string count;
      std::getline(cells, statistic.name, ',');
      std::getline(cells, count, ',');
      std::getline(cells, statistic.per_million_paths, ',');
      std::getline(cells, statistic.per_million_candidates);
      statistic.count = std::stoull(count);
      statistics.push_back(statistic);
    }
    return statistics;
  }

  /// With three digits behind the point.
  static std::string thousandths(double number) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << number;
    return text.str();
  }
};

TEST_F(SurehitQuery, answers_pairs) {
  write("pairs", downwards + triangle + "\n5 5 1  5 5 -1  " + triangle + "\n0 0 -1  0 0 3  " + triangle +
                     "\n0 -1 0  0 0.5 0  " + triangle + "\n");
  expect_output("pair pairs", "hit,t,u,v,side\n1,0.5,0.25,0.5,front\n0,,,,\n1,0.25,0.25,0.5,back\n1,0,0.5,0,edge_on\n");
}

TEST_F(SurehitQuery, skips_comments_and_blank_lines) {
  write("pairs", "# p q a b c\n\n  # more\r\n" + downwards + triangle + "\r\n \n");
  expect_output("pair pairs", "hit,t,u,v,side\n1,0.5,0.25,0.5,front\n");
}

TEST_F(SurehitQuery, answers_nothing_with_a_header) {
  write_squares();
  expect_output("pair /dev/null", "hit,t,u,v,side\n");
  expect_output("first squares.obj /dev/null", "triangle,t,u,v,side\n");
  expect_output("any squares.obj /dev/null", "hit\n");
  expect_output("all squares.obj /dev/null", "path,triangle,t,u,v,side,tie\n");
}

TEST_F(SurehitQuery, takes_white_space_and_commas_between_numbers) {
  const std::string expected = "hit,t,u,v,side\n1,0.5,0.25,0.5,front\n";
  for (const char* numbers : {"0,0,1,0,0,-1,-1,-1,0,1,-1,0,0,1,0", "0\\t0 1 , 0,0 ,-1, -1 -1 0 1 -1 0 0 1 0",
                              " +0x0p0 -0 0x1p+0 0 0 -0X.8P1 -1 -1 0 1e0 -1.0 0 0 10e-1 .0 "}) {
    expect_output("pair - <<END\n$(printf '" + std::string(numbers) + "')\nEND\n", expected);
  }
}

TEST_F(SurehitQuery, takes_segments_rays_and_lines) {
  const std::string header = "hit,t,u,v,side\n";
  write("short", "0 0 3  0 0 2  " + triangle + "\n");
  expect_output("pair short --path segment", header + "0,,,,\n");
  write("direction", "0 0 3  0 0 -2  " + triangle + "\n0 0 -3  0 0 -2  " + triangle + "\n");
  expect_output("pair direction --path ray", header + "1,1.5,0.25,0.5,front\n0,,,,\n");
  expect_output("pair direction --path line", header + "1,1.5,0.25,0.5,front\n1,-1.5,0.25,0.5,front\n");
}

TEST_F(SurehitQuery, culls_sides) {
  write("pairs", downwards + triangle + "\n0 0 -1  0 0 1  " + triangle + "\n0 -1 0  0 1 0  " + triangle + "\n");
  const std::string front = "1,0.5,0.25,0.5,front\n";
  const std::string back = "1,0.5,0.25,0.5,back\n";
  const std::string miss = "0,,,,\n";
  expect_output("pair pairs --cull none", "hit,t,u,v,side\n" + front + back + "1,0,0.5,0,edge_on\n");
  expect_output("pair pairs --cull back", "hit,t,u,v,side\n" + front + miss + miss);
  expect_output("pair pairs --cull front", "hit,t,u,v,side\n" + miss + back + miss);
}

TEST_F(SurehitQuery, rounds_to_the_scalar_asked_for_and_back_to_the_same_bits) {
  write("third", "0 0 1  0 0 -2  " + triangle + "\n");
  expect_output("pair third", "hit,t,u,v,side\n1,0.33333334,0.25,0.5,front\n");
  expect_output("pair third --scalar float", "hit,t,u,v,side\n1,0.33333334,0.25,0.5,front\n");
  expect_output("pair third --scalar double", "hit,t,u,v,side\n1,0.3333333333333333,0.25,0.5,front\n");
}

TEST_F(SurehitQuery, prints_a_parameter_beyond_all_numbers_as_infinite) {
  write("slow", "0 0 0  0 0 1e-45  -1 -1 1e38  1 -1 1e38  0 1 1e38\n");
  expect_output("pair slow --path ray", "hit,t,u,v,side\n1,inf,0.25,0.5,back\n");
}

TEST_F(SurehitQuery, answers_where_a_path_first_meets_a_mesh) {
  write_squares();
  write("paths", "0.5 0.25 -1  0.5 0.25 3\n0.5 0.25 3  0.5 0.25 -1\n9 9 9  8 8 8\n0 0.5 0.5  1 0.5 0.5\n");
  expect_output("first squares.obj paths",
                "triangle,t,u,v,side\n0,0.25,0.25,0.25,back\n2,0.5,0.25,0.25,front\n-1,,,,\n-1,,,,\n");
}

TEST_F(SurehitQuery, answers_whether_a_path_meets_a_mesh) {
  write_squares();
  write("paths", "0.5 0.25 -1  0.5 0.25 3\n9 9 9  8 8 8\n0.5 0.5 1  0.5 0.5 2\n");
  expect_output("any squares.obj paths", "hit\n1\n0\n1\n");
}

TEST_F(SurehitQuery, answers_where_a_path_meets_a_mesh_at_all) {
  write_squares();
  write("paths", "9 9 9  8 8 8\n0.5 0.25 3  0.5 0.25 -1\n0.5 0.5 -1  0.5 0.5 0.5\n");
  expect_output("all squares.obj paths",
                "path,triangle,t,u,v,side,tie\n1,2,0.5,0.25,0.25,front,0\n1,0,0.75,0.25,0.25,front,0\n"
                "2,0,0.6666667,0,0.5,back,1\n2,1,0.6666667,0.5,0,back,1\n");
}

TEST_F(SurehitQuery, warns_of_a_mesh_once) {
  write("empty.obj", "v 0 0 0\n");
  write("unused.obj", "v nan 0 0\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 inf 1\nf 2 3 4\n");
  write("survey.obj",
        "v 5283911.5 634250.25 412.75\nv 5283911.7 634250.25 412.75\nv 5283911.5 634250.45 412.75\nf 1 2 3\n");
  write("paths", "0 0 1  0 0 -1\n1 1 1  1 1 -1\n");
  const std::pair<std::string, std::string> warnings[] = {
      {"empty.obj", "the mesh has no triangles, so nothing is ever hit"},
      {"unused.obj", "2 vertices are not finite, the first of them vertex 0 of line 1; no face uses them"},
      {"survey.obj",
       "float cannot hold its coordinates, double can: x of vertex 1 is 5283911.7 and becomes 5283911.5 in a mesh that "
       "measures 0.2; 1 of 1 triangles change by more than a hundredth of their longest side"}};
  for (const auto& [mesh, warning] : warnings) {
    const Outcome outcome = run("any " + mesh + " paths");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.error, "surehit-query: warning: " + mesh + ": " + warning + "\n");
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 3);
  }
  EXPECT_EQ(run("any survey.obj paths --scalar double").error, "");
  expect_output("any survey.obj - --scalar double <<END\n5283911.55 634250.3 413 5283911.55 634250.3 412\nEND\n",
                "hit\n1\n");
}

TEST_F(SurehitQuery, says_what_its_queries_did) {
  write_squares();
  // Three through both squares, one beside them, and four in the plane of one. These meet a corner alone, which only
  // exact arithmetic decides.
  std::string paths = "9 9 9  8 8 8\n";
  for (int i = 0; i < 3; ++i) paths += "0.5 0.25 -1  0.5 0.25 3\n";
  for (int i = 0; i < 4; ++i) paths += "0.5 -0.5 1  1.5 0.5 1\n";
  write("paths", paths);
  for (const std::string question : {"first", "any", "all"}) {
    const Outcome silent = run(question + " squares.obj paths");
    const Outcome outcome = run(question + " squares.obj paths --statistics");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, silent.output);
    EXPECT_EQ(silent.error, "");
    const std::vector<Statistic> statistics = statistics_of(outcome.error);
    std::vector<std::string> names;
    for (const Statistic& statistic : statistics) names.push_back(statistic.name);
    ASSERT_EQ(names, (std::vector<std::string>{"paths", "cells", "candidates", "undecided", "exact_decisions",
                                               "exact_orders", "exact_roundings", "unclipped"}));
    EXPECT_EQ(statistics[0].count, 8u);
    EXPECT_GE(statistics[1].count, 7u);
    EXPECT_GE(statistics[2].count, 7u);
    EXPECT_GE(statistics[3].count, 4u);
    EXPECT_GE(statistics[4].count, 4u);
    EXPECT_LT(statistics[4].count, statistics[2].count);
    EXPECT_EQ(statistics[7].count, 0u);
    for (const Statistic& statistic : statistics) {
      EXPECT_EQ(statistic.per_million_paths, thousandths(1e6 * static_cast<double>(statistic.count) / 8));
      EXPECT_EQ(statistic.per_million_candidates,
                thousandths(1e6 * static_cast<double>(statistic.count) / static_cast<double>(statistics[2].count)));
    }
  }
}

TEST_F(SurehitQuery, says_the_same_of_its_queries_for_any_number_of_threads) {
  write_squares();
  write("paths", random_paths(20000));
  const std::string arguments = "first squares.obj paths --path line --statistics -o answers.csv --threads ";
  const Outcome one = run(arguments + "1");
  EXPECT_EQ(statistics_of(one.error).front().count, 20000u);
  EXPECT_EQ(run(arguments + "3").error, one.error);
}

TEST_F(SurehitQuery, says_that_queries_of_no_paths_did_nothing) {
  write_squares();
  EXPECT_EQ(run("any squares.obj /dev/null --statistics").error,
            "statistic,count,per_million_paths,per_million_candidates\npaths,0,,\ncells,0,,\ncandidates,0,,\n"
            "undecided,0,,\nexact_decisions,0,,\nexact_orders,0,,\nexact_roundings,0,,\nunclipped,0,,\n");
}

TEST_F(SurehitQuery, reads_standard_input) {
  write_squares();
  expect_output("any squares.obj - <<END\n0 0 -1 0 0 1\nEND\n", "hit\n1\n");
}

TEST_F(SurehitQuery, writes_the_same_for_any_number_of_threads) {
  write_squares();
  write("paths", random_paths(20000));
  for (const std::string question : {"first", "any", "all"}) {
    const std::string arguments = question + " squares.obj paths --path line --threads ";
    const Outcome one = run(arguments + "1");
    ASSERT_EQ(one.status, 0) << one.error;
    EXPECT_GT(std::count(one.output.begin(), one.output.end(), '\n'), 1000);
    for (const char* threads : {"2", "3", "16"}) EXPECT_EQ(run(arguments + threads).output, one.output) << question;
  }
}

TEST_F(SurehitQuery, writes_what_standard_output_gets_to_a_file) {
  write_squares();
  write("paths", random_paths(100));
  const Outcome outcome = run("first squares.obj paths");
  expect_output("first squares.obj paths -o answers.csv", "");
  EXPECT_EQ(folder_.read("answers.csv"), outcome.output);
  EXPECT_EQ(folder_.file_count(), 3u);
}

TEST_F(SurehitQuery, replaces_an_old_output_file_only_when_done) {
  write("pairs", downwards + triangle + "\n");
  write("bad", downwards + triangle + "\n1 2\n");
  write("answers.csv", "old");
  EXPECT_EQ(run("pair bad -o answers.csv").status, 2);
  EXPECT_EQ(folder_.read("answers.csv"), "old");
  expect_output("pair pairs -o answers.csv", "");
  EXPECT_EQ(folder_.read("answers.csv"), "hit,t,u,v,side\n1,0.5,0.25,0.5,front\n");
  EXPECT_EQ(folder_.file_count(), 3u);
}

TEST_F(SurehitQuery, writes_through_a_symbolic_link) {
  write("pairs", downwards + triangle + "\n");
  write("target.csv", "old");
  fs::create_symlink("target.csv", folder_.at("link.csv"));
  expect_output("pair pairs -o link.csv", "");
  EXPECT_TRUE(fs::is_symlink(folder_.at("link.csv")));
  EXPECT_EQ(folder_.read("target.csv"), "hit,t,u,v,side\n1,0.5,0.25,0.5,front\n");

  fs::create_symlink("target_to_come.csv", folder_.at("early_link.csv"));
  expect_output("pair pairs -o early_link.csv", "");
  EXPECT_TRUE(fs::is_symlink(folder_.at("early_link.csv")));
  EXPECT_EQ(folder_.read("target_to_come.csv"), folder_.read("target.csv"));
}

TEST_F(SurehitQuery, names_the_line_of_bad_paths) {
  write_squares();
  const std::string good = "0 0 0 1 1 1\n";
  const std::pair<std::string, std::string> lines[] = {
      {"1 2 3 4 5\n", "expected 6 numbers, not 5"},
      {"1 2 3 4 5 6 7\n", "expected 6 numbers, not 7"},
      {"1 2 3 4 5 six\n", "'six' is not a number"},
      {"1 2 3 4 5 nan\n", "'nan' is not a number"},
      {"1 2 3 4 5 -inf\n", "'-inf' is not a number"},
      {"1 2 3 4 5 1e39\n", "'1e39' is beyond the largest float"},
      {"1 2 3 4 5 6 # no\n", "expected 6 numbers, not 8"},
      {"1,2,3,4,5,,6\n", "a number is missing beside a comma"},
      {"1,2,3,4,5,6,\n", "a number is missing beside a comma"},
      {",1 2 3 4 5 6\n", "a number is missing beside a comma"},
  };
  for (const auto& [line, error] : lines) {
    write("paths", "# paths\n" + good + line + good);
    for (const std::string question : {"first", "any", "all"}) {
      expect_bad_input(question + " squares.obj paths", "paths: line 3: " + error);
    }
  }
  write("pairs", downwards + triangle + "\n" + downwards + "\n");
  expect_bad_input("pair pairs", "pairs: line 2: expected 15 numbers, not 6");
  expect_bad_input("pair - <pairs", "standard input: line 2: expected 15 numbers, not 6");
  expect_bad_input("pair missing", "missing: cannot be read: No such file or directory");
}

TEST_F(SurehitQuery, names_the_line_of_a_bad_mesh) {
  write("bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  expect_bad_input("first bad.obj /dev/null", "bad.obj: line 3: vertex index 3 is out of range, there are 2 vertices");
  expect_bad_input("any missing.ply /dev/null", "missing.ply: cannot be read: No such file or directory");
  write("crossed.obj", "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\nf 1 3 2\nf 1 2 3 4\n");
  expect_bad_input("all crossed.obj /dev/null",
                   "crossed.obj: line 6: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
  expect_bad_input("all bad.mesh /dev/null", "bad.mesh: a mesh file's name ends in .obj, .ply, .stl or .off");
}

TEST_F(SurehitQuery, refuses_wrong_usage_in_one_line) {
  write("pairs", downwards + triangle + "\n");
  for (const char* arguments : {"",
                                "pair",
                                "first",
                                "first squares.obj",
                                "guess pairs",
                                "pair pairs pairs",
                                "pair pairs --scalar half",
                                "pair pairs --path curve",
                                "pair pairs --cull both",
                                "pair pairs --threads 0",
                                "pair pairs --threads -1",
                                "pair pairs --threads many",
                                "pair pairs --statistics",
                                "pair pairs --ids face",
                                "pair pairs --masks pairs",
                                "pair pairs --mask 1",
                                "pair pairs --ignore-triangle 0",
                                "pair pairs --free-points",
                                "any squares.obj pairs --points",
                                "first squares.obj pairs --mask -1",
                                "first squares.obj pairs --mask 4294967296",
                                "first squares.obj pairs --ignore-triangle -1",
                                "first squares.obj pairs --ids vertex",
                                "first squares.obj pairs --free-points --path ray",
                                "all squares.obj pairs --free-points",
                                "first squares.obj - --masks -",
                                "pair pairs --wrong",
                                "pair pairs -o"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.output, "") << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  }
}

TEST_F(SurehitQuery, helps_with_every_command) {
  for (const char* arguments : {"--help", "pair --help", "first --help", "any --help", "all --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_NE(outcome.output.find("Usage: surehit-query"), std::string::npos) << arguments;
    EXPECT_EQ(outcome.error, "") << arguments;
  }
  for (const char* arguments : {"first --help", "any --help", "all --help"}) {
    const std::string help = run(arguments).output;
    EXPECT_NE(help.find("which are edge_on"), std::string::npos) << "what culling does with them";
    EXPECT_NE(help.find("outline crosses itself is refused"), std::string::npos) << "how polygons are cut";
    EXPECT_NE(help.find("OBJ, PLY, STL or OFF"), std::string::npos) << "what is read";
  }
}

TEST_F(SurehitQuery, says_that_its_output_cannot_be_written) {
  write("pairs", downwards + triangle + "\n");
  if (fs::exists("/dev/full")) {
    for (const char* arguments : {"pair pairs -o /dev/full", "pair pairs >/dev/full"}) {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.status, 1) << arguments;
      EXPECT_NE(outcome.error.find("cannot be written: No space left on device"), std::string::npos) << outcome.error;
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
  const Outcome outcome = run("pair pairs -o missing/answers.csv");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("missing/answers.csv: cannot be written: No such file or directory"), std::string::npos)
      << outcome.error;
}

TEST_F(SurehitQuery, leaves_no_part_of_a_file_when_the_disk_is_full) {
  write_squares();
  write("paths", random_paths(20000));
  const std::size_t files = folder_.file_count();
  // A limit on the size of files stands in for a full disk.
  const Outcome outcome = run("first squares.obj paths -o answers.csv", "trap '' XFSZ && ulimit -f 8");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("answers.csv: cannot be written: File too large"), std::string::npos) << outcome.error;
  EXPECT_EQ(folder_.file_count(), files);
}

}  // namespace
}  // namespace surehit::test::surehit_query_test
