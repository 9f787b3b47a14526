#include "game_physics/arena_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surehit::example {
namespace {

constexpr Colour night = Colour::hex(0x10141d);
constexpr Colour back_wall = Colour::hex(0x1b2232);
constexpr Colour side_wall = Colour::hex(0x171d2b);
constexpr Colour floor_colour = Colour::hex(0x20283a);
constexpr Colour frame = Colour::hex(0x5a6a8c);
constexpr Colour slat_dark = Colour::hex(0x2b3d5f);
constexpr Colour slat_light = Colour::hex(0x86a5d6);
constexpr Colour ink = Colour::hex(0xe8ebf2);
constexpr Colour before_escape = Colour::hex(0xffd166);
constexpr Colour alarm = Colour::hex(0xff4d4f);
constexpr std::array<Colour, 7> trail_colours = {Colour::hex(0xffd166), Colour::hex(0xff9f5a), Colour::hex(0x7be0c3),
                                                 Colour::hex(0xf7a8c4), Colour::hex(0xd6f06f), Colour::hex(0x8fd3ff),
                                                 Colour::hex(0xc9a7ff)};

constexpr int panel_width = 1600;
constexpr float title_height = 52;
constexpr float border = 1;  ///< of the room, in its own unit

/// Oblique projection: x to the right, z up, and y away to the upper right.
class View {
 public:
  View(const Boxf& room, float top) : room_(room), top_(top) {
    const Vector3f size = room.high - room.low;
    scale_ = panel_width / (size.x() + right_per_depth * size.y() + 2 * border);
    height_ = scale_ * (size.z() + up_per_depth * size.y() + 2 * border);
  }

  [[nodiscard]] Spot spot(const Vector3f& p) const {
    const Vector3f q = p - room_.low;
    return {scale_ * (border + q.x() + right_per_depth * q.y()),
            top_ + height_ - scale_ * (border + q.z() + up_per_depth * q.y())};
  }
  /// Of the room: each is 0 or 1.
  [[nodiscard]] Spot corner(int right, int back, int up) const {
    const auto pick = [&](int side, int axis) { return side == 0 ? room_.low[axis] : room_.high[axis]; };
    return spot({pick(right, 0), pick(back, 1), pick(up, 2)});
  }
  [[nodiscard]] float height() const { return height_; }

 private:
  static constexpr float right_per_depth = 0.3f;
  static constexpr float up_per_depth = 0.22f;

  Boxf room_;
  float top_;
  float scale_;
  float height_;
};

void draw_room(Canvas& canvas, const View& view) {
  using Quad = std::array<Spot, 4>;
  const auto at = [&](int right, int back, int up) { return view.corner(right, back, up); };
  canvas.draw_convex(Quad{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}, back_wall);
  canvas.draw_convex(Quad{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}, side_wall);
  canvas.draw_convex(Quad{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}, floor_colour);
  canvas.draw_line(at(0, 1, 0), at(1, 1, 0), 1.5f, frame, 0.6f);
  canvas.draw_line(at(0, 1, 0), at(0, 1, 1), 1.5f, frame, 0.6f);
  canvas.draw_line(at(0, 1, 0), at(0, 0, 0), 1.5f, frame, 0.6f);
}

void draw_front_frame(Canvas& canvas, const View& view) {
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

/// A slat's triangle or a piece of a trail. They are cut short and drawn from the back to the front.
struct Shape {
  float depth;
  std::vector<Spot> spots;  ///< one of a disc, two of a line, more of a face
  Colour colour;
  float opacity;
  float width;  ///< of a line; a disc's radius
};

/// All that is drawn within the room.
class Scene {
 public:
  explicit Scene(const View& view) : view_(view) {}

  void add_face(const std::vector<Vector3f>& corners, const Colour& colour, float opacity) {
    add(corners, colour, opacity, 0);
  }

  void add_line(const Vector3f& from, const Vector3f& to, float width, const Colour& colour, float opacity = 1) {
    const int pieces = 1 + static_cast<int>((to - from).norm() / 0.25f);
    const auto at = [&](int i) -> Vector3f {
      return from + static_cast<float>(i) / static_cast<float>(pieces) * (to - from);
    };
    for (int i = 0; i < pieces; ++i) add({at(i), at(i + 1)}, colour, opacity, width);
  }

  void add_disc(const Vector3f& centre, float radius, const Colour& colour) { add({centre}, colour, 1, radius); }

  void draw(Canvas& canvas) {
    std::stable_sort(shapes_.begin(), shapes_.end(), [](const Shape& a, const Shape& b) { return a.depth > b.depth; });
    for (const Shape& shape : shapes_) {
      if (shape.spots.size() == 1) canvas.draw_disc(shape.spots[0], shape.width, shape.colour, shape.opacity);
      if (shape.spots.size() == 2) {
        canvas.draw_line(shape.spots[0], shape.spots[1], shape.width, shape.colour, shape.opacity);
      }
      if (shape.spots.size() > 2) canvas.draw_convex(shape.spots, shape.colour, shape.opacity);
    }
  }

 private:
  void add(const std::vector<Vector3f>& points, const Colour& colour, float opacity, float width) {
    Shape shape{0, {}, colour, opacity, width};
    for (const Vector3f& point : points) {
      shape.depth += point.y() / static_cast<float>(points.size());
      shape.spots.push_back(view_.spot(point));
    }
    shapes_.push_back(std::move(shape));
  }

  const View& view_;
  std::vector<Shape> shapes_;
};

void add_slats(Scene& scene, const Arena& arena) {
  constexpr std::size_t room_triangles = 12;
  const TriangleMeshViewf mesh = arena.walls.view();
  const Vector3f light = Vector3f(-0.4f, -0.5f, 0.75f).normalized();
  for (auto i = static_cast<std::uint32_t>(room_triangles); i < mesh.triangle_count(); ++i) {
    const float brightness = std::abs(normal(mesh, i).dot(light));
    const auto& [a, b, c] = arena.walls.triangles[i];
    const std::array<Vector3f, 3> corners = {mesh.vertex(a), mesh.vertex(b), mesh.vertex(c)};
    scene.add_face({corners[0], corners[1], corners[2]}, mix(slat_dark, slat_light, brightness), 0.75f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f& p = corners[k];
      const Vector3f& q = corners[(k + 1) % 3];
      if (p.y() == arena.room.low.y() && q.y() == p.y()) scene.add_line(p, q, 2.5f, ink);
    }
  }
}

void add_trail(Scene& scene, const Trail& trail, std::size_t first, std::size_t last, float width,
               const Colour& colour) {
  for (std::size_t i = first; i < last; ++i) {
    scene.add_line(trail.positions[i], trail.positions[i + 1], width, colour);
    scene.add_disc(trail.positions[i + 1], 1.4f * width, colour);
  }
}

/// Where a point started, and its bounces.
void add_flight(Scene& scene, const Trail& trail, const Colour& colour) {
  scene.add_disc(trail.positions.front(), 6, colour);
  add_trail(scene, trail, 0, trail.positions.size() - 1, 2.2f, colour);
}

/// How a point came to a wall, and where it went on beyond it.
void add_escape(Scene& scene, const Trail& trail) {
  const std::size_t last = std::min(trail.breach + 3, trail.positions.size() - 1);
  add_trail(scene, trail, trail.breach - std::min<std::size_t>(trail.breach, 2), trail.breach, 1.6f, before_escape);
  add_trail(scene, trail, trail.breach, last, 2.2f, alarm);
  scene.add_disc(trail.positions[trail.breach], 7, alarm);
}

float draw_panel(Canvas& canvas, const Arena& arena, float top, const std::string& title, const TrialReport& report,
                 bool shows_escapes) {
  const View view(arena.room, top + title_height);
  const float left = view.corner(0, 0, 0).x;
  const float after_title = canvas.draw_text({left, top + 24}, title, 3, ink) + 40;
  if (shows_escapes) {
    const float after_legend = canvas.draw_text({after_title, top + 29}, "before the wall", 2, before_escape) + 20;
    canvas.draw_text({after_legend, top + 29}, "through it and on", 2, alarm);
  } else {
    canvas.draw_text({after_title, top + 29}, "from a start, bounce by bounce", 2, trail_colours[0]);
  }
  draw_room(canvas, view);
  Scene scene(view);
  add_slats(scene, arena);
  if (shows_escapes) {
    for (const Trail& trail : report.escapes) add_escape(scene, trail);
  } else {
    const std::size_t flights = std::min(report.trails.size(), trail_colours.size());
    for (std::size_t i = 0; i < flights; ++i) add_flight(scene, report.trails[i], trail_colours[i]);
  }
  scene.draw(canvas);
  draw_front_frame(canvas, view);
  return view.height() + title_height;
}

}  // namespace

Canvas draw_trials(const Arena& arena, const TrialReport& exact, const TrialReport& with_epsilon) {
  const float panel_height = View(arena.room, 0).height() + title_height;
  Canvas canvas(panel_width, static_cast<int>(2 * panel_height), night);
  const auto title = [](const char* name, const TrialReport& report) {
    return std::string(name) + ": " + std::to_string(report.escaped) + " of " + std::to_string(report.points) +
           " points through a wall";
  };
  const float second = draw_panel(canvas, arena, 0, title("surehit", exact), exact, false);
  draw_panel(canvas, arena, second, title("float with epsilon", with_epsilon), with_epsilon, true);
  return canvas;
}

}  // namespace surehit::example
