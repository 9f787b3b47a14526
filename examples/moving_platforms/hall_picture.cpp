#include "moving_platforms/hall_picture.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "game_physics/depth_sorted.hpp"
#include "game_physics/oblique_view.hpp"

namespace surehit::example {
namespace {

constexpr Colour night = Colour::hex(0x10141d);
constexpr Colour bullet_colour = Colour::hex(0xffd166);
constexpr Colour debris_colour = Colour::hex(0xd9e2f2);
constexpr Colour fan_colour = Colour::hex(0x7be0c3);

/// For so many steps a bullet leaves a streak.
constexpr std::uint32_t streak_steps = 3;

struct Look {
  Colour colour;
  float opacity;
};

Look look_of(Platform::Kind kind) {
  switch (kind) {
    case Platform::Kind::lift:
      return {Colour::hex(0x86a5d6), 1};
    case Platform::Kind::door:
      return {Colour::hex(0x6fa8dc), 0.45f};
    case Platform::Kind::train:
      return {Colour::hex(0xc8553d), 1};
  }
  return {};
}

/// The three faces of a box that are seen: its top, its right side and its front.
void add_box(DepthSorted& shapes, const Boxf& box, const Look& look) {
  const auto at = [&](int right, int back, int up) -> Vector3f {
    const auto pick = [&](int side, int axis) { return side == 0 ? box.low[axis] : box.high[axis]; };
    return {pick(right, 0), pick(back, 1), pick(up, 2)};
  };
  const auto shade = [&](float light) { return mix(night, look.colour, light); };
  shapes.add_face({at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, shade(0.55f), look.opacity);
  shapes.add_face({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, shade(1), look.opacity);
  shapes.add_face({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, shade(0.75f), look.opacity);
}

void add_fan(DepthSorted& shapes, const Fan& fan, const FanTurn& turn) {
  const Mesh<float> mesh = fan.mesh();
  const Posef pose = turn.pose(fan);
  const Vector3f light = Vector3f(-0.4f, -0.5f, 0.75f).normalized();
  for (const auto& triangle : mesh.triangles) {
    std::vector<Vector3f> corners;
    for (const std::uint32_t id : triangle) {
      const auto& [x, y, z] = mesh.vertices[id];
      corners.emplace_back(pose.linear * Vector3f(x, y, z) + pose.translation);
    }
    const Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    shapes.add_face(corners, mix(night, fan_colour, 0.4f + 0.6f * std::abs(normal.dot(light))), 1);
  }
  shapes.add_disc(fan.centre, 3, fan_colour);
}

}  // namespace

void HallPicture::note_step(std::uint32_t step, const Game& game) {
  step_ = step;
  for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i].advance(hall_.fans[i]);
  std::erase_if(traces_, [&](const Trace& trace) { return trace.step + streak_steps <= step; });
  for (const Way& way : game.ways()) traces_.push_back({way, game.pieces()[way.slot].kind, step});
}

Canvas HallPicture::draw() {
  const ObliqueView view(hall_.room, static_cast<float>(width_), 0);
  Canvas canvas(width_, static_cast<int>(view.height()), night);
  draw_back_of_room(canvas, view);
  DepthSorted shapes(view);
  for (const Platform& platform : hall_.platforms) {
    const Vector3f position = platform.position(step_ + 1);
    for (const Boxf& box : platform.boxes) {
      add_box(shapes, {box.low + position, box.high + position}, look_of(platform.kind));
    }
  }
  for (std::size_t i = 0; i < turns_.size(); ++i) add_fan(shapes, hall_.fans[i], turns_[i]);
  for (const Trace& trace : traces_) {
    const bool is_last = trace.step == step_;
    if (trace.kind == Piece::Kind::bullet) {
      shapes.add_line(trace.way.from, trace.way.to, is_last ? 2.0f : 1.25f, bullet_colour);
    } else if (is_last) {
      shapes.add_disc(trace.way.to, 2, debris_colour);
    }
  }
  shapes.draw(canvas);
  draw_front_of_room(canvas, view);
  return canvas;
}

}  // namespace surehit::example
