#include "mesh_io/read_off.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "error_of.hpp"
#include "mesh_io/text_lines.hpp"
#include "off_text.hpp"
#include "sample_polygons.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_off_test {
namespace {

using example::Mesh;
using example::read_off;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Floats = std::vector<std::array<float, 3>>;
using Faces = std::vector<std::uint32_t>;
using Warnings = std::vector<std::string>;

const Floats square_corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Triangles square_fan = {{0, 1, 2}, {0, 2, 3}};
const Triangles two_triangles = {{0, 1, 2}, {3, 2, 1}};

std::string error_in(const std::string& text) {
  return error_of([&] { return read_off<float>(text); });
}

void expect_reads(const std::string& text, const Floats& vertices, const Triangles& triangles) {
  Mesh<float> mesh;
  ASSERT_NO_THROW(mesh = read_off<float>(text)) << text;
  EXPECT_EQ(mesh.vertices, vertices) << text;
  EXPECT_EQ(mesh.triangles, triangles) << text;
  EXPECT_TRUE(mesh.warnings.empty()) << text;
}

/// The text with some of its white space changed: a line break at each `nth` word, and no other.
std::string broken_at_each(std::size_t nth, const std::string& text) {
  std::vector<std::string_view> words;
  std::string line = text;
  for (char& c : line) c = c == '\n' ? ' ' : c;
  example::split(line, words);
  std::string broken;
  for (std::size_t i = 0; i < words.size(); ++i) broken += std::string(words[i]) + ((i + 1) % nth == 0 ? "\n" : " ");
  return broken;
}

TEST(ReadOff, reads_vertices_and_polygons) {
  const Mesh<double> mesh = read_off<double>("OFF\n4 2 0\n0.1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 3 2 1\n");
  const std::vector<std::array<double, 3>> expected = {{0.1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
  EXPECT_EQ(mesh.faces, (Faces{0, 0, 1}));
  EXPECT_EQ(mesh.face_count(), 2u);
}

TEST(ReadOff, cuts_concave_faces) {
  expect_every_sample_is_cut_rightly<double>([](const SampleFace& face) { return read_off<double>(text_of(face)); });
  expect_every_sample_is_cut_rightly<float>(
      [](const SampleFace& face) { return read_off<float>(broken_at_each(5, text_of(face))); });
}

TEST(ReadOff, leaves_the_window_of_a_keyholed_wall_open) {
  expect_keyholed_wall_has_its_window([](const SampleFace& face) { return read_off<double>(text_of(face)); });
}

TEST(ReadOff, tells_which_face_a_triangle_is_of) {
  const std::string l = "0 0 0\n4 0 0\n4 2 0\n2 2 0\n2 4 0\n0 4 0\n";
  const Mesh<float> mesh = read_off<float>("OFF\n6 4 0\n" + l + "3 0 1 2\n6 0 1 2 3 4 5\n4 0 1 2 3 1 0 0\n3 3 4 5\n");
  EXPECT_EQ(mesh.faces, (Faces{0, 1, 1, 1, 1, 2, 2, 3}));
  EXPECT_EQ(mesh.face_count(), 4u);
  const Mesh<float> triangles = read_off<float>("OFF\n6 2 0\n" + l + "3 0 1 2\n3 3 4 5\n");
  EXPECT_TRUE(triangles.faces.empty());
  EXPECT_EQ(triangles.face_of(1), 1u);
}

TEST(ReadOff, names_the_face_whose_outline_crosses_itself) {
  const std::string vertices = "0 0 0\n4 4 0\n4 0 0\n0 4 0\n";
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + vertices + "4 0 1 2 3\n"),
            "line 7: face 0 of 4 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in("OFF\n4 3 0\n" + vertices + "3 0 1 2\n4 0 1 2 3 0 1 0\n3 0 1 2\n"),
            "line 8: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in(broken_at_each(4, "OFF 4 2 0\n" + vertices + "3 0 1 2 4 0 1 2 3\n")),
            "line 7: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
}

TEST(ReadOff, takes_comments_and_blank_lines_anywhere) {
  EXPECT_EQ(read_off<float>("# a\nOFF # b\n\n4 1 0 # c\n# d\n" + square + "\n4 0 1 2 3 # e\n# f\n").triangles.size(),
            2u);
  expect_reads(
      "#\n\n \t# 1\nOFF\n# 2\n4 # vertices\n#\n1 # face\n0\n0 0 0 # 3\n\n1 0\n# 4\n0\n1 1 0\t# 5\n0 1 0\n"
      "4 0 1 # 6\n#\n2 3 #",
      square_corners, square_fan);
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "4 0 1 2 3#\n"), "line 7: '3#' is not an integer");
}

TEST(ReadOff, takes_any_line_ends) {
  const std::string text = "OFF\n# a comment\n4 2 0\n" + square + "\n3 0 1 2\n3 3 2 1 255 0 0\n";
  for (const std::string_view end : line_ends) expect_reads(with_line_ends(text, end), square_corners, two_triangles);
  expect_reads(with_mixed_line_ends(text), square_corners, two_triangles);
}

TEST(ReadOff, counts_lines_by_any_ends) {
  const std::string text = "OFF\n# a comment\n4 2 0\n\n0 0 0\n1 0 0\n1 x 0\n0 1 0\n3 0 1 2\n3 3 2 1\n";
  for (const std::string_view end : line_ends) {
    EXPECT_EQ(error_in(with_line_ends(text, end)), "line 7: 'x' is not a number");
  }
  EXPECT_EQ(error_in(with_mixed_line_ends(text)), "line 7: 'x' is not a number");
}

TEST(ReadOff, takes_a_closing_control_z) {
  for (const std::string_view closing : closing_control_z) {
    expect_reads("OFF\n4 2 0\n" + square + "3 0 1 2\n3 3 2 1" + std::string(closing), square_corners, two_triangles);
    expect_reads("OFF\n4 2 0\n" + square + "3 0 1 2\n3 3 2 1\n" + std::string(closing), square_corners, two_triangles);
  }
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "4 0 1 2 3\n\x1a\n3 2 1 0"), "line 8: something follows the last face");
}

TEST(ReadOff, takes_its_first_word_in_any_case_or_none) {
  for (const char* word :
       {"OFF\n", "off\n", "Off\n", "oFF ", "", "\n", "# no word\n", "\xef\xbb\xbfOFF\n", "OFF # a\n"}) {
    expect_reads(word + ("4 2 0\n" + square) + "3 0 1 2\n3 3 2 1\n", square_corners, two_triangles);
  }
}

TEST(ReadOff, takes_counts_with_and_without_edges) {
  for (const char* header : {"OFF 4 2 0\n", "OFF4 2 0\n", "OFF\n4 2\n", "OFF 4 2\n", "off4 2\n", "4 2\n", "4 2 0\n",
                             "OFF\n4\n2\n0\n", "OFF 4\n2 0\n", "OFF\n4 2\n0\n", "OFF\n\n4\n\n2 # faces\n5\n",
                             "OFF\n4\n2\n", "OFF 4\n2\n", "OFF\n4 2 99 # edges\n"}) {
    expect_reads(header + square + "3 0 1 2\n3 3 2 1\n", square_corners, two_triangles);
  }
}

TEST(ReadOff, takes_the_count_of_edges_for_no_coordinate) {
  // Without its last word, the body of each would be one of four vertices and one face as well.
  expect_reads("OFF\n4 1\n0\n0 0 0\n1 0 0\n1 1 0\n0 1 3\n3 0 1 2\n", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 3}},
               {{0, 1, 2}});
  expect_reads("OFF\n4 1\n0\n0 0 4 4\n0 4 4 4 4 0 4 4\n3 0 1 2\n", {{0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}},
               {{0, 1, 2}});
  // Nor a coordinate for the count of edges.
  expect_reads("OFF\n3\n1\n0 0 0 9 0 0 9\n4 0 0 9 9 9 9\n0 4 0 9 9 9 9\n3 0 1 2\n", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
               {{0, 1, 2}});
}

TEST(ReadOff, takes_free_line_breaks) {
  for (const char* header : {"OFF 4 2 0\n", "4 2 0\n", "off\n4\n2\n0\n"}) {
    const std::string text = header + square + "3 0 1 2\n3 3 2 1\n";
    expect_reads(broken_at_each(1, text), square_corners, two_triangles);
    expect_reads(broken_at_each(1000, text), square_corners, two_triangles);
    for (std::size_t nth = 2; nth < 23; ++nth) {
      const std::string broken = broken_at_each(nth, text);
      expect_reads(broken, square_corners, two_triangles);
      for (const std::string_view end : line_ends) {
        expect_reads(with_line_ends(broken, end), square_corners, two_triangles);
      }
    }
  }
}

TEST(ReadOff, takes_faces_over_several_lines_and_several_in_one) {
  const std::string start = "OFF\n4 2 0\n" + square;
  for (const char* faces : {"3 0 1 2 3 3 2 1", "3\n0 1 2\n3 3\n2 1\n", "3 0\n1 2 3 3\n2\n1", "3 0 1\n2\n3 3 2 1"}) {
    expect_reads(start + faces, square_corners, two_triangles);
  }
  expect_reads("OFF\n4 3 0\n" + square + "3 0 1 2 3 3 2 1\n3 1 2 3", square_corners, {{0, 1, 2}, {3, 2, 1}, {1, 2, 3}});
  expect_reads("OFF\n4 1 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n4 0 1\n2 3", square_corners, square_fan);
}

TEST(ReadOff, passes_over_colors_of_faces) {
  const std::string start = "OFF\n4 2 0\n" + square;
  expect_reads(start + "3 0 1 2 7\n3 3 2 1\n", square_corners, two_triangles);
  expect_reads(start + "3 0 1 2 255 128 0\n3 3 2 1 0.5 0.5 1e-1\n", square_corners, two_triangles);
  expect_reads(start + "3 0 1 2 255 128 0 255\n3 3 2 1 0 0 0 1\n", square_corners, two_triangles);
  expect_reads(start + "3 0 1 2\n3 3 2 1 3 0 1 2\n", square_corners, two_triangles);
  // A color may also follow a face of several lines.
  expect_reads(start + "3 0\n1 2 1 0 0\n3 3\n2 1 0 1 0\n", square_corners, two_triangles);
  EXPECT_EQ(error_in(start + "3 0 1 2 0 1\n3 3 2 1\n"),
            "line 7: a face is followed by 2 numbers in its line, but a color has 1, 3 or 4");
  EXPECT_EQ(error_in(start + "3 0 1 2\n3 3 2 1 1 1 1 1 1\n"),
            "line 8: a face is followed by 5 numbers in its line, but a color has 1, 3 or 4");
  EXPECT_EQ(error_in(start + "3 0 1 2 red\n3 3 2 1\n"), "line 7: 'red' is not a number");
}

TEST(ReadOff, passes_over_what_its_first_word_announces) {
  const Floats vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Triangles triangles = {{0, 1, 2}};
  const std::pair<const char*, const char*> attributes_of[] = {
      {"COFF", " 255 0 0 1"},     {"coff", " 0.5 0.5 0.5"},
      {"NOFF", " 0 0 1"},         {"noff", " nan 0 1"},
      {"STOFF", " 0.5 0.25"},     {"CNOFF", " 1 0 0 1 0 0 1"},
      {"STCOFF", " 1 1 0 0 1 7"}, {"STCNOFF", " 0 0 1 1 0 0 1 0.5 0.5"}};
  for (const auto& [word, attributes] : attributes_of) {
    const std::string text = word + std::string("\n3 1 0\n0 0 0") + attributes + "\n4 0 0" + attributes + "\n0 4 0" +
                             attributes + "\n3 0 1 2\n";
    expect_reads(text, vertices, triangles);
    for (const std::size_t nth : {1u, 2u, 5u, 1000u}) expect_reads(broken_at_each(nth, text), vertices, triangles);
  }
  // In lines of their own there may be as many as one likes.
  expect_reads("COFF\n3 1 0\n0 0 0\n4 0 0 7\n0 4 0 1 1\n3 0 1 2\n", vertices, triangles);
}

TEST(ReadOff, passes_over_colors_of_vertices_under_a_plain_first_word) {
  const Floats vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (const char* color : {" 255 0 0", " 0.5 0.25 0.125", " 255 0 0 255", " 3 0 1 2", " 0 0 0"}) {
    for (const char* word : {"OFF", "off", ""}) {
      const std::string text =
          word + std::string("\n3 1 0\n0 0 0") + color + "\n4 0 0" + color + "\n0 4 0" + color + "\n3 0 1 2\n";
      expect_reads(text, vertices, {{0, 1, 2}});
    }
    const std::string text =
        "OFF 3 2 0 0 0 0" + std::string(color) + " 4 0 0" + color + " 0 4 0" + color + " 3 0 1 2 3 2 1 0";
    for (const std::size_t nth : {1u, 4u, 1000u}) {
      expect_reads(broken_at_each(nth, text), vertices, {{0, 1, 2}, {2, 1, 0}});
    }
  }
  expect_reads("OFF\n3 1 0\n0 0 0\n4 0 0 1 0 0\n0 4 0 1 0 0 1\n3 0 1 2\n", vertices, {{0, 1, 2}});
}

TEST(ReadOff, warns_of_vertices_that_are_not_finite_where_no_face_uses_them) {
  const Mesh<float> mesh = read_off<float>("OFF\n5 1 0\n0 0 0\nnan 0 0\n4 0 0\n0 4 0\n0 -inf 0\n3 0 2 3\n");
  EXPECT_EQ(mesh.warnings,
            Warnings{"2 vertices are not finite, the first of them vertex 1 of line 4; no face uses them"});
  EXPECT_FALSE(find_invalid(mesh.view()));
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0\nnan 0 0\n4 0 0\n0 4 0\n3 0 2 1\n"),
            "line 7: face 0 uses vertex 1 of line 4, of which x is nan");
  EXPECT_EQ(error_in("OFF\n3 1 0\n0 0 0\n4 0 0\n0 inf 0\n3 0 2 1\n"),
            "line 6: face 0 uses vertex 2 of line 5, of which y is infinite");
}

TEST(ReadOff, warns_of_a_mesh_of_nothing) {
  for (const char* text : {"OFF\n0 0 0\n", "OFF 0 0", "0 0\n", "OFF\n0\n0\n0\n", "OFF\n2 0 0\n0 0 0\n1 0 0\n"}) {
    const Mesh<float> mesh = read_off<float>(text);
    EXPECT_TRUE(mesh.triangles.empty()) << text;
    EXPECT_EQ(mesh.warnings, Warnings{example::no_triangles}) << text;
  }
}

struct RandomMesh {
  Floats vertices;
  std::vector<std::vector<std::uint32_t>> faces;

  [[nodiscard]] Triangles fans() const {
    Triangles triangles;
    for (const auto& face : faces) {
      for (std::size_t i = 2; i < face.size(); ++i) triangles.push_back({face[0], face[i - 1], face[i]});
    }
    return triangles;
  }
};

/// Vertices on a parabola, so that corners in the order of their ids make a convex face. All numbers are small and
/// whole: what is read at a wrong position may well pass for a count or for an index.
RandomMesh random_mesh(Random& random) {
  RandomMesh mesh;
  const auto height = static_cast<float>(random.between(2, 5));
  for (std::int64_t i = random.between(3, 9); i > 0; --i) {
    const auto x = static_cast<float>(mesh.vertices.size());
    mesh.vertices.push_back({x, x * x, height});
  }
  for (std::uint64_t count = 1 + random.below(8); count > 0; --count) {
    std::vector<std::uint32_t> face;
    while (face.size() < 3) {
      face.clear();
      for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        if (random.one_in(2)) face.push_back(i);
      }
    }
    const auto first = static_cast<std::ptrdiff_t>(random.below(face.size()));
    std::rotate(face.begin(), face.begin() + first, face.end());
    mesh.faces.push_back(face);
  }
  return mesh;
}

/// The mesh in a line for each vertex and face; `attributes` and `color` are written behind each.
std::string lines_of(const RandomMesh& mesh, const std::string& header, const std::string& attributes,
                     const std::string& color) {
  std::ostringstream text;
  text << header << " " << mesh.vertices.size() << " " << mesh.faces.size() << " 0\n";
  for (const auto& [x, y, z] : mesh.vertices) text << x << " " << y << " " << z << attributes << "\n";
  for (const auto& face : mesh.faces) {
    text << face.size();
    for (const std::uint32_t corner : face) text << " " << corner;
    text << color << "\n";
  }
  return text.str();
}

TEST(ReadOff, reads_random_meshes_in_lines) {
  constexpr const char* headers[] = {"OFF", "off", "", "OFF\n"};
  constexpr const char* attributes[] = {"", " 3 3 3", " 3 4 5 3"};
  constexpr const char* colors[] = {"", " 3", " 3 4 3", " 3 0 1 2"};
  Random random(41);
  for (std::size_t i = case_count(3000); i > 0; --i) {
    const RandomMesh mesh = random_mesh(random);
    const std::string text =
        lines_of(mesh, headers[random.below(4)], attributes[random.below(3)], colors[random.below(4)]);
    expect_reads(text, mesh.vertices, mesh.fans());
    ASSERT_FALSE(HasFailure());
  }
}

TEST(ReadOff, reads_random_meshes_in_free_line_breaks) {
  constexpr std::pair<const char*, const char*> kinds[] = {{"OFF", ""},
                                                           {"off", ""},
                                                           {"", ""},
                                                           {"NOFF", " 3 3 3"},
                                                           {"COFF", " 3 4 5 3"},
                                                           {"OFF", " 0.5 0.5 0.5"},
                                                           {"OFF", " 0.5 0.5 0.5 1"},
                                                           {"COFF", " 0.5 0.5 0.5"}};
  Random random(42);
  for (std::size_t i = case_count(3000); i > 0; --i) {
    const RandomMesh mesh = random_mesh(random);
    const auto [header, attributes] = kinds[random.below(std::size(kinds))];
    std::string text = lines_of(mesh, header, attributes, "");
    const std::uint64_t rarity = 1 + random.below(20);
    for (char& c : text) {
      if (c == ' ' || c == '\n') c = random.one_in(rarity) ? '\n' : ' ';
    }
    expect_reads(text, mesh.vertices, mesh.fans());
    ASSERT_FALSE(HasFailure());
  }
}

}  // namespace
}  // namespace surehit::test::read_off_test
