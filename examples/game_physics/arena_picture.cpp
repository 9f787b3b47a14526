#include "game_physics/arena_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "game_physics/depth_sorted.hpp"
#include "game_physics/oblique_view.hpp"

namespace surehit::example {
namespace {

constexpr Colour night = Colour::hex(0x10141d);
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

void add_slats(DepthSorted& shapes, const Arena& arena) {
  constexpr std::size_t room_triangles = 12;
  const TriangleMeshViewf mesh = arena.walls.view();
  const Vector3f light = Vector3f(-0.4f, -0.5f, 0.75f).normalized();
  for (auto i = static_cast<std::uint32_t>(room_triangles); i < mesh.triangle_count(); ++i) {
    const float brightness = std::abs(normal(mesh, i).dot(light));
    const auto& [a, b, c] = arena.walls.triangles[i];
    const std::array<Vector3f, 3> corners = {mesh.vertex(a), mesh.vertex(b), mesh.vertex(c)};
    shapes.add_face({corners[0], corners[1], corners[2]}, mix(slat_dark, slat_light, brightness), 0.75f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f& p = corners[k];
      const Vector3f& q = corners[(k + 1) % 3];
      if (p.y() == arena.room.low.y() && q.y() == p.y()) shapes.add_line(p, q, 2.5f, ink);
    }
  }
}

void add_trail(DepthSorted& shapes, const Trail& trail, std::size_t first, std::size_t last, float width,
               const Colour& colour) {
  for (std::size_t i = first; i < last; ++i) {
    shapes.add_line(trail.positions[i], trail.positions[i + 1], width, colour);
    shapes.add_disc(trail.positions[i + 1], 1.4f * width, colour);
  }
}

/// Where a point started, and its bounces.
void add_flight(DepthSorted& shapes, const Trail& trail, const Colour& colour) {
  shapes.add_disc(trail.positions.front(), 6, colour);
  add_trail(shapes, trail, 0, trail.positions.size() - 1, 2.2f, colour);
}

/// How a point came to a wall, and where it went on beyond it.
void add_escape(DepthSorted& shapes, const Trail& trail) {
  const std::size_t last = std::min(trail.breach + 3, trail.positions.size() - 1);
  add_trail(shapes, trail, trail.breach - std::min<std::size_t>(trail.breach, 2), trail.breach, 1.6f, before_escape);
  add_trail(shapes, trail, trail.breach, last, 2.2f, alarm);
  shapes.add_disc(trail.positions[trail.breach], 7, alarm);
}

float draw_panel(Canvas& canvas, const Arena& arena, float top, const std::string& title, const TrialReport& report,
                 bool shows_escapes) {
  const ObliqueView view(arena.room, panel_width, top + title_height);
  const float left = view.corner(0, 0, 0).x;
  const float after_title = canvas.draw_text({left, top + 24}, title, 3, ink) + 40;
  if (shows_escapes) {
    const float after_legend = canvas.draw_text({after_title, top + 29}, "before the wall", 2, before_escape) + 20;
    canvas.draw_text({after_legend, top + 29}, "through it and on", 2, alarm);
  } else {
    canvas.draw_text({after_title, top + 29}, "from a start, bounce by bounce", 2, trail_colours[0]);
  }
  draw_back_of_room(canvas, view);
  DepthSorted shapes(view);
  add_slats(shapes, arena);
  if (shows_escapes) {
    for (const Trail& trail : report.escapes) add_escape(shapes, trail);
  } else {
    const std::size_t flights = std::min(report.trails.size(), trail_colours.size());
    for (std::size_t i = 0; i < flights; ++i) add_flight(shapes, report.trails[i], trail_colours[i]);
  }
  shapes.draw(canvas);
  draw_front_of_room(canvas, view);
  return view.height() + title_height;
}

}  // namespace

Canvas draw_trials(const Arena& arena, const TrialReport& exact, const TrialReport& with_epsilon) {
  const float panel_height = ObliqueView(arena.room, panel_width, 0).height() + title_height;
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
