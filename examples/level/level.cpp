#include "level/level.hpp"

#include "level/architecture.hpp"
#include "level/terrain.hpp"

namespace surehit::example {
namespace {

constexpr float storey = 4;

Opening door(float from, float width = 1.25f) { return {from, from + width, 0, 2.25f}; }
Opening window(float from, float width = 2.5f) { return {from, from + width, 0.875f, 2.5f}; }

std::vector<Wall> outer_walls() {
  using enum Wall::Along;
  constexpr float thick = 0.5f;
  return {
      {x, 10, 13.75f, 58.25f, thick, {window(17.5f), window(29.5f, 3), door(35, 3), window(41, 3), window(50, 4)}},
      {x, 44, 13.75f, 58.25f, thick, {window(17), door(24.875f), window(30, 3), window(39.5f, 3), window(50, 4)}},
      {y, 14, 10.25f, 43.75f, thick, {window(12.75f), window(21), window(29, 3), window(38, 3)}},
      {y, 58, 10.25f, 43.75f, thick, {window(13, 5), window(24, 5), window(36, 4)}},
  };
}

std::vector<Wall> inner_walls() {
  using enum Wall::Along;
  constexpr float thin = 0.25f;
  return {
      {y, 24, 10.25f, 43.75f, thin, {door(13.5f), door(21.5f, 1.5f), door(30), door(39)}},
      {y, 27, 10.25f, 43.75f, thin, {door(13, 2), door(21.5f, 2), door(30, 2.5f), door(40)}},
      {y, 46, 10.25f, 43.75f, thin, {door(13), door(24, 2.5f), door(35.5f)}},
      {x, 18, 27.125f, 45.875f, thin, {door(33.5f, 6)}},
      {x, 38, 27.125f, 45.875f, thin, {door(31), door(40.5f)}},
      {x, 18, 14.25f, 23.875f, thin, {door(19)}},
      {x, 26, 14.25f, 23.875f, thin, {}},
      {x, 35, 14.25f, 23.875f, thin, {door(16)}},
      {x, 21, 46.125f, 57.75f, thin, {door(51)}},
      {x, 32, 46.125f, 57.75f, thin, {door(49)}},
      {y, 36, 38.125f, 43.75f, thin, {}},
  };
}

void add_walls(SolidBuilder& builder, bool furnished) {
  for (const auto& walls : {outer_walls(), inner_walls()}) {
    for (Wall wall : walls) {
      if (!furnished) std::erase_if(wall.openings, [](const Opening& opening) { return opening.low > 0; });
      add_wall(builder, wall, storey);
    }
  }
}

void add_hall(SolidBuilder& builder) {
  for (const float x : {31.5f, 41.5f}) {
    for (const float y : {20.5f, 24.75f, 29.0f}) add_pillar(builder, {x, y, 0}, storey, 0.375f);
  }
  add_stairs(builder, {34.5f, 31.125f, 0}, 4, 0.375f, 0.25f, 9);
}

void add_gallery(SolidBuilder& builder) {
  constexpr float underside = 2;
  constexpr float deck = 2.25f;
  for (const float x : {29.0f, 32.5f, 40.5f, 44.0f}) add_pillar(builder, {x, 34.875f, 0}, underside, 0.1875f);
  builder.add_box({27.125f, 34.5f, underside}, {45.875f, 37.875f, deck});
  add_railing(builder, {27.25f, 34.625f, deck}, {34.5f, 34.625f, deck}, 1, 0.1875f);
  add_railing(builder, {38.5f, 34.625f, deck}, {45.75f, 34.625f, deck}, 1, 0.1875f);
}

void add_balustrades(SolidBuilder& builder) {
  constexpr float apart = 0.25f;
  add_railing(builder, {41.5f, 25.375f, 0}, {41.5f, 28.375f, 0}, 1, apart);
  add_railing(builder, {31.5f, 25.375f, 0}, {31.5f, 28.375f, 0}, 1, apart);
  add_railing(builder, {32.5f, 12.5f, 0}, {32.5f, 15.5f, 0}, 1, apart);
  add_railing(builder, {40.5f, 12.5f, 0}, {40.5f, 15.5f, 0}, 1, apart);
  add_railing(builder, {31.125f, 9.5f, 0}, {31.125f, 4.125f, 0}, 1, apart);
  add_railing(builder, {31.125f, 4.125f, 0}, {34.5f, 4.125f, 0}, 1, apart);
  add_railing(builder, {38.5f, 4.125f, 0}, {41.875f, 4.125f, 0}, 1, apart);
  add_railing(builder, {41.875f, 4.125f, 0}, {41.875f, 9.5f, 0}, 1, apart);
}

void add_furniture(SolidBuilder& builder) {
  for (const float y : {39.25f, 41.0f, 42.75f}) builder.add_box({28, y, 0}, {30.5f, y + 0.5f, 1.75f});
  for (const float x : {37.5f, 39.5f, 43.5f}) builder.add_box({x, 40.5f, 0}, {x + 0.5f, 43.25f, 1.75f});
  const Point crate = {1, 1, 1};
  builder.add_turned_box({52, 25, 0}, crate, 0.8f, 0.6f);
  builder.add_turned_box({53.375f, 25.75f, 0}, crate, 0.96f, 0.28f);
  builder.add_turned_box({52.625f, 25.375f, 1}, crate, 0.6f, 0.8f);
  builder.add_turned_box({49, 36.5f, 0}, {2.5f, 1.25f, 0.75f}, 0.96f, 0.28f);
  builder.add_turned_box({54, 39, 0}, {1.5f, 1.5f, 1.75f}, 0.8f, 0.6f);
  builder.add_turned_box({51, 14, 0}, {5, 1.5f, 0.75f}, 1, 0);
  builder.add_turned_box({17.5f, 23.75f, 0}, {2, 1, 0.75f}, 0.28f, 0.96f);
  builder.add_turned_box({19, 31.5f, 0}, {1, 2.5f, 1.875f}, 0.8f, 0.6f);
  builder.add_turned_box({18, 14, 0}, {1.5f, 1.5f, 1.875f}, 0.96f, 0.28f);
  builder.add_turned_box({20.5f, 40.5f, 0}, {3, 1, 0.75f}, 0.6f, 0.8f);
}

void add_trees(SolidBuilder& builder, const Terrain& terrain) {
  constexpr std::array<std::array<float, 2>, 22> places = {{
      {4, 8},   {8, 20},  {5, 30},  {9, 39},  {3, 46},     {20, 4},  {26, 6},  {35, 1.5f}, {46, 5},  {52, 3},  {61, 8},
      {66, 14}, {63, 22}, {68, 27}, {64, 33}, {69.5f, 40}, {61, 47}, {50, 48}, {40, 50},   {30, 47}, {18, 49}, {10, 13},
  }};
  for (const auto& [x, y] : places) {
    const float ground = terrain.height_at(x, y);
    builder.add_round({x, y, ground - 0.25f}, 2.5f, 0.25f, 0.1875f);
    builder.add_round({x, y, ground + 2.25f}, 3, 1.25f, 0.0625f);
  }
}

}  // namespace

Level build_level(const LevelOptions& options) {
  const bool furnished = options.detail >= 0.2f;
  SolidBuilder builder(0.625f / options.detail);
  const Terrain terrain({0, 0}, {72, 52}, {13, 4}, {59, 45}, -0.125f);
  add_walls(builder, furnished);
  add_hall(builder);
  if (furnished) {
    add_gallery(builder);
    add_balustrades(builder);
    add_furniture(builder);
  }
  builder.add_box({31, 4, -0.25f}, {42, 9.75f, 0});
  builder.add_box({13.75f, 9.75f, -0.25f}, {58.25f, 44.25f, 0});
  builder.add_box({13.75f, 9.75f, storey}, {58.25f, 44.25f, storey + 0.25f});
  if (furnished) add_trees(builder, terrain);
  terrain.add_to(builder);
  return {builder.take(), {36.5f, 24.25f, 1.625f}};
}

}  // namespace surehit::example
