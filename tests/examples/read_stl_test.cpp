#include "mesh_io/read_stl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mutations.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_stl_test {
namespace {

using example::Mesh;
using example::read_stl;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Vertices = std::vector<std::array<float, 3>>;
using Warnings = std::vector<std::string>;

const std::string facet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 0.1 0\n"
    "    endloop\n  endfacet\n";
const Vertices facet_corners = {{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};

/// A triangle of a binary file: its attribute, what follows it, and its corners.
struct BinaryTriangle {
  std::uint16_t attribute = 0;
  std::string payload = {};
  Vertices corners = facet_corners;
};

std::string binary_stl(const std::string& title, const std::vector<BinaryTriangle>& triangles) {
  std::string bytes = title;
  bytes.resize(80);
  append_little_endian(static_cast<std::uint32_t>(triangles.size()), bytes);
  for (const BinaryTriangle& triangle : triangles) {
    bytes.append(12, '\0');
    for (const auto& corner : triangle.corners) {
      for (const float coordinate : corner) append_little_endian(coordinate, bytes);
    }
    append_little_endian(triangle.attribute, bytes);
    bytes += triangle.payload;
  }
  return bytes;
}

/// A file of so many triangles, all alike.
std::string binary_stl(const std::string& title, std::size_t count) {
  return binary_stl(title, std::vector<BinaryTriangle>(count));
}

std::string error_in(const std::string& bytes) {
  return error_of([&] { return read_stl<float>(bytes); });
}

void expect_facets(std::size_t count, const std::string& bytes, const Warnings& warnings = {}) {
  Mesh<float> mesh;
  ASSERT_NO_THROW(mesh = read_stl<float>(bytes)) << bytes;
  ASSERT_EQ(mesh.triangles.size(), count) << bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(mesh.vertices[mesh.triangles[i][corner]], facet_corners[corner]) << bytes;
    }
  }
  EXPECT_TRUE(mesh.faces.empty());
  EXPECT_EQ(mesh.warnings, warnings) << bytes;
}

TEST(ReadStl, reads_text) {
  const Mesh<float> mesh = read_stl<float>("solid a name of its own\n" + facet + facet + "endsolid\n");
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(Vertices(mesh.vertices.begin() + 3, mesh.vertices.end()), facet_corners);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(ReadStl, reads_text_to_the_nearest_double) {
  EXPECT_EQ(read_stl<double>("solid\n" + facet + "endsolid").vertices[2][1], 0.1);
}

TEST(ReadStl, takes_any_case_several_solids_and_meaningless_normals) {
  const std::string capitals =
      "SOLID\nFACET NORMAL nan nan nan\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 0.1 0\nENDLOOP\nENDFACET\n"
      "ENDSOLID\n";
  expect_facets(1, capitals);
  expect_facets(2, capitals + "\nsolid b\n" + facet + "endsolid b\n");
  expect_facets(1,
                "Solid A\nFacet Normal -1.#IND 0 0\nOuter Loop\nVertex 0 0 0\nVertex 1 0 0\nVertex 0 1E-1 0\n"
                "EndLoop\nEndFacet\nEndSolid A\n");
}

TEST(ReadStl, takes_an_end_of_two_words) {
  expect_facets(
      1,
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0.1 0\nend loop\nend facet\n"
      "end solid\n");
  expect_facets(2, "SOLID a\nFACET\nOUTER\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 0.1 0\nEND LOOP\nendfacet\n" + facet +
                       "End  Solid a\n");
  expect_facets(2, "solid a\n" + facet + "end solid a\nsolid b\n" + facet + "endsolid b\n");
  EXPECT_EQ(error_in("solid\n" + facet + "end\n"), "line 9: expected facet, not 'end'");
  EXPECT_EQ(error_in("solid\n" + facet + "end loop\n"), "line 9: expected facet, not 'end'");
  EXPECT_EQ(error_in("end solid\n"), "line 1: expected solid, not 'end'");
}

TEST(ReadStl, takes_solids_without_an_end) {
  expect_facets(1, "solid\n" + facet);
  expect_facets(2, "solid\n" + facet + facet + "\n\n");
  expect_facets(2, "solid a\n" + facet + "solid b\n" + facet);
  expect_facets(2, "solid a\n" + facet + "solid b\n" + facet + "endsolid b\n");
  expect_facets(2, "solid a\n" + facet + "endsolid a\nsolid b\n" + facet);
  expect_facets(2, "solid a\nsolid b\n" + facet + "solid c\nendsolid c\nsolid d\n" + facet);
  for (std::size_t lines = 2; lines < 8; ++lines) {
    std::string text = "solid\n";
    for (std::size_t at = 0; lines != static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));) {
      text += facet.substr(at, facet.find('\n', at) + 1 - at);
      at = facet.find('\n', at) + 1;
    }
    EXPECT_EQ(error_in(text), "line " + std::to_string(lines) + ": the file ends within a facet");
  }
}

TEST(ReadStl, passes_over_lines_of_colors) {
  const std::string color = "color 0.5 0.5 0.5\n";
  std::string text;
  const std::string lines = "solid\n" + facet + facet + "endsolid\n";
  for (std::size_t at = 0; at < lines.size(); at = lines.find('\n', at) + 1) {
    const std::string line = lines.substr(at, lines.find('\n', at) + 1 - at);
    expect_facets(2, lines.substr(0, at) + color + lines.substr(at));
    text += color + "  COLOUR 1 0 0\n" + line;
  }
  expect_facets(2, text + "Color\n");
}

TEST(ReadStl, takes_any_line_ends) {
  const std::string text = "solid a\n\n" + facet + "\nendsolid a\n";
  for (const std::string_view end : line_ends) {
    expect_facets(1, with_line_ends(text, end));
    EXPECT_EQ(error_in(with_line_ends("solid a\n\n" + facet + "facet\nouter loop\nvertex 0 0 x\n", end)),
              "line 12: 'x' is not a number");
  }
  expect_facets(1, with_mixed_line_ends(text));
}

TEST(ReadStl, takes_a_closing_control_z) {
  for (const std::string_view closing : closing_control_z) {
    expect_facets(1, "solid a\n" + facet + "endsolid a" + std::string(closing));
    expect_facets(1, "solid a\n" + facet + "endsolid a\n" + std::string(closing));
    expect_facets(1, "solid a\n" + facet + std::string(closing));
  }
  EXPECT_EQ(error_in("solid a\n" + facet + "endsolid a\n\x1a\nsolid b\n"), "line 10: expected solid, not '?'");
}

TEST(ReadStl, reads_bytes) {
  const Mesh<double> mesh = read_stl<double>(binary_stl("made by hand", 1));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(mesh.vertices[2][1], double{0.1f});
  expect_facets(3, binary_stl("", 3));
}

TEST(ReadStl, tells_bytes_from_text_that_they_pretend_to_be) {
  for (const std::string title :
       {"solid", "solid lies", "SOLID lies\n", " solid\r\nfacet normal 0 0 1\r\nouter loop"}) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{30}}) {
      const std::string bytes = binary_stl(title, count);
      expect_facets(count, bytes);
      expect_facets(count, bytes + "and more");
      expect_facets(count, bytes + std::string(2000, ' '),
                    {"2000 bytes follow the last of " + std::to_string(count) + " triangles, and are passed over"});
      EXPECT_EQ(error_in(bytes.substr(0, bytes.size() - 1)),
                "a binary STL file of " + std::to_string(count) + " triangles is " + std::to_string(bytes.size()) +
                    " bytes long, not " + std::to_string(bytes.size() - 1));
    }
  }
}

TEST(ReadStl, passes_over_a_few_bytes_behind_the_last_triangle) {
  for (const std::size_t more : {std::size_t{1}, std::size_t{2}, std::size_t{49}}) {
    for (const char byte : {'\0', ' ', '\n', '\x1a', '\xff'}) {
      expect_facets(1, binary_stl("", 1) + std::string(more, byte));
      expect_facets(2, binary_stl("solid", 2) + std::string(more, byte));
    }
  }
  for (const std::size_t more : {std::size_t{50}, std::size_t{51}, std::size_t{100}, std::size_t{5000}}) {
    const std::string bytes = std::to_string(more) + " bytes follow the last of ";
    expect_facets(1, binary_stl("", 1) + std::string(more, '\0'), {bytes + "1 triangles, and are passed over"});
    expect_facets(2, binary_stl("", 2) + std::string(more, 'a'), {bytes + "2 triangles, and are passed over"});
  }
  const Mesh<float> nothing = read_stl<float>(binary_stl("", 0) + std::string(50, '\0'));
  EXPECT_EQ(nothing.warnings,
            (Warnings{"50 bytes follow the last of 0 triangles, and are passed over", example::no_triangles}));
}

TEST(ReadStl, passes_over_payloads_of_the_size_that_the_attribute_tells) {
  expect_facets(1, binary_stl("", {{5, "bytes"}}));
  expect_facets(3, binary_stl("", {{1, "a"}, {0, ""}, {300, std::string(300, '\x7f')}}));
  expect_facets(2, binary_stl("solid", {{50, std::string(50, '\0')}, {65535, std::string(65535, 's')}}));
  // Bytes that the sizes do not account for may as well be what colors do not.
  const std::string ambiguous = "may be colors or sizes of what follows each, and the file's length fits neither";
  EXPECT_EQ(error_in(binary_stl("", {{5, "bytes"}}) + "x"), "the attributes of its 1 triangles " + ambiguous);
  EXPECT_EQ(error_in(binary_stl("", {{1, "a"}, {2, "ab"}}) + "\n"), "the attributes of its 2 triangles " + ambiguous);
  EXPECT_EQ(error_in(binary_stl("", {{5, "bytes"}}).substr(0, 84 + 50 + 4) + "and more"),
            "the attributes of its 1 triangles " + ambiguous);
  const std::string cut = binary_stl("", {{5, "bytes"}, {0, ""}}).substr(0, 84 + 99);
  EXPECT_EQ(error_in(cut), "a binary STL file of 2 triangles is 184 bytes long, not 183");
}

TEST(ReadStl, passes_over_attributes_that_are_colors) {
  expect_facets(2, binary_stl("COLOR=\xff\xff\xff\xff", {{0x7c00, ""}, {0x801f, ""}}));
  expect_facets(3, binary_stl("", {{1, ""}, {65535, ""}, {50, ""}}));
  // Sizes would lead beyond the end, so a few bytes more make no doubt.
  expect_facets(2, binary_stl("", {{0x7c00, ""}, {0x801f, ""}}) + "\n");
  expect_facets(1, binary_stl("", {{0x7c00, ""}}) + std::string(60, '\0'),
                {"60 bytes follow the last of 1 triangles, and are passed over"});
}

TEST(ReadStl, names_the_length_that_the_count_asks_for) {
  EXPECT_EQ(error_in(binary_stl("", 2).substr(0, 184 - 1)),
            "a binary STL file of 2 triangles is 184 bytes long, not 183");
  EXPECT_EQ(error_in(binary_stl("", 1).substr(0, 84)), "a binary STL file of 1 triangles is 134 bytes long, not 84");
  EXPECT_EQ(error_in(binary_stl("", 3).substr(0, 84 + 50)),
            "a binary STL file of 3 triangles is 234 bytes long, not 134");
}

TEST(ReadStl, takes_no_memory_on_the_word_of_a_header) {
  std::string bytes = binary_stl("", 1);
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(error_in(bytes), "a binary STL file of 4294967295 triangles is 214748364834 bytes long, not 134");
}

/// A NUL in place of each byte, and between each two, of a text that is long enough for a binary file's header.
TEST(ReadStl, names_the_line_of_a_nul_in_text) {
  const std::string small =
      "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0.1 0\nendloop\nendfacet\n\n\n";
  ASSERT_EQ(small.size(), 85u);
  for (const std::string& text : {small, small + "endsolid\n", "solid a\r\n" + facet + "endsolid a\r\n",
                                  "solid\n" + facet + facet + facet + "endsolid", "\xef\xbb\xbfSOLID b\n" + facet,
                                  with_line_ends("solid a\n" + facet + facet + "end solid\n", "\r")}) {
    expect_facets(static_cast<std::size_t>(read_stl<float>(text).triangles.size()), text);
    for (std::size_t at = 0; at <= text.size(); ++at) {
      const auto line_of = [at](const std::string& bytes) {
        const std::string before = bytes.substr(0, at);
        std::size_t lines = 1;
        for (std::size_t i = 0; i < before.size(); ++i) {
          if (before[i] == '\n' || (before[i] == '\r' && bytes.substr(i, 2) != "\r\n")) ++lines;
        }
        return std::to_string(lines);
      };
      std::string inserted = text;
      inserted.insert(at, 1, '\0');
      EXPECT_EQ(error_in(inserted), "line " + line_of(inserted) + ": the line has a NUL byte in it") << "at " << at;
      if (at == text.size()) continue;
      std::string replaced = text;
      replaced[at] = '\0';
      EXPECT_EQ(error_in(replaced), "line " + line_of(replaced) + ": the line has a NUL byte in it") << "at " << at;
    }
  }
}

TEST(ReadStl, reads_text_of_any_length_as_text) {
  const std::string text = "solid a name that takes bytes 80 to 83 along the lines of the file\n" + facet;
  for (std::size_t more = 0; more < 300; ++more) {
    expect_facets(2, "solid " + std::string(more, 'x') + "\n" + facet + facet);
    EXPECT_EQ(error_in("solid " + std::string(more, 'x') + "\n" + facet + "facet\n"),
              "line 9: the file ends within a facet");
  }
  expect_facets(1, text);
}

TEST(ReadStl, warns_of_a_mesh_of_nothing) {
  for (const std::string text : {"solid\nendsolid\n", "solid\n", "solid a\nend solid\n", "SOLID\ncolor 1 1 1\nENDSOLID",
                                 "solid a\nendsolid\nsolid b\nendsolid\n", "solid\nsolid\n\x1a"}) {
    const Mesh<float> mesh = read_stl<float>(text);
    EXPECT_TRUE(mesh.vertices.empty()) << text;
    EXPECT_EQ(mesh.warnings, Warnings{example::no_triangles}) << text;
  }
  EXPECT_EQ(read_stl<float>(binary_stl("", 0)).warnings, Warnings{example::no_triangles});
  EXPECT_EQ(read_stl<float>(binary_stl("solid", 0) + "\n").warnings, Warnings{example::no_triangles});
}

TEST(ReadStl, names_the_line_of_an_error_in_text) {
  EXPECT_EQ(error_in("hello"), "line 1: expected solid, not 'hello'");
  EXPECT_EQ(error_in(std::string(40, 'v') + std::string(60, ' ') + "\n"),
            "line 1: expected solid, not '" + std::string(40, 'v') + "'");
  EXPECT_EQ(error_in(""), "the file is empty");
  EXPECT_EQ(error_in("\n\n"), "line 2: the file is empty");
  EXPECT_EQ(error_in("solid\n" + facet + "endsolid\n" + facet), "line 10: expected solid, not 'facet'");
  EXPECT_EQ(error_in("solid\nvertex 1 2 3\n"), "line 2: expected facet, not 'vertex'");
  EXPECT_EQ(error_in("solid\nfacet\nendfacet\n"), "line 3: expected outer, not 'endfacet'");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 2\n"), "line 4: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 2 3 4\n"), "line 4: a vertex has 3 coordinates, not 4");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 2 -inf\n"), "line 4: '-inf' is not a number");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 1 nan 2\n"), "line 4: 'nan' is not a number");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"), "line 5: expected vertex, not 'endloop'");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\n"),
            "line 7: expected endloop, not 'vertex'");
  EXPECT_EQ(error_in("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nendloop\nendsolid\n"),
            "line 8: expected endfacet, not 'endsolid'");
}

TEST(ReadStl, names_line_and_value_of_a_number_that_old_windows_wrote) {
  for (const std::string value : {"1.#QNAN", "-1.#IND00", "1.#INF", "1.#IND", "-1.#INF"}) {
    const std::string start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
    EXPECT_EQ(error_in(start + "vertex 0 " + value + " 0\n"), "line 5: '" + value + "' is not a number");
    EXPECT_EQ(error_in(with_line_ends(start + "\nvertex 0 0 " + value + "\n", "\r")),
              "line 6: '" + value + "' is not a number");
  }
}

TEST(ReadStl, names_the_triangle_of_an_error_in_bytes) {
  for (const float number : {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()}) {
    BinaryTriangle bad = {3, "abc", {{0, 0, 0}, {0, number, 0}, {0, 0, 0}}};
    EXPECT_EQ(error_in(binary_stl("", {{}, bad})), "triangle 1: a coordinate is not finite");
    bad.attribute = 0;
    bad.payload = "";
    EXPECT_EQ(error_in(binary_stl("", {bad, {}})), "triangle 0: a coordinate is not finite");
  }
}

TEST(ReadStl, makes_an_error_or_a_mesh_of_any_text) {
  expect_error_or_sound_mesh("solid a\n" + facet + facet + "endsolid a\n", read_stl<float>);
  expect_error_or_sound_mesh(
      with_line_ends("SOLID a\ncolor 1 0 0\n" + facet + "end solid\nsolid b\n" + facet + "\x1a", "\r"),
      read_stl<double>);
}

TEST(ReadStl, makes_an_error_or_a_mesh_of_any_bytes) {
  expect_error_or_sound_mesh(binary_stl("title", 1), read_stl<double>);
  expect_error_or_sound_mesh(binary_stl("solid", {{3, "abc"}, {0, ""}, {60, std::string(60, 'x')}}), read_stl<float>);
}

}  // namespace
}  // namespace surehit::test::read_stl_test
