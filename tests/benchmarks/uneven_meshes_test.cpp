#include "uneven_meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "determinism/answers.hpp"

namespace surehit::test::uneven_meshes_test {
namespace {

using benchmark::NamedMesh;
using benchmark::uneven_mesh;
using benchmark::uneven_mesh_names;

/// A hash of all bits of a mesh.
std::uint64_t hash_of(const NamedMesh& named) {
  AnswerHash hash;
  for (const auto& vertex : named.mesh.vertices) {
    for (const float x : vertex) hash.take(x);
  }
  for (const auto& triangle : named.mesh.triangles) {
    for (const std::uint32_t vertex : triangle) hash.take(vertex);
  }
  return hash.value();
}

TEST(UnevenMeshes, have_the_published_bits) {
  const std::map<std::string, std::uint64_t> published = {
      {"stadium_10", 0xf15c99ebb75f1322u},   {"stadium_100", 0x030b23dae9540a59u},
      {"stadium_1000", 0x299892e403aad8f8u}, {"stadium_10000", 0xfee628f3ece9bd78u},
      {"sky_box", 0x4f38894674a91459u},      {"stray_1e1", 0x6609d1e92909e5feu},
      {"stray_1e3", 0xe224d2307bd764acu},    {"stray_1e5", 0x7f6fd15e7c487841u},
      {"stray_1e9", 0x47dd5b62cf5cb3b0u},    {"stray_1e30", 0xf635c1b3a917da63u},
      {"voxels", 0xb8279d05c4aea531u},       {"terrain", 0x6f132dc2f02ba261u},
  };
  std::map<std::string, std::uint64_t> hashes;
  for (const std::string& name : uneven_mesh_names()) {
    hashes[name] = hash_of(uneven_mesh(name, 0.1F));
  }
  EXPECT_EQ(hashes, published);
}

TEST(UnevenMeshes, have_as_many_triangles_as_is_said) {
  const auto triangles = [](const std::string& name) { return uneven_mesh(name, 1).mesh.triangles.size(); };
  EXPECT_EQ(triangles("sky_box"), 69'312U + 12);
  EXPECT_EQ(triangles("stray_1e30"), 20'000U + 1);
  EXPECT_EQ(triangles("terrain"), 1'002'528U);
  EXPECT_GT(triangles("voxels"), 100'000U);
}

/// No face is missing: as many triangles go along an edge in one direction as in the other.
TEST(UnevenMeshes, has_voxels_that_are_closed) {
  std::map<std::array<std::uint32_t, 2>, int> balance;
  for (const auto& triangle : uneven_mesh("voxels", 0.1F).mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangle[corner];
      const std::uint32_t to = triangle[(corner + 1) % 3];
      balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0) << edge[0] << ' ' << edge[1];
}

}  // namespace
}  // namespace surehit::test::uneven_meshes_test
