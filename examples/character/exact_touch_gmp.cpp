#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "character/capsule_sweep.hpp"
#include "character/core_distance.hpp"

namespace surehit::example {
namespace {

using Rational3 = std::array<mpq_class, 3>;

Rational3 point_of(const Vector3f& v) {
  return {mpq_class(double{v.x()}), mpq_class(double{v.y()}), mpq_class(double{v.z()})};
}

Rational3 sum(const Rational3& x, const mpq_class& factor, const Rational3& y) {
  return {mpq_class(x[0] + factor * y[0]), mpq_class(x[1] + factor * y[1]), mpq_class(x[2] + factor * y[2])};
}
Rational3 difference(const Rational3& x, const Rational3& y) { return sum(x, -1, y); }
mpq_class dot(const Rational3& x, const Rational3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Rational3 cross(const Rational3& x, const Rational3& y) {
  return {mpq_class(x[1] * y[2] - x[2] * y[1]), mpq_class(x[2] * y[0] - x[0] * y[2]),
          mpq_class(x[0] * y[1] - x[1] * y[0])};
}
mpq_class square(const Rational3& x) { return dot(x, x); }

/// The squared distance of a point and a segment.
mpq_class point_to_segment(const Rational3& x, const Rational3& a, const Rational3& b) {
  const Rational3 e = difference(b, a);
  const mpq_class ee = square(e);
  mpq_class s = ee == 0 ? mpq_class(0) : mpq_class(dot(difference(x, a), e) / ee);
  if (s < 0) s = 0;
  if (s > 1) s = 1;
  return square(difference(x, sum(a, s, e)));
}

/// The squared distance of two segments.
mpq_class segment_to_segment(const Rational3& p, const Rational3& q, const Rational3& a, const Rational3& b) {
  const Rational3 d = difference(q, p);
  const Rational3 e = difference(b, a);
  const Rational3 m = cross(d, e);
  const mpq_class mm = square(m);
  if (mm != 0) {
    const Rational3 w = difference(a, p);
    const mpq_class s = dot(m, cross(w, e)) / mm;
    const mpq_class t = dot(m, cross(w, d)) / mm;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return square(difference(sum(p, s, d), sum(a, t, e)));
  }
  return std::min(
      {point_to_segment(p, a, b), point_to_segment(q, a, b), point_to_segment(a, p, q), point_to_segment(b, p, q)});
}

/// A convex polygon, perhaps without area.
template <std::size_t Count>
struct Polygon {
  std::array<Rational3, Count> corners;
  Rational3 normal;

  explicit Polygon(std::array<Rational3, Count> points) : corners(std::move(points)) {
    normal = cross(difference(corners[1], corners[0]), difference(corners[2], corners[1]));
  }
  [[nodiscard]] const Rational3& next(std::size_t i) const { return corners[(i + 1) % Count]; }
  /// Whether a point is above or below the inside or the outline. The polygon must have area.
  [[nodiscard]] bool is_across_from(const Rational3& x) const {
    for (std::size_t i = 0; i < Count; ++i) {
      if (dot(normal, cross(difference(next(i), corners[i]), difference(x, corners[i]))) < 0) return false;
    }
    return true;
  }
};

/// Whether a corner or an edge of x comes as near to the inside of y as the square of a distance.
template <typename X, typename Y>
bool reaches_inside(const X& x, const Y& y, const mpq_class& rr) {
  const mpq_class nn = square(y.normal);
  if (nn == 0) return false;
  for (std::size_t i = 0; i < x.corners.size(); ++i) {
    const Rational3& p = x.corners[i];
    const Rational3& q = x.next(i);
    const mpq_class from = dot(y.normal, difference(p, y.corners[0]));
    const mpq_class to = dot(y.normal, difference(q, y.corners[0]));
    if (from * from <= rr * nn && y.is_across_from(p)) return true;
    if (sgn(from) * sgn(to) < 0 && y.is_across_from(sum(p, from / (from - to), difference(q, p)))) return true;
  }
  return false;
}

}  // namespace

/// The nearest points of two convex polygons are on two edges, or one is a corner or on an edge that goes through the
/// other polygon.
std::optional<bool> touches_exactly(const Vector3f& from, const Vector3f& to, const Trianglef& triangle) {
  const Rational3 p = point_of(from);
  const Rational3 q = point_of(to);
  const Rational3 axis = point_of(Body::half_axis());
  const Polygon<4> core({sum(p, -1, axis), sum(p, 1, axis), sum(q, 1, axis), sum(q, -1, axis)});
  const Polygon<3> other({point_of(triangle.a), point_of(triangle.b), point_of(triangle.c)});
  const mpq_class rr = mpq_class(double{Body::radius}) * mpq_class(double{Body::radius});
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (segment_to_segment(core.corners[i], core.next(i), other.corners[k], other.next(k)) <= rr) return true;
    }
  }
  return reaches_inside(core, other, rr) || reaches_inside(other, core, rr);
}

}  // namespace surehit::example
