#include "render/corner_normals.hpp"

#include <gtest/gtest.h>

#include <surehit/hit.hpp>

#include "level/room.hpp"
#include "render/shapes.hpp"

namespace surehit::example::corner_normals_test {
namespace {

TEST(CornerNormals, are_round_on_a_sphere) {
  const Model sphere = tessellated_sphere({5, 6, 7}, 2, 4);
  const auto normals = corner_normals(sphere.mesh);
  ASSERT_EQ(normals.size(), sphere.normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_GT(normals[i][corner].dot(sphere.normals[i][corner]), 0.9999f);
    }
  }
}

TEST(CornerNormals, keep_the_edges_of_a_room) {
  const Mesh<float> room = build_room({0, 0, 0}, {3, 4, 5}, {2, 2, 2});
  const auto normals = corner_normals(room);
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    for (const Vector3f& normal_of_corner : normals[i]) EXPECT_EQ(normal_of_corner, normal(room.view(), i));
  }
}

TEST(CornerNormals, of_a_triangle_without_area_are_zero) {
  Mesh<float> mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(corner_normals(mesh)[0][0], Vector3f(0, 0, 0));
}

}  // namespace
}  // namespace surehit::example::corner_normals_test
