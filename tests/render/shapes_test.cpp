#include "render/shapes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <surehit/collider.hpp>
#include <utility>

namespace surehit::example::shapes_test {
namespace {

TEST(Shapes, a_sphere_is_closed_and_round) {
  const Vector3f centre(0.3f, 0.7f, -0.2f);
  const Model sphere = tessellated_sphere(centre, 1.3f, 3);
  ASSERT_EQ(sphere.mesh.triangles.size(), 20u << 6);
  EXPECT_EQ(sphere.mesh.vertices.size(), 2 + sphere.mesh.triangles.size() / 2) << "Euler's formula";
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::uint32_t i = 0; i < sphere.mesh.triangles.size(); ++i) {
    const auto& corners = sphere.mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) ++edges[{corners[k], corners[(k + 1) % 3]}];
    const Trianglef triangle = sphere.mesh.view().triangle(i);
    const Vector3f outward = (triangle.a + triangle.b + triangle.c) / 3 - centre;
    EXPECT_GT(normal(triangle).dot(outward / outward.norm()), 0.99f);
    EXPECT_NEAR((triangle.a - centre).norm(), 1.3f, 1e-6);
    EXPECT_LT((sphere.normals[i][0] - (triangle.a - centre) / 1.3f).norm(), 1e-6f);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "the neighbour goes along it the other way";
  }
}

TEST(Shapes, a_chess_board_covers_its_squares) {
  const Model board = chess_board({1, 2, 3}, 8, 4);
  ASSERT_EQ(board.mesh.triangles.size(), 32u);
  EXPECT_EQ(board.mesh.vertices.size(), 25u);
  const Colliderf collider(board.mesh.view());
  EXPECT_EQ(collider.box().low, Vector3f(-3, -2, 3));
  EXPECT_EQ(collider.box().high, Vector3f(5, 6, 3));
  const auto hit = collider.first_hit(Rayf{{-1.5f, 4.25f, 9}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->side, Side::front) << "its normal points up";
  const Eigen::Vector2f place = interpolated(board.texture_coordinates[hit->triangle], hit->u, hit->v);
  EXPECT_FLOAT_EQ(place.x(), 0.75f);
  EXPECT_FLOAT_EQ(place.y(), 3.125f);
}

TEST(Shapes, models_become_one) {
  Model all;
  Model floor = chess_board({0, 0, 0}, 2, 1);
  set_material(floor, {.mirror = 0.5f});
  all.append(floor);
  all.append(tessellated_sphere({0, 0, 1}, 1, 0));
  ASSERT_EQ(all.mesh.triangles.size(), 22u);
  EXPECT_EQ(all.normals.size(), 22u);
  EXPECT_EQ(all.texture_coordinates.size(), 22u);
  EXPECT_EQ(all.material(1).mirror, 0.5f);
  EXPECT_EQ(all.material(2).mirror, 0);
  EXPECT_FALSE(find_invalid(all.mesh.view()));
}

}  // namespace
}  // namespace surehit::example::shapes_test
