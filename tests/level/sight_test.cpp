#include "line_of_sight/sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "level/level.hpp"
#include "level/room.hpp"
#include "line_of_sight/figures.hpp"
#include "support/case_count.hpp"

namespace surehit::example::sight_test {
namespace {

constexpr Point low = {-3, 1, -0.5f};
constexpr Point high = {7.25f, 6, 2.75f};
const Vector3f eye(0.3f, 4.7f, 1.1f);

Figures look(const Mesh<float>& mesh, const Vector3f& from, float height, std::size_t points, unsigned threads) {
  const Colliderf collider(mesh.view());
  Figures figures;
  figures.count(look_around(collider, FloorPlan(collider, from.z(), points, threads), from, height, threads));
  return figures;
}

TEST(Sight, everything_is_visible_in_an_empty_room) {
  const std::size_t points = test::case_count(1'000'000);
  const Figures figures = look(build_room(low, high, {7, 5, 3}), eye, 0.4f, points, 2);
  EXPECT_GE(figures.points, points);
  EXPECT_EQ(figures.visible, figures.points);
  EXPECT_EQ(figures.without_floor, 0u);
}

TEST(Sight, a_screen_hides_what_is_behind_it) {
  SolidBuilder builder(1);
  builder.add_box({2, low[1], low[2]}, {3, high[1], high[2]});
  Mesh<float> mesh = builder.take();
  const Mesh<float> room = build_room(low, high, {7, 5, 3});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), room.vertices.begin(), room.vertices.end());
  for (const auto& [a, b, c] : room.triangles) mesh.triangles.push_back({a + first, b + first, c + first});

  const Colliderf collider(mesh.view());
  const FloorPlan plan(collider, eye.z(), 2'000, 1);
  const auto sights = look_around(collider, plan, eye, 0.4f, 1);
  std::size_t in_front = 0;
  std::size_t behind = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan.x(i) < 2) {
      EXPECT_EQ(sights[i], Sight::visible);
      ++in_front;
    } else if (plan.x(i) > 3) {
      EXPECT_EQ(sights[i], Sight::hidden);
      ++behind;
    } else {
      EXPECT_EQ(sights[i], Sight::no_floor);
      ++inside;
    }
  }
  EXPECT_GT(in_front, 500u);
  EXPECT_GT(behind, 500u);
  EXPECT_GT(inside, 100u);
}

TEST(Sight, points_are_at_their_height_above_the_floor) {
  const Mesh<float> room = build_room(low, high, {1, 1, 1});
  const Colliderf collider(room.view());
  const FloorPlan plan(collider, eye.z(), 100, 1);
  for (std::size_t i = 0; i < plan.size(); ++i) EXPECT_FLOAT_EQ(plan.floor_height(i), low[2]);
  const auto through_the_ceiling = look_around(collider, plan, eye, 4, 1);
  EXPECT_TRUE(std::ranges::all_of(through_the_ceiling, [](Sight sight) { return sight == Sight::hidden; }));
}

TEST(Sight, is_the_same_for_any_number_of_threads) {
  const Level level = build_level({0.3f});
  const Colliderf collider(level.mesh.view());
  const Vector3f from(level.eye[0], level.eye[1], level.eye[2]);
  const FloorPlan plan(collider, from.z(), 40'000, 1);
  const auto alone = look_around(collider, plan, from, 0.5f, 1);
  EXPECT_EQ(look_around(collider, plan, from, 0.5f, 3), alone);
  EXPECT_GT(std::ranges::count(alone, Sight::visible), 0);
  EXPECT_GT(std::ranges::count(alone, Sight::hidden), 0);
}

TEST(FloorPlan, grows_until_enough_points_have_a_floor) {
  const Level level = build_level({0.3f});
  const Colliderf collider(level.mesh.view());
  const FloorPlan plan(collider, level.eye[2], 10'000, 1);
  EXPECT_GE(plan.floor_count(), 10'000u);
  EXPECT_LT(plan.floor_count(), plan.size()) << "walls are no floor";
}

TEST(FloorPlan, says_where_there_is_none) {
  const Mesh<float> room = build_room(low, high, {1, 1, 1});
  const Colliderf collider(room.view());
  EXPECT_THROW(FloorPlan(collider, low[2] - 1, 100, 1), std::runtime_error);
  EXPECT_THROW(FloorPlan(Colliderf(), 0, 100, 1), std::runtime_error);
}

}  // namespace
}  // namespace surehit::example::sight_test
