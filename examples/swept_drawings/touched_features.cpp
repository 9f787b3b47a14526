#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <surehit/surehit.hpp>
#include <vector>

#include "swept_drawings/drawings.hpp"
#include "swept_drawings/plane_view.hpp"

namespace surehit::example {
namespace {

constexpr int plan_height = 540;
constexpr float radius = 1;
constexpr float top = 4;  ///< Balls fall from this height to its opposite.
constexpr std::array<Colour, 7> colours = {Colour::hex(0x4f8fe0), Colour::hex(0xffb02e), Colour::hex(0x43d9a3),
                                           Colour::hex(0xe6f25a), Colour::hex(0xff5d5d), Colour::hex(0xd58bff),
                                           Colour::hex(0xff9fd0)};
constexpr std::array<const char*, 7> names = {"face",     "edge_ab",  "edge_bc", "edge_ca",
                                              "corner_a", "corner_b", "corner_c"};

Colour colour_of(Feature feature) { return colours[static_cast<std::size_t>(feature)]; }

SweptSpheref falling(float x, float y) { return {{x, y, top}, {x, y, -top}, radius}; }
float height_at(const ShapeHitf& hit) { return top - 2 * top * hit.t; }

const Trianglef triangle{{0, 0, 0}, {6, 1, 0}, {2, 5, 0}};
/// From corner a straight across the edge from b to c.
const Vector3f along = Vector3f(1, 1, 0).normalized();

/// The height of each ball where it first touches, as light, and the part that it touches, as colour.
void draw_plan(Canvas& canvas, const PlaneView& view, int columns) {
  const std::array<Vector3f, 3> corners = {triangle.a, triangle.b, triangle.c};
  constexpr std::array<unsigned, 3> ids = {0, 1, 2};
  const Colliderf collider(TriangleMeshViewf(corners, ids));
  std::vector<SweptSpheref> balls;
  for (int y = 0; y < plan_height; ++y) {
    for (int x = 0; x < columns; ++x) {
      balls.push_back(falling((static_cast<float>(x) + 0.5f - view.origin.x) / view.scale,
                              (view.origin.y - static_cast<float>(y) - 0.5f) / view.scale));
    }
  }
  std::vector<ShapeHitf> hits(balls.size());
  collider.first_hits(balls, hits);
  const auto level_of = [](const ShapeHitf& hit) {
    return hit.triangle == no_triangle ? -1 : static_cast<int>(std::ceil(6 * height_at(hit)));
  };
  for (int y = 0; y < plan_height; ++y) {
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * columns + x);
      if (hits[i].triangle == no_triangle) continue;
      const bool is_line = (x > 0 && level_of(hits[i]) != level_of(hits[i - 1])) ||
                           (y > 0 && level_of(hits[i]) != level_of(hits[i - static_cast<std::size_t>(columns)]));
      canvas.at(x, y) =
          mix(night, colour_of(hits[i].feature), (is_line ? 0.5f : 0.9f) * (0.35f + 0.65f * height_at(hits[i])));
    }
  }
}

/// A ball that falls at some way from corner a, from the side.
void draw_ball(Canvas& canvas, const PlaneView& view, float way) {
  const SweptSpheref ball = falling(way * along.x(), way * along.y());
  const auto hit = intersect(ball, triangle);
  const SweptSpheref from_the_side{{way, 0, top}, {way, 0, -top}, radius};
  const Spot start = view.spot(way, 3.4f);
  if (!hit) {
    draw_dashes(canvas, start, view.spot(way, -1.6f), dim);
    draw_outline(canvas, outline_from_the_side(from_the_side, {way, 0, -0.6f}, view), dim, 0.15f, 2);
    draw_centred(canvas, view.spot(way, 3.7f), "misses", 2, dim);
    return;
  }
  const float z = height_at(*hit);
  const Colour colour = colour_of(hit->feature);
  draw_dashes(canvas, start, view.spot(way, z), dim);
  draw_outline(canvas, outline_from_the_side(from_the_side, {way, 0, z}, view), colour, 0.3f, 3);
  const Vector3f touched = contact_point(triangle, *hit);
  const Vector3f normal = contact_normal(ball, triangle);
  const Spot point = view.spot(touched.dot(along), touched.z());
  draw_arrow(canvas, point,
             view.spot(touched.dot(along) + radius * normal.dot(along), touched.z() + radius * normal.z()), ink);
  canvas.draw_disc(point, 6, ink);
  draw_centred(canvas, view.spot(way, 3.7f), names[static_cast<std::size_t>(hit->feature)], 2, colour);
}

}  // namespace

Canvas draw_touched_features() {
  constexpr int plan_width = 560;
  Canvas canvas(drawing_width, plan_height, night);
  const PlaneView plan{{100, 420}, 62};
  draw_plan(canvas, plan, plan_width);
  const auto spot = [&](const Vector3f& point) { return plan.spot(point.x(), point.y()); };
  const std::array<Vector3f, 3> corners = {triangle.a, triangle.b, triangle.c};
  for (std::size_t i = 0; i < 3; ++i) canvas.draw_line(spot(corners[i]), spot(corners[(i + 1) % 3]), 3, night);
  draw_centred(canvas, {spot(triangle.a).x - 18, spot(triangle.a).y + 14}, "a", 3, night);
  draw_centred(canvas, {spot(triangle.b).x + 24, spot(triangle.b).y}, "b", 3, night);
  draw_centred(canvas, {spot(triangle.c).x, spot(triangle.c).y - 26}, "c", 3, night);

  const std::array<float, 4> ways = {-0.7f, 2.2f, 5.3f, 7.1f};
  draw_dashes(canvas, spot(-1.4f * along), spot(7.4f * along), ink);
  for (const float way : ways) canvas.draw_disc(spot(way * along), 4, ink);

  const PlaneView side{{740, 350}, 62};
  const float edge = triangle.b.dot(along);
  canvas.draw_line(side.spot(0, 0), side.spot(edge, 0), 6, ink);
  draw_centred(canvas, side.spot(0, -0.35f), "a", 3, ink);
  draw_centred(canvas, side.spot(edge, -0.35f), "bc", 3, ink);
  for (const float way : ways) draw_ball(canvas, side, way);
  draw_centred(canvas, {plan_width / 2 + 6, plan_height - 30}, "from above: the part that each ball touches first", 2,
               ink);
  draw_centred(canvas, {(plan_width + drawing_width) / 2.0f, plan_height - 30},
               "from the side, along the line of dashes", 2, ink);
  return canvas;
}

}  // namespace surehit::example
