#include "mesh_io/read_obj.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "mutations.hpp"

namespace surehit::test {
namespace {

using example::Mesh;
using example::read_obj;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string error_in(const std::string& text) {
  return error_of([&] { return read_obj<float>(text); });
}

TEST(ReadObj, ReadsVerticesAndTriangles) {
  const Mesh<float> mesh = read_obj<float>("v 0 -1 .5\nv 1e2 0x1.8p1 +4\r\nv 7 8 9\nf 3 1 2\n");
  const std::vector<std::array<float, 3>> expected = {{0, -1, 0.5f}, {100, 3, 4}, {7, 8, 9}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}}));
}

TEST(ReadObj, RoundsToTheNearestOfEitherScalar) {
  const std::string text = "v 0.1 1.00000005960464477539062500000000000000001 1e-60";
  const std::vector<std::array<float, 3>> floats = {{0.1f, 0x1.000002p0f, 0}};
  const std::vector<std::array<double, 3>> doubles = {{0.1, 0x1.000001p0, 1e-60}};
  EXPECT_EQ(read_obj<float>(text).vertices, floats);
  EXPECT_EQ(read_obj<double>(text).vertices, doubles);
}

TEST(ReadObj, SplitsPolygonsIntoFans) {
  EXPECT_EQ(read_obj<float>(square + "f 1 2 3 4").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read_obj<float>(square + "f 4 3 2 1 2").triangles, (Triangles{{3, 2, 1}, {3, 1, 0}, {3, 0, 1}}));
}

TEST(ReadObj, TakesEveryFormOfACorner) {
  const std::string attributes = "vt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -4/-1/-1 -3 -2"}) {
    EXPECT_EQ(read_obj<float>(square + attributes + face).triangles, (Triangles{{0, 1, 2}})) << face;
  }
}

TEST(ReadObj, CountsNegativeIndicesBackFromTheNewestVertex) {
  EXPECT_EQ(read_obj<float>(square + "f -4 -3 -2\nv 5 5 5\nf -1 1 -2").triangles, (Triangles{{0, 1, 2}, {4, 0, 3}}));
}

TEST(ReadObj, TakesFacesBeforeTheirVertices) {
  EXPECT_EQ(read_obj<float>("f 1 2 3\n" + square).triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadObj, TakesCommentsBlankLinesAndContinuedLines) {
  EXPECT_EQ(read_obj<float>("# a square\n\n" + square + "f 1 2 \\\n 3 4 # and its fan\n").triangles.size(), 2u);
  EXPECT_EQ(read_obj<float>(square + "f 1 2 3\\\n4").triangles.size(), 2u);
}

TEST(ReadObj, TakesWeightsAndColorsOfVertices) {
  EXPECT_EQ(read_obj<float>("v 1 2 3 1\nv 1 2 3 0.5 0.5 0.5").vertices.size(), 2u);
}

TEST(ReadObj, PassesOverWhatAddsNoSurface) {
  EXPECT_TRUE(read_obj<float>("mtllib a.mtl\no name\ng\ns off\nusemtl red\nl 1 2\np 1\n").triangles.empty());
  EXPECT_TRUE(read_obj<float>("").vertices.empty());
}

TEST(ReadObj, NamesTheLineOfAnError) {
  EXPECT_EQ(error_in("v 0 0"), "line 1: a vertex needs 3 coordinates, not 2");
  EXPECT_EQ(error_in("\n\nv 0 0 x\n"), "line 3: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 nan"), "line 1: 'nan' is not a number");
  EXPECT_EQ(error_in("v 0 0 1e39"), "line 1: '1e39' is beyond the largest float");
  EXPECT_EQ(error_in(square + "f 1 2"), "line 5: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in(square + "f 1 2 0"), "line 5: vertex indices count from 1, there is no vertex 0");
  EXPECT_EQ(error_in(square + "f 1 2 5\nf 1 2 3"), "line 5: vertex index 5 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in(square + "f 1 2 -5"), "line 5: vertex index -5 reaches back before the first of 4 vertices");
  EXPECT_EQ(error_in(square + "f 1 2 99999999999"), "line 5: a vertex index is beyond 32 bits");
  EXPECT_EQ(error_in(square + "f 1 2 99999999999999999999"), "line 5: '99999999999999999999' is beyond 64 bits");
  EXPECT_EQ(error_in(square + "f 1 2 three"), "line 5: 'three' is not a face corner");
  EXPECT_EQ(error_in(square + "f 1 2 /3"), "line 5: '' is not an integer");
  EXPECT_EQ(error_in(square + "f 1 2 \\"), "line 5: the file ends where a backslash promises another line");
  EXPECT_EQ(error_in("surf 0 1 0 1"), "line 1: unknown statement 'surf'");
}

TEST(ReadObj, MakesAnErrorOrAMeshOfAnyBytes) {
  expect_error_or_sound_mesh("# square\n" + square + "vt 0 0\nf 1 2 3 4\nf -4/1/2 -2//1 -1/1 \\\n 2\ng end\n",
                             read_obj<float>);
}

}  // namespace
}  // namespace surehit::test
