#include "support/path_drawer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surehit::test {
namespace {

template <typename Scalar>
Vector3<Scalar> kept_finite(const Vector3<Scalar>& point) {
  constexpr Scalar largest = std::numeric_limits<Scalar>::max();
  return point.cwiseMax(-largest).cwiseMin(largest);
}

template <typename Scalar>
Vector3<Scalar> mirrored(const Vector3<Scalar>& point, const Vector3<Scalar>& centre) {
  return kept_finite<Scalar>(centre + (centre - point));
}

}  // namespace

template <typename Scalar>
PathDrawer<Scalar>::PathDrawer(const TriangleMeshView<Scalar>& mesh, std::uint64_t seed)
    : mesh_(mesh), box_(box_of(mesh)), random_(seed) {}

template <typename Scalar>
Vector3<Scalar> PathDrawer<Scalar>::point_on_mesh() {
  const Triangle<Scalar> triangle = mesh_.triangle(random_.below(mesh_.triangle_count()));
  if (random_.one_in(3)) return triangle.a;
  const Scalar weight = random_.one_in(4) ? Scalar{1} / 2 : random_.unit<Scalar>();
  const Vector3<Scalar> on_edge = triangle.a * (1 - weight) + triangle.b * weight;
  if (random_.one_in(2)) return kept_finite(on_edge);
  const Scalar weight_of_c = random_.unit<Scalar>();
  return kept_finite<Scalar>(on_edge * (1 - weight_of_c) + triangle.c * weight_of_c);
}

template <typename Scalar>
Vector3<Scalar> PathDrawer<Scalar>::point_around_mesh() {
  Vector3<Scalar> point;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Scalar weight = Scalar{1.5} * random_.unit<Scalar>() - Scalar{0.25};
    point[axis] = box_.low[axis] * (1 - weight) + box_.high[axis] * weight;
  }
  return kept_finite(point);
}

template <typename Scalar>
Path<Scalar> PathDrawer<Scalar>::any_kind(const Segment<Scalar>& segment) {
  const Vector3<Scalar> direction = kept_finite<Scalar>(segment.end - segment.start);
  switch (random_.below(4)) {
    case 0:
      return Ray<Scalar>{segment.start, direction};
    case 1:
      return Line<Scalar>{segment.start, direction};
    default:
      return segment;
  }
}

template <typename Scalar>
Path<Scalar> PathDrawer<Scalar>::draw() {
  const Vector3<Scalar> start = random_.one_in(4) ? point_on_mesh() : point_around_mesh();
  const Vector3<Scalar> aim = point_on_mesh();
  switch (random_.below(8)) {
    case 0:
      return any_kind({start, point_around_mesh()});
    case 1:
      return any_kind({start, aim});
    case 2:
      return any_kind({aim, aim});
    case 3:
      return any_kind({aim, kept_finite<Scalar>(aim + (start - aim) * Scalar{0x1p-10})});
    case 4:
      return draw_axis_parallel();
    default:
      return any_kind({start, mirrored(start, aim)});
  }
}

template <typename Scalar>
Path<Scalar> PathDrawer<Scalar>::draw_from_afar(Scalar distance) {
  const Vector3<Scalar> aim = point_on_mesh();
  Vector3<Scalar> offset;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    offset[axis] = random_.one_in(4) ? Scalar{0} : distance * random_.symmetric<Scalar>();
  }
  offset[static_cast<Eigen::Index>(random_.below(3))] = random_.one_in(2) ? distance : -distance;
  const Vector3<Scalar> start = kept_finite<Scalar>(aim + offset);
  return any_kind({start, mirrored(start, aim)});
}

template <typename Scalar>
Path<Scalar> PathDrawer<Scalar>::draw_axis_parallel() {
  Segment<Scalar> segment = {point_on_mesh(), point_around_mesh()};
  const auto axis = static_cast<Eigen::Index>(random_.below(3));
  segment.end[axis] = segment.start[axis];
  if (random_.one_in(2)) segment.end[(axis + 1) % 3] = segment.start[(axis + 1) % 3];
  if (random_.one_in(2)) segment.start = mirrored(segment.end, segment.start);
  return any_kind(segment);
}

template <typename Scalar>
Segment<Scalar> far_through_origin(int exponent, Random& random) {
  // Products of whole numbers that just fit a Scalar: their sum, the segment's direction, does not.
  constexpr int digits = std::numeric_limits<Scalar>::digits;
  const auto whole = [&](int bits) { return static_cast<Scalar>(random.between(1, (std::int64_t{1} << bits) - 1)); };
  const auto component = [&] { return random.one_in(2) ? whole(digits / 2) : -whole(digits / 2); };
  const Vector3<Scalar> direction{component(), component(), component()};
  const auto distance = [&] {
    const int bits = digits - digits / 2;
    return std::ldexp(whole(bits - 1) + std::ldexp(Scalar{1}, bits - 1), exponent - digits);
  };
  return {direction * distance(), direction * -distance()};
}

template Segment<float> far_through_origin(int, Random&);
template Segment<double> far_through_origin(int, Random&);
template class PathDrawer<float>;
template class PathDrawer<double>;

}  // namespace surehit::test
