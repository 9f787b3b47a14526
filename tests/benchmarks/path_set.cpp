#include "path_set.hpp"

#include <functional>

namespace surehit::benchmark {
namespace {

using test::Random;
using Draw = std::function<Segmentf(Random&)>;

constexpr double short_length = 0.01;  // of the diagonal, as the next one
constexpr double near_distance = 0.005;

/// A point in the scene's box when that is inflated about its centre.
class BoxPoints {
 public:
  BoxPoints(const Boxf& box, double inflation)
      : centre_((box.low.cast<double>() + box.high.cast<double>()) / 2),
        size_(inflation * (box.high.cast<double>() - box.low.cast<double>())) {}

  [[nodiscard]] Vector3d draw(Random& random) const {
    return centre_ + (draw_in_unit_cube(random) - Vector3d::Constant(0.5)).cwiseProduct(size_);
  }

 private:
  Vector3d centre_;
  Vector3d size_;
};

Segmentf rounded(const Vector3d& start, const Vector3d& end) { return {start.cast<float>(), end.cast<float>()}; }

Draw long_draw(const Scene& scene) {
  return [points = BoxPoints(scene.box(), 1.2)](Random& random) {
    const Vector3d start = points.draw(random);
    return rounded(start, points.draw(random));
  };
}

Draw short_draw(const Scene& scene) {
  return [points = BoxPoints(scene.box(), 1), length = short_length * scene.diagonal()](Random& random) {
    const Vector3d start = points.draw(random);
    return rounded(start, start + length * draw_direction(random));
  };
}

Draw near_draw(const Scene& scene) {
  const SurfacePoints surface(scene.mesh.view(), [](const Trianglef&) { return true; });
  return [surface, diagonal = scene.diagonal()](Random& random) {
    const Vector3d touched = surface.draw(random);
    const Vector3d start = touched + near_distance * diagonal * draw_in_unit_ball(random);
    return rounded(start, start + short_length * diagonal * draw_direction(random));
  };
}

Draw sight_draw(const Scene& scene) {
  return [floor = scene.floor(), eye = scene.eye, above = scene.upward(Scene::target_height * scene.diagonal())](
             Random& random) { return rounded(eye, floor.draw(random) + above); };
}

Vector3d draw_vertex_or_edge_point(const TriangleMeshViewf& mesh, Random& random) {
  const std::size_t triangle = random.below(mesh.triangle_count());
  const std::size_t which = random.below(3);
  const Vector3d a = mesh.vertex(mesh.corner(triangle, which)).cast<double>();
  if (random.one_in(2)) return a;
  const Vector3d b = mesh.vertex(mesh.corner(triangle, (which + 1) % 3)).cast<double>();
  const Vector3d between = a + random.unit<double>() * (b - a);
  return between.cast<float>().cast<double>();
}

Draw edge_draw(const Scene& scene) {
  return [points = BoxPoints(scene.box(), 1.2), mesh = scene.mesh.view()](Random& random) {
    const Vector3d start = points.draw(random).cast<float>().cast<double>();
    return rounded(start, 2 * draw_vertex_or_edge_point(mesh, random) - start);
  };
}

Draw draw_of(PathSet set, const Scene& scene) {
  switch (set) {
    case PathSet::long_paths:
      return long_draw(scene);
    case PathSet::short_paths:
      return short_draw(scene);
    case PathSet::near_paths:
      return near_draw(scene);
    case PathSet::sight_paths:
      return sight_draw(scene);
    case PathSet::edge_paths:
      break;
  }
  return edge_draw(scene);
}

}  // namespace

std::string name_of(PathSet set) {
  constexpr std::array names = {"long", "short", "near", "sight", "edge"};
  return names[static_cast<std::size_t>(set)];
}

PathBatch draw_paths(PathSet set, const Scene& scene, std::size_t count, std::uint64_t seed) {
  const Draw draw = draw_of(set, scene);
  Random random(seed);
  std::vector<Segmentf> segments;
  do {
    segments.push_back(draw(random));
  } while (segments.size() < count || segments.size() % PathBatch::octet_size != 0);
  return PathBatch(std::move(segments));
}

}  // namespace surehit::benchmark
