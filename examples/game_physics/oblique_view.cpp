#include "game_physics/oblique_view.hpp"

#include <array>

namespace surehit::example {
namespace {

constexpr Colour back_wall = Colour::hex(0x1b2232);
constexpr Colour side_wall = Colour::hex(0x171d2b);
constexpr Colour floor_colour = Colour::hex(0x20283a);
constexpr Colour frame = Colour::hex(0x5a6a8c);

}  // namespace

ObliqueView::ObliqueView(const Boxf& room, float width, float top) : room_(room), top_(top) {
  const Vector3f size = room.high - room.low;
  scale_ = width / (size.x() + right_per_depth * size.y() + 2 * border);
  height_ = scale_ * (size.z() + up_per_depth * size.y() + 2 * border);
}

Spot ObliqueView::spot(const Vector3f& point) const {
  const Vector3f q = point - room_.low;
  return {scale_ * (border + q.x() + right_per_depth * q.y()),
          top_ + height_ - scale_ * (border + q.z() + up_per_depth * q.y())};
}

Spot ObliqueView::corner(int right, int back, int up) const {
  const auto pick = [&](int side, int axis) { return side == 0 ? room_.low[axis] : room_.high[axis]; };
  return spot({pick(right, 0), pick(back, 1), pick(up, 2)});
}

void draw_back_of_room(Canvas& canvas, const ObliqueView& view) {
  using Quad = std::array<Spot, 4>;
  const auto at = [&](int right, int back, int up) { return view.corner(right, back, up); };
  canvas.draw_convex(Quad{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}, back_wall);
  canvas.draw_convex(Quad{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}, side_wall);
  canvas.draw_convex(Quad{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}, floor_colour);
  canvas.draw_line(at(0, 1, 0), at(1, 1, 0), 1.5f, frame, 0.6f);
  canvas.draw_line(at(0, 1, 0), at(0, 1, 1), 1.5f, frame, 0.6f);
  canvas.draw_line(at(0, 1, 0), at(0, 0, 0), 1.5f, frame, 0.6f);
}

void draw_front_of_room(Canvas& canvas, const ObliqueView& view) {
  const auto at = [&](int right, int back, int up) { return view.corner(right, back, up); };
  for (const int side : {0, 1}) {
    canvas.draw_line(at(0, 0, side), at(1, 0, side), 2, frame);
    canvas.draw_line(at(1, 0, side), at(1, 1, side), 2, frame);
    canvas.draw_line(at(side, 0, 0), at(side, 0, 1), 2, frame);
  }
  canvas.draw_line(at(0, 0, 1), at(0, 1, 1), 2, frame);
  canvas.draw_line(at(0, 1, 1), at(1, 1, 1), 2, frame);
  canvas.draw_line(at(1, 1, 0), at(1, 1, 1), 2, frame);
}

}  // namespace surehit::example
