#include "render/free_points.hpp"

#include <gtest/gtest.h>

#include "level/level.hpp"
#include "render/shapes.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::example::free_points_test {
namespace {

/// Rays from around a place, with what they hit. All of them are in air.
struct Rays {
  std::vector<Rayf> rays;
  std::vector<Hitf> hits;
  std::vector<Medium> media;
  std::vector<Vector3f> points;

  Rays(const World& world, const Vector3f& place, float spread, std::size_t count) {
    test::Random random(4);
    const auto draw = [&] { return static_cast<float>(random.between(-1000, 1000)) / 1000; };
    while (rays.size() < count) {
      const Vector3f around(draw(), draw(), draw());
      const Rayf ray{place + spread * around, {draw(), draw(), draw()}};
      const auto hit = world.collider().first_hit(ray, {.culling = Culling::none});
      if (!hit) continue;
      rays.push_back(ray);
      hits.push_back(*hit);
    }
    media.assign(rays.size(), Medium::air);
    points.resize(rays.size());
    free_points(world, rays, media, hits, points);
  }
};

TEST(FreePoints, are_those_of_the_library_where_a_ray_is_a_segment) {
  // From the origin, the ray and the segment with the same numbers go the same way.
  Model model;
  model.mesh = build_level({0.3f}).mesh;
  for (auto& [x, y, z] : model.mesh.vertices) {
    x = (x - 36.5f) / 64;
    y = (y - 24.25f) / 64;
    z = (z - 1.625f) / 64;
  }
  const World world(model, Culling::none);
  const Rays rays(world, {0, 0, 0}, 0, test::case_count(4'000));
  std::size_t compared = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const Segmentf segment{{0, 0, 0}, rays.rays[i].direction};
    if (!(rays.hits[i].t <= 1) || !world.collider().first_hit(segment)) continue;
    EXPECT_EQ(rays.points[i], world.collider().last_free_point(segment, rays.hits[i])) << i;
    ++compared;
  }
  EXPECT_GT(compared, rays.rays.size() / 4);
}

TEST(FreePoints, are_just_in_front_of_the_hit) {
  const Model model = [] {
    Model level;
    level.mesh = build_level({0.3f}).mesh;
    return level;
  }();
  const World world(model, Culling::none);
  const Rays rays(world, {36.5f, 24.25f, 1.625f}, 1, test::case_count(4'000));
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    EXPECT_FALSE(world.collider().any_hit(Segmentf{rays.rays[i].origin, rays.points[i]})) << i;
    EXPECT_LT((rays.points[i] - point(rays.rays[i], rays.hits[i])).norm(), 1e-2f) << i;
  }
}

TEST(FreePoints, of_glass_are_on_the_side_of_the_medium) {
  Model glass = tessellated_sphere({0, 0, 0}, 1, 4);
  set_material(glass, {.is_glass = true});
  const World world(glass, Culling::none);
  const Vector3f place(0.3f, 0.1f, 3);
  const std::vector<Rayf> rays = {{place, {-0.07f, 0.02f, -1}}};
  std::vector<Hitf> hits(1);
  std::vector<Vector3f> points(1);
  std::vector<Medium> media = {Medium::air};
  world.first_hits(rays, media, hits);
  free_points(world, rays, media, hits, points);
  EXPECT_GT(points[0].z(), 0.5f);
  EXPECT_FALSE(world.collider().any_hit(Segmentf{place, points[0]}));

  // In glass, the next ray from there meets the far side, and not the surface that it goes through.
  const std::vector<Rayf> inside = {{points[0], {0, 0, -1}}};
  media = {Medium::glass};
  world.first_hits(inside, media, hits);
  EXPECT_EQ(hits[0].side, Side::back);
  free_points(world, inside, media, hits, points);
  EXPECT_LT(points[0].z(), -0.5f);
  EXPECT_LT(points[0].norm(), 1);
  EXPECT_TRUE(world.collider().any_hit(Segmentf{{0, 0, -2}, points[0]})) << "it is inside";
  EXPECT_FALSE(world.collider().any_hit(Segmentf{{0, 0, 0}, points[0]}));
}

TEST(FreePoints, of_a_hit_at_the_origin_is_the_origin) {
  Model floor = chess_board({0, 0, 0}, 8, 1);
  const World world(floor, Culling::none);
  const std::vector<Rayf> rays = {{{1, 2, 0}, {0, 0, -1}}};
  std::vector<Hitf> hits(1);
  const std::vector<Medium> media = {Medium::air};
  std::vector<Vector3f> points(1);
  world.first_hits(rays, media, hits);
  ASSERT_EQ(hits[0].t, 0);
  free_points(world, rays, media, hits, points);
  EXPECT_EQ(points[0], Vector3f(1, 2, 0));
}

}  // namespace
}  // namespace surehit::example::free_points_test
