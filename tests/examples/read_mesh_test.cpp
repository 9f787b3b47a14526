#include "mesh_io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "append_bytes.hpp"
#include "error_of.hpp"
#include "mesh_io/read_obj.hpp"
#include "mesh_io/read_off.hpp"
#include "mesh_io/read_ply.hpp"
#include "mesh_io/triangulate.hpp"
#include "outlines.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "temporary_folder.hpp"

namespace surehit::test::read_mesh_test {
namespace {

using example::read_mesh;
using Warnings = std::vector<std::string>;

const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ReadMesh, tells_the_format_by_the_ending_in_either_case) {
  const TemporaryFolder folder;
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string paths[] = {
      folder.write("a.obj", obj), folder.write("A.OBJ", obj),
      folder.write("a.off", "OFF\n3 1 0\n" + corners + "3 0 1 2\n"),
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                       corners + "3 0 1 2\n"),
      folder.write(
          "a.stl",
          "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n")};
  for (const std::string& path : paths) {
    const auto mesh = read_mesh<double>(path);
    ASSERT_EQ(mesh.view().vertex_count(), 3u) << path;
    ASSERT_EQ(mesh.view().triangle_count(), 1u) << path;
    EXPECT_EQ(mesh.view().triangle(0).b, Vector3d(1, 0, 0)) << path;
    EXPECT_EQ(mesh.view().triangle(0).c, Vector3d(0, 1, 0)) << path;
  }
}

TEST(ReadMesh, names_the_file_of_an_error) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.obj", "v 0 0 0\nv 1 x 0\n");
  EXPECT_EQ(error_of([&] { return read_mesh<float>(bad); }), bad + ": line 2: 'x' is not a number");
  const std::string missing = folder.at("missing.obj");
  EXPECT_EQ(error_of([&] { return read_mesh<float>(missing); }),
            missing + ": cannot be read: No such file or directory");
  const std::string other = folder.write("a.txt", obj);
  EXPECT_EQ(error_of([&] { return read_mesh<float>(other); }),
            other + ": a mesh file's name ends in .obj, .ply, .stl or .off");
  std::filesystem::create_directory(folder.at("folder.obj"));
  EXPECT_EQ(error_of([&] { return read_mesh<float>(folder.at("folder.obj")); }),
            folder.at("folder.obj") + ": cannot be read: Is a directory");
}

TEST(ReadMesh, hands_on_the_warnings_of_the_readers) {
  const TemporaryFolder folder;
  const std::string nothing = folder.write("nothing.obj", "v 0 0 0\n");
  EXPECT_EQ(read_mesh<float>(nothing).warnings, Warnings{example::no_triangles});
  EXPECT_EQ(read_mesh<double>(nothing).warnings, Warnings{example::no_triangles});
  const std::string nan = folder.write("nan.obj", obj + "v 0 0 nan\n");
  const Warnings unused = {"1 vertex is not finite, the first of them vertex 3 of line 5; no face uses them"};
  EXPECT_EQ(read_mesh<float>(nan).warnings, unused);
  EXPECT_EQ(read_mesh<double>(nan).warnings, unused);
  EXPECT_EQ(read_mesh<float>(folder.write("empty.stl", "solid\nendsolid\n")).warnings, Warnings{example::no_triangles});
  EXPECT_EQ(read_mesh<float>(folder.write("empty.off", "OFF 0 0 0\n")).warnings, Warnings{example::no_triangles});
  EXPECT_EQ(read_mesh<double>(folder.write("empty.ply",
                                           "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                                           "property float y\nproperty float z\nend_header\n"))
                .warnings,
            Warnings{example::no_triangles});
}

/// A triangle 20 cm wide, as surveyors give its position.
const std::string survey_corners[] = {"5283911.5 634250.25 412.75", "5283911.7 634250.25 412.75",
                                      "5283911.5 634250.45 412.75"};

void expect_float_alone_warns_of_loss(const std::string& path) {
  EXPECT_TRUE(read_mesh<double>(path).warnings.empty()) << path;
  const Warnings warnings = read_mesh<float>(path).warnings;
  ASSERT_EQ(warnings.size(), 1u) << path;
  EXPECT_EQ(warnings[0].find("float cannot hold its coordinates, double can: "), 0u) << path << ": " << warnings[0];
  EXPECT_NE(warnings[0].find("x of vertex 1 is 5283911.7 and becomes 5283911.5"), std::string::npos) << warnings[0];
}

TEST(ReadMesh, warns_of_what_float_loses_in_every_format) {
  const TemporaryFolder folder;
  const auto& [a, b, c] = survey_corners;
  const std::string corners = a + "\n" + b + "\n" + c + "\n";
  const std::string vertex = "\nvertex ";
  std::string ply =
      "element vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + ply;
  for (const double number :
       {5283911.5, 634250.25, 412.75, 5283911.7, 634250.25, 412.75, 5283911.5, 634250.45, 412.75}) {
    append_little_endian(number, bytes);
  }
  bytes += '\3';
  for (const std::int32_t corner : {0, 1, 2}) append_little_endian(corner, bytes);
  for (const std::string& path :
       {folder.write("a.obj", "v " + a + "\rv " + b + "\rv " + c + "\rf 1 2 3\r"),
        folder.write("a.off", "OFF 3 1 0\n" + corners + "3 0 1 2\n"), folder.write("b.ply", bytes),
        folder.write("a.ply", "ply\nformat ascii 1.0\n" + ply + corners + "3 0 1 2\n"),
        folder.write("a.stl", "solid\nfacet\nouter loop" + vertex + a + vertex + b + vertex + c +
                                  "\nendloop\nendfacet\nendsolid\n")}) {
    expect_float_alone_warns_of_loss(path);
  }
}

TEST(ReadMesh, does_not_warn_of_what_float_holds) {
  const TemporaryFolder folder;
  const std::string near = folder.write("near.obj", "v 0.1 0.2 0.3\nv 10.7 0.2 0.3\nv 0.1 10.9 0.3\nf 1 2 3\n");
  EXPECT_TRUE(read_mesh<float>(near).warnings.empty());
  // Far away, but on floats.
  const std::string exact = folder.write(
      "exact.obj", "v 5283911.5 634250.25 412.75\nv 5283912 634250.25 412.75\nv 5283911.5 634250.5 412.75\nf 1 2 3\n");
  EXPECT_TRUE(read_mesh<float>(exact).warnings.empty());
  // What no triangle uses is not lost.
  const std::string unused = folder.write("unused.obj", obj + "v 5283911.7 634250.25 412.75\n");
  EXPECT_TRUE(read_mesh<float>(unused).warnings.empty());
  EXPECT_EQ(read_mesh<float>(folder.write("points.obj", "v 5283911.7 634250.25 412.75\n")).warnings,
            Warnings{example::no_triangles});
}

TEST(ReadMesh, warns_of_all_that_there_is) {
  const TemporaryFolder folder;
  const auto& [a, b, c] = survey_corners;
  const std::string path = folder.write("a.obj", "v " + a + "\nv " + b + "\nv " + c + "\nv nan 0 0\nf 1 2 3\n");
  const Warnings warnings = read_mesh<float>(path).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], "1 vertex is not finite, the first of them vertex 3 of line 4; no face uses them");
  EXPECT_EQ(warnings[1].find("float cannot hold its coordinates"), 0u);
  EXPECT_EQ(read_mesh<double>(path).warnings, Warnings{warnings[0]});
}

/// An outline that crosses itself in float, since its corners are half a metre apart there, is no fault of the file's.
TEST(ReadMesh, says_of_an_error_that_it_is_one_in_float_alone) {
  const TemporaryFolder folder;
  const std::string survey =
      folder.write("survey.obj",
                   "v 5283911.7 634251.2 412.75\nv 5283914.0 634251.7 412.75\nv 5283912.4 634251.2 412.75\n"
                   "v 5283911.0 634250.3 412.75\nv 5283912.9 634253.0 412.75\nf 1 2 3 4 5\n");
  EXPECT_EQ(read_mesh<double>(survey).triangles.size(), 3u);
  EXPECT_EQ(error_of([&] { return read_mesh<float>(survey); }),
            survey +
                ": line 6: face 0 of 5 corners has no valid triangulation: its outline crosses itself (only in "
                "float: double can read the file)");
  const std::string large = folder.write("large.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(read_mesh<double>(large).triangles.size(), 1u);
  EXPECT_EQ(error_of([&] { return read_mesh<float>(large); }),
            large + ": line 2: '1e39' is beyond the largest float (only in float: double can read the file)");
  const std::string bad = folder.write("bad.obj", "v 0 0 0\nv 1e39 0 x\n");
  EXPECT_EQ(error_of([&] { return read_mesh<float>(bad); }), bad + ": line 2: '1e39' is beyond the largest float");
}

/// Corner i of the face is vertex i. A bent face has each place moved across by a little of its own.
std::vector<std::array<double, 3>> corners_of(const Outline& outline, bool is_tilted, bool is_bent) {
  std::vector<std::array<double, 3>> corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto x = static_cast<double>(outline[i][0]);
    const auto y = static_cast<double>(outline[i][1]);
    const double bend = is_bent ? static_cast<double>((outline[i][0] + 5 * outline[i][1]) % 3) / 64 : 0;
    corners.push_back(is_tilted ? std::array{2 * x + bend, y - x + bend, 3 * y - bend} : std::array{x, bend, y});
  }
  return corners;
}

TEST(ReadMesh, cuts_generated_faces_alike_in_every_format) {
  Random random(20261125);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < case_count(600); ++i) {
    const Outline outline = random.one_in(2) ? draw_simple(random) : draw_wall(1 + random.below(4), i % 3 != 2, random);
    const auto vertices = corners_of(outline, i % 2 == 1, i % 3 == 2);
    const std::string count = std::to_string(vertices.size());
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      corners.push_back(static_cast<std::uint32_t>((k + i) % vertices.size()));
    }
    std::string points;
    std::string obj_points;
    std::string indices = count;
    std::string obj_face = "f";
    for (const auto& [x, y, z] : vertices) {
      const std::string line = std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
      points += line;
      obj_points += "v " + line;
    }
    for (const std::uint32_t corner : corners) {
      indices += " " + std::to_string(corner);
      obj_face += " " + std::to_string(corner + 1);
    }
    const auto from_obj = example::read_obj<double>(obj_points + obj_face);
    const auto from_off = example::read_off<double>("OFF\n" + count + " 1 0\n" + points + indices);
    const auto from_ply =
        example::read_ply<double>("ply\nformat ascii 1.0\nelement vertex " + count +
                                  "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                                  "property list uint uint vertex_indices\nend_header\n" +
                                  points + indices + "\n");
    std::vector<std::array<std::uint32_t, 3>> expected;
    ASSERT_TRUE(example::triangulate(from_obj.vertices, corners, expected));
    EXPECT_EQ(from_obj.triangles, expected);
    EXPECT_EQ(from_off.triangles, expected);
    EXPECT_EQ(from_ply.triangles, expected);
    cut += expected.front()[0] != expected.back()[0] ? 1 : 0;
  }
  EXPECT_GT(cut, case_count(600) / 4) << "most of them are no fans";
}

TEST(ReadMesh, views_a_mesh_of_nothing) {
  const example::Mesh<float> nothing;
  EXPECT_EQ(nothing.view().vertex_count(), 0u);
  EXPECT_EQ(nothing.view().triangle_count(), 0u);
  EXPECT_EQ(nothing.face_count(), 0u);
}

TEST(ReadMesh, tells_the_face_of_a_triangle) {
  example::Mesh<float> mesh;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(mesh.face_of(2), 2u);
  EXPECT_EQ(mesh.face_count(), 3u);
  mesh.faces = {0, 0, 1};
  EXPECT_EQ(mesh.face_of(0), 0u);
  EXPECT_EQ(mesh.face_of(1), 0u);
  EXPECT_EQ(mesh.face_of(2), 1u);
  EXPECT_EQ(mesh.face_count(), 2u);
}

struct SharedMesh {
  const char* file;
  std::size_t triangles;
};

void PrintTo(const SharedMesh& mesh, std::ostream* out) { *out << mesh.file; }

class ReadSharedMesh : public testing::TestWithParam<SharedMesh> {};

TEST_P(ReadSharedMesh, has_the_triangles_that_its_readme_tells) {
  const std::string path = std::string(SUREHIT_MESH_FOLDER "/") + GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not at hand";
  const auto mesh = read_mesh<float>(path);
  EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
  EXPECT_FALSE(find_invalid(mesh.view()));
  EXPECT_TRUE(mesh.warnings.empty());
}

INSTANTIATE_TEST_SUITE_P(Meshes, ReadSharedMesh,
                         testing::Values(SharedMesh{"stanford-bunny.obj", 69451}, SharedMesh{"ogre.obj", 124008},
                                         SharedMesh{"dungeon.obj", 10133}, SharedMesh{"nav_test.obj", 1612}));

}  // namespace
}  // namespace surehit::test::read_mesh_test
