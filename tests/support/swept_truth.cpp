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

/// A capsule and a triangle in whole numbers of one unit. A ball is a capsule with a half axis of zero.
struct WholePair {
  Vec start;
  Vec step;
  Vec half_axis;
  std::array<Vec, 3> corners;
  mpz_class rr;

  [[nodiscard]] bool has_axis() const { return half_axis != Vec{0, 0, 0}; }
  [[nodiscard]] Vec normal() const {
    return cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
  }
};

template <typename Scalar>
WholePair whole_pair(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  const std::array<DyadicVector, 6> points = {dyadic(capsule.start), dyadic(capsule.end), dyadic(capsule.half_axis),
                                              dyadic(triangle.a),    dyadic(triangle.b),  dyadic(triangle.c)};
  const Dyadic radius(double{capsule.radius});
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
  return {start,
          difference(whole(points[1]), start),
          whole(points[2]),
          {whole(points[3]), whole(points[4]), whole(points[5])},
          r * r};
}

/// A quantity that is linear in t.
struct Linear {
  mpz_class constant = 0;
  mpz_class rate = 0;

  [[nodiscard]] int sign_at(const OneRootNumber& t) const { return t.linear(constant, rate, 1).sign(); }
  friend Linear operator+(const Linear& x, const Linear& y) { return {x.constant + y.constant, x.rate + y.rate}; }
  friend Linear operator-(const Linear& x, const Linear& y) { return {x.constant - y.constant, x.rate - y.rate}; }
  friend Linear operator*(const mpz_class& factor, const Linear& x) { return {factor * x.constant, factor * x.rate}; }
};

/// A part of what the centre must come near to: the triangle, moved along the core in both directions. It is a face, an
/// edge or a corner, with its outline.
struct Part {
  /// The squared distance to the part's plane, line or point is (a t² + 2 b t + c) / scale + r².
  QuadraticRoot equation;
  mpz_class scale;
  /// The projection of the centre belongs to the part if none of these is negative.
  std::vector<Linear> bounds;
  /// The projection is the sum of the corners times their weights, and of the half axis times `along`. Both are times
  /// `scale` here.
  std::array<Linear, 3> weights;
  Linear along;

  [[nodiscard]] bool is_over_it(const OneRootNumber& t) const {
    return std::all_of(bounds.begin(), bounds.end(), [&](const Linear& bound) { return bound.sign_at(t) >= 0; });
  }
};

/// A corner, moved to an end of the core that is there.
struct Vertex {
  std::size_t corner;
  int side;
  Vec place;
};

class PartLister {
 public:
  explicit PartLister(const WholePair& pair) : pair_(pair), n_(pair.normal()) {}

  std::vector<Part> parts() {
    const std::vector<int> sides = pair_.has_axis() ? std::vector<int>{-1, 1} : std::vector<int>{0};
    for (const int side : sides) {
      if (n_ != Vec{0, 0, 0}) add_face(side);
      for (const auto& [from, to] : edges()) add_edge(vertex(from, side), vertex(to, side));
      for (const std::size_t corner : corners()) add_corner(vertex(corner, side));
    }
    if (!pair_.has_axis()) return std::move(parts_);
    for (const auto& [from, to] : edges()) add_parallelogram(from, to);
    for (const std::size_t corner : corners()) add_edge(vertex(corner, -1), vertex(corner, 1));
    return std::move(parts_);
  }

 private:
  /// A triangle without area is the edge between its first and its last corner, or a point.
  [[nodiscard]] std::vector<std::size_t> corners() const {
    if (n_ != Vec{0, 0, 0}) return {0, 1, 2};
    const auto& all = pair_.corners;
    const auto low = static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin());
    const auto high = static_cast<std::size_t>(std::max_element(all.begin(), all.end()) - all.begin());
    if (low == high) return {low};
    return {low, high};
  }
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> edges() const {
    const std::vector<std::size_t> some = corners();
    if (some.size() == 1) return {};
    if (some.size() == 2) return {{some[0], some[1]}};
    return {{0, 1}, {1, 2}, {2, 0}};
  }
  [[nodiscard]] Vertex vertex(std::size_t corner, int side) const {
    Vec place = pair_.corners[corner];
    for (std::size_t i = 0; i < 3; ++i) place[i] += side * pair_.half_axis[i];
    return {corner, side, place};
  }
  /// What grows from zero where `constant` grows with the start and `rate` with the step.
  template <typename Measure>
  [[nodiscard]] Linear measured(const Vec& w, const Measure& measure) const {
    return {measure(w), measure(pair_.step)};
  }

  void add_corner(const Vertex& at) {
    const Vec w = difference(pair_.start, at.place);
    Part part{{dot(pair_.step, pair_.step), dot(pair_.step, w), dot(w, w) - pair_.rr}, 1, {}, {}, {at.side, 0}};
    part.weights[at.corner].constant = 1;
    parts_.push_back(std::move(part));
  }

  void add_edge(const Vertex& from, const Vertex& to) {
    const Vec e = difference(to.place, from.place);
    const Vec w = difference(pair_.start, from.place);
    const mpz_class ee = dot(e, e);
    const Vec rate = cross(pair_.step, e);
    const Vec across = cross(w, e);
    const Linear whole = {ee, 0};
    const Linear share = measured(w, [&](const Vec& x) { return dot(x, e); });
    Part part{{dot(rate, rate), dot(rate, across), dot(across, across) - pair_.rr * ee},
              ee,
              {share, whole - share},
              {},
              from.side * (whole - share) + to.side * share};
    part.weights[from.corner] = whole - share;
    part.weights[to.corner] = part.weights[to.corner] + share;
    parts_.push_back(std::move(part));
  }

  void add_face(int side) {
    const Vec to_b = difference(pair_.corners[1], pair_.corners[0]);
    const Vec to_c = difference(pair_.corners[2], pair_.corners[0]);
    const Vec w = difference(pair_.start, vertex(0, side).place);
    Part part = plane_part(n_, w);
    const Linear u = measured(w, [&](const Vec& x) { return dot(n_, cross(x, to_c)); });
    const Linear v = measured(w, [&](const Vec& x) { return dot(n_, cross(to_b, x)); });
    const Linear whole = {part.scale, 0};
    part.weights = {whole - u - v, u, v};
    part.bounds = {u, v, whole - u - v};
    part.along = side * whole;
    parts_.push_back(std::move(part));
  }

  void add_parallelogram(std::size_t from, std::size_t to) {
    const Vec e = difference(pair_.corners[to], pair_.corners[from]);
    const Vec axis = difference(vertex(from, 1).place, vertex(from, -1).place);
    const Vec n = cross(e, axis);
    if (n == Vec{0, 0, 0}) return;
    const Vec w = difference(pair_.start, vertex(from, -1).place);
    Part part = plane_part(n, w);
    const Linear share = measured(w, [&](const Vec& x) { return dot(n, cross(x, axis)); });
    const Linear along = measured(w, [&](const Vec& x) { return dot(n, cross(e, x)); });
    const Linear whole = {part.scale, 0};
    part.weights[from] = whole - share;
    part.weights[to] = share;
    part.bounds = {share, whole - share, along, whole - along};
    part.along = along + along - whole;
    parts_.push_back(std::move(part));
  }

  [[nodiscard]] Part plane_part(const Vec& n, const Vec& w) const {
    const mpz_class nn = dot(n, n);
    const mpz_class height = dot(n, w);
    const mpz_class rate = dot(n, pair_.step);
    return {{rate * rate, rate * height, height * height - pair_.rr * nn}, nn, {}, {}, {}};
  }

  const WholePair& pair_;
  Vec n_;
  std::vector<Part> parts_;
};

/// The half axis as a sum of corners whose weights add up to zero, if it is parallel to the triangle: the weights times
/// a positive whole number, and this number. It is 0 if the axis is not parallel.
struct AxisInTriangle {
  std::array<mpz_class, 3> weights;
  mpz_class whole = 0;
};

AxisInTriangle axis_in_triangle(const WholePair& pair) {
  AxisInTriangle axis;
  if (!pair.has_axis()) return axis;
  const Vec n = pair.normal();
  if (n != Vec{0, 0, 0}) {
    if (dot(n, pair.half_axis) != 0) return axis;
    const Vec to_b = difference(pair.corners[1], pair.corners[0]);
    const Vec to_c = difference(pair.corners[2], pair.corners[0]);
    axis.whole = dot(n, n);
    axis.weights[1] = dot(n, cross(pair.half_axis, to_c));
    axis.weights[2] = dot(n, cross(to_b, pair.half_axis));
    axis.weights[0] = -axis.weights[1] - axis.weights[2];
    return axis;
  }
  const auto low =
      static_cast<std::size_t>(std::min_element(pair.corners.begin(), pair.corners.end()) - pair.corners.begin());
  const auto high =
      static_cast<std::size_t>(std::max_element(pair.corners.begin(), pair.corners.end()) - pair.corners.begin());
  const Vec e = difference(pair.corners[high], pair.corners[low]);
  if (low == high || cross(e, pair.half_axis) != Vec{0, 0, 0}) return axis;
  axis.whole = dot(e, e);
  axis.weights[high] = dot(e, pair.half_axis);
  axis.weights[low] = -axis.weights[high];
  return axis;
}

/// Moves the touched point along the axis toward the one below the centre, for as long as it stays in the triangle. All
/// of these points are equally near to the core.
void move_toward_centre(const AxisInTriangle& axis, const OneRootNumber& t, Part& part) {
  const int side = part.along.sign_at(t);
  if (axis.whole == 0 || side == 0) return;
  // The point moves by limit / whole half axes.
  Linear limit = side * part.along;
  mpz_class whole = part.scale;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class rate = -side * axis.weights[i];
    if (rate <= 0) continue;
    const Linear other = axis.whole * part.weights[i];
    const mpz_class other_whole = part.scale * rate;
    if ((whole * other - other_whole * limit).sign_at(t) >= 0) continue;
    limit = other;
    whole = other_whole;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    part.weights[i] = (whole * axis.whole) * part.weights[i] + (part.scale * side * axis.weights[i]) * limit;
  }
  part.scale *= whole * axis.whole;
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
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = t.number().linear(part.weights[i].constant, part.weights[i].rate, part.scale);
  }
  return {true, false, t, weights[1], weights[2], feature_of(weights)};
}

/// What is true if the core crosses the triangle at the start, in one point.
std::optional<SweptTruth> truth_across(const WholePair& pair) {
  const Vec n = pair.normal();
  mpz_class rate = dot(n, pair.half_axis);
  if (rate == 0) return std::nullopt;
  const Vec w = difference(pair.start, pair.corners[0]);
  mpz_class height = dot(n, w);
  if (abs(height) > abs(rate)) return std::nullopt;
  // The point is the start less height / rate half axes.
  Vec at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = sgn(rate) * (rate * w[i] - height * pair.half_axis[i]);
  const Vec to_b = difference(pair.corners[1], pair.corners[0]);
  const Vec to_c = difference(pair.corners[2], pair.corners[0]);
  Part part;
  part.scale = dot(n, n) * abs(rate);
  const mpz_class u = dot(n, cross(at, to_c));
  const mpz_class v = dot(n, cross(to_b, at));
  part.weights = {Linear{part.scale - u - v, 0}, Linear{u, 0}, Linear{v, 0}};
  if (u < 0 || v < 0 || u + v > part.scale) return std::nullopt;
  return truth_at({}, part);
}

/// What is true if they touch at the start. Then the nearest point is the touched one.
std::optional<SweptTruth> truth_at_start(const WholePair& pair, const std::vector<Part>& parts) {
  std::optional<SweptTruth> truth = truth_across(pair);
  if (!truth) {
    const QuadraticRoot zero;
    const Part* nearest = nullptr;
    for (const Part& part : parts) {
      if (!part.is_over_it(zero.number())) continue;
      // Compares c / scale, which is the squared distance less r².
      if (nearest == nullptr || part.equation.c * nearest->scale < nearest->equation.c * part.scale) nearest = &part;
    }
    if (nearest == nullptr || nearest->equation.c > 0) return std::nullopt;
    Part touched = *nearest;
    move_toward_centre(axis_in_triangle(pair), zero.number(), touched);
    truth = truth_at(zero, touched);
  }
  truth->starts_touching = true;
  return truth;
}

}  // namespace

template <typename Scalar>
SweptTruth truth_of(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  const WholePair pair = whole_pair(capsule, triangle);
  const std::vector<Part> parts = PartLister(pair).parts();
  if (const auto at_start = truth_at_start(pair, parts)) return *at_start;
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
  if (first == nullptr) return {};
  Part touched = *first;
  move_toward_centre(axis_in_triangle(pair), root.number(), touched);
  return truth_at(root, touched);
}

template <typename Scalar>
SweptTruth truth_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  return truth_of(SweptCapsule<Scalar>{sphere.start, sphere.end, {0, 0, 0}, sphere.radius}, triangle);
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
