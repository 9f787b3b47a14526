#include "support/swept_truth.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "support/dyadic.hpp"

namespace surehit::test {
namespace {

using Vec = std::array<mpz_class, 3>;

Vec difference(const Vec& x, const Vec& y) {
  return {mpz_class(x[0] - y[0]), mpz_class(x[1] - y[1]), mpz_class(x[2] - y[2])};
}
mpz_class dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vec cross(const Vec& x, const Vec& y) {
  return {mpz_class(x[1] * y[2] - x[2] * y[1]), mpz_class(x[2] * y[0] - x[0] * y[2]),
          mpz_class(x[0] * y[1] - x[1] * y[0])};
}

/// A ball and a triangle in whole numbers of one unit.
struct WholePair {
  Vec start;
  Vec step;
  std::array<Vec, 3> corners;
  mpz_class rr;
};

template <typename Scalar>
WholePair whole_pair(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  const std::array<DyadicVector, 5> points = {dyadic(sphere.start), dyadic(sphere.end), dyadic(triangle.a),
                                              dyadic(triangle.b), dyadic(triangle.c)};
  const Dyadic radius(double{sphere.radius});
  long low = std::numeric_limits<long>::max();
  const auto see = [&](const Dyadic& x) {
    if (!x.is_zero()) low = std::min(low, x.exponent());
  };
  see(radius);
  for (const DyadicVector& point : points) {
    for (const Dyadic& x : point) see(x);
  }
  const auto whole = [&](const DyadicVector& x) {
    return Vec{x[0].in_units_of(low), x[1].in_units_of(low), x[2].in_units_of(low)};
  };
  const Vec start = whole(points[0]);
  const mpz_class r = radius.in_units_of(low);
  return {start, difference(whole(points[1]), start), {whole(points[2]), whole(points[3]), whole(points[4])}, r * r};
}

/// A quantity that is linear in t.
struct Linear {
  mpz_class constant;
  mpz_class rate;

  [[nodiscard]] int sign_at(const OneRootNumber& t) const { return t.linear(constant, rate, 1).sign(); }
};

/// A part of the triangle: the inside with its outline, an edge with its ends, or a corner.
struct Part {
  std::vector<std::size_t> corners;
  /// The squared distance to the part's plane, line or point is (a t² + 2 b t + c) / scale + r².
  QuadraticRoot equation;
  mpz_class scale;
  /// The weights of the corners at the projection of the centre, times `scale`. Their sum is `scale`.
  std::vector<Linear> weights;

  /// Whether the projection belongs to the part.
  [[nodiscard]] bool is_over_it(const OneRootNumber& t) const {
    return std::all_of(weights.begin(), weights.end(), [&](const Linear& weight) { return weight.sign_at(t) >= 0; });
  }
};

QuadraticRoot equation_of(const Vec& rate, const Vec& constant, const mpz_class& reach) {
  return {dot(rate, rate), dot(rate, constant), dot(constant, constant) - reach};
}

Part corner_part(const WholePair& pair, std::size_t corner) {
  const Vec w = difference(pair.start, pair.corners[corner]);
  return {{corner}, equation_of(pair.step, w, pair.rr), 1, {{1, 0}}};
}

Part edge_part(const WholePair& pair, std::size_t from, std::size_t to) {
  const Vec e = difference(pair.corners[to], pair.corners[from]);
  const Vec w = difference(pair.start, pair.corners[from]);
  const mpz_class ee = dot(e, e);
  const Linear along = {dot(w, e), dot(pair.step, e)};
  return {{from, to},
          equation_of(cross(pair.step, e), cross(w, e), pair.rr * ee),
          ee,
          {{ee - along.constant, -along.rate}, along}};
}

Part face_part(const WholePair& pair, const Vec& n) {
  const Vec to_b = difference(pair.corners[1], pair.corners[0]);
  const Vec to_c = difference(pair.corners[2], pair.corners[0]);
  const Vec w = difference(pair.start, pair.corners[0]);
  const mpz_class nn = dot(n, n);
  const Linear u = {dot(n, cross(w, to_c)), dot(n, cross(pair.step, to_c))};
  const Linear v = {dot(n, cross(to_b, w)), dot(n, cross(to_b, pair.step))};
  const mpz_class height = dot(n, w);
  const mpz_class rate = dot(n, pair.step);
  return {{0, 1, 2},
          {rate * rate, rate * height, height * height - pair.rr * nn},
          nn,
          {{nn - u.constant - v.constant, -u.rate - v.rate}, u, v}};
}

/// A triangle without area is the edge between its first and its last corner, or a point.
std::vector<Part> parts_of(const WholePair& pair) {
  const auto& corners = pair.corners;
  const Vec n = cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
  std::vector<Part> parts;
  if (n != Vec{0, 0, 0}) {
    parts.push_back(face_part(pair, n));
    for (std::size_t i = 0; i < 3; ++i) {
      parts.push_back(edge_part(pair, i, (i + 1) % 3));
      parts.push_back(corner_part(pair, i));
    }
    return parts;
  }
  const auto low = static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
  const auto high = static_cast<std::size_t>(std::max_element(corners.begin(), corners.end()) - corners.begin());
  parts.push_back(corner_part(pair, low));
  if (low == high) return parts;
  parts.push_back(corner_part(pair, high));
  parts.push_back(edge_part(pair, low, high));
  return parts;
}

Feature feature_of(const std::array<OneRootNumber, 3>& weights) {
  std::array<bool, 3> has{};
  for (std::size_t i = 0; i < 3; ++i) has[i] = weights[i].sign() > 0;
  if (has[0] && has[1] && has[2]) return Feature::face;
  if (has[0] && has[1]) return Feature::edge_ab;
  if (has[1] && has[2]) return Feature::edge_bc;
  if (has[2] && has[0]) return Feature::edge_ca;
  return has[0] ? Feature::corner_a : has[1] ? Feature::corner_b : Feature::corner_c;
}

SweptTruth truth_at(const QuadraticRoot& t, const Part& part) {
  std::array<OneRootNumber, 3> weights;
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    weights[part.corners[i]] = t.number().linear(part.weights[i].constant, part.weights[i].rate, part.scale);
  }
  return {true, false, t, weights[1], weights[2], feature_of(weights)};
}

/// What is true if the ball touches at its start. Then the nearest point is the touched one.
std::optional<SweptTruth> truth_at_start(const std::vector<Part>& parts) {
  const QuadraticRoot zero;
  const Part* nearest = nullptr;
  for (const Part& part : parts) {
    if (!part.is_over_it(zero.number())) continue;
    // Compares c / scale, which is the squared distance less r².
    if (nearest == nullptr || part.equation.c * nearest->scale < nearest->equation.c * part.scale) nearest = &part;
  }
  if (nearest == nullptr || nearest->equation.c > 0) return std::nullopt;
  SweptTruth truth = truth_at(zero, *nearest);
  truth.starts_touching = true;
  return truth;
}

}  // namespace

template <typename Scalar>
SweptTruth truth_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  const std::vector<Part> parts = parts_of(whole_pair(sphere, triangle));
  if (const auto at_start = truth_at_start(parts)) return *at_start;
  const Part* first = nullptr;
  QuadraticRoot root;
  for (const Part& part : parts) {
    QuadraticRoot candidate = part.equation;
    if (candidate.a == 0 || candidate.b * candidate.b < candidate.a * candidate.c) continue;
    for (const bool is_upper : {false, true}) {
      candidate.is_upper = is_upper;
      const OneRootNumber t = candidate.number();
      if (t.sign() < 0 || t.compare(1, 0) > 0 || !part.is_over_it(t)) continue;
      if (first != nullptr && t.compare(root.number()) >= 0) continue;
      first = &part;
      root = candidate;
    }
  }
  return first == nullptr ? SweptTruth{} : truth_at(root, *first);
}

template <typename Scalar>
ShapeHit<Scalar> rounded_hit(const SweptTruth& truth) {
  return {nearest<Scalar>(truth.t.number()),
          nearest<Scalar>(truth.u),
          nearest<Scalar>(truth.v),
          0,
          truth.feature,
          truth.starts_touching};
}

template <typename Scalar>
std::optional<std::string> find_error(const SweptTruth& truth, const std::optional<ShapeHit<Scalar>>& answer) {
  if (answer.has_value() != truth.touches) {
    return truth.touches ? "a miss, but they touch" : "a hit, but they do not touch";
  }
  if (!answer) return std::nullopt;
  if (answer->started_touching != truth.starts_touching) return "started_touching is wrong";
  if (!is_nearest(answer->t, truth.t.number())) return "t is wrong";
  if (!is_nearest(answer->u, truth.u)) return "u is wrong";
  if (!is_nearest(answer->v, truth.v)) return "v is wrong";
  if (answer->feature != truth.feature) return "the feature is wrong";
  return std::nullopt;
}

#define SUREHIT_INSTANTIATE(Scalar)                                                  \
  template SweptTruth truth_of(const SweptSphere<Scalar>&, const Triangle<Scalar>&); \
  template ShapeHit<Scalar> rounded_hit(const SweptTruth&);                          \
  template std::optional<std::string> find_error(const SweptTruth&, const std::optional<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
