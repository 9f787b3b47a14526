#include "support/swept_truth.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "support/dyadic.hpp"

namespace surehit::test {
namespace {

using Vec = WholeVector;

Vec difference(const Vec& x, const Vec& y) {
  return {mpz_class(x[0] - y[0]), mpz_class(x[1] - y[1]), mpz_class(x[2] - y[2])};
}
/// GMP adds and subtracts products in place. Expressions allocate memory for each, which takes longer than they do.
mpz_class dot(const Vec& x, const Vec& y) {
  mpz_class sum = x[0] * y[0];
  for (const std::size_t i : {1U, 2U}) mpz_addmul(sum.get_mpz_t(), x[i].get_mpz_t(), y[i].get_mpz_t());
  return sum;
}
Vec cross(const Vec& x, const Vec& y) {
  Vec result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[i] = x[j] * y[k];
    mpz_submul(result[i].get_mpz_t(), x[k].get_mpz_t(), y[j].get_mpz_t());
  }
  return result;
}

bool has_axis(const WholeCapsulePair& pair) { return pair.half_axis != Vec{0, 0, 0}; }
Vec normal_of(const WholeCapsulePair& pair) {
  return cross(difference(pair.corners[1], pair.corners[0]), difference(pair.corners[2], pair.corners[0]));
}

template <typename Scalar>
WholeCapsulePair whole_pair(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
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
  /// What the projection of the centre on the part is made of: a corner, an end of the core, or a corner moved to an
  /// end. Each has a weight, which is not negative where the projection belongs to the part.
  struct Share {
    Linear weight;  ///< It is times `scale`.
    std::optional<std::size_t> corner;
    int side;  ///< It is the share of the half axis: 1 and -1 are the ends of the core.
  };

  /// The squared distance to the part's plane, line or point is (a t² + 2 b t + c) / scale + r².
  QuadraticRoot equation;
  mpz_class scale;
  /// Lists the shares. Most parts are too far away for them to matter.
  std::function<std::vector<Share>()> shares;

  [[nodiscard]] bool is_over_it(const OneRootNumber& t) const {
    const std::vector<Share> all = shares();
    return std::all_of(all.begin(), all.end(), [&](const Share& share) { return share.weight.sign_at(t) >= 0; });
  }
};

/// A corner, moved to an end of the core that is there.
struct Vertex {
  std::size_t corner;
  int side;
};

/// Its parts are valid for as long as it is there.
class PartLister {
 public:
  explicit PartLister(const WholeCapsulePair& pair) : pair_(pair), n_(normal_of(pair)) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      places_[corner].fill(pair.corners[corner]);
      for (std::size_t i = 0; i < 3; ++i) {
        places_[corner].front()[i] -= pair.half_axis[i];
        places_[corner].back()[i] += pair.half_axis[i];
      }
    }
  }

  [[nodiscard]] std::vector<Part> parts() const {
    std::vector<Part> all;
    all.reserve(20);  // Two faces, nine edges, six corners and three parallelograms.
    const std::vector<int> sides = has_axis(pair_) ? std::vector<int>{-1, 1} : std::vector<int>{0};
    for (const int side : sides) {
      if (has_area()) all.push_back(face(side));
      for (const auto& [from, to] : edges()) all.push_back(edge({from, side}, {to, side}));
      for (const std::size_t corner : corners()) all.push_back(single({corner, side}));
    }
    if (!has_axis(pair_)) return all;
    for (const auto& [from, to] : edges()) {
      if (normal_of_parallelogram(from, to) != Vec{0, 0, 0}) all.push_back(parallelogram(from, to));
    }
    for (const std::size_t corner : corners()) all.push_back(edge({corner, -1}, {corner, 1}));
    return all;
  }

 private:
  using Share = Part::Share;

  [[nodiscard]] bool has_area() const { return n_ != Vec{0, 0, 0}; }
  /// A triangle without area is the edge between its first and its last corner, or a point.
  [[nodiscard]] std::vector<std::size_t> corners() const {
    if (has_area()) return {0, 1, 2};
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
  [[nodiscard]] const Vec& place(const Vertex& at) const {
    return places_[at.corner][static_cast<std::size_t>(1 + at.side)];
  }
  [[nodiscard]] Vec from_corner(std::size_t from, std::size_t to) const {
    return difference(pair_.corners[to], pair_.corners[from]);
  }
  [[nodiscard]] Vec axis() const { return {2 * pair_.half_axis[0], 2 * pair_.half_axis[1], 2 * pair_.half_axis[2]}; }
  [[nodiscard]] Vec start_from(const Vertex& at) const { return difference(pair_.start, place(at)); }
  [[nodiscard]] Vec normal_of_parallelogram(std::size_t from, std::size_t to) const {
    return cross(from_corner(from, to), axis());
  }
  /// What grows from zero where `constant` grows with the start and `rate` with the step.
  template <typename Measure>
  [[nodiscard]] Linear measured(const Vec& w, const Measure& measure) const {
    return {measure(w), measure(pair_.step)};
  }

  [[nodiscard]] Part single(const Vertex& at) const {
    const Vec w = start_from(at);
    const auto shares = [at] { return std::vector<Share>{{{1, 0}, at.corner, at.side}}; };
    return {{dot(pair_.step, pair_.step), dot(pair_.step, w), dot(w, w) - pair_.rr}, 1, shares};
  }

  [[nodiscard]] Part edge(const Vertex& from, const Vertex& to) const {
    const Vec e = difference(place(to), place(from));
    const mpz_class ee = dot(e, e);
    const Vec rate = cross(pair_.step, e);
    const Vec across = cross(start_from(from), e);
    const auto shares = [this, from, to] {
      const Vec along = difference(place(to), place(from));
      const Linear whole = {dot(along, along), 0};
      const Linear share = measured(start_from(from), [&](const Vec& x) { return dot(x, along); });
      return std::vector<Share>{{share, to.corner, to.side}, {whole - share, from.corner, from.side}};
    };
    return {{dot(rate, rate), dot(rate, across), dot(across, across) - pair_.rr * ee}, ee, shares};
  }

  [[nodiscard]] Part face(int side) const {
    const auto shares = [this, side] {
      const Vec to_b = from_corner(0, 1);
      const Vec to_c = from_corner(0, 2);
      const Vec w = start_from({0, side});
      const Linear whole = {dot(n_, n_), 0};
      const Linear u = measured(w, [&](const Vec& x) { return dot(n_, cross(x, to_c)); });
      const Linear v = measured(w, [&](const Vec& x) { return dot(n_, cross(to_b, x)); });
      return std::vector<Share>{{u, 1, side}, {v, 2, side}, {whole - u - v, 0, side}};
    };
    return in_plane(n_, start_from({0, side}), shares);
  }

  [[nodiscard]] Part parallelogram(std::size_t from, std::size_t to) const {
    const auto shares = [this, from, to] {
      const Vec n = normal_of_parallelogram(from, to);
      const Vec w = start_from({from, -1});
      const Linear whole = {dot(n, n), 0};
      const Linear share = measured(w, [&](const Vec& x) { return dot(n, cross(x, axis())); });
      const Linear along = measured(w, [&](const Vec& x) { return dot(n, cross(from_corner(from, to), x)); });
      return std::vector<Share>{{share, to, 0}, {whole - share, from, 0}, {along, {}, 1}, {whole - along, {}, -1}};
    };
    return in_plane(normal_of_parallelogram(from, to), start_from({from, -1}), shares);
  }

  template <typename Shares>
  [[nodiscard]] Part in_plane(const Vec& n, const Vec& w, const Shares& shares) const {
    const mpz_class nn = dot(n, n);
    const mpz_class height = dot(n, w);
    const mpz_class rate = dot(n, pair_.step);
    return {{rate * rate, rate * height, height * height - pair_.rr * nn}, nn, shares};
  }

  const WholeCapsulePair& pair_;
  Vec n_;
  std::array<std::array<Vec, 3>, 3>
      places_;  ///< The places of each corner: at an end, in the middle, at the other end.
};

/// The touched point: the sum of the corners times their weights, and of the half axis times `along`. All are times
/// `scale` here.
struct Touched {
  mpz_class scale;
  std::array<Linear, 3> weights;
  Linear along;
};

Touched touched_of(const Part& part) {
  Touched touched{part.scale, {}, {}};
  for (const auto& [weight, corner, side] : part.shares()) {
    if (corner) touched.weights[*corner] = touched.weights[*corner] + weight;
    touched.along = touched.along + side * weight;
  }
  return touched;
}

/// The half axis as a sum of corners whose weights add up to zero, if it is parallel to the triangle: the weights times
/// a positive whole number, and this number. It is 0 if the axis is not parallel.
struct AxisInTriangle {
  std::array<mpz_class, 3> weights;
  mpz_class whole = 0;
};

AxisInTriangle axis_in_triangle(const WholeCapsulePair& pair) {
  AxisInTriangle axis;
  if (!has_axis(pair)) return axis;
  const Vec n = normal_of(pair);
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
void move_toward_centre(const AxisInTriangle& axis, const OneRootNumber& t, Touched& touched) {
  const int side = touched.along.sign_at(t);
  if (axis.whole == 0 || side == 0) return;
  // The point moves by limit / whole half axes.
  Linear limit = side * touched.along;
  mpz_class whole = touched.scale;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class rate = -side * axis.weights[i];
    if (rate <= 0) continue;
    const Linear other = axis.whole * touched.weights[i];
    const mpz_class other_whole = touched.scale * rate;
    if ((whole * other - other_whole * limit).sign_at(t) >= 0) continue;
    limit = other;
    whole = other_whole;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    touched.weights[i] = (whole * axis.whole) * touched.weights[i] + (touched.scale * side * axis.weights[i]) * limit;
  }
  touched.scale *= whole * axis.whole;
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

SweptTruth truth_at(const QuadraticRoot& t, const Touched& touched) {
  std::array<OneRootNumber, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = t.number().linear(touched.weights[i].constant, touched.weights[i].rate, touched.scale);
  }
  return {true, false, t, weights[1], weights[2], feature_of(weights)};
}

/// What is true if the core crosses the triangle at the start, in one point.
std::optional<SweptTruth> truth_across(const WholeCapsulePair& pair) {
  const Vec n = normal_of(pair);
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
  Touched touched;
  touched.scale = dot(n, n) * abs(rate);
  const mpz_class u = dot(n, cross(at, to_c));
  const mpz_class v = dot(n, cross(to_b, at));
  touched.weights = {Linear{touched.scale - u - v, 0}, Linear{u, 0}, Linear{v, 0}};
  if (u < 0 || v < 0 || u + v > touched.scale) return std::nullopt;
  return truth_at({}, touched);
}

/// What is true if they touch at the start. Then the nearest point is the touched one.
std::optional<SweptTruth> truth_at_start(const WholeCapsulePair& pair, const std::vector<Part>& parts) {
  std::optional<SweptTruth> truth = truth_across(pair);
  if (!truth) {
    const QuadraticRoot zero;
    const Part* nearest = nullptr;
    for (const Part& part : parts) {
      // c / scale is the squared distance less r².
      if (part.equation.c > 0 || !part.is_over_it(zero.number())) continue;
      if (nearest == nullptr || part.equation.c * nearest->scale < nearest->equation.c * part.scale) nearest = &part;
    }
    if (nearest == nullptr) return std::nullopt;
    Touched touched = touched_of(*nearest);
    move_toward_centre(axis_in_triangle(pair), zero.number(), touched);
    truth = truth_at(zero, touched);
  }
  truth->starts_touching = true;
  return truth;
}

/// Whether a root is in [0, 1], if the equation has roots. Signs tell. Both roots are negative if their sum -2 b / a
/// is, and their product c / a is not. Less 1, they are the roots of a x² + 2 (a + b) x + (a + 2 b + c).
bool is_in_range(const QuadraticRoot& root) {
  const mpz_class slope = root.a + root.b;
  const mpz_class value = slope + root.b + root.c;
  if (root.is_upper) return !(root.b > 0 && root.c > 0) && slope >= 0 && value >= 0;
  return root.b <= 0 && root.c >= 0 && !(slope < 0 && value > 0);
}

/// Whether the coordinates that the capsule passes on an axis are not those of the triangle. So it is for most misses.
bool are_apart(const WholeCapsulePair& pair) {
  const mpz_class radius = sqrt(pair.rr) + 1;  // Or a little more.
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class& from = pair.start[i];
    const mpz_class to = from + pair.step[i];
    const mpz_class reach = abs(pair.half_axis[i]) + radius;
    const auto [low, high] = std::minmax({pair.corners[0][i], pair.corners[1][i], pair.corners[2][i]});
    if (std::min(from, to) - reach > high || std::max(from, to) + reach < low) return true;
  }
  return false;
}

}  // namespace

SweptTruth truth_of(const WholeCapsulePair& pair) {
  if (are_apart(pair)) return {};
  const PartLister lister(pair);
  const std::vector<Part> parts = lister.parts();
  if (const auto at_start = truth_at_start(pair, parts)) return *at_start;
  const Part* first = nullptr;
  QuadraticRoot root;
  OneRootNumber first_t;
  for (const Part& part : parts) {
    QuadraticRoot candidate = part.equation;
    if (candidate.a == 0) continue;
    for (const bool is_upper : {false, true}) {
      candidate.is_upper = is_upper;
      if (!is_in_range(candidate)) continue;
      const OneRootNumber t = candidate.number();
      if (t.d < 0) break;  // There are no roots.
      if (!part.is_over_it(t)) continue;
      if (first == nullptr || t.compare(first_t) < 0) {
        first = &part;
        root = candidate;
        first_t = t;
      }
      break;  // The upper root is not before the lower one.
    }
  }
  if (first == nullptr) return {};
  Touched touched = touched_of(*first);
  move_toward_centre(axis_in_triangle(pair), first_t, touched);
  return truth_at(root, touched);
}

template <typename Scalar>
SweptTruth truth_of(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  return truth_of(whole_pair(capsule, triangle));
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

#define SUREHIT_INSTANTIATE(Scalar)                                                   \
  template SweptTruth truth_of(const SweptSphere<Scalar>&, const Triangle<Scalar>&);  \
  template SweptTruth truth_of(const SweptCapsule<Scalar>&, const Triangle<Scalar>&); \
  template ShapeHit<Scalar> rounded_hit(const SweptTruth&);                           \
  template std::optional<std::string> find_error(const SweptTruth&, const std::optional<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
