#include "level/architecture.hpp"

#include <cmath>

namespace surehit::example {
namespace {

/// The box that a wall fills between two positions along it and two heights.
void add_wall_piece(SolidBuilder& builder, const Wall& wall, float from, float to, float low, float high) {
  if (!(from < to && low < high)) return;
  const float half = wall.thickness / 2;
  if (wall.along == Wall::Along::x) {
    builder.add_box({from, wall.position - half, low}, {to, wall.position + half, high});
  } else {
    builder.add_box({wall.position - half, from, low}, {wall.position + half, to, high});
  }
}

}  // namespace

void add_wall(SolidBuilder& builder, const Wall& wall, float height) {
  float from = wall.from;
  for (const Opening& opening : wall.openings) {
    add_wall_piece(builder, wall, from, opening.from, 0, height);
    add_wall_piece(builder, wall, opening.from, opening.to, 0, opening.low);
    add_wall_piece(builder, wall, opening.from, opening.to, opening.high, height);
    from = opening.to;
  }
  add_wall_piece(builder, wall, from, wall.to, 0, height);
}

void add_pillar(SolidBuilder& builder, const Point& base_centre, float height, float radius) {
  constexpr float plinth = 0.25f;
  const auto [x, y, z] = base_centre;
  const Point block = {2.5f * radius, 2.5f * radius, plinth};
  builder.add_turned_box(base_centre, block, 1, 0);
  builder.add_round({x, y, z + plinth}, height - 2 * plinth, radius, radius);
  builder.add_turned_box({x, y, z + height - plinth}, block, 1, 0);
}

void add_stairs(SolidBuilder& builder, const Point& low_corner, float width, float run, float rise, int steps) {
  const auto [x, y, z] = low_corner;
  for (int step = 0; step < steps; ++step) {
    const auto below = static_cast<float>(step);
    builder.add_box({x, y + below * run, z}, {x + width, y + (below + 1) * run, z + (below + 1) * rise});
  }
}

void add_railing(SolidBuilder& builder, const Point& from, const Point& to, float height, float post_distance) {
  constexpr float post = 0.0625f;
  constexpr float handrail = 0.09375f;
  const float dx = to[0] - from[0];
  const float dy = to[1] - from[1];
  const float length = std::sqrt(dx * dx + dy * dy);
  const float cosine = dx / length;
  const float sine = dy / length;
  const int posts = static_cast<int>(std::ceil(length / post_distance));
  for (int i = 0; i < posts; ++i) {
    const float s = static_cast<float>(i) / static_cast<float>(posts);
    builder.add_turned_box({from[0] + s * dx, from[1] + s * dy, from[2]}, {post, post, height}, cosine, sine);
  }
  const Point middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, from[2] + height};
  builder.add_turned_box(middle, {length, handrail, handrail}, cosine, sine);
}

}  // namespace surehit::example
