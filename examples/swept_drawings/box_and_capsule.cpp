#include <cmath>
#include <cstdio>
#include <string>
#include <surehit/surehit.hpp>
#include <variant>
#include <vector>

#include "swept_drawings/drawings.hpp"
#include "swept_drawings/plane_view.hpp"

namespace surehit::example {
namespace {

constexpr int ways_height = 560;
constexpr Colour ground = Colour::hex(0x39445c);

/// A level that is the same at all y: some lines in x and z, each drawn out along y.
struct Profile {
  std::vector<Vector3f> vertices;
  std::vector<unsigned> triangles;

  void add(float x, float z, float other_x, float other_z) {
    const auto first = static_cast<unsigned>(vertices.size());
    vertices.insert(vertices.end(), {{x, -5, z}, {other_x, -5, other_z}, {other_x, 5, other_z}, {x, 5, z}});
    for (const unsigned corner : {0U, 1U, 2U, 0U, 2U, 3U}) triangles.push_back(first + corner);
  }
};

/// One shape on its way to what it touches first, and where it would have gone.
void draw_way(Canvas& canvas, const PlaneView& view, const Colliderf& level, const SweptShapef& shape, const char* name,
              const Colour& colour) {
  const auto [start, end] =
      std::visit([](const auto& any) { return std::pair<Vector3f, Vector3f>(any.start, any.end); }, shape);
  const auto hit = level.first_hit(shape);
  const Vector3f rest = level.last_free_point(shape, *hit);
  constexpr int ghosts = 5;
  draw_dashes(canvas, view.spot(start.x(), start.z()), view.spot(end.x(), end.z()), dim);
  draw_outline(canvas, outline_from_the_side(shape, end, view), mix(night, dim, 0.7f), 0, 1.5f);
  for (int i = 0; i < ghosts; ++i) {
    const float share = static_cast<float>(i) / ghosts;
    const Vector3f centre = start + share * (rest - start);
    draw_outline(canvas, outline_from_the_side(shape, centre, view), mix(night, colour, 0.35f + 0.4f * share), 0.08f,
                 2);
  }
  draw_outline(canvas, outline_from_the_side(shape, rest, view), colour, 0.35f, 3);
  const Trianglef touched_triangle = level.triangle(hit->triangle);
  const Vector3f touched = contact_point(touched_triangle, *hit);
  const Vector3f normal = contact_normal<float>(shape, touched_triangle);
  const Spot spot = view.spot(touched.x(), touched.z());
  draw_arrow(canvas, spot, view.spot(touched.x() + 1.3f * normal.x(), touched.z() + 1.3f * normal.z()), ink);
  canvas.draw_disc(spot, 7, ink);
  char text[80];
  std::snprintf(text, sizeof text, "%s: t = %.4g", name, double{hit->t});
  draw_centred(canvas, view.spot(start.x() + 0.5f, start.z() + 1.35f), text, 2, colour);
}

}  // namespace

Canvas draw_box_and_capsule() {
  Canvas canvas(drawing_width, ways_height, night);
  const PlaneView view{{30, 480}, 76};
  Profile profile;
  profile.add(0, 0, 4.5f, 0);
  profile.add(4.5f, 0, 4.5f, 1.5f);
  profile.add(4.5f, 1.5f, 7, 1.5f);
  profile.add(7, 1.5f, 7, 0);
  profile.add(7, 0, 10, 0);
  profile.add(10, 0, 16, 3);
  const std::vector<std::vector<Spot>> solids = {
      {view.spot(0, 0), view.spot(16.1f, 0), view.spot(16.1f, -0.5f), view.spot(0, -0.5f)},
      {view.spot(4.5f, 0), view.spot(7, 0), view.spot(7, 1.5f), view.spot(4.5f, 1.5f)},
      {view.spot(10, 0), view.spot(16.1f, 0), view.spot(16.1f, 3.05f)}};
  for (const auto& solid : solids) canvas.draw_convex(solid, ground);
  const Colliderf level(TriangleMeshViewf(profile.vertices, profile.triangles));
  draw_way(canvas, view, level, SweptBoxf{{1.2f, 0, 4.4f}, {6.2f, 0, 0.9f}, {0.9f, 0.5f, 0.6f}}, "SweptBox",
           Colour::hex(0xffb02e));
  draw_way(canvas, view, level, SweptCapsulef{{9, 0, 4.6f}, {14.6f, 0, 0.4f}, {0.45f, 0, 0.6f}, 0.5f}, "SweptCapsule",
           Colour::hex(0x58b4ff));
  return canvas;
}

}  // namespace surehit::example
