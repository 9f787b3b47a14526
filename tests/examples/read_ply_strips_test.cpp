// The strips of triangles that `read_ply` reads.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mesh_io/read_ply.hpp"
#include "mutations.hpp"
#include "ply_lines.hpp"
#include "surehit/collider.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_ply_strips_test {
namespace {

using example::Mesh;
using example::read_ply;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Faces = std::vector<std::uint32_t>;
using Warnings = std::vector<std::string>;

std::string error_in(const std::string& bytes) {
  return error_of([&] { return read_ply<float>(bytes); });
}

const std::string strip_list = "property list int int vertex_indices\n";

/// A file of the corners of a strip of unit squares, and of the strips.
std::string ascii_strips(const std::string& strips, std::size_t count = 1) {
  return "ply\nformat ascii 1.0\nelement vertex 6\n" + vertex_lines + "element tristrips " + std::to_string(count) +
         "\n" + strip_list + "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n" + strips;
}

template <typename Append>
std::string binary_strips(const std::vector<std::int32_t>& strip, const std::string& format, Append append) {
  std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 6\n" + vertex_lines + "element tristrips 1\n" +
                      strip_list + "end_header\n";
  for (const auto& [x, y] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}}) {
    append(static_cast<float>(x), bytes);
    append(static_cast<float>(y), bytes);
    append(0.0f, bytes);
  }
  append(static_cast<std::int32_t>(strip.size()), bytes);
  for (const std::int32_t corner : strip) append(corner, bytes);
  return bytes;
}

TEST(ReadPlyStrips, become_triangles) {
  struct Case {
    std::vector<std::int32_t> strip;
    Triangles triangles;
  };
  const Case cases[] = {
      {{0, 1, 2}, {{0, 1, 2}}},
      // Every second triangle is turned, so all look the same way.
      {{0, 1, 2, 3, 4, 5}, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}},
      // -1 begins anew, with a triangle that is not turned.
      {{0, 1, 2, 3, -1, 2, 3, 4, 5}, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}},
      {{0, 1, 2, -1, 3, 4, 5, -1}, {{0, 1, 2}, {3, 4, 5}}},
      {{-1, -1, 0, 1, 2, -1, -1, 5}, {{0, 1, 2}}},
      {{0, 1, -1, 2, 3, 4}, {{2, 3, 4}}},
      // Stitches: corners named twice lead on, and count on.
      {{0, 1, 2, 2, 3, 3, 4, 5}, {{0, 1, 2}, {4, 3, 5}}},
      {{0, 1, 2, 2, 3, 4, 5}, {{0, 1, 2}, {3, 2, 4}, {3, 4, 5}}},
      {{0, 1, 0, 2}, {{0, 1, 2}}},
      {{0, 0, 1, 2}, {{1, 0, 2}}},
      {{}, {}},
      {{0, 1}, {}},
      {{0, 1, 1, 1, 0}, {}},
  };
  for (const auto& [strip, triangles] : cases) {
    std::string line = std::to_string(strip.size());
    for (const std::int32_t corner : strip) line += " " + std::to_string(corner);
    for (const Mesh<float>& mesh : {read_ply<float>(ascii_strips(line)),
                                    read_ply<float>(binary_strips(strip, "binary_little_endian", little_endian)),
                                    read_ply<float>(binary_strips(strip, "binary_big_endian", big_endian))}) {
      EXPECT_EQ(mesh.triangles, triangles) << line;
      EXPECT_TRUE(mesh.faces.empty()) << line;
      EXPECT_EQ(mesh.face_count(), triangles.size()) << line;
      EXPECT_EQ(mesh.warnings, triangles.empty() ? Warnings{example::no_triangles} : Warnings{}) << line;
    }
  }
}

TEST(ReadPlyStrips, look_the_same_way_with_all_triangles) {
  const Mesh<float> mesh = read_ply<float>(ascii_strips("6 0 1 2 3 4 5"));
  const Colliderf collider(mesh.view());
  for (const float x : {0.25f, 0.75f, 1.25f, 1.75f}) {
    const auto hit = collider.first_hit(Segmentf{{x, 0.5f, -1}, {x, 0.5f, 1}});
    ASSERT_TRUE(hit) << x;
    EXPECT_EQ(hit->side, Side::front) << x;
  }
}

TEST(ReadPlyStrips, may_be_several_with_faces_beside_them) {
  EXPECT_EQ(read_ply<float>(ascii_strips("3 0 1 2\n4 2 3 4 5\n", 2)).triangles,
            (Triangles{{0, 1, 2}, {2, 3, 4}, {4, 3, 5}}));
  const std::string vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  const std::string start = "ply\nformat ascii 1.0\nelement vertex 6\n" + vertex_lines;
  const std::string faces = "element face 1\n" + face_line;
  const std::string strips = "element tristrips 1\n" + strip_list;
  const Mesh<float> faces_first =
      read_ply<float>(start + faces + strips + "end_header\n" + vertices + "4 0 2 3 1\n4 2 3 4 5\n");
  EXPECT_EQ(faces_first.triangles, (Triangles{{0, 2, 3}, {0, 3, 1}, {2, 3, 4}, {4, 3, 5}}));
  EXPECT_EQ(faces_first.faces, (Faces{0, 0, 1, 2}));
  EXPECT_EQ(faces_first.face_count(), 3u);
  const Mesh<float> strips_first =
      read_ply<float>(start + strips + faces + "end_header\n" + vertices + "4 2 3 4 5\n4 0 2 3 1\n");
  EXPECT_EQ(strips_first.triangles, (Triangles{{2, 3, 4}, {4, 3, 5}, {0, 2, 3}, {0, 3, 1}}));
  EXPECT_EQ(strips_first.faces, (Faces{0, 1, 2, 2}));
  EXPECT_EQ(strips_first.face_of(1), 1u);
  // An element of no faces needs no list beside strips.
  EXPECT_EQ(
      read_ply<float>(start + "element face 0\n" + strips + "end_header\n" + vertices + "3 0 1 2\n").triangles.size(),
      1u);
}

TEST(ReadPlyStrips, are_named_in_errors) {
  EXPECT_EQ(error_in(ascii_strips("4 0 1 2 6\n")),
            "line 16: tristrips 0: vertex index 6 is out of range, there are 6 vertices");
  EXPECT_EQ(error_in(ascii_strips("3 0 1 2\n4 -1 0 -2 1\n", 2)),
            "line 17: tristrips 1: vertex index -2 is out of range, there are 6 vertices");
  EXPECT_EQ(error_in(ascii_strips("4 0 1 2\n")), "line 16: tristrips 0: the line ends too early");
  EXPECT_EQ(error_in(ascii_strips("3 0 1 2 3\n")), "line 16: tristrips 0: '3' is more than the header announces");
  EXPECT_EQ(error_in(ascii_strips("")), "line 15: tristrips 0: the file ends too early");
  EXPECT_EQ(error_in(binary_strips({0, 1, 6}, "binary_big_endian", big_endian)),
            "tristrips 0: vertex index 6 is out of range, there are 6 vertices");
  EXPECT_EQ(error_in(binary_strips({0, 1, 2, -1, -2}, "binary_little_endian", little_endian)),
            "tristrips 0: vertex index -2 is out of range, there are 6 vertices");
  const std::string cut = binary_strips({0, 1, 2}, "binary_little_endian", little_endian);
  EXPECT_EQ(error_in(cut.substr(0, cut.size() - 1)), "tristrips 0: the file ends too early");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\nelement vertex 0\n" + vertex_lines + "element tristrips 1\nend_header\n"),
            "line 8: the element tristrips has no list 'vertex_indices' of integers");
}

TEST(ReadPlyStrips, make_an_error_or_a_mesh_of_any_bytes) {
  expect_error_or_sound_mesh(with_line_ends(ascii_strips("8 0 1 2 -1 2 3 4 5\n\x1a"), "\r"), read_ply<double>);
  expect_error_or_sound_mesh(binary_strips({0, 1, 2, 3, -1, 3, 4, 5}, "binary_big_endian", big_endian),
                             read_ply<float>);
}

}  // namespace
}  // namespace surehit::test::read_ply_strips_test
