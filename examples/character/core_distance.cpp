#include "character/core_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "character/capsule_sweep.hpp"

namespace surehit::example {
namespace {

/// The parallelogram and the triangle, both seen from the start of the way.
///
/// CD1. Let L be the largest coordinate of `core` and `corners`. Each coordinate is a sum of at most three floats with
/// at most two roundings in double, and no part of a sum exceeds 2 L. So it is off by less than 2^-51 L.
struct Pair {
  std::array<Vector3d, 4> core;
  std::array<Vector3d, 3> corners;
  double size = 0;  // L

  Pair(const Vector3f& from, const Vector3f& to, const Trianglef& triangle) {
    const Vector3d start = from.cast<double>();
    const Vector3d step = to.cast<double>() - start;
    const Vector3d axis = Body::half_axis().cast<double>();
    core = {Vector3d(-axis), axis, step + axis, step - axis};
    corners = {triangle.a.cast<double>() - start, triangle.b.cast<double>() - start, triangle.c.cast<double>() - start};
    for (const Vector3d& p : core) size = std::max(size, p.cwiseAbs().maxCoeff());
    for (const Vector3d& p : corners) size = std::max(size, p.cwiseAbs().maxCoeff());
  }

  /// Whether a direction proves that they are farther than the radius from each other.
  ///
  /// CD2. For any m, all points x of one polygon and y of the other have |x - y| |m| >= m·x - m·y. So they are apart if
  /// the smallest m·x of corners x exceeds the largest m·y by more than r |m|. By CD1, a product m·x is off by less
  /// than |m|_1 L (2^-51 + 3 · 2^-53), its sums included, and r |m| by less than 2^-50 r |m|. Twice this and the
  /// rounding of the difference are below the allowances.
  [[nodiscard]] bool is_apart_along(const Vector3d& m) const {
    double low_core = m.dot(core[0]);
    double high_core = low_core;
    for (const Vector3d& p : core) {
      low_core = std::min(low_core, m.dot(p));
      high_core = std::max(high_core, m.dot(p));
    }
    double low_corner = m.dot(corners[0]);
    double high_corner = low_corner;
    for (const Vector3d& p : corners) {
      low_corner = std::min(low_corner, m.dot(p));
      high_corner = std::max(high_corner, m.dot(p));
    }
    const double gap = std::max(low_core - high_corner, low_corner - high_core);
    return gap > double{Body::radius} * m.norm() * (1 + 0x1p-48) + 0x1p-48 * m.lpNorm<1>() * size;
  }
};

/// A point of each polygon, and their squared distance.
struct NearPair {
  Vector3d core, corner;
  double square = std::numeric_limits<double>::infinity();

  void take(const Vector3d& of_core, const Vector3d& of_triangle) {
    const double other = (of_core - of_triangle).squaredNorm();
    if (other < square) *this = {of_core, of_triangle, other};
  }
};

double clamped(double share) { return std::isnan(share) ? 0 : std::clamp(share, 0.0, 1.0); }

/// Takes points of two segments that are about as near to each other as any.
void take_segments(NearPair& nearest, const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = q - p;
  const Vector3d e = b - a;
  const Vector3d w = p - a;
  const double dd = d.squaredNorm();
  const double ee = e.squaredNorm();
  const double de = d.dot(e);
  const double det = dd * ee - de * de;
  double s = clamped((de * w.dot(e) - ee * w.dot(d)) / det);
  const double t = clamped((w + s * d).dot(e) / ee);
  s = clamped((t * de - w.dot(d)) / dd);
  nearest.take(p + s * d, a + t * e);
}

/// Takes a point of the core and the point of the triangle across from it, if there is one.
void take_face(NearPair& nearest, const Pair& pair, const Vector3d& n, const Vector3d& x) {
  const Vector3d ab = pair.corners[1] - pair.corners[0];
  const Vector3d ac = pair.corners[2] - pair.corners[0];
  const Vector3d w = x - pair.corners[0];
  const double nn = n.squaredNorm();
  const double u = n.dot(w.cross(ac)) / nn;
  const double v = n.dot(ab.cross(w)) / nn;
  if (u >= 0 && v >= 0 && u + v <= 1 - 0x1p-40) nearest.take(x, pair.corners[0] + u * ab + v * ac);
}

NearPair near_pair(const Pair& pair, const Vector3d& n) {
  NearPair nearest;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d& p = pair.core[i];
    const Vector3d& q = pair.core[(i + 1) % 4];
    for (std::size_t k = 0; k < 3; ++k) take_segments(nearest, p, q, pair.corners[k], pair.corners[(k + 1) % 3]);
    take_face(nearest, pair, n, p);
    const double from = n.dot(p - pair.corners[0]);
    const double to = n.dot(q - pair.corners[0]);
    if (from * to < 0) take_face(nearest, pair, n, p + from / (from - to) * (q - p));
  }
  return nearest;
}

}  // namespace

CoreDistance core_distance(const Vector3f& from, const Vector3f& to, const Trianglef& triangle) {
  const Pair pair(from, to, triangle);
  const double infinity = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (pair.is_apart_along(Vector3d::Unit(axis))) return {Verdict::free, infinity};
  }
  const Vector3d n = (pair.corners[1] - pair.corners[0]).cross(pair.corners[2] - pair.corners[0]);
  if (pair.is_apart_along(n)) return {Verdict::free, infinity};
  const Vector3d side = (pair.core[1] - pair.core[0]).cross(pair.core[2] - pair.core[1]);
  if (pair.is_apart_along(side)) return {Verdict::free, infinity};
  const NearPair nearest = near_pair(pair, n);
  if (pair.is_apart_along(nearest.core - nearest.corner)) return {Verdict::free, infinity};
  // CD3. Weights in [0, 1] name points of both polygons exactly. A computed point p + s d is off by less than 2^-49 L
  // on each axis, by CD1 and its three roundings. So is a + u ab + v ac, by five: its weights add up to less than 1,
  // even if they are rounded. So the distance is off by less than 2^-46 L, and its own roundings are below 2^-50 of it.
  const double upper = std::sqrt(nearest.square);
  const bool is_touching = upper < double{Body::radius} - 0x1p-44 * (pair.size + double{Body::radius});
  return {is_touching ? Verdict::touching : Verdict::unsure, upper};
}

}  // namespace surehit::example
