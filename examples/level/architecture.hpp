#pragma once

#include <vector>

#include "level/solid_builder.hpp"

namespace surehit::example {

/// A door or a window: the part of a wall between `from` and `to` along it and between `low` and `high` above its foot.
struct Opening {
  float from;
  float to;
  float low;
  float high;
};

/// A straight upright wall along x or y, with its middle on `position` of the other axis.
struct Wall {
  enum class Along { x, y };

  Along along;
  float position;
  float from;
  float to;
  float thickness;
  std::vector<Opening> openings;  ///< in ascending order, apart from each other
};

void add_wall(SolidBuilder& builder, const Wall& wall, float height);

/// A round pillar between a square base and a square head.
void add_pillar(SolidBuilder& builder, const Point& base_centre, float height, float radius);

/// A solid flight of steps that rises along +y from `low_corner`.
void add_stairs(SolidBuilder& builder, const Point& low_corner, float width, float run, float rise, int steps);

/// Posts and a handrail in a straight line from one point of the floor to another; the far post is left to whatever
/// follows.
void add_railing(SolidBuilder& builder, const Point& from, const Point& to, float height, float post_distance);

}  // namespace surehit::example
