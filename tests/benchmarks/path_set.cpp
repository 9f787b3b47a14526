#include "path_set.hpp"

#include <cmath>
#include <functional>

namespace surehit::benchmark {
namespace {

using test::Random;
using Draw = std::function<Segmentf(Random&)>;

constexpr double short_length = 0.01;  // of the diagonal, as the next one
constexpr double near_distance = 0.005;

/// A point in the mesh's box when that is inflated about its centre.
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

Draw long_draw(const NamedMesh& named) {
  return [points = BoxPoints(named.box(), 1.2)](Random& random) {
    const Vector3d start = points.draw(random);
    return rounded(start, points.draw(random));
  };
}

Draw short_draw(const NamedMesh& named) {
  return [points = BoxPoints(named.box(), 1), length = short_length * named.diagonal()](Random& random) {
    const Vector3d start = points.draw(random);
    return rounded(start, start + length * draw_direction(random));
  };
}

/// Returns a corner of a triangle. Corner 3 is corner 0 again.
Vector3d corner_of(const Trianglef& triangle, std::size_t corner) {
  return (corner % 3 == 0 ? triangle.a : corner % 3 == 1 ? triangle.b : triangle.c).cast<double>();
}

/// Draws a short segment that begins near this point.
Segmentf draw_near(const Vector3d& point, double diagonal, Random& random) {
  const Vector3d start = point + near_distance * diagonal * draw_in_unit_ball(random);
  return rounded(start, start + short_length * diagonal * draw_direction(random));
}

Draw near_draw(const NamedMesh& named) {
  const SurfacePoints surface(named.mesh.view(), [&](const Trianglef& triangle) { return named.draws_at(triangle); });
  return [surface, diagonal = named.diagonal()](Random& random) {
    const Vector3d touched = surface.draw(random);
    return draw_near(touched, diagonal, random);
  };
}

Draw detail_draw(const NamedMesh& named) {
  return [&named, diagonal = named.diagonal()](Random& random) {
    const Vector3d touched = draw_in_triangle(draw_triangle(named, random), random);
    return draw_near(touched, diagonal, random);
  };
}

Draw sight_draw(const NamedMesh& named) {
  return [floor = named.floor(), eye = named.eye, above = named.upward(NamedMesh::target_height * named.diagonal())](
             Random& random) { return rounded(eye, floor.draw(random) + above); };
}

Vector3d draw_vertex_or_edge_point(const NamedMesh& named, Random& random) {
  const Trianglef triangle = draw_triangle(named, random);
  const std::size_t which = random.below(3);
  const Vector3d a = corner_of(triangle, which);
  if (random.one_in(2)) return a;
  const Vector3d between = a + random.unit<double>() * (corner_of(triangle, which + 1) - a);
  return between.cast<float>().cast<double>();
}

Draw edge_draw(const NamedMesh& named) {
  return [points = BoxPoints(named.box(), 1.2), &named](Random& random) {
    const Vector3d start = points.draw(random).cast<float>().cast<double>();
    return rounded(start, 2 * draw_vertex_or_edge_point(named, random) - start);
  };
}

Vector3d draw_vertex_or_edge_middle(const NamedMesh& named, Random& random) {
  const Trianglef triangle = draw_triangle(named, random);
  const std::size_t which = random.below(3);
  const Vector3d a = corner_of(triangle, which);
  return random.one_in(2) ? a : Vector3d((a + corner_of(triangle, which + 1)) / 2);
}

Draw edge_end_draw(const NamedMesh& named) {
  return [points = BoxPoints(named.box(), 1.2), &named](Random& random) {
    const Vector3d start = points.draw(random);
    return rounded(start, draw_vertex_or_edge_middle(named, random));
  };
}

Draw in_plane_draw(const NamedMesh& named) {
  return [&named, tilt = 1e-6 * named.diagonal()](Random& random) {
    const Trianglef triangle = draw_triangle(named, random);
    const Vector3d a = triangle.a.cast<double>();
    const Vector3d to_b = triangle.b.cast<double>() - a;
    const Vector3d to_c = triangle.c.cast<double>() - a;
    const auto draw_in_plane = [&] {
      const double u = 3 * random.unit<double>() - 1;
      const double v = 3 * random.unit<double>() - 1;
      return Vector3d(a + u * to_b + v * to_c);
    };
    const std::size_t which = random.below(4);
    if (which == 0) return Segmentf{triangle.a, triangle.b};
    const Vector3d start = draw_in_plane();
    if (which == 1) return rounded(start, a);
    const Vector3d end = draw_in_plane();
    if (which == 2) return rounded(start, end);
    return rounded(start + tilt * draw_in_unit_ball(random), end + tilt * draw_in_unit_ball(random));
  };
}

/// Paths between centres of cubes. On meshes that are not made of cubes, both ends are on a grid of powers of two.
Draw cell_draw(const NamedMesh& named) {
  constexpr std::int64_t max_cells = 12;
  constexpr double cells_in_diagonal = 200;
  const double cell =
      named.cell > 0 ? named.cell : std::exp2(std::round(std::log2(named.diagonal() / cells_in_diagonal)));
  return [points = BoxPoints(named.box(), 1), cell](Random& random) {
    const Vector3d first = (points.draw(random) / cell).array().floor();
    Vector3d last = first;
    for (int axis = 0; axis < 3; ++axis) last[axis] += static_cast<double>(random.between(-max_cells, max_cells));
    const Vector3d half = Vector3d::Constant(0.5);
    return rounded(cell * (first + half), cell * (last + half));
  };
}

/// If `may_go_beyond`, one path in two ends as far beyond its target as it begins before it.
Draw far_draw(const NamedMesh& named, bool may_go_beyond) {
  const Boxf box = named.box();
  const Vector3d centre = (box.low.cast<double>() + box.high.cast<double>()) / 2;
  return [points = BoxPoints(box, 1), centre, diagonal = named.diagonal(), may_go_beyond](Random& random) {
    const double distance = diagonal * std::pow(10.0, 1 + 2 * random.unit<double>());
    const Vector3d start = centre + distance * draw_direction(random);
    // A path that passes the mesh does so at a distance of a few diagonals.
    const bool is_aimed = random.one_in(2);
    const Vector3d target =
        is_aimed ? points.draw(random) : centre + (2 + 8 * random.unit<double>()) * diagonal * draw_direction(random);
    return rounded(start, !may_go_beyond || random.one_in(2) ? target : 2 * target - start);
  };
}

Draw draw_of(PathSet set, const NamedMesh& named) {
  switch (set) {
    case PathSet::long_paths:
      return long_draw(named);
    case PathSet::short_paths:
      return short_draw(named);
    case PathSet::near_paths:
      return near_draw(named);
    case PathSet::sight_paths:
      return sight_draw(named);
    case PathSet::edge_paths:
      return edge_draw(named);
    case PathSet::detail_paths:
      return detail_draw(named);
    case PathSet::edge_end_paths:
      return edge_end_draw(named);
    case PathSet::in_plane_paths:
      return in_plane_draw(named);
    case PathSet::cell_paths:
      return cell_draw(named);
    case PathSet::far_paths:
      return far_draw(named, true);
    case PathSet::far_rays:
      break;
  }
  return far_draw(named, false);
}

}  // namespace

std::string name_of(PathSet set) {
  constexpr std::array names = {"long",     "short",    "near",  "sight", "edge",    "detail",
                                "edge_end", "in_plane", "cells", "far",   "far_rays"};
  return names[static_cast<std::size_t>(set)];
}

Trianglef draw_triangle(const NamedMesh& named, Random& random) {
  const TriangleMeshViewf mesh = named.mesh.view();
  for (;;) {
    const Trianglef triangle = mesh.triangle(random.below(mesh.triangle_count()));
    if (named.draws_at(triangle)) return triangle;
  }
}

std::vector<PathSet> sets_of_segments(std::vector<PathSet> sets) {
  std::erase(sets, PathSet::far_rays);
  return sets;
}

PathBatch draw_paths(PathSet set, const NamedMesh& named, std::size_t count, std::uint64_t seed) {
  const Draw draw = draw_of(set, named);
  Random random(seed);
  std::vector<Segmentf> segments;
  do {
    segments.push_back(draw(random));
  } while (segments.size() < count || segments.size() % PathBatch::octet_size != 0);
  return PathBatch(std::move(segments), set == PathSet::far_rays);
}

}  // namespace surehit::benchmark
