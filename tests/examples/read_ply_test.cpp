#include "mesh_io/read_ply.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mutations.hpp"
#include "ply_lines.hpp"
#include "sample_polygons.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_ply_test {
namespace {

using example::Mesh;
using example::read_ply;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Floats = std::vector<std::array<float, 3>>;
using Faces = std::vector<std::uint32_t>;
using Warnings = std::vector<std::string>;

std::string header(const std::string& format, std::uint64_t vertices, std::uint64_t faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" + vertex_lines +
         "element face " + std::to_string(faces) + "\n" + face_line + "end_header\n";
}

std::string error_in(const std::string& bytes) {
  return error_of([&] { return read_ply<float>(bytes); });
}

/// What an error says that is about a header, here of `lines` between the format and the end.
std::string error_in_header(const std::string& lines) {
  return error_in("ply\nformat ascii 1.0\n" + lines + "end_header\n");
}

/// A body in binary: corners of a unit square and the square itself, with properties and elements around them that
/// nobody needs.
template <typename Append>
std::string busy_binary_square(const std::string& format, Append append) {
  std::string bytes =
      "ply\nformat " + format +
      " 1.0\ncomment made by hand\nobj_info nothing\nelement material 2\nproperty list ushort double weights\nproperty "
      "char kind\n"
      "element vertex 4\nproperty uchar red\nproperty double x\nproperty list int short tags\nproperty float y\n"
      "property short z\nelement face 1\nproperty float area\nproperty list ushort uint vertex_index\nproperty int "
      "group\n"
      "element edge 0\nproperty int a\nend_header\n";
  for (const std::uint16_t weights : {std::uint16_t{2}, std::uint16_t{0}}) {
    append(weights, bytes);
    for (std::uint16_t i = 0; i < weights; ++i) append(0.5, bytes);
    append(std::int8_t{-1}, bytes);
  }
  for (std::int32_t i = 0; i < 4; ++i) {
    append(std::uint8_t{255}, bytes);
    append(i == 1 || i == 2 ? 1.00000005960464477540 : 0.0, bytes);
    append(i, bytes);
    for (std::int16_t tag = 0; tag < i; ++tag) append(tag, bytes);
    append(i >= 2 ? 0.1f : 0.0f, bytes);
    append(std::int16_t{-7}, bytes);
  }
  append(2.0f, bytes);
  append(std::uint16_t{4}, bytes);
  for (std::uint32_t corner = 0; corner < 4; ++corner) append(corner, bytes);
  append(std::int32_t{9}, bytes);
  return bytes;
}

std::string ascii_text_of(const SampleFace& face) {
  std::string text = header("ascii", face.vertices.size(), 1);
  for (const auto& [x, y, z] : face.vertices) {
    text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  text += std::to_string(face.corners.size());
  for (const std::uint32_t corner : face.corners) text += " " + std::to_string(corner);
  return text + "\n";
}

template <typename Append>
std::string bytes_of(const SampleFace& face, const std::string& format, Append append) {
  std::string bytes = header(format, face.vertices.size(), 1);
  for (const auto& vertex : face.vertices) {
    for (const std::int64_t coordinate : vertex) append(static_cast<float>(coordinate), bytes);
  }
  append(static_cast<std::uint8_t>(face.corners.size()), bytes);
  for (const std::uint32_t corner : face.corners) append(static_cast<std::int32_t>(corner), bytes);
  return bytes;
}

std::string little_endian_bytes_of(const SampleFace& face) {
  return bytes_of(face, "binary_little_endian", little_endian);
}

std::string big_endian_bytes_of(const SampleFace& face) { return bytes_of(face, "binary_big_endian", big_endian); }

const std::string ascii_square = header("ascii", 4, 2) + "0 0 0\n1 0 0\n1 1 0\n0 0.1 0\n4 0 1 2 3\n3 3 2 1\n";

TEST(ReadPly, reads_text) {
  const Mesh<double> mesh = read_ply<double>(ascii_square);
  const std::vector<std::array<double, 3>> expected = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0.1, 0}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
  EXPECT_EQ(mesh.faces, (Faces{0, 0, 1}));
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(ReadPly, cuts_concave_faces_in_text) {
  expect_every_sample_is_cut_rightly<float>(
      [](const SampleFace& face) { return read_ply<float>(ascii_text_of(face)); });
}

TEST(ReadPly, cuts_concave_faces_in_bytes_of_either_order) {
  expect_every_sample_is_cut_rightly<double>(
      [](const SampleFace& face) { return read_ply<double>(little_endian_bytes_of(face)); });
  expect_every_sample_is_cut_rightly<float>(
      [](const SampleFace& face) { return read_ply<float>(big_endian_bytes_of(face)); });
}

TEST(ReadPly, leaves_the_window_of_a_keyholed_wall_open) {
  for (const auto write : {ascii_text_of, little_endian_bytes_of, big_endian_bytes_of}) {
    expect_keyholed_wall_has_its_window([&](const SampleFace& face) { return read_ply<double>(write(face)); });
  }
}

TEST(ReadPly, names_the_face_whose_outline_crosses_itself) {
  const SampleFace bow_tie = {{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}, {0, 1, 2, 3}};
  const std::string error = "face 0 of 4 corners has no valid triangulation: its outline crosses itself";
  EXPECT_EQ(error_in(ascii_text_of(bow_tie)), "line 14: " + error);
  EXPECT_EQ(error_in(with_line_ends(ascii_text_of(bow_tie), "\r")), "line 14: " + error);
  EXPECT_EQ(error_in(little_endian_bytes_of(bow_tie)), error);
  EXPECT_EQ(error_in(big_endian_bytes_of(bow_tie)), error);
  EXPECT_EQ(error_in(header("ascii", 4, 3) + "0 0 0\n4 4 0\n4 0 0\n0 4 0\n3 0 1 2\n\n4 0 2 1 3\n4 3 2 1 0\n"),
            "line 17: face 2 of 4 corners has no valid triangulation: its outline crosses itself");
}

TEST(ReadPly, reads_faces_before_their_vertices) {
  const std::string start =
      "ply\nformat ascii 1.0\nelement face 2\n" + face_line + "element vertex 6\n" + vertex_lines + "end_header\n";
  const std::string l = "0 0 0\n4 0 0\n4 2 0\n2 2 0\n2 4 0\n0 4 0\n";
  const Mesh<float> mesh = read_ply<float>(start + "3 0 1 2\n6 2 3 4 5 0 1\n" + l);
  EXPECT_EQ(mesh.faces, (Faces{0, 1, 1, 1, 1}));
  EXPECT_FALSE(Colliderf(mesh.view()).any_hit(Segmentf{{3, 3, 5}, {3, 3, -5}}));
  EXPECT_TRUE(Colliderf(mesh.view()).any_hit(Segmentf{{1, 3, 5}, {1, 3, -5}}));
  EXPECT_EQ(error_in(start + "3 0 1 2\n4 0 2 1 3\n" + l),
            "line 11: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
  EXPECT_EQ(error_in(start + "3 0 1 6\n4 0 2 1 3\n" + l),
            "line 10: face 0: vertex index 6 is out of range, there are 6 vertices");
}

TEST(ReadPly, tells_which_face_a_triangle_is_of) {
  const std::string l = "0 0 0\n4 0 0\n4 2 0\n2 2 0\n2 4 0\n0 4 0\n";
  const Mesh<float> mesh = read_ply<float>(header("ascii", 6, 4) + l + "3 0 1 2\n6 0 1 2 3 4 5\n4 0 1 2 3\n3 3 4 5\n");
  EXPECT_EQ(mesh.faces, (Faces{0, 1, 1, 1, 1, 2, 2, 3}));
  EXPECT_EQ(mesh.face_count(), 4u);
  const Mesh<float> triangles = read_ply<float>(header("ascii", 6, 2) + l + "3 0 1 2\n3 3 4 5\n");
  EXPECT_TRUE(triangles.faces.empty());
  EXPECT_EQ(triangles.face_of(1), 1u);
}

TEST(ReadPly, takes_any_line_ends_in_text) {
  for (const std::string_view end : line_ends) {
    const Mesh<float> mesh = read_ply<float>(with_line_ends(ascii_square, end));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
    EXPECT_EQ(error_in(with_line_ends(header("ascii", 3, 1) + "0 0 0\n\n1 0\n", end)),
              "line 12: vertex 1: the line ends too early");
    EXPECT_EQ(error_in(with_line_ends("ply\nformat ascii 1.0\nelement vertex x\n", end)),
              "line 3: 'x' is not an integer");
  }
  EXPECT_EQ(read_ply<float>(with_mixed_line_ends(ascii_square)).vertices.size(), 4u);
}

/// Three vertices whose first byte, and whole first coordinate, are as they are told.
template <typename Append>
std::string bytes_that_begin_with(std::string_view first, std::string_view line_end, const std::string& format,
                                  Append append) {
  std::string bytes = with_line_ends(header(format, 3, 1), line_end);
  bytes += first;
  for (std::size_t i = 1; i < 9; ++i) append(static_cast<float>(i), bytes);
  append(std::uint8_t{3}, bytes);
  for (std::int32_t corner = 0; corner < 3; ++corner) append(corner, bytes);
  return bytes;
}

TEST(ReadPly, reads_bytes_behind_any_line_end_whatever_they_begin_with) {
  for (const std::string_view line_end : line_ends) {
    for (const std::string_view first :
         {"\x0a\x0b\x0c\x3d", "\x0d\x0b\x0c\x3d", "\x0d\x0a\x0c\x3d", "\x0a\x0d\x0c\x3d", "\x0a\x0a\x0a\x0a",
          "\x0d\x0d\x0d\x0d", "\x1a\x1a\x1a\x1a", "\x0a\x1a\x0a\x1a", "\x20\x20\x0a\x0d"}) {
      const auto little = std::bit_cast<std::uint32_t>(std::array<char, 4>{first[0], first[1], first[2], first[3]});
      const auto big = std::bit_cast<std::uint32_t>(std::array<char, 4>{first[3], first[2], first[1], first[0]});
      const auto in_little =
          read_ply<float>(bytes_that_begin_with(first, line_end, "binary_little_endian", little_endian));
      const auto in_big = read_ply<float>(bytes_that_begin_with(first, line_end, "binary_big_endian", big_endian));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(in_little.vertices[0][0]), little);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(in_big.vertices[0][0]), big);
      EXPECT_EQ(in_little.vertices[2], (std::array<float, 3>{6, 7, 8}));
      EXPECT_EQ(in_big.vertices[2], (std::array<float, 3>{6, 7, 8}));
      EXPECT_EQ(in_big.triangles, (Triangles{{0, 1, 2}}));
    }
  }
}

TEST(ReadPly, reads_bytes_that_are_all_white_space_or_control_z) {
  for (const std::string_view line_end : line_ends) {
    for (const char byte : {'\n', '\r', '\x1a', ' '}) {
      const std::string bytes =
          with_line_ends(header("binary_little_endian", 3, 0), line_end) + std::string(3 * 12, byte);
      const float number = std::bit_cast<float>(std::array<char, 4>{byte, byte, byte, byte});
      const Floats expected(3, {number, number, number});
      EXPECT_EQ(read_ply<float>(bytes).vertices, expected);
      EXPECT_EQ(error_in(bytes.substr(0, bytes.size() - 1)), "vertex 2: the file ends too early");
    }
  }
}

TEST(ReadPly, takes_a_closing_control_z) {
  for (const std::string_view closing : closing_control_z) {
    EXPECT_EQ(read_ply<float>(ascii_square + std::string(closing)).triangles.size(), 3u);
  }
  for (const char* closing : {"\x1a", "\x1a\x1a", "\n", "\r\n", "\n\x1a", "\r\n\x1a\r\n"}) {
    EXPECT_EQ(read_ply<float>(busy_binary_square("binary_little_endian", little_endian) + closing).triangles.size(),
              2u);
    EXPECT_EQ(read_ply<float>(busy_binary_square("binary_big_endian", big_endian) + closing).triangles.size(), 2u);
  }
  EXPECT_EQ(error_in(ascii_square + "\x1a\n3 0 1 2\n"), "line 16: something follows the last element");
}

TEST(ReadPly, keeps_a_last_byte_that_is_a_control_z) {
  const auto with_last = [](std::uint32_t last, const std::string& format, auto append) {
    std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 27\n" + vertex_lines +
                        "element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
    for (int i = 0; i < 27 * 3; ++i) append(static_cast<float>(i % 5), bytes);
    append(std::uint8_t{3}, bytes);
    for (const std::uint32_t corner : {0u, 1u, last}) append(corner, bytes);
    return bytes;
  };
  const std::string big = with_last(26, "binary_big_endian", big_endian);
  ASSERT_EQ(big.back(), '\x1a');
  for (const char* closing : {"", "\x1a", "\n\x1a"}) {
    EXPECT_EQ(read_ply<float>(big + closing).triangles, (Triangles{{0, 1, 26}}));
  }
  const std::string little = with_last(0x1a000000, "binary_little_endian", little_endian);
  ASSERT_EQ(little.back(), '\x1a');
  EXPECT_EQ(error_in(little), "face 0: vertex index 436207616 is out of range, there are 27 vertices");
}

TEST(ReadPly, reads_a_file_of_no_faces) {
  const std::string vertices = "ply\nformat ascii 1.0\nelement vertex 2\n" + vertex_lines;
  for (const std::string faces :
       {"", "element face 0\n", "element face 0\nproperty list uchar int vertex_indices\n",
        "element face 0\nproperty int a\n", "element tristrips 0\n", "element face 0\nelement tristrips 0\n"}) {
    const Mesh<float> mesh = read_ply<float>(vertices + faces + "end_header\n0 0 0\n1 2 3\n");
    EXPECT_EQ(mesh.vertices, (Floats{{0, 0, 0}, {1, 2, 3}})) << faces;
    EXPECT_EQ(mesh.face_count(), 0u) << faces;
    EXPECT_EQ(mesh.warnings, Warnings{example::no_triangles}) << faces;
  }
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + vertex_lines + "end_header\n";
  for (const float coordinate : {1.0f, 2.0f, 3.0f}) append_little_endian(coordinate, bytes);
  EXPECT_EQ(read_ply<float>(bytes).vertices, (Floats{{1, 2, 3}}));
  EXPECT_EQ(read_ply<float>(bytes).warnings, Warnings{example::no_triangles});
}

TEST(ReadPly, says_what_is_wrong_with_its_first_line) {
  const std::string alone = "line 1: the first line of a PLY file is ply alone, but here it ";
  for (const char* blank : {"ply \n", "ply\t\n", " ply\n", "ply  \r\n", "ply \r", "ply "}) {
    EXPECT_EQ(error_in(blank + std::string("format ascii 1.0\n")).substr(0, alone.size()), alone) << blank;
  }
  EXPECT_EQ(error_in("ply \nformat ascii 1.0\n"), alone + "has a blank beside it");
  EXPECT_EQ(error_in("ply"), "line 1: the file ends within the header");
  EXPECT_EQ(error_in("ply x\nformat ascii 1.0\n"), alone + "goes on with 'x'");
  EXPECT_EQ(error_in("ply format ascii 1.0\n"), alone + "goes on with 'format'");
  EXPECT_EQ(error_in("PLY\nformat ascii 1.0\n"), "line 1: a PLY file begins with a line: ply");
  EXPECT_EQ(error_in("plyx\nformat ascii 1.0\n"), "line 1: a PLY file begins with a line: ply");
  EXPECT_EQ(error_in("\nply\n"), "line 1: a PLY file begins with a line: ply");
  EXPECT_EQ(error_in(""), "a PLY file begins with a line: ply");
}

TEST(ReadPly, names_line_and_value_of_a_number_that_old_windows_wrote) {
  for (const std::string value : {"1.#QNAN", "-1.#IND00", "1.#INF", "1.#IND", "-1.#INF"}) {
    const std::string vertices = header("ascii", 3, 1) + "0 0 0\n4 0 0\n";
    EXPECT_EQ(error_in(vertices + "0 4 " + value + "\n3 0 1 2\n"),
              "line 12: vertex 2: '" + value + "' is not a number");
    EXPECT_EQ(error_in(vertices + value + " 4 0\n3 0 1 2\n"), "line 12: vertex 2: '" + value + "' is not a number");
    EXPECT_EQ(error_in(vertices + "0 4 0\n3 0 1 " + value + "\n"),
              "line 13: face 0: '" + value + "' is not an integer");
  }
}

TEST(ReadPly, warns_of_vertices_that_are_not_finite_where_no_face_uses_them) {
  const std::string text = header("ascii", 5, 1) + "0 0 0\nnan 0 0\n4 0 0\n0 -inf inf\n0 4 0\n";
  const Mesh<float> mesh = read_ply<float>(text + "3 0 2 4\n");
  EXPECT_EQ(mesh.warnings,
            Warnings{"2 vertices are not finite, the first of them vertex 1 of line 11; no face uses them"});
  EXPECT_FALSE(find_invalid(mesh.view()));
  EXPECT_EQ(error_in(text + "3 0 2 3\n"), "line 15: face 0 uses vertex 3 of line 13, of which y is infinite");
  EXPECT_EQ(error_in(text + "3 1 2 3\n"), "line 15: face 0 uses vertex 1 of line 11, of which x is nan");

  for (const float number : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const std::int32_t third : {2, 3}) {
      std::string bytes = header("binary_big_endian", 4, 1);
      for (const float coordinate : {0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 0.f, number}) {
        append_big_endian(coordinate, bytes);
      }
      append_big_endian(std::uint8_t{3}, bytes);
      for (const std::int32_t corner : {0, 1, third}) append_big_endian(corner, bytes);
      if (third == 3) {
        EXPECT_EQ(error_in(bytes),
                  std::string("face 0 uses vertex 3, of which z is ") + (std::isnan(number) ? "nan" : "infinite"));
      } else {
        EXPECT_EQ(read_ply<double>(bytes).warnings,
                  Warnings{"1 vertex is not finite, the first of them vertex 3; no face uses them"});
      }
    }
  }
}

TEST(ReadPly, reads_text_with_properties_and_elements_that_nobody_needs) {
  const Mesh<float> mesh = read_ply<float>(
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty int id\r\nproperty float z\r\nproperty float y\r\n"
      "property float x\r\nproperty list uchar int tags\r\nelement nothing 5\r\nelement face 1\r\n"
      "property list uchar int vertex_indices\r\nproperty uchar red\r\nelement edge 1\r\nproperty int "
      "a\r\nend_header\r\n"
      "0 3 2 1 0\r\n\r\n1 6 5 4 2 8 8\r\n2 9 8 7 1 8\r\n3 0 1 2 255\r\n17\r\n");
  const std::vector<std::array<float, 3>> expected = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadPly, reads_bytes_in_either_order) {
  for (const std::string& bytes : {busy_binary_square("binary_little_endian", little_endian),
                                   busy_binary_square("binary_big_endian", big_endian)}) {
    const Mesh<double> mesh = read_ply<double>(bytes);
    constexpr double x = 1.00000005960464477540;
    const std::vector<std::array<double, 3>> expected = {{0, 0, -7}, {x, 0, -7}, {x, 0.1f, -7}, {0, 0.1f, -7}};
    EXPECT_EQ(mesh.vertices, expected);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(ReadPly, rounds_binary_numbers_once) {
  const std::string bytes = busy_binary_square("binary_little_endian", little_endian);
  EXPECT_EQ(read_ply<float>(bytes).vertices[1][0], static_cast<float>(1.00000005960464477540));
  std::string integers =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty uint x\nproperty int y\nproperty char z\n"
      "element face 0\n" +
      face_line + "end_header\n";
  integers += std::string("\xff\xff\xff\x7f\x80\x00\x00\x00\xff", 9);
  const std::vector<std::array<float, 3>> floats = {{4294967040.0f, -2147483648.0f, -1.0f}};
  const std::vector<std::array<double, 3>> doubles = {{4294967167.0, -2147483648.0, -1.0}};
  EXPECT_EQ(read_ply<float>(integers).vertices, floats);
  EXPECT_EQ(read_ply<double>(integers).vertices, doubles);
}

TEST(ReadPly, rounds_text_once_whatever_type_the_header_names) {
  std::string text = header("ascii", 1, 0) + "1.00000005960464477539062500000000000000001 0.1 1e-60\n";
  const std::vector<std::array<float, 3>> floats = {{0x1.000002p0f, 0.1f, 0}};
  const std::vector<std::array<double, 3>> doubles = {{0x1.000001p0, 0.1, 1e-60}};
  EXPECT_EQ(read_ply<float>(text).vertices, floats);
  EXPECT_EQ(read_ply<double>(text).vertices, doubles);
}

TEST(ReadPly, names_the_line_of_an_error_in_the_header) {
  EXPECT_EQ(error_in("solid\n"), "line 1: a PLY file begins with a line: ply");
  EXPECT_EQ(error_in("ply\nelement vertex 1\n"), "line 2: expected: format NAME VERSION");
  EXPECT_EQ(error_in("ply\nformat binary 1.0\n"), "line 2: unknown format 'binary'");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\nelement vertex 1\n"), "line 3: the file ends within the header");
  EXPECT_EQ(error_in_header("element vertex\n"), "line 3: expected: element NAME COUNT");
  EXPECT_EQ(error_in_header("element vertex -1\n"), "line 3: a count is negative: '-1'");
  EXPECT_EQ(error_in_header("element vertex many\n"), "line 3: 'many' is not an integer");
  EXPECT_EQ(error_in_header("element a 1\nelement a 1\n"), "line 4: a second element 'a'");
  EXPECT_EQ(error_in_header("property float x\n"), "line 3: a property before the first element");
  EXPECT_EQ(error_in_header("element a 1\nproperty float\n"),
            "line 4: expected: property TYPE NAME, or: property list COUNT_TYPE TYPE NAME");
  EXPECT_EQ(error_in_header("element a 1\nproperty half x\n"), "line 4: unknown type 'half'");
  EXPECT_EQ(error_in_header("element a 1\nproperty list float int x\n"), "line 4: the count of a list is an integer");
  EXPECT_EQ(error_in_header("element a 1\nproperty int x\nproperty int x\n"), "line 5: a second property 'x'");
  EXPECT_EQ(error_in_header("elements a 1\n"), "line 3: unknown header line 'elements a 1'");
}

TEST(ReadPly, names_what_the_header_lacks) {
  const std::string faces = "element face 0\n" + face_line;
  EXPECT_EQ(error_in_header(faces), "line 5: the header has no element 'vertex'");
  EXPECT_EQ(error_in_header("element vertex 0\nproperty float x\nproperty float y\n" + faces),
            "line 8: the element vertex has no number 'z'");
  EXPECT_EQ(error_in_header("element vertex 0\nproperty list int float x\n" + faces),
            "line 7: the element vertex has no number 'x'");
  for (const std::string list : {"", "property int vertex_indices\n", "property list int float vertex_indices\n"}) {
    const std::string error = error_in_header("element vertex 0\n" + vertex_lines + "element face 1\n" + list);
    EXPECT_NE(error.find("the element face has no list 'vertex_indices' of integers"), std::string::npos) << error;
  }
}

TEST(ReadPly, names_the_line_and_the_element_of_an_error_in_text) {
  const std::string vertices = header("ascii", 3, 1) + "0 0 0\n1 0 0\n1 1 0\n";
  EXPECT_EQ(error_in(header("ascii", 3, 1) + "0 0 0\n1 0\n"), "line 11: vertex 1: the line ends too early");
  EXPECT_EQ(error_in(header("ascii", 3, 1) + "0 0 0 0\n"), "line 10: vertex 0: '0' is more than the header announces");
  EXPECT_EQ(error_in(header("ascii", 3, 1) + "0 0 0x\n"), "line 10: vertex 0: '0x' is not a number");
  EXPECT_EQ(error_in(header("ascii", 3, 1) + "0 0 -1e39\n"), "line 10: vertex 0: '-1e39' is beyond the largest float");
  EXPECT_EQ(error_in(vertices), "line 12: face 0: the file ends too early");
  EXPECT_EQ(error_in(vertices + "2 0 1\n"), "line 13: face 0: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in(vertices + "-3 0 1 2\n"), "line 13: face 0: the count of a list is negative: -3");
  EXPECT_EQ(error_in(vertices + "3 0 1\n"), "line 13: face 0: the line ends too early");
  EXPECT_EQ(error_in(vertices + "3 0 1 3\n"), "line 13: face 0: vertex index 3 is out of range, there are 3 vertices");
  EXPECT_EQ(error_in(vertices + "3 0 1 1.5\n"), "line 13: face 0: '1.5' is not an integer");
  EXPECT_EQ(error_in(vertices + "3 0 1 2\n3 0 1 2\n"), "line 14: something follows the last element");
}

TEST(ReadPly, names_the_element_of_an_error_in_bytes) {
  const std::string vertices = header("binary_little_endian", 1, 1) + std::string(12, '\0');
  EXPECT_EQ(error_in(header("binary_little_endian", 1, 1) + std::string(11, '\0')),
            "vertex 0: the file ends too early");
  EXPECT_EQ(error_in(vertices), "face 0: the file ends too early");
  EXPECT_EQ(error_in(vertices + '\2' + std::string(8, '\0')), "face 0: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in(vertices + '\3' + std::string(8, '\0') + std::string(4, '\xff')),
            "face 0: vertex index -1 is out of range, there are 1 vertices");
  EXPECT_EQ(error_in(vertices + '\3' + std::string(12, '\0') + "left"), "4 bytes follow the last element");
}

/// A message ends at a byte 0 for those who read it as C does; a fuzzer found one that was empty.
TEST(ReadPly, names_an_element_whose_name_is_not_printable) {
  const std::string name(1, '\0');
  EXPECT_EQ(error_in("ply\nformat binary_little_endian 1.0\nelement " + name + " 8\nproperty double x\n" +
                     "element vertex 0\n" + vertex_lines + "element face 0\n" + face_line + "end_header\n"),
            "? 0: the file ends too early");
}

TEST(ReadPly, rejects_binary_doubles_beyond_the_largest_float) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty float y\n"
      "property float z\nelement face 0\n" +
      face_line + "end_header\n";
  append_little_endian(1e39, bytes);
  bytes.append(8, '\0');
  EXPECT_EQ(error_in(bytes), "vertex 0: a coordinate is beyond the largest number");
  EXPECT_EQ(read_ply<double>(bytes).vertices[0][0], 1e39);
}

TEST(ReadPly, takes_no_memory_or_time_on_the_word_of_a_header) {
  constexpr std::uint64_t many = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(error_in(header("ascii", many, many) + "0 0 0\n"), "line 10: vertex 1: the file ends too early");
  EXPECT_EQ(error_in(header("binary_little_endian", many, many)), "vertex 0: the file ends too early");
  EXPECT_EQ(error_in(header("binary_little_endian", 0, many)), "face 0: the file ends too early");
  const std::string count = std::to_string(many);
  EXPECT_TRUE(read_ply<float>("ply\nformat ascii 1.0\nelement nothing " + count + "\nelement vertex 0\n" +
                              vertex_lines + "element face 0\n" + face_line + "end_header\n")
                  .vertices.empty());
}

TEST(ReadPly, takes_no_memory_on_the_word_of_a_list) {
  const std::string tags = "element a 1\nproperty list uint double tags\n";
  const std::string rest =
      "element vertex 0\n" + vertex_lines + "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  const std::string start = "ply\nformat binary_little_endian 1.0\n";
  EXPECT_EQ(error_in(start + tags + rest + "\xff\xff\xff\xff"), "a 0: the file ends too early");
  EXPECT_EQ(error_in(start + rest + "\xff\xff\xff\xff"), "face 0: the file ends too early");
}

TEST(ReadPly, makes_an_error_or_a_mesh_of_any_text) {
  expect_error_or_sound_mesh(ascii_square, read_ply<float>);
  expect_error_or_sound_mesh(ascii_text_of(placed(wall_plane, keyholed_wall)), read_ply<float>);
}

TEST(ReadPly, makes_an_error_or_a_mesh_of_any_bytes) {
  expect_error_or_sound_mesh(busy_binary_square("binary_little_endian", little_endian), read_ply<float>);
  expect_error_or_sound_mesh(busy_binary_square("binary_big_endian", big_endian), read_ply<double>);
  expect_error_or_sound_mesh(little_endian_bytes_of(placed(wall_plane, keyholed_wall)), read_ply<double>);
}

}  // namespace
}  // namespace surehit::test::read_ply_test
