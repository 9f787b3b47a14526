#include "mesh_io/read_obj.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "error_of.hpp"
#include "mutations.hpp"
#include "sample_polygons.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_obj_test {
namespace {

using example::Mesh;
using example::read_obj;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Faces = std::vector<std::uint32_t>;
using Floats = std::vector<std::array<float, 3>>;
using Doubles = std::vector<std::array<double, 3>>;
using Warnings = std::vector<std::string>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string triangle = "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n";
const Floats triangle_corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

std::string error_in(const std::string& text) {
  return error_of([&] { return read_obj<float>(text); });
}

std::string text_of(const SampleFace& face) {
  std::string text;
  for (const auto& [x, y, z] : face.vertices) {
    text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  text += "f";
  for (const std::uint32_t corner : face.corners) text += " " + std::to_string(corner + 1);
  return text + "\n";
}

/// The face before its vertices.
std::string face_first_text_of(const SampleFace& face) {
  const std::string text = text_of(face);
  const std::size_t at = text.find('f');
  return text.substr(at) + text.substr(0, at);
}

TEST(ReadObj, reads_vertices_and_triangles) {
  const Mesh<float> mesh = read_obj<float>("v 0 -1 .5\nv 1e2 0x1.8p1 +4\r\nv 7 8 9\nf 3 1 2\n");
  EXPECT_EQ(mesh.vertices, (Floats{{0, -1, 0.5f}, {100, 3, 4}, {7, 8, 9}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}}));
  EXPECT_TRUE(mesh.faces.empty());
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(ReadObj, rounds_to_the_nearest_of_either_scalar) {
  const std::string text = "v 0.1 1.00000005960464477539062500000000000000001 1e-60";
  EXPECT_EQ(read_obj<float>(text).vertices, (Floats{{0.1f, 0x1.000002p0f, 0}}));
  EXPECT_EQ(read_obj<double>(text).vertices, (Doubles{{0.1, 0x1.000001p0, 1e-60}}));
}

TEST(ReadObj, splits_convex_polygons_into_fans) {
  EXPECT_EQ(read_obj<float>(square + "f 1 2 3 4").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read_obj<float>(square + "f 3 2 1 4").triangles, (Triangles{{2, 1, 0}, {2, 0, 3}}));
  const std::string pentagon = "v 0 0 7\nv 4 0 7\nv 5 3 7\nv 2 5 7\nv -1 3 7\nf 4 5 1 2 3\n";
  EXPECT_EQ(read_obj<float>(pentagon).triangles, (Triangles{{3, 4, 0}, {3, 0, 1}, {3, 1, 2}}));
}

TEST(ReadObj, cuts_concave_faces) {
  expect_every_sample_is_cut_rightly<double>([](const SampleFace& face) { return read_obj<double>(text_of(face)); });
  expect_every_sample_is_cut_rightly<float>([](const SampleFace& face) { return read_obj<float>(text_of(face)); });
}

TEST(ReadObj, cuts_concave_faces_before_their_vertices) {
  expect_every_sample_is_cut_rightly<float>(
      [](const SampleFace& face) { return read_obj<float>(face_first_text_of(face)); });
}

TEST(ReadObj, leaves_the_window_of_a_keyholed_wall_open) {
  expect_keyholed_wall_has_its_window([](const SampleFace& face) { return read_obj<double>(text_of(face)); });
  const std::string wall =
      "v 0 0 0\nv 6 0 0\nv 6 0 4\nv 0 0 4\nv 2 0 1\nv 2 0 3\nv 4 0 3\nv 4 0 1\nf 1 2 3 4 1 5 6 7 8 5\n";
  const Mesh<double> mesh = read_obj<double>(wall);
  const Colliderd collider(mesh.view());
  EXPECT_FALSE(collider.any_hit(Segmentd{{3, -5, 2}, {3, 5, 2}}));
  EXPECT_TRUE(collider.any_hit(Segmentd{{1, -5, 2}, {1, 5, 2}}));
}

TEST(ReadObj, leaves_the_notch_of_a_dart_open) {
  for (const char* face : {"f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3", "f 4 3 2 1", "f -1 -4 -3 -2"}) {
    const Mesh<float> mesh = read_obj<float>("v -4 4 0\nv 0 0 0\nv 4 4 0\nv 0 2 0\n" + std::string(face));
    const Colliderf collider(mesh.view());
    EXPECT_FALSE(collider.any_hit(Segmentf{{0, 3, 5}, {0, 3, -5}})) << face;
    EXPECT_TRUE(collider.any_hit(Segmentf{{0, 1, 5}, {0, 1, -5}})) << face;
    EXPECT_TRUE(collider.any_hit(Segmentf{{-3, 3.25f, 5}, {-3, 3.25f, -5}})) << face;
  }
}

TEST(ReadObj, tells_which_face_a_triangle_is_of) {
  const std::string vertices = "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 2 2 0\nv 2 4 0\nv 0 4 0\n";
  const std::string faces = "f 1 2 3\nf 1 2 3 4 5 6\nf 1 2 3 4\nf 4 5 6\n";
  const Faces expected = {0, 1, 1, 1, 1, 2, 2, 3};
  for (const std::string& text : {vertices + faces, faces + vertices}) {
    const Mesh<float> mesh = read_obj<float>(text);
    EXPECT_EQ(mesh.faces, expected);
    EXPECT_EQ(mesh.face_of(0), 0u);
    EXPECT_EQ(mesh.face_of(4), 1u);
    EXPECT_EQ(mesh.face_of(7), 3u);
    EXPECT_EQ(mesh.face_count(), 4u);
    EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(mesh.triangles[7], (std::array<std::uint32_t, 3>{3, 4, 5}));
  }
  const Mesh<float> triangles = read_obj<float>(vertices + "f 1 2 3\nf 4 5 6\n");
  EXPECT_TRUE(triangles.faces.empty());
  EXPECT_EQ(triangles.face_of(1), 1u);
  EXPECT_EQ(triangles.face_count(), 2u);
}

TEST(ReadObj, names_the_face_whose_outline_crosses_itself) {
  const std::string vertices = "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\nv 9 2 0\n";
  EXPECT_EQ(error_in(vertices + "f 1 2 3 4\n"),
            "line 6: face 0 of 4 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in(vertices + "f 1 3 2 4\nf 1 2 3\nf 1 \\\n 2 5 3 4\n"),
            "line 9: face 2 of 5 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in("f 1 2 3\nf 1 2 3 4\nf 1 2 3\n" + vertices),
            "line 2: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in(with_line_ends("f 1 2 3\n\nf 1 2 3 4\n" + vertices, "\r")),
            "line 3: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
  const std::string upright = "v 0 0 0\nv 0 4 4\nv 0 4 0\nv 0 0 4\nf 1 2 3 4\n";
  EXPECT_EQ(error_in(upright), "line 5: face 0 of 4 corners has no valid triangulation: its outline crosses itself");
}

TEST(ReadObj, takes_every_form_of_a_corner) {
  const std::string attributes = "vt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -4/-1/-1 -3 -2"}) {
    EXPECT_EQ(read_obj<float>(square + attributes + face).triangles, (Triangles{{0, 1, 2}})) << face;
  }
}

TEST(ReadObj, counts_negative_indices_back_from_the_newest_vertex) {
  EXPECT_EQ(read_obj<float>(square + "f -4 -3 -2\nv 5 5 5\nf -1 1 -2").triangles, (Triangles{{0, 1, 2}, {4, 0, 3}}));
}

TEST(ReadObj, takes_faces_before_their_vertices) {
  EXPECT_EQ(read_obj<float>("f 1 2 3\n" + square).triangles, (Triangles{{0, 1, 2}}));
  // A face that has its vertices stays behind one that waits for them.
  EXPECT_EQ(read_obj<float>("v 9 9 9\nv 8 8 8\nv 7 7 8\nf 4 5 6\nf 1 2 3\n" + square).triangles,
            (Triangles{{3, 4, 5}, {0, 1, 2}}));
}

TEST(ReadObj, takes_any_line_ends) {
  const std::string text = "# made by hand\n\nv 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n";
  for (const std::string_view end : line_ends) {
    const Mesh<float> mesh = read_obj<float>(with_line_ends(text, end));
    EXPECT_EQ(mesh.vertices, triangle_corners);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  }
  EXPECT_EQ(read_obj<float>(with_mixed_line_ends(text)).vertices, triangle_corners);
  EXPECT_EQ(read_obj<float>("v 0 0 0\rv 4 0 0\nv 0 4 0\nf 1 2 3").vertices, triangle_corners);
  // A comment ends with a lone \r too.
  EXPECT_EQ(read_obj<float>("v 0 0 0\nv 4 0 0 # the second\rv 0 4 0\nf 1 2 3").vertices, triangle_corners);
}

TEST(ReadObj, hits_what_an_old_mac_wrote) {
  const Mesh<double> mesh = read_obj<double>("# made by hand\rv 0 0 0\rv 4 0 0\rv 0 4 0\rf 1 2 3\r");
  const auto hit = Colliderd(mesh.view()).first_hit(Segmentd{{1, 1, 5}, {1, 1, -5}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0u);
  EXPECT_EQ(hit->t, 0.5);
  EXPECT_EQ(hit->u, 0.25);
  EXPECT_EQ(hit->v, 0.25);
}

TEST(ReadObj, counts_lines_by_any_ends) {
  const std::string text = "# a\n\nv 0 0 0\nv 4 0 0\nv 0 x 0\n";
  for (const std::string_view end : line_ends) {
    EXPECT_EQ(error_in(with_line_ends(text, end)), "line 5: 'x' is not a number");
  }
  EXPECT_EQ(error_in(with_mixed_line_ends(text)), "line 5: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 0\r\r\n\n\rv 0 0\n"), "line 5: a vertex needs 3 coordinates, not 2");
}

TEST(ReadObj, continues_lines_with_any_ends) {
  const std::string text = "v 0 0 0\nv 4 0 \\\n 0\nv \\\n0\\\n 4 0\n# no more \\\nf 1 \\\n2\\\n\t3\n";
  for (const std::string_view end : line_ends) {
    const Mesh<float> mesh = read_obj<float>(with_line_ends(text, end));
    EXPECT_EQ(mesh.vertices, triangle_corners);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  }
  EXPECT_EQ(read_obj<float>(with_mixed_line_ends(text)).vertices, triangle_corners);
  for (const std::string_view end : line_ends) {
    EXPECT_EQ(error_in(with_line_ends(square + "f 1 \\\n 2 \\\n x\nf 1 2 3", end)), "line 7: 'x' is not a face corner");
    EXPECT_EQ(error_in(with_line_ends(square + "f 1 2 \\\n 3\nf 1 2", end)),
              "line 7: a face needs 3 corners or more, not 2");
  }
}

TEST(ReadObj, takes_a_closing_control_z) {
  for (const std::string_view closing : closing_control_z) {
    const Mesh<float> mesh = read_obj<float>(triangle + std::string(closing));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(read_obj<float>("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3" + std::string(closing)).vertices, triangle_corners);
  }
  EXPECT_EQ(error_in(triangle + "\x1a\nv 0 0 0"), "line 5: unknown statement '?'");
  EXPECT_EQ(error_in("v 0 0 0\x1a\nv 4 0 0"), "line 1: '0?' is not a number");
}

TEST(ReadObj, takes_comments_blank_lines_and_continued_lines) {
  EXPECT_EQ(read_obj<float>("# a square\n\n" + square + "f 1 2 \\\n 3 4 # and its fan\n").triangles.size(), 2u);
  EXPECT_EQ(read_obj<float>(square + "f 1 2 3\\\n4").triangles.size(), 2u);
  EXPECT_EQ(read_obj<float>(square + "f 1 2 \\ # and so on\n 3 4").triangles.size(), 2u);
  EXPECT_EQ(read_obj<float>(" \t# indented\n" + square + "f 1 2 3\t# after a tab\nf 1 2 3 #4\n").triangles.size(), 2u);
}

TEST(ReadObj, begins_no_comment_inside_a_word) {
  EXPECT_EQ(error_in(square + "f 1 2 3#4\n"), "line 5: '3#4' is not a face corner");
  EXPECT_EQ(error_in("v 0 0 0#1\n"), "line 1: '0#1' is not a number");
  EXPECT_EQ(read_obj<float>("o part#1\nusemtl #red\n" + triangle).triangles.size(), 1u);
}

TEST(ReadObj, names_line_and_value_of_a_number_that_old_windows_wrote) {
  for (const std::string value : {"1.#QNAN", "-1.#IND00", "1.#INF", "1.#IND", "-1.#INF", "1.#QNAN0"}) {
    const std::string error = "line 3: '" + value + "' is not a number";
    EXPECT_EQ(error_in("v 0 0 0\nv 4 0 0\nv 0 4 " + value + "\nf 1 2 3\n"), error);
    EXPECT_EQ(error_in("v 0 0 0\nv 4 0 0\nv " + value + " 0 4\n"), error);
    EXPECT_EQ(error_in("v 0 0 0\nv 4 0 0\nv 0 4 0 " + value + "\nf 1 2 3\n"), error);
    EXPECT_EQ(error_in("v 0 0 0\nv 4 0 0\nv 0 4 0 1 1 " + value + "\nf 1 2 3\n"), error);
    EXPECT_EQ(error_in(with_line_ends("v 0 0 0\nv 4 0 0\nv 0 4 " + value + "\nf 1 2 3\n", "\r")), error);
  }
}

TEST(ReadObj, checks_every_field_of_a_vertex) {
  EXPECT_EQ(error_in("v 0 0 0 v 4 0 0\n"), "line 1: 'v' is not a number");
  EXPECT_EQ(error_in("v x 0 0"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 x 0"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 x"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 0 x"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 0 1 1 x"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 0 1 1 1 x"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("v 1,5 0 0"), "line 1: '1,5' is not a number");
  EXPECT_EQ(error_in("v"), "line 1: a vertex needs 3 coordinates, not 0");
  EXPECT_EQ(error_in("v 1"), "line 1: a vertex needs 3 coordinates, not 1");
  EXPECT_EQ(error_in("v 1 2"), "line 1: a vertex needs 3 coordinates, not 2");
  const std::string too_many =
      "line 1: a vertex has 3 coordinates and then nothing, a weight, or a color of 3 or 4 "
      "numbers, but here are ";
  EXPECT_EQ(error_in("v 1 2 3 4 5"), too_many + "5 numbers");
  EXPECT_EQ(error_in("v 1 2 3 4 5 6 7 8"), too_many + "8 numbers");
  EXPECT_EQ(error_in("v 0 0 0 v 4 0 0 v 0 4 0"), too_many + "11 numbers");
}

TEST(ReadObj, passes_over_colors_of_vertices) {
  const Floats expected = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(read_obj<float>("v 1 2 3 1 0.5 0\nv 4 5 6 255 0 1\nv 7 8 9 -1 nan 2").vertices, expected);
  EXPECT_EQ(read_obj<float>("v 1 2 3 1 0.5 0 1\nv 4 5 6 0 0 0 0.5\nv 7 8 9 1 1 1 2").vertices, expected);
  EXPECT_EQ(read_obj<float>("v 1 2 3\nv 4 5 6 1 1 1\nv 7 8 9 1 1 1 1").vertices, expected);
}

TEST(ReadObj, divides_by_a_weight) {
  EXPECT_EQ(read_obj<float>("v 1 2 3 1\nv 1 2 3 1.0\nv 1 2 3 +1e0").vertices,
            (Floats{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(read_obj<float>("v 2 -4 7 2\nv 2 -4 7 0.5\nv 2 -4 7 -1").vertices,
            (Floats{{1, -2, 3.5f}, {4, -8, 14}, {-2, 4, -7}}));
  EXPECT_EQ(read_obj<double>("v 1 2 3 3").vertices, (Doubles{{1.0 / 3, 2.0 / 3, 1}}));
  EXPECT_EQ(read_obj<float>("v 0.1 2 3 3").vertices, (Floats{{0.1f / 3, 2.0f / 3, 1}}));
  // A quotient may round to a denormal or to zero.
  EXPECT_EQ(read_obj<float>("v 1e-38 1e-45 -1e-45 1e5").vertices, (Floats{{1e-38f / 1e5f, 0, -0.0f}}));
}

TEST(ReadObj, names_a_weight_that_makes_no_point) {
  EXPECT_EQ(error_in(square + "v 1 2 3 0"), "line 5: a vertex of weight '0' is no point");
  EXPECT_EQ(error_in("v 1 2 3 -0.0"), "line 1: a vertex of weight '-0.0' is no point");
  EXPECT_EQ(error_in("v 1 2 3 1e-99"), "line 1: a vertex of weight '1e-99' is no point");
  EXPECT_EQ(error_in("v 1 2 3 nan"), "line 1: a vertex of weight 'nan' is no point");
  EXPECT_EQ(error_in("v 1 2 3 -inf"), "line 1: a vertex of weight '-inf' is no point");
  EXPECT_EQ(error_in("v 1 2 3 1e39"), "line 1: '1e39' is beyond the largest float");
  EXPECT_EQ(error_in("v 0 0 0\nv 1 1e38 3 -1e-5"),
            "line 2: divided by its weight '-1e-5', a coordinate is beyond the largest number");
  EXPECT_EQ(read_obj<double>("v 1 1e38 3 1e-5").vertices[0][1], 1e38 / 1e-5);
}

TEST(ReadObj, warns_of_vertices_that_are_not_finite_where_no_face_uses_them) {
  const Mesh<float> one = read_obj<float>("v 0 0 0\nv 4 0 0\nv nan 0 0\nv 0 4 0\nf 1 2 4\n");
  EXPECT_EQ(one.warnings, Warnings{"1 vertex is not finite, the first of them vertex 2 of line 3; no face uses them"});
  EXPECT_EQ(one.triangles, (Triangles{{0, 1, 3}}));
  EXPECT_FALSE(find_invalid(one.view()));

  const Mesh<double> three = read_obj<double>(triangle + "v 0 -inf 0\nv nan nan nan\nv 1 2 3\nv 0 0 infinity\n");
  EXPECT_EQ(three.warnings,
            Warnings{"3 vertices are not finite, the first of them vertex 3 of line 5; no face uses them"});
  EXPECT_EQ(three.vertices[5], (std::array<double, 3>{1, 2, 3}));
  EXPECT_FALSE(find_invalid(three.view()));

  const Mesh<float> all = read_obj<float>("v inf 0 0");
  EXPECT_FALSE(find_invalid(all.view()));
  EXPECT_EQ(all.warnings, (Warnings{"1 vertex is not finite, the first of them vertex 0 of line 1; no face uses them",
                                    example::no_triangles}));
}

TEST(ReadObj, names_a_face_of_a_vertex_that_is_not_finite) {
  const std::string vertices = "v 0 0 0\nv 4 0 inf\nv 0 4 0\nv 1 nan 0\nv 0 -inf nan 2\n";
  EXPECT_EQ(error_in(vertices + "f 1 3 2\n"), "line 6: face 0 uses vertex 1 of line 2, of which z is infinite");
  EXPECT_EQ(error_in(vertices + "f 1 1 1\nf 1 3 4\n"), "line 7: face 1 uses vertex 3 of line 4, of which y is nan");
  EXPECT_EQ(error_in(vertices + "f 1 3 -1\n"), "line 6: face 0 uses vertex 4 of line 5, of which y is infinite");
  EXPECT_EQ(error_in("f 1 3 2\n" + vertices), "line 1: face 0 uses vertex 1 of line 3, of which z is infinite");
  EXPECT_EQ(error_in(with_line_ends("\nf 1 1 1\nf 1 3 4 \\\n 3\n" + vertices, "\r")),
            "line 4: face 1 uses vertex 3 of line 8, of which y is nan");
}

TEST(ReadObj, passes_over_what_adds_no_surface) {
  EXPECT_TRUE(read_obj<float>("mtllib a.mtl\no name\ng\ns off\nusemtl red\nl 1 2\np 1\n").triangles.empty());
  EXPECT_EQ(read_obj<float>("vn 1.#QNAN 0 0\nvt x\n" + triangle).triangles.size(), 1u);
}

TEST(ReadObj, warns_of_a_mesh_of_nothing) {
  for (const char* text : {"", "\n", "# nothing\n", "\x1a", "v 0 0 0\nv 4 0 0\nv 0 4 0\n", "o name\nl 1 2\n"}) {
    const Mesh<float> mesh = read_obj<float>(text);
    EXPECT_TRUE(mesh.triangles.empty()) << text;
    EXPECT_EQ(mesh.face_count(), 0u) << text;
    EXPECT_EQ(mesh.warnings, Warnings{example::no_triangles}) << text;
  }
}

TEST(ReadObj, names_the_line_of_an_error) {
  EXPECT_EQ(error_in("\n\nv 0 0 x\n"), "line 3: 'x' is not a number");
  EXPECT_EQ(error_in("v 0 0 1e39"), "line 1: '1e39' is beyond the largest float");
  EXPECT_EQ(error_in(square + "f 1 2"), "line 5: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in(square + "f"), "line 5: a face needs 3 corners or more, not 0");
  EXPECT_EQ(error_in(square + "f 1 2 0"), "line 5: vertex indices count from 1, there is no vertex 0");
  EXPECT_EQ(error_in(square + "f 1 2 5\nf 1 2 3"), "line 5: vertex index 5 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("f 1 2 3 9\n" + square), "line 1: vertex index 9 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in(square + "f 1 2 -5"), "line 5: vertex index -5 reaches back before the first of 4 vertices");
  EXPECT_EQ(error_in(square + "f 1 2 99999999999"), "line 5: a vertex index is beyond 32 bits");
  EXPECT_EQ(error_in(square + "f 1 2 99999999999999999999"), "line 5: '99999999999999999999' is beyond 64 bits");
  EXPECT_EQ(error_in(square + "f 1 2 three"), "line 5: 'three' is not a face corner");
  EXPECT_EQ(error_in(square + "f 1 2 /3"), "line 5: '' is not an integer");
  EXPECT_EQ(error_in(square + "f 1 2 \\"), "line 5: the file ends where a backslash promises another line");
  EXPECT_EQ(error_in(square + "f 1 2 3 \\\n\x1a"), "line 5: the file ends where a backslash promises another line");
  EXPECT_EQ(error_in("surf 0 1 0 1"), "line 1: unknown statement 'surf'");
}

TEST(ReadObj, makes_an_error_or_a_mesh_of_any_bytes) {
  expect_error_or_sound_mesh("# square\n" + square + "vt 0 0\nf 1 2 3 4\nf -4/1/2 -2//1 \\\n -1/1\ng end\n",
                             read_obj<float>);
  expect_error_or_sound_mesh(
      "f 1 2 3 4 \\\r 5 6\rv 0 0 0 2\rv 4 0 0\rv 4 2 0 1 0 0\r\nv 2 2 0\rv 2 4 0\rv 0 4 0 1\n"
      "v nan 0 inf\n#1.#QNAN\n\x1a",
      read_obj<double>);
  expect_error_or_sound_mesh(text_of(placed(wall_plane, keyholed_wall)), read_obj<float>);
}

}  // namespace
}  // namespace surehit::test::read_obj_test
