#include "surehit_query/explanation_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace surehit::example {
namespace {

constexpr Colour night = Colour::hex(0x10141d);
constexpr Colour ink = Colour::hex(0xe8ebf2);
constexpr int width = 1440;
constexpr int height = 900;
constexpr float margin = 40;
constexpr float legend_height = 56;

/// A parallel projection that is turned a little, so that boxes have depth.
class AsideView {
 public:
  AsideView(const Drawing& drawing, const Vector3d& direction) {
    Vector3d right =
        direction.norm() > 0 && std::isfinite(direction.norm()) ? direction.normalized() : Vector3d(1, 0, 0);
    // Up is z, or y for a path that goes up or down.
    const Vector3d sky = std::abs(right.z()) < 0.9 ? Vector3d(0, 0, 1) : Vector3d(0, 1, 0);
    const Vector3d away = sky.cross(right).normalized();
    const Vector3d up = right.cross(away);
    const double turn = 0.35;
    const double tilt = 0.4;
    right_ = std::cos(turn) * right + std::sin(turn) * away;
    const Vector3d turned_away = std::cos(turn) * away - std::sin(turn) * right;
    up_ = std::cos(tilt) * up + std::sin(tilt) * turned_away;
    away_ = std::cos(tilt) * turned_away - std::sin(tilt) * up;

    Boxd box;
    const auto see = [&](const Vector3d& point) { box.extend({right_.dot(point), up_.dot(point), 0}); };
    for (const Drawing::Line& line : drawing.lines) {
      see(line.from);
      see(line.to);
    }
    if (box.is_empty()) box.extend(Vector3d::Zero());
    const Vector3d size = box.high - box.low;
    const double room_x = width - 2 * margin;
    const double room_y = height - 2 * margin - legend_height;
    scale_ = std::min(room_x / std::max(size.x(), 1e-300), room_y / std::max(size.y(), 1e-300));
    if (!std::isfinite(scale_)) scale_ = 1;
    middle_ = box.low / 2 + box.high / 2;
  }

  [[nodiscard]] Spot spot(const Vector3d& point) const {
    return {on_canvas(width / 2.0 + scale_ * (right_.dot(point) - middle_.x())),
            on_canvas((height - legend_height) / 2.0 - scale_ * (up_.dot(point) - middle_.y()))};
  }
  [[nodiscard]] double depth(const Vector3d& point) const { return away_.dot(point); }
  /// Light from the upper left: faces that are turned to it are brighter.
  [[nodiscard]] float light_on(const Triangled& triangle) const {
    const Vector3d normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    if (!(normal.norm() > 0)) return 1;
    const Vector3d light = (-0.5 * right_ + 0.7 * up_ - 0.5 * away_).normalized();
    return 0.55F + 0.45F * static_cast<float>(std::abs(normal.normalized().dot(light)));
  }

 private:
  /// Returns a number that a canvas takes, for points that are anywhere.
  static float on_canvas(double spot) {
    return std::isfinite(spot) ? static_cast<float>(std::clamp(spot, -1e7, 1e7)) : 0;
  }

  Vector3d right_, up_, away_;
  Vector3d middle_;
  double scale_;
};

template <typename Scalar>
void draw_mesh(Canvas& canvas, const AsideView& view, const Collider<Scalar>& mesh) {
  for (std::uint32_t id = 0; id < mesh.triangle_count(); ++id) {
    const Triangle<Scalar> triangle = mesh.triangle(id);
    const std::array<Spot, 3> spots = {view.spot(triangle.a.template cast<double>()),
                                       view.spot(triangle.b.template cast<double>()),
                                       view.spot(triangle.c.template cast<double>())};
    for (std::size_t i = 0; i < 3; ++i) canvas.draw_line(spots[i], spots[(i + 1) % 3], 1, miss_colour, 0.1F);
  }
}

void draw_lines(Canvas& canvas, const AsideView& view, const Drawing& drawing, Drawing::Stroke stroke, float line_width,
                float opacity) {
  for (const Drawing::Line& line : drawing.lines) {
    if (line.stroke != stroke) continue;
    canvas.draw_line(view.spot(line.from), view.spot(line.to), line_width, line.colour, opacity);
  }
}

void draw_faces(Canvas& canvas, const AsideView& view, const Drawing& drawing) {
  std::vector<const Drawing::Face*> faces;
  for (const Drawing::Face& face : drawing.faces) faces.push_back(&face);
  const auto depth = [&](const Drawing::Face* face) {
    return view.depth(face->triangle.a + face->triangle.b + face->triangle.c);
  };
  std::ranges::stable_sort(faces, [&](const auto* x, const auto* y) { return depth(x) > depth(y); });
  for (const Drawing::Face* face : faces) {
    const std::array<Spot, 3> spots = {view.spot(face->triangle.a), view.spot(face->triangle.b),
                                       view.spot(face->triangle.c)};
    canvas.draw_convex(spots, mix(night, face->colour, view.light_on(face->triangle)), 0.75F);
    for (std::size_t i = 0; i < 3; ++i) canvas.draw_line(spots[i], spots[(i + 1) % 3], 1, face->colour, 0.9F);
  }
}

void draw_legend(Canvas& canvas) {
  struct Entry {
    Colour colour;
    std::string_view meaning;
  };
  constexpr std::array<Entry, 8> entries = {{{path_colour, "path"},
                                             {empty_colour, "empty cells"},
                                             {passed_colour, "box or slab missed"},
                                             {list_colour, "list"},
                                             {miss_colour, "candidate, miss"},
                                             {left_out_colour, "left out"},
                                             {hit_colour, "hit"},
                                             {first_colour, "first hit"}}};
  const float top = height - legend_height + 12;
  float x = margin;
  for (const auto& [colour, meaning] : entries) {
    canvas.draw_rectangle({x, top}, {x + 18, top + 18}, colour);
    x = canvas.draw_text({x + 26, top + 2}, meaning, 2, ink) + 32;
  }
}

}  // namespace

template <typename Scalar>
Canvas picture_of(const Drawing& drawing, const Collider<Scalar>& mesh, const Vector3d& direction) {
  const AsideView view(drawing, direction);
  Canvas canvas(width, height, night);
  draw_mesh(canvas, view, mesh);
  draw_lines(canvas, view, drawing, Drawing::Stroke::cell, 1, 0.9F);
  draw_faces(canvas, view, drawing);
  draw_lines(canvas, view, drawing, Drawing::Stroke::list, 1.5F, 0.9F);
  draw_lines(canvas, view, drawing, Drawing::Stroke::rest_of_path, 1.5F, 0.7F);
  draw_lines(canvas, view, drawing, Drawing::Stroke::path, 3, 1);
  for (const Vector3d& point : drawing.points) {
    canvas.draw_disc(view.spot(point), 8, ink);
    canvas.draw_disc(view.spot(point), 6, first_colour);
  }
  draw_legend(canvas);
  return canvas;
}

template Canvas picture_of(const Drawing&, const Collider<float>&, const Vector3d&);
template Canvas picture_of(const Drawing&, const Collider<double>&, const Vector3d&);

}  // namespace surehit::example
