#include "mesh_io/read_ply.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mutations.hpp"

namespace surehit::test {
namespace {

using example::Mesh;
using example::read_ply;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string vertex_lines = "property float x\nproperty float y\nproperty float z\n";
const std::string face_line = "property list uchar int vertex_indices\n";

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

const auto little_endian = [](auto number, std::string& bytes) { append_little_endian(number, bytes); };
const auto big_endian = [](auto number, std::string& bytes) { append_big_endian(number, bytes); };

const std::string ascii_square = header("ascii", 4, 2) + "0 0 0\n1 0 0\n1 1 0\n0 0.1 0\n4 0 1 2 3\n3 3 2 1\n";

TEST(ReadPly, ReadsText) {
  const Mesh<double> mesh = read_ply<double>(ascii_square);
  const std::vector<std::array<double, 3>> expected = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0.1, 0}};
  EXPECT_EQ(mesh.vertices, expected);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
}

TEST(ReadPly, ReadsTextWithPropertiesAndElementsThatNobodyNeeds) {
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

TEST(ReadPly, ReadsBytesInEitherOrder) {
  for (const std::string& bytes : {busy_binary_square("binary_little_endian", little_endian),
                                   busy_binary_square("binary_big_endian", big_endian)}) {
    const Mesh<double> mesh = read_ply<double>(bytes);
    constexpr double x = 1.00000005960464477540;
    const std::vector<std::array<double, 3>> expected = {{0, 0, -7}, {x, 0, -7}, {x, 0.1f, -7}, {0, 0.1f, -7}};
    EXPECT_EQ(mesh.vertices, expected);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(ReadPly, RoundsBinaryNumbersOnce) {
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

TEST(ReadPly, RoundsTextOnceWhateverTypeTheHeaderNames) {
  std::string text = header("ascii", 1, 0) + "1.00000005960464477539062500000000000000001 0.1 1e-60\n";
  const std::vector<std::array<float, 3>> floats = {{0x1.000002p0f, 0.1f, 0}};
  const std::vector<std::array<double, 3>> doubles = {{0x1.000001p0, 0.1, 1e-60}};
  EXPECT_EQ(read_ply<float>(text).vertices, floats);
  EXPECT_EQ(read_ply<double>(text).vertices, doubles);
}

TEST(ReadPly, NamesTheLineOfAnErrorInTheHeader) {
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

TEST(ReadPly, NamesWhatTheHeaderLacks) {
  const std::string faces = "element face 0\n" + face_line;
  EXPECT_EQ(error_in_header(faces), "line 5: the header has no element 'vertex'");
  EXPECT_EQ(error_in_header("element vertex 0\n" + vertex_lines), "line 7: the header has no element 'face'");
  EXPECT_EQ(error_in_header("element vertex 0\nproperty float x\nproperty float y\n" + faces),
            "line 8: the element vertex has no number 'z'");
  EXPECT_EQ(error_in_header("element vertex 0\nproperty list int float x\n" + faces),
            "line 7: the element vertex has no number 'x'");
  for (const std::string list : {"", "property int vertex_indices\n", "property list int float vertex_indices\n"}) {
    const std::string error = error_in_header("element vertex 0\n" + vertex_lines + "element face 0\n" + list);
    EXPECT_NE(error.find("the element face has no list 'vertex_indices' of integers"), std::string::npos) << error;
  }
}

TEST(ReadPly, NamesTheLineAndTheElementOfAnErrorInText) {
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

TEST(ReadPly, NamesTheElementOfAnErrorInBytes) {
  const std::string vertices = header("binary_little_endian", 1, 1) + std::string(12, '\0');
  EXPECT_EQ(error_in(header("binary_little_endian", 1, 1) + std::string(11, '\0')),
            "vertex 0: the file ends too early");
  EXPECT_EQ(error_in(vertices), "face 0: the file ends too early");
  EXPECT_EQ(error_in(vertices + '\2' + std::string(8, '\0')), "face 0: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in(vertices + '\3' + std::string(8, '\0') + std::string(4, '\xff')),
            "face 0: vertex index -1 is out of range, there are 1 vertices");
  EXPECT_EQ(error_in(vertices + '\3' + std::string(12, '\0') + "left"), "4 bytes follow the last element");
  EXPECT_EQ(error_in(header("binary_big_endian", 1, 0) + std::string("\x7f\x80\0\0\0\0\0\0\0\0\0\0", 12)),
            "vertex 0: a coordinate is not finite, or beyond the largest number");
}

/// A message ends at a byte 0 for those who read it as C does; a fuzzer found one that was empty.
TEST(ReadPly, NamesAnElementWhoseNameIsNotPrintable) {
  const std::string name(1, '\0');
  EXPECT_EQ(error_in("ply\nformat binary_little_endian 1.0\nelement " + name + " 8\nproperty double x\n" +
                     "element vertex 0\n" + vertex_lines + "element face 0\n" + face_line + "end_header\n"),
            "? 0: the file ends too early");
}

TEST(ReadPly, RejectsBinaryDoublesBeyondTheLargestFloat) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty float y\n"
      "property float z\nelement face 0\n" +
      face_line + "end_header\n";
  append_little_endian(1e39, bytes);
  bytes.append(8, '\0');
  EXPECT_EQ(error_in(bytes), "vertex 0: a coordinate is not finite, or beyond the largest number");
  EXPECT_EQ(read_ply<double>(bytes).vertices[0][0], 1e39);
}

TEST(ReadPly, TakesNoMemoryOrTimeOnTheWordOfAHeader) {
  constexpr std::uint64_t many = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(error_in(header("ascii", many, many) + "0 0 0\n"), "line 10: vertex 1: the file ends too early");
  EXPECT_EQ(error_in(header("binary_little_endian", many, many)), "vertex 0: the file ends too early");
  EXPECT_EQ(error_in(header("binary_little_endian", 0, many)), "face 0: the file ends too early");
  const std::string count = std::to_string(many);
  EXPECT_TRUE(read_ply<float>("ply\nformat ascii 1.0\nelement nothing " + count + "\nelement vertex 0\n" +
                              vertex_lines + "element face 0\n" + face_line + "end_header\n")
                  .vertices.empty());
}

TEST(ReadPly, TakesNoMemoryOnTheWordOfAList) {
  const std::string tags = "element a 1\nproperty list uint double tags\n";
  const std::string rest =
      "element vertex 0\n" + vertex_lines + "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  const std::string start = "ply\nformat binary_little_endian 1.0\n";
  EXPECT_EQ(error_in(start + tags + rest + "\xff\xff\xff\xff"), "a 0: the file ends too early");
  EXPECT_EQ(error_in(start + rest + "\xff\xff\xff\xff"), "face 0: the file ends too early");
}

TEST(ReadPly, MakesAnErrorOrAMeshOfAnyText) { expect_error_or_sound_mesh(ascii_square, read_ply<float>); }

TEST(ReadPly, MakesAnErrorOrAMeshOfAnyBytes) {
  expect_error_or_sound_mesh(busy_binary_square("binary_little_endian", little_endian), read_ply<float>);
  expect_error_or_sound_mesh(busy_binary_square("binary_big_endian", big_endian), read_ply<double>);
}

}  // namespace
}  // namespace surehit::test
