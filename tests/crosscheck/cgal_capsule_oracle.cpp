#include "cgal_capsule_oracle.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "cgal_shapes.hpp"

namespace surehit::test {
namespace {

using namespace cgal;
using Segment3 = Kernel::Segment_3;
using Triangle3 = Kernel::Triangle_3;

// CGAL asks its arguments to be what their names say: none of its segments is a point.
using Hull = std::variant<Point, Segment3, Triangle3>;

/// Three corners without area are the segment between the extreme ones, or a point.
Hull hull_of(const Corners& corners) {
  if (has_area(corners)) return Triangle3(corners[0], corners[1], corners[2]);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  if (*low == *high) return *low;
  return Segment3(*low, *high);
}

Segment3 side(const Triangle3& triangle, int i) { return {triangle.vertex(i), triangle.vertex(i + 1)}; }

// Each kind of pair is here in one order.
Rational apart(const Point& x, const Point& y) { return CGAL::squared_distance(x, y); }
Rational apart(const Point& x, const Segment3& y) { return CGAL::squared_distance(x, y); }
Rational apart(const Point& x, const Triangle3& y) { return CGAL::squared_distance(x, y); }
Rational apart(const Segment3& x, const Segment3& y) { return CGAL::squared_distance(x, y); }
Rational apart(const Segment3& x, const Triangle3& y) {
  if (CGAL::do_intersect(x, y)) return 0;
  Rational best = std::min(apart(x.source(), y), apart(x.target(), y));
  for (int i = 0; i < 3; ++i) best = std::min(best, apart(x, side(y, i)));
  return best;
}
Rational apart(const Triangle3& x, const Triangle3& y) {
  if (CGAL::do_intersect(x, y)) return 0;
  Rational best = apart(x.vertex(0), y);
  for (int i = 0; i < 3; ++i) {
    best = std::min({best, apart(x.vertex(i), y), apart(y.vertex(i), x)});
    for (int k = 0; k < 3; ++k) best = std::min(best, apart(side(x, i), side(y, k)));
  }
  return best;
}

Rational distance(const Hull& x, const Hull& y) {
  const auto in_order = [](const auto& left, const auto& right) -> Rational {
    if constexpr (requires { apart(left, right); }) {
      return apart(left, right);
    } else {
      return apart(right, left);
    }
  };
  return std::visit(in_order, x, y);
}

struct ExactCapsule {
  Point start;
  Vector step, half_axis;
  Rational rr;
  Corners corners;
  Hull hull;

  template <typename Scalar>
  ExactCapsule(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle)
      : start(to_point(capsule.start)),
        step(to_point(capsule.end) - start),
        half_axis(to_point(capsule.half_axis) - CGAL::ORIGIN),
        rr(Rational(double{capsule.radius}) * Rational(double{capsule.radius})),
        corners(to_corners(triangle)),
        hull(hull_of(corners)) {}

  /// Returns how near the core comes until t, squared.
  [[nodiscard]] Rational squared_distance_until(const Rational& t) const {
    const Point low = start - half_axis;
    const Point high = start + half_axis;
    const Vector way = t * step;
    const Rational first = distance(hull_of({low, high, high + way}), hull);
    if (first <= rr && t != 0) return first;
    return std::min(first, distance(hull_of({low, low + way, high + way}), hull));
  }
  [[nodiscard]] bool touches_until(const Rational& t) const { return squared_distance_until(t) <= rr; }
};

/// The line of the core, and an edge that is not parallel to it.
std::optional<MeetingParts> meet_edge(const ExactCapsule& capsule, std::size_t from, std::size_t to) {
  const Vector n = CGAL::cross_product(capsule.half_axis, capsule.corners[to] - capsule.corners[from]);
  const Rational nn = n * n;
  if (nn == 0) return std::nullopt;
  const Vector w = capsule.start - capsule.corners[from];
  const Rational rate = n * capsule.step;
  const Rational height = n * w;
  MeetingParts parts{rate * rate / nn, rate * height / nn, height * height / nn - capsule.rr, {}};
  const Vector across = CGAL::cross_product(n, capsule.half_axis);
  parts.weights[to] = {across * w / nn, across * capsule.step / nn};
  parts.weights[from] = {1 - parts.weights[to].constant, -parts.weights[to].rate};
  return parts;
}

/// The line of the core, and a corner.
std::optional<MeetingParts> meet_corner(const ExactCapsule& capsule, std::size_t corner) {
  const Vector& e = capsule.half_axis;
  const Rational ee = e * e;
  if (ee == 0) return std::nullopt;
  const Vector w = capsule.start - capsule.corners[corner];
  const Vector step = capsule.step - (capsule.step * e) / ee * e;
  const Vector across = w - (w * e) / ee * e;
  MeetingParts parts{step * step, step * across, across * across - capsule.rr, {}};
  parts.weights[corner].constant = 1;
  return parts;
}

/// Where the line of the core crosses the face at the start.
std::optional<MeetingParts> meet_face(const ExactCapsule& capsule) {
  const Corners& corners = capsule.corners;
  const Vector n = CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
  const Rational along = n * capsule.half_axis;
  if (along == 0) return std::nullopt;
  const Point crossing = capsule.start - (n * (capsule.start - corners[0])) / along * capsule.half_axis;
  return cgal::meet_face(crossing, Vector(0, 0, 0), capsule.rr, corners);
}

/// Returns how each part of the core and a part of the triangle come near.
std::vector<MeetingParts> all_meetings(const ExactCapsule& capsule, Feature feature) {
  std::vector<MeetingParts> all;
  const auto add = [&](const std::optional<MeetingParts>& parts) {
    if (parts) all.push_back(*parts);
  };
  for (const Point& point : {capsule.start, capsule.start + capsule.half_axis, capsule.start - capsule.half_axis}) {
    add(meet(point, capsule.step, capsule.rr, capsule.corners, feature));
  }
  if (feature == Feature::face) {
    add(meet_face(capsule));
    return all;
  }
  const auto [from, to] = ends_of(feature);
  add(from == to ? meet_corner(capsule, from) : meet_edge(capsule, from, to));
  return all;
}

/// Returns how far the point of the triangle is from the core, and from the centre, squared. Both rest at the start.
std::array<Rational, 2> distances_at_start(const ExactCapsule& capsule, const std::array<Rational, 3>& weights) {
  const Corners& corners = capsule.corners;
  const Point point = corners[0] + weights[1] * (corners[1] - corners[0]) + weights[2] * (corners[2] - corners[0]);
  const Hull core = hull_of({capsule.start - capsule.half_axis, capsule.start, capsule.start + capsule.half_axis});
  return {distance(core, point), apart(capsule.start, point)};
}

/// The touched point is the nearest one to the centre of all that are nearest to the core.
template <typename Scalar>
std::optional<std::string> error_at_start(const ExactCapsule& capsule, const ShapeHit<Scalar>& answer) {
  if (!rounds_to(OneRoot(0), answer.t)) return "CGAL: t is wrong";
  std::optional<std::array<Rational, 2>> best;
  std::optional<std::array<Rational, 2>> answered;
  for (const Feature feature : {Feature::face, Feature::edge_ab, Feature::edge_bc, Feature::edge_ca, Feature::corner_a,
                                Feature::corner_b, Feature::corner_c}) {
    for (const MeetingParts& parts : all_meetings(capsule, feature)) {
      const std::array<Rational, 3> weights = {parts.weights[0].constant, parts.weights[1].constant,
                                               parts.weights[2].constant};
      if (!is_inside(weights, feature)) continue;
      const auto distances = distances_at_start(capsule, weights);
      if (!best || distances < *best) best = distances;
      if (feature != answer.feature) continue;
      if (!rounds_to(OneRoot(weights[1]), answer.u) || !rounds_to(OneRoot(weights[2]), answer.v)) continue;
      if (!answered || distances < *answered) answered = distances;
    }
  }
  if (!answered || *answered != *best) return "CGAL: the feature, u or v is wrong";
  return std::nullopt;
}

template <typename Scalar>
bool is_right(const MeetingParts& parts, const ShapeHit<Scalar>& answer) {
  const std::optional<OneRoot> t = parts.time();
  if (!t || !rounds_to(*t, answer.t)) return false;
  const std::array<OneRoot, 3> weights = {parts.weights[0].at(*t), parts.weights[1].at(*t), parts.weights[2].at(*t)};
  return is_inside(weights, answer.feature) && rounds_to(weights[1], answer.u) && rounds_to(weights[2], answer.v);
}

}  // namespace

template <typename Scalar>
std::optional<std::string> cgal_error(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const ExactCapsule exact(capsule, triangle);
  if (exact.touches_until(1) != answer.has_value()) {
    return answer ? "CGAL: a hit, but they do not touch" : "CGAL: a miss, but they touch";
  }
  if (!answer) return std::nullopt;
  const bool starts = exact.touches_until(0);
  if (answer->started_touching != starts) return "CGAL: started_touching is wrong";
  if (starts) return error_at_start(exact, *answer);
  const auto touches_until = [&](const Rational& t) { return exact.touches_until(t); };
  if (const auto error = error_of_t(answer->t, touches_until)) return error;
  for (const MeetingParts& parts : all_meetings(exact, answer->feature)) {
    if (is_right(parts, *answer)) return std::nullopt;
  }
  return "CGAL: t, the feature, u or v is wrong";
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                    \
  template std::optional<std::string> cgal_error(const SweptCapsule<Scalar>&, const Triangle<Scalar>&, \
                                                 const std::optional<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
