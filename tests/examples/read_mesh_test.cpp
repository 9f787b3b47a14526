#include "mesh_io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace surehit::test {
namespace {

using example::read_mesh;

const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ReadMesh, TellsTheFormatByTheEndingInEitherCase) {
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

TEST(ReadMesh, NamesTheFileOfAnError) {
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

TEST(ReadMesh, ViewsAMeshOfNothing) {
  const example::Mesh<float> nothing;
  EXPECT_EQ(nothing.view().vertex_count(), 0u);
  EXPECT_EQ(nothing.view().triangle_count(), 0u);
}

struct SharedMesh {
  const char* file;
  std::size_t triangles;
};

void PrintTo(const SharedMesh& mesh, std::ostream* out) { *out << mesh.file; }

class ReadSharedMesh : public testing::TestWithParam<SharedMesh> {};

TEST_P(ReadSharedMesh, HasTheTrianglesThatItsReadmeTells) {
  const std::string path = std::string(SUREHIT_MESH_FOLDER "/") + GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not at hand";
  const auto mesh = read_mesh<float>(path);
  EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
  EXPECT_FALSE(find_invalid(mesh.view()));
}

INSTANTIATE_TEST_SUITE_P(Meshes, ReadSharedMesh,
                         testing::Values(SharedMesh{"stanford-bunny.obj", 69451}, SharedMesh{"ogre.obj", 124008},
                                         SharedMesh{"dungeon.obj", 10133}, SharedMesh{"nav_test.obj", 1612}));

}  // namespace
}  // namespace surehit::test
