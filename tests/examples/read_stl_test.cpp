#include "mesh_io/read_stl.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mutations.hpp"

namespace surehit::test {
namespace {

using example::Mesh;
using example::read_stl;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Vertices = std::vector<std::array<float, 3>>;

const std::string facet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 0.1 0\n"
    "    endloop\n  endfacet\n";
const Vertices facet_corners = {{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};

std::string binary_stl(const std::string& title, const Vertices& corners) {
  std::string bytes = title;
  bytes.resize(80);
  append_little_endian(static_cast<std::uint32_t>(corners.size() / 3), bytes);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) bytes.append(12, '\0');
    for (const float coordinate : corners[i]) append_little_endian(coordinate, bytes);
    if (i % 3 == 2) bytes.append(2, '\0');
  }
  return bytes;
}

std::string error_in(const std::string& bytes) {
  return error_of([&] { return read_stl<float>(bytes); });
}

TEST(ReadStl, ReadsText) {
  const Mesh<float> mesh = read_stl<float>("solid a name of its own\n" + facet + facet + "endsolid\n");
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(Vertices(mesh.vertices.begin() + 3, mesh.vertices.end()), facet_corners);
}

TEST(ReadStl, ReadsTextToTheNearestDouble) {
  EXPECT_EQ(read_stl<double>("solid\n" + facet + "endsolid").vertices[2][1], 0.1);
}

TEST(ReadStl, TakesCapitalsSeveralSolidsAndMeaninglessNormals) {
  const std::string capitals =
      "SOLID\nFACET NORMAL nan nan nan\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 "
      "0\nENDLOOP\nENDFACET\nENDSOLID\n";
  EXPECT_EQ(read_stl<float>(capitals + "\nsolid b\n" + facet + "endsolid b\n").triangles.size(), 2u);
}

TEST(ReadStl, ReadsBytes) {
  const Mesh<double> mesh = read_stl<double>(binary_stl("made by hand", facet_corners));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(mesh.vertices[2][1], double{0.1f});
}

TEST(ReadStl, TellsBytesFromTextThatTheyPretendToBe) {
  EXPECT_EQ(read_stl<float>(binary_stl("solid lies", facet_corners)).vertices, facet_corners);
  EXPECT_EQ(error_in(binary_stl("solid lies", facet_corners) + "and more"),
            "a binary STL file of 1 triangles is not 142 bytes long");
}

TEST(ReadStl, ReadsAMeshOfNothing) {
  EXPECT_TRUE(read_stl<float>("solid\nendsolid\n").vertices.empty());
  EXPECT_TRUE(read_stl<float>(binary_stl("", {})).vertices.empty());
}

TEST(ReadStl, NamesTheLineOfAnErrorInText) {
  EXPECT_EQ(error_in("hello"), "line 1: expected solid, not 'hello'");
  EXPECT_EQ(error_in("\n\n"), "line 2: the file is empty");
  EXPECT_EQ(error_in("solid\n" + facet), "line 8: the file ends within a solid");
  EXPECT_EQ(error_in("solid\nvertex 1 2 3\n"), "line 2: expected facet, not 'vertex'");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 2\n"), "line 4: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 2 -inf\n"), "line 4: '-inf' is not a number");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"), "line 5: expected vertex, not 'endloop'");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\n"),
            "line 7: expected endloop, not 'vertex'");
}

TEST(ReadStl, NamesTheTriangleOfAnErrorInBytes) {
  Vertices corners = facet_corners;
  corners.insert(corners.end(), {{0, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}, {0, 0, 0}});
  EXPECT_EQ(error_in(binary_stl("", corners)), "triangle 1: a coordinate is not finite");
}

TEST(ReadStl, TakesNoMemoryOnTheWordOfAHeader) {
  std::string bytes = binary_stl("", facet_corners);
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(error_in(bytes), "a binary STL file of 4294967295 triangles is not 134 bytes long");
}

TEST(ReadStl, MakesAnErrorOrAMeshOfAnyText) {
  expect_error_or_sound_mesh("solid a\n" + facet + facet + "endsolid a\n", read_stl<float>);
}

TEST(ReadStl, MakesAnErrorOrAMeshOfAnyBytes) {
  expect_error_or_sound_mesh(binary_stl("title", facet_corners), read_stl<double>);
}

}  // namespace
}  // namespace surehit::test
