#include "surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

namespace surehit::benchmark {
namespace {

double area_of(const Trianglef& triangle) {
  const Vector3d a = triangle.a.cast<double>();
  return (triangle.b.cast<double>() - a).cross(triangle.c.cast<double>() - a).norm() / 2;
}

std::vector<double> areas_up_to(const TriangleMeshViewf& mesh, const SurfacePoints::Choice& chosen) {
  std::vector<double> areas(mesh.triangle_count());
  double area = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Trianglef triangle = mesh.triangle(i);
    if (chosen(triangle)) area += area_of(triangle);
    areas[i] = area;
  }
  return areas;
}

}  // namespace

SurfacePoints::SurfacePoints(const TriangleMeshViewf& mesh, const Choice& chosen)
    : mesh_(mesh), area_up_to_(areas_up_to(mesh, chosen)) {
  const auto has_area = [&] { return !area_up_to_.empty() && area_up_to_.back() > 0; };
  if (!has_area()) area_up_to_ = areas_up_to(mesh, [](const Trianglef&) { return true; });
  if (!has_area()) throw std::runtime_error("a mesh without any area cannot be measured");
}

Vector3d SurfacePoints::draw(test::Random& random) const {
  const double area = random.unit<double>() * area_up_to_.back();
  const auto place = std::upper_bound(area_up_to_.begin(), area_up_to_.end(), area);
  const Trianglef triangle = mesh_.triangle(static_cast<std::size_t>(place - area_up_to_.begin()));
  return draw_in_triangle(triangle, random);
}

Vector3d draw_in_triangle(const Trianglef& triangle, test::Random& random) {
  double u = random.unit<double>();
  double v = random.unit<double>();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vector3d a = triangle.a.cast<double>();
  return a + u * (triangle.b.cast<double>() - a) + v * (triangle.c.cast<double>() - a);
}

Vector3d draw_in_unit_cube(test::Random& random) {
  const double x = random.unit<double>();
  const double y = random.unit<double>();
  const double z = random.unit<double>();
  return {x, y, z};
}

Vector3d draw_in_unit_ball(test::Random& random) {
  for (;;) {
    const Vector3d point = 2 * draw_in_unit_cube(random) - Vector3d::Ones();
    if (point.squaredNorm() <= 1) return point;
  }
}

Vector3d draw_direction(test::Random& random) {
  for (;;) {
    const Vector3d point = draw_in_unit_ball(random);
    if (point.squaredNorm() > 0.01) return point.normalized();
  }
}

}  // namespace surehit::benchmark
