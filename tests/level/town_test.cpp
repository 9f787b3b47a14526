#include "agents_tick/town.hpp"

#include <gtest/gtest.h>

#include <array>

#include "agents_tick/crowd.hpp"

namespace surehit::example::town_test {
namespace {

/// All placed triangles of a town as one mesh. Each has the mask of its instance.
Colliderf flattened(const Scenef& scene) {
  std::vector<Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> masks;
  for (const InstanceId id : scene.instances()) {
    for (std::uint32_t i = 0; i < scene.triangle_count(id); ++i) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      const Trianglef triangle = scene.triangle(id, i);
      vertices.insert(vertices.end(), {triangle.a, triangle.b, triangle.c});
      triangles.push_back({first, first + 1, first + 2});
      masks.push_back(scene.mask(id));
    }
  }
  return Colliderf(TriangleMeshViewf(vertices, triangles), {.masks = masks});
}

TEST(Town, has_2000_instances) {
  const Town town(1);
  EXPECT_EQ(town.scene().instance_count(), 2'000u);
  EXPECT_GT(town.triangle_count(), 100'000u);
}

TEST(Town, answers_as_one_mesh_does) {
  Town town(1);
  town.set_doors(40, {});
  const Colliderf mesh = flattened(town.scene());
  const Crowd crowd(300, 1);
  const std::vector<Segmentf> segments = crowd.segments(crowd.looks(5'000));
  ASSERT_EQ(segments.size(), 5'000u);
  for (const std::uint32_t mask : {std::uint32_t{blocks_sight}, std::uint32_t{blocks_movement}}) {
    std::vector<std::uint8_t> in_scene(segments.size());
    std::vector<std::uint8_t> in_mesh(segments.size());
    town.scene().any_hits(segments, in_scene, {.options = {.instance_mask = mask}});
    mesh.any_hits(segments, in_mesh, {.options = {.mask = mask}});
    EXPECT_EQ(in_scene, in_mesh);
  }
}

TEST(Town, glass_blocks_movement_but_not_sight) {
  const Town town(1);
  std::size_t panes = 0;
  for (const InstanceId id : town.scene().instances()) {
    // The ground and railings are the other ones that do not block sight.
    const Vector3f normal = town.scene().normal(id, 0);
    const auto last = static_cast<std::uint32_t>(town.scene().triangle_count(id) - 1);
    const bool has_height = town.scene().triangle(id, last).c.z() > 2;
    if (town.scene().mask(id) != blocks_movement || normal.z() > 0 || !has_height) continue;
    const Posef& pose = town.scene().pose(id);
    const auto at = [&](float y) -> Vector3f { return pose.linear * Vector3f(5.5f, y, 1.25f) + pose.translation; };
    const Segmentf through{at(-0.25f), at(0.25f)};
    EXPECT_TRUE(town.scene().any_hit(through, {.instance_mask = blocks_movement}));
    EXPECT_FALSE(town.scene().any_hit(through, {.instance_mask = blocks_sight}));
    ++panes;
  }
  EXPECT_GT(panes, 50u);
}

TEST(Town, open_doors_block_nothing) {
  Town town(1);
  town.set_doors(16, {});
  std::vector<InstanceId> open_doors;
  for (const InstanceId id : town.scene().instances()) {
    if (town.scene().mask(id) == 0) open_doors.push_back(id);
  }
  EXPECT_GT(open_doors.size(), 30u);
  const auto through = [&](InstanceId id) -> Segmentf {
    const Posef& pose = town.scene().pose(id);
    const auto at = [&](float y) -> Vector3f { return pose.linear * Vector3f(1.5f, y, 1) + pose.translation; };
    return {at(-0.25f), at(0.25f)};
  };
  for (const InstanceId id : open_doors) EXPECT_FALSE(town.scene().any_hit(through(id)));
  town.set_doors(32, {});
  for (const InstanceId id : open_doors) {
    const auto hit = town.scene().first_hit(through(id));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->instance, id);
  }
}

}  // namespace
}  // namespace surehit::example::town_test
