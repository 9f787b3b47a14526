#include "support/scene_path_drawer.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "support/neighbour.hpp"
#include "support/pair_families.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
Vector3<Scalar> kept_finite(const Vector3<Scalar>& point) {
  constexpr Scalar largest = std::numeric_limits<Scalar>::max();
  return point.cwiseMax(-largest).cwiseMin(largest);
}

}  // namespace

template <typename Scalar>
std::size_t ScenePathDrawer<Scalar>::any_instance() {
  for (;;) {
    const std::size_t instance = random_.below(drawn_.instances.size());
    if (!drawn_.meshes[drawn_.instances[instance].mesh].triangles.empty()) return instance;
  }
}

template <typename Scalar>
auto ScenePathDrawer<Scalar>::any_target() -> Target {
  const std::size_t instance = any_instance();
  const auto& [mesh, placement] = drawn_.instances[instance];
  const auto triangle = static_cast<std::uint32_t>(random_.below(drawn_.meshes[mesh].triangles.size()));
  Triangle<Scalar> placed = oracle_.triangle(ids_[instance], triangle);
  for (Point* corner : {&placed.a, &placed.b, &placed.c}) *corner = kept_finite(*corner);
  const Scalar size =
      std::max((placed.b - placed.a).cwiseAbs().maxCoeff(), (placed.c - placed.a).cwiseAbs().maxCoeff());
  return {placed, placement.motion, size};
}

template <typename Scalar>
auto ScenePathDrawer<Scalar>::point_on(const Triangle<Scalar>& triangle) -> Point {
  if (random_.one_in(3)) return random_.one_in(2) ? triangle.a : triangle.c;
  const Scalar weight = random_.one_in(3) ? Scalar{1} / 2 : random_.unit<Scalar>();
  const Point on_edge = triangle.a * (1 - weight) + triangle.b * weight;
  if (random_.one_in(2)) return on_edge;
  const Scalar weight_of_c = random_.one_in(3) ? Scalar{1} / 2 : random_.unit<Scalar>();
  return on_edge * (1 - weight_of_c) + triangle.c * weight_of_c;
}

template <typename Scalar>
auto ScenePathDrawer<Scalar>::point_in_plane_of(const Triangle<Scalar>& triangle) -> Point {
  const auto factor_of_b = static_cast<Scalar>(random_.between(-4, 4));
  const auto factor_of_c = static_cast<Scalar>(random_.between(-4, 4));
  return triangle.a + factor_of_b / 2 * (triangle.b - triangle.a) + factor_of_c / 2 * (triangle.c - triangle.a);
}

template <typename Scalar>
auto ScenePathDrawer<Scalar>::point_around(const Target& target) -> Point {
  const Scalar reach = 2 * target.size + (random_.one_in(4) ? Scalar{1} : Scalar{0});
  Point point = target.triangle.a;
  for (Scalar& x : point) x += reach * (random_.one_in(4) ? Scalar{1} : random_.symmetric<Scalar>());
  return point;
}

template <typename Scalar>
Segment<Scalar> ScenePathDrawer<Scalar>::draw_segment(const Target& target) {
  const Point aim = point_on(target.triangle);
  const Point start = random_.one_in(4) ? point_on(any_target().triangle) : point_around(target);
  const auto across = [&](Scalar share) {
    return Segment<Scalar>{aim + share * (start - aim), aim - share * (start - aim)};
  };
  switch (random_.below(13)) {
    case 0:
      return {start, aim};
    case 1:
      return {aim, start};
    case 2:
      return {aim, aim};
    case 3:
      return across(Scalar{0x1p-12F});
    case 4:
      return across(random_.one_in(2) ? Scalar{0x1p20F} : Scalar{0x1p60F});
    case 5:
      return {point_in_plane_of(target.triangle), point_in_plane_of(target.triangle)};
    case 6: {
      Segment<Scalar> parallel = across(1);
      const auto axis = static_cast<Eigen::Index>(random_.below(3));
      parallel.start[axis] = parallel.end[axis] = aim[axis];
      if (random_.one_in(2)) parallel.start[(axis + 1) % 3] = parallel.end[(axis + 1) % 3] = aim[(axis + 1) % 3];
      return parallel;
    }
    case 7:
      return {aim, point_on(any_target().triangle)};
    case 8:
      return {start, point_around(target)};
    case 9: {
      Point beside = aim;
      for (Scalar& x : beside) x = neighbour(x, static_cast<int>(random_.between(-1, 1)));
      return {start, beside};
    }
    case 10:  // the hit is at a tiny t
      return {across(Scalar{0x1p-20F}).start, across(random_.one_in(2) ? Scalar{0x1p20F} : Scalar{0x1p70F}).end};
    default:
      return across(1);
  }
}

template <typename Scalar>
Path<Scalar> ScenePathDrawer<Scalar>::any_kind(const Segment<Scalar>& segment) {
  if (random_.one_in(2)) return segment;
  const Scalar length = random_.one_in(4) ? (random_.one_in(2) ? Scalar{0x1p40F} : Scalar{0x1p-40F}) : Scalar{1};
  const Point direction = kept_finite<Scalar>(length * (segment.end - segment.start));
  if (random_.one_in(2)) return Ray<Scalar>{segment.start, direction};
  return Line<Scalar>{segment.start, direction};
}

template <typename Scalar>
Path<Scalar> ScenePathDrawer<Scalar>::path_of_mesh() {
  const auto& [index, placement] = drawn_.instances[any_instance()];
  const std::vector<Path<double>>& paths = drawn_.meshes[index].paths;
  if (paths.empty()) return draw_segment(any_target());
  const Path<double>& path = paths[random_.below(paths.size())];
  const Eigen::Matrix<double, 3, 3> linear = placement.pose.linear.template cast<double>();
  const Vector3<double> translation = placement.pose.translation.template cast<double>();
  const auto image = [&](const Vector3<double>& point) { return rounded<Scalar>(linear * point + translation); };
  if (path.kind == PathKind::segment) {
    const Point end = image(path.toward);
    return Segment<Scalar>{image(path.start), random_.one_in(2) ? end : kept_finite<Scalar>(end + placement.motion)};
  }
  return {path.kind, image(path.start), rounded<Scalar>(linear * path.toward)};
}

template <typename Scalar>
Path<Scalar> ScenePathDrawer<Scalar>::draw() {
  for (;;) {
    const Path<Scalar> path = any_path();
    if (path.start.allFinite() && path.toward.allFinite()) return path;
  }
}

template <typename Scalar>
Path<Scalar> ScenePathDrawer<Scalar>::any_path() {
  if (random_.one_in(6)) return path_of_mesh();
  const Target target = any_target();
  Segment<Scalar> segment = draw_segment(target);
  // The same way as the target sees it, while that moves.
  const bool is_swept = random_.one_in(2) && !target.motion.isZero(0);
  if (is_swept) segment.end += target.motion;
  segment = {kept_finite(segment.start), kept_finite(segment.end)};
  return is_swept ? segment : any_kind(segment);
}

template <typename Scalar>
SceneQueryOptions<Scalar> draw_scene_options(const SceneHit<Scalar>& hit, Random& random) {
  const QueryOptions<Scalar> of_pair = draw_options<Scalar>(random, hit.t);
  SceneQueryOptions<Scalar> options;
  options.min_t = of_pair.min_t;
  options.max_t = of_pair.max_t;
  options.culling = of_pair.culling;
  options.ignore_start_contact = of_pair.ignore_start_contact;
  options.ignore_end_contact = of_pair.ignore_end_contact;
  if (random.one_in(3)) options.mask = static_cast<std::uint32_t>(random.below(4));
  if (random.one_in(3)) options.instance_mask = static_cast<std::uint32_t>(random.below(4));
  if (random.one_in(3)) options.ignored_instance = hit.instance;
  if (random.one_in(8)) ++options.ignored_instance.generation;
  if (random.one_in(3)) options.ignored_triangle = hit.triangle;
  return options;
}

#define SUREHIT_INSTANTIATE(Scalar)       \
  template class ScenePathDrawer<Scalar>; \
  template SceneQueryOptions<Scalar> draw_scene_options(const SceneHit<Scalar>&, Random&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
