#include "mesh_io/read_off.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "mutations.hpp"

namespace surehit::test {
namespace {

using example::Mesh;
using example::read_off;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string error_in(const std::string& text) {
  return error_of([&] { return read_off<float>(text); });
}

TEST(ReadOff, ReadsVerticesAndPolygons) {
  const Mesh<double> mesh = read_off<double>("OFF\n4 2 0\n0.1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 3 2 1\n");
  const std::vector<std::array<double, 3>> expected = {{0.1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
}

TEST(ReadOff, TakesCommentsAndBlankLinesAnywhere) {
  EXPECT_EQ(read_off<float>("# a\nOFF # b\n\n4 1 0 # c\n# d\n" + square + "\n4 0 1 2 3 # e\n# f\n").triangles.size(),
            2u);
}

TEST(ReadOff, TakesCountsOnTheFirstLineAndNoEdges) {
  for (const char* header : {"OFF 4 1 0\n", "OFF4 1 0\n", "OFF\n4 1\n"}) {
    EXPECT_EQ(read_off<float>(header + square + "4 0 1 2 3").triangles.size(), 2u) << header;
  }
}

TEST(ReadOff, PassesOverColorsAndNormals) {
  EXPECT_EQ(
      read_off<float>("COFF\n3 1 0\n0 0 0 255 0 0 1\n1 0 0 0 255 0 1\n0 1 0 0 0 255 1\n3 0 1 2\n").vertices.size(), 3u);
  EXPECT_EQ(read_off<float>("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n").vertices.size(), 3u);
  EXPECT_EQ(read_off<float>("OFF\n4 1 0\n" + square + "3 0 1 2 255 128 0").triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadOff, ReadsAMeshOfNothing) { EXPECT_TRUE(read_off<float>("OFF\n0 0 0\n").vertices.empty()); }

TEST(ReadOff, NamesTheLineOfAnError) {
  EXPECT_EQ(error_in("# nothing\n"), "line 1: the file is empty");
  EXPECT_EQ(error_in("ply\n"), "line 1: an OFF file begins with OFF, not with 'ply'");
  EXPECT_EQ(error_in("4OFF\n"), "line 1: '4OFF' is a kind of OFF file without 3 coordinates a vertex");
  EXPECT_EQ(error_in("OFF BINARY\n"), "line 1: binary OFF files are not supported");
  EXPECT_EQ(error_in("OFF\n"), "line 1: the file ends before the counts");
  EXPECT_EQ(error_in("OFF\n4\n"), "line 2: expected the counts of vertices, faces and edges");
  EXPECT_EQ(error_in("OFF\n-4 1 0\n"), "line 2: a count is negative: '-4'");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0\n"), "line 3: the file ends before vertex 1");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0\n"), "line 3: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0 1\n"), "line 3: a vertex has 3 coordinates, not 4");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 inf\n"), "line 3: 'inf' is not a number");
  EXPECT_EQ(error_in("OFF\n4 2 0\n" + square + "3 0 1 2"), "line 7: the file ends before face 1");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "4 0 1 2"), "line 7: a face of 4 corners has only 3 numbers");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "2 0 1"), "line 7: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 4"),
            "line 7: vertex index 4 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 -1"),
            "line 7: vertex index -1 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 2\n3 1 2 3"), "line 8: something follows the last face");
}

TEST(ReadOff, TakesNoMemoryOnTheWordOfAHeader) {
  EXPECT_EQ(error_in("OFF\n9223372036854775807 9223372036854775807 0\n0 0 0\n"),
            "line 3: the file ends before vertex 1");
  EXPECT_EQ(error_in("OFF\n0 9223372036854775807 0\n"), "line 2: the file ends before face 0");
}

TEST(ReadOff, MakesAnErrorOrAMeshOfAnyBytes) {
  expect_error_or_sound_mesh("OFF # square\n4 2 5\n" + square + "4 0 1 2 3\n3 0 1 2 0.5 0.5 0.5\n", read_off<float>);
}

}  // namespace
}  // namespace surehit::test
