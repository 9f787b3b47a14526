#include "sweep_batch.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace surehit::benchmark {
namespace {

using test::Random;

/// Draws a triangle that is across an axis, if there are enough of them. Then the height of a shape above its plane is
/// exact in float.
Trianglef draw_triangle_across_axis(const NamedMesh& named, Random& random) {
  constexpr int tries = 100;
  Trianglef triangle = draw_triangle(named, random);
  for (int i = 0; i < tries; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (triangle.a[axis] == triangle.b[axis] && triangle.a[axis] == triangle.c[axis]) return triangle;
    }
    triangle = draw_triangle(named, random);
  }
  return triangle;
}

Segmentf draw_resting(const NamedMesh& named, float size, Random& random) {
  const Trianglef triangle = draw_triangle_across_axis(named, random);
  const Vector3d a = triangle.a.cast<double>();
  const Vector3d to_b = triangle.b.cast<double>() - a;
  const Vector3d to_c = triangle.c.cast<double>() - a;
  const Vector3d up = double{size} * to_b.cross(to_c).stableNormalized();
  const auto draw_above = [&] {
    const double u = 3 * random.unit<double>() - 1;
    const double v = 3 * random.unit<double>() - 1;
    return Vector3d(a + u * to_b + v * to_c + up);
  };
  const Vector3d start = draw_above();
  const Vector3d end = draw_above();
  return {start.cast<float>(), end.cast<float>()};
}

PathBatch draw_all_resting(const NamedMesh& named, float size, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Segmentf> segments;
  do {
    segments.push_back(draw_resting(named, size, random));
  } while (segments.size() < count || segments.size() % PathBatch::octet_size != 0);
  return PathBatch(std::move(segments));
}

}  // namespace

std::string name_of(ShapeKind kind) {
  constexpr std::array names = {"sphere", "box", "capsule"};
  return names[static_cast<std::size_t>(kind)];
}

PathSet path_set_of(SweepSet set) {
  switch (set) {
    case SweepSet::long_sweeps:
      return PathSet::long_paths;
    case SweepSet::short_sweeps:
      return PathSet::short_paths;
    case SweepSet::near_sweeps:
      return PathSet::near_paths;
    case SweepSet::sight_sweeps:
      return PathSet::sight_paths;
    case SweepSet::edge_sweeps:
      return PathSet::edge_paths;
    case SweepSet::edge_end_sweeps:
      return PathSet::edge_end_paths;
    case SweepSet::cell_sweeps:
      return PathSet::cell_paths;
    case SweepSet::in_plane_sweeps:
    case SweepSet::resting_sweeps:
      break;
  }
  return PathSet::in_plane_paths;
}

std::string name_of(SweepSet set) { return set == SweepSet::resting_sweeps ? "resting" : name_of(path_set_of(set)); }

SweepBatch::SweepBatch(ShapeKind kind, float size, PathBatch paths)
    : kind_(kind), size_(size), paths_(std::move(paths)) {
  for (const auto& [start, end] : paths_.segments()) {
    if (kind == ShapeKind::sphere) spheres_.push_back({start, end, size});
    if (kind == ShapeKind::box) boxes_.push_back({start, end, {size, size, size}});
    if (kind == ShapeKind::capsule) capsules_.push_back({start, end, {0, 0, size}, size});
  }
}

SweptShapeSpanf SweepBatch::shapes(std::size_t count) const {
  if (kind_ == ShapeKind::box) return std::span(boxes_).first(count);
  if (kind_ == ShapeKind::capsule) return std::span(capsules_).first(count);
  return std::span(spheres_).first(count);
}

SweptShapef SweepBatch::shape(std::size_t index) const {
  if (kind_ == ShapeKind::box) return boxes_[index];
  if (kind_ == ShapeKind::capsule) return capsules_[index];
  return spheres_[index];
}

PathBatch draw_sweeps(SweepSet set, const NamedMesh& named, float size, std::size_t count, std::uint64_t seed) {
  if (set == SweepSet::resting_sweeps) return draw_all_resting(named, size, count, seed);
  return draw_paths(path_set_of(set), named, count, seed);
}

PathBatch moved_a_bit(const PathBatch& paths, double distance, std::uint64_t seed) {
  Random random(seed);
  const auto moved = [&](const Vector3f& point) {
    return Vector3f((point.cast<double>() + distance * draw_in_unit_ball(random)).cast<float>());
  };
  std::vector<Segmentf> segments;
  for (const Segmentf& path : paths.segments()) {
    const Vector3f start = moved(path.start);
    segments.push_back({start, moved(path.end)});
  }
  return PathBatch(std::move(segments));
}

}  // namespace surehit::benchmark
