#include "game_physics/depth_sorted.hpp"

#include <algorithm>
#include <utility>

namespace surehit::example {

void DepthSorted::add_face(const std::vector<Vector3f>& corners, const Colour& colour, float opacity) {
  add(corners, colour, opacity, 0);
}

void DepthSorted::add_line(const Vector3f& from, const Vector3f& to, float width, const Colour& colour, float opacity) {
  const int pieces = 1 + static_cast<int>((to - from).norm() / 0.25f);
  const auto at = [&](int i) -> Vector3f {
    return from + static_cast<float>(i) / static_cast<float>(pieces) * (to - from);
  };
  for (int i = 0; i < pieces; ++i) add({at(i), at(i + 1)}, colour, opacity, width);
}

void DepthSorted::add_disc(const Vector3f& centre, float radius, const Colour& colour) {
  add({centre}, colour, 1, radius);
}

void DepthSorted::draw(Canvas& canvas) {
  std::stable_sort(shapes_.begin(), shapes_.end(), [](const Shape& a, const Shape& b) { return a.depth > b.depth; });
  for (const Shape& shape : shapes_) {
    if (shape.spots.size() == 1) canvas.draw_disc(shape.spots[0], shape.width, shape.colour, shape.opacity);
    if (shape.spots.size() == 2) {
      canvas.draw_line(shape.spots[0], shape.spots[1], shape.width, shape.colour, shape.opacity);
    }
    if (shape.spots.size() > 2) canvas.draw_convex(shape.spots, shape.colour, shape.opacity);
  }
}

void DepthSorted::add(const std::vector<Vector3f>& points, const Colour& colour, float opacity, float width) {
  Shape shape{0, {}, colour, opacity, width};
  for (const Vector3f& point : points) {
    shape.depth += point.y() / static_cast<float>(points.size());
    shape.spots.push_back(view_.spot(point));
  }
  shapes_.push_back(std::move(shape));
}

}  // namespace surehit::example
