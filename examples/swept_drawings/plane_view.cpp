#include "swept_drawings/plane_view.hpp"

#include <cmath>
#include <numbers>
#include <variant>

namespace surehit::example {
namespace {

constexpr int corners_of_a_circle = 96;

/// Appends the part of a circle between two angles.
void append_arc(Outline& outline, const PlaneView& view, float x, float y, float radius, float first, float last) {
  const int count = static_cast<int>(std::ceil((last - first) / (2 * std::numbers::pi_v<float>)*corners_of_a_circle));
  for (int i = 0; i <= count; ++i) {
    const float angle = first + (last - first) * static_cast<float>(i) / static_cast<float>(count);
    outline.push_back(view.spot(x + radius * std::cos(angle), y + radius * std::sin(angle)));
  }
}

Outline outline_at(const SweptSpheref& ball, const Vector3f& centre, const PlaneView& view) {
  Outline outline;
  append_arc(outline, view, centre.x(), centre.z(), ball.radius, 0, 2 * std::numbers::pi_v<float>);
  outline.pop_back();
  return outline;
}

Outline outline_at(const SweptBoxf& box, const Vector3f& centre, const PlaneView& view) {
  const Vector3f low = centre - box.half_extents;
  const Vector3f high = centre + box.half_extents;
  return {view.spot(low.x(), low.z()), view.spot(high.x(), low.z()), view.spot(high.x(), high.z()),
          view.spot(low.x(), high.z())};
}

Outline outline_at(const SweptCapsulef& capsule, const Vector3f& centre, const PlaneView& view) {
  constexpr float half_turn = std::numbers::pi_v<float>;
  const Vector3f first = centre + capsule.half_axis;
  const Vector3f last = centre - capsule.half_axis;
  const float along = std::atan2(capsule.half_axis.z(), capsule.half_axis.x());
  Outline outline;
  append_arc(outline, view, first.x(), first.z(), capsule.radius, along - half_turn / 2, along + half_turn / 2);
  append_arc(outline, view, last.x(), last.z(), capsule.radius, along + half_turn / 2, along + 3 * half_turn / 2);
  return outline;
}

}  // namespace

Outline outline_from_the_side(const SweptShapef& shape, const Vector3f& centre, const PlaneView& view) {
  return std::visit([&](const auto& any) { return outline_at(any, centre, view); }, shape);
}

void draw_outline(Canvas& canvas, const Outline& outline, const Colour& colour, float filled, float line_width) {
  if (filled > 0) canvas.draw_convex(outline, colour, filled);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    canvas.draw_line(outline[i], outline[(i + 1) % outline.size()], line_width, colour);
  }
}

void draw_arrow(Canvas& canvas, const Spot& from, const Spot& to, const Colour& colour) {
  constexpr float head = 12;
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  const float x = (to.x - from.x) / length;
  const float y = (to.y - from.y) / length;
  const Spot neck = {to.x - head * x, to.y - head * y};
  canvas.draw_line(from, neck, 3, colour);
  const Spot corners[] = {
      to, {neck.x - head / 2 * y, neck.y + head / 2 * x}, {neck.x + head / 2 * y, neck.y - head / 2 * x}};
  canvas.draw_convex(corners, colour);
}

void draw_dashes(Canvas& canvas, const Spot& from, const Spot& to, const Colour& colour) {
  constexpr float dash = 7;
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  const auto at = [&](float way) {
    const float share = std::min(1.0f, way / length);
    return Spot{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
  };
  for (float way = 0; way < length; way += 2 * dash) canvas.draw_line(at(way), at(way + dash), 1.5f, colour);
}

void draw_centred(Canvas& canvas, const Spot& middle, std::string_view text, float scale, const Colour& colour) {
  Canvas unseen(1, 1, night);
  const float width = unseen.draw_text({0, 0}, text, scale, colour);
  canvas.draw_text({middle.x - width / 2, middle.y - 3.5f * scale}, text, scale, colour);
}

}  // namespace surehit::example
