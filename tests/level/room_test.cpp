#include "level/room.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <surehit/hit.hpp>

namespace surehit::example::room_test {
namespace {

constexpr Point low = {-1, 2, 0};
constexpr Point high = {6, 7.5f, 3.25f};

TEST(Room, has_two_triangles_for_each_cell_of_its_sides) {
  EXPECT_EQ(build_room(low, high, {1, 1, 1}).triangles.size(), 12u);
  EXPECT_EQ(build_room(low, high, {3, 5, 2}).triangles.size(), 4u * (3 * 5 + 5 * 2 + 2 * 3));
}

TEST(Room, is_closed) {
  const Mesh<float> room = build_room(low, high, {3, 5, 2});
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : room.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(Room, shares_its_vertices) {
  const Mesh<float> room = build_room(low, high, {3, 5, 2});
  const std::set<Point> distinct(room.vertices.begin(), room.vertices.end());
  EXPECT_EQ(distinct.size(), room.vertices.size());
  EXPECT_TRUE(distinct.contains(low));
  EXPECT_TRUE(distinct.contains(high));
}

TEST(Room, looks_inwards) {
  const Mesh<float> room = build_room(low, high, {3, 5, 2});
  const TriangleMeshViewf view = room.view();
  const Vector3f middle(2.5f, 4.75f, 1.625f);
  for (std::uint32_t i = 0; i < view.triangle_count(); ++i) {
    const Vector3f corner = view.vertex(room.triangles[i][0]);
    EXPECT_GT(normal(view, i).dot(middle - corner), 0) << "triangle " << i;
  }
}

}  // namespace
}  // namespace surehit::example::room_test
