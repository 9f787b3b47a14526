#include "support/box_oracle.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/dyadic.hpp"
#include "support/swept_truth.hpp"

namespace surehit::test {
namespace {

using Vec = std::array<mpq_class, 3>;

Vec operator-(const Vec& x, const Vec& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Vec operator*(const Vec& x, const mpq_class& factor) { return {x[0] * factor, x[1] * factor, x[2] * factor}; }
Vec along(const Vec& x, const mpq_class& t, const Vec& d) {
  return {x[0] + t * d[0], x[1] + t * d[1], x[2] + t * d[2]};
}
mpq_class dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vec cross(const Vec& x, const Vec& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// A box and a triangle in whole numbers.
struct Pair {
  Vec start, step, extents;
  std::array<Vec, 3> corners;
};

template <typename Scalar>
Pair convert(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle) {
  const std::array points = {dyadic(box.start),  dyadic(box.end),    dyadic(box.half_extents),
                             dyadic(triangle.a), dyadic(triangle.b), dyadic(triangle.c)};
  long unit = std::numeric_limits<long>::max();
  for (const auto& point : points) {
    for (const Dyadic& x : point) {
      if (!x.is_zero()) unit = std::min(unit, x.exponent());
    }
  }
  const auto whole = [&](const DyadicVector& x) -> Vec {
    return {x[0].in_units_of(unit), x[1].in_units_of(unit), x[2].in_units_of(unit)};
  };
  const Vec start = whole(points[0]);
  return {start, whole(points[1]) - start, whole(points[2]), {whole(points[3]), whole(points[4]), whole(points[5])}};
}

/// The linear inequality factors[0] u + factors[1] v + factors[2] t + factors[3] >= 0.
struct Row {
  std::array<mpz_class, 4> factors;
  std::bitset<11> sources;  ///< The first inequalities that it is a sum of.
};

/// What remains of inequalities for the other unknowns: each row that bounds one unknown from below is added to each
/// row that bounds it from above, so often that the unknown is gone. Unknowns before this one are gone already.
///
/// A sum of more than k + 1 first inequalities says nothing new after k unknowns are gone, and is left out (Kohler
/// 1967).
std::vector<Row> eliminated(const std::vector<Row>& rows, std::size_t unknown) {
  const std::size_t max_sources = unknown + 2;
  std::vector<Row> rest;
  rest.reserve(rows.size() * rows.size() / 4 + rows.size());  // Each sum has a row of both kinds.
  for (const Row& low : rows) {
    const int sign = sgn(low.factors[unknown]);
    if (sign == 0) rest.push_back(low);
    if (sign <= 0) continue;
    for (const Row& high : rows) {
      if (sgn(high.factors[unknown]) >= 0) continue;
      Row sum = {{}, low.sources | high.sources};
      if (sum.sources.count() > max_sources) continue;
      for (std::size_t i = unknown + 1; i < 4; ++i) {
        mpz_class& factor = sum.factors[i];
        factor = high.factors[i] * low.factors[unknown];
        mpz_submul(factor.get_mpz_t(), low.factors[i].get_mpz_t(), high.factors[unknown].get_mpz_t());
      }
      rest.push_back(std::move(sum));
    }
  }
  return rest;
}

/// A quotient with a positive denominator. It need not be in lowest terms, as a common divisor takes long to find.
struct Quotient {
  mpz_class numerator;
  mpz_class denominator;

  friend bool operator<(const Quotient& x, const Quotient& y) {
    return x.numerator * y.denominator < y.numerator * x.denominator;
  }
};

/// Whether the coordinates that the box passes on an axis are not those of the triangle. So it is for most misses.
bool are_apart(const Pair& pair) {
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class& from = pair.start[i].get_num();
    const mpz_class to = from + pair.step[i].get_num();
    const mpz_class& reach = pair.extents[i].get_num();
    const auto [low, high] = std::minmax({pair.corners[0][i], pair.corners[1][i], pair.corners[2][i]});
    if (std::min(from, to) - reach > high.get_num() || std::max(from, to) + reach < low.get_num()) return true;
  }
  return false;
}

/// The lowest t in [0, 1] at which a point of the triangle is in the box.
std::optional<mpq_class> first_time(const Pair& pair) {
  if (are_apart(pair)) return std::nullopt;
  const auto& [start, step, extents, corners] = pair;
  std::vector<Row> rows;
  const auto add = [&](std::array<mpz_class, 4> factors) {
    rows.push_back({std::move(factors), std::bitset<11>().set(rows.size())});
  };
  add({1, 0, 0, 0});
  add({0, 1, 0, 0});
  add({-1, -1, 0, 1});
  add({0, 0, 1, 0});
  add({0, 0, -1, 1});
  for (std::size_t i = 0; i < 3; ++i) {
    // The centre less the point.
    const std::array<mpz_class, 4> way = {mpz_class(corners[0][i] - corners[1][i]),
                                          mpz_class(corners[0][i] - corners[2][i]), mpz_class(step[i]),
                                          mpz_class(start[i] - corners[0][i])};
    const mpz_class reach(extents[i]);
    add({way[0], way[1], way[2], way[3] + reach});
    add({-way[0], -way[1], -way[2], reach - way[3]});
  }
  rows = eliminated(eliminated(rows, 0), 1);
  Quotient low = {0, 1};
  Quotient high = {1, 1};
  for (const auto& [factors, sources] : rows) {
    const int sign = sgn(factors[2]);
    if (sign == 0 && factors[3] < 0) return std::nullopt;
    if (sign == 0) continue;
    Quotient bound = sign > 0 ? Quotient{-factors[3], factors[2]} : Quotient{factors[3], -factors[2]};
    if (sign > 0 && low < bound) low = std::move(bound);
    if (sign < 0 && bound < high) high = std::move(bound);
  }
  if (high < low) return std::nullopt;
  mpq_class first(low.numerator, low.denominator);
  first.canonicalize();
  return first;
}

/// A point of a triangle with the weights of all corners.
struct Weighted {
  Vec point;
  Vec weights;
};

Weighted between(const Weighted& from, const Weighted& to, const mpq_class& share) {
  return {along(from.point, share, to.point - from.point), along(from.weights, share, to.weights - from.weights)};
}

/// Keeps the part of a convex polygon where `height` is not negative (Sutherland and Hodgman 1974).
template <typename Height>
std::vector<Weighted> cut(const std::vector<Weighted>& polygon, const Height& height) {
  std::vector<Weighted> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Weighted& from = polygon[i];
    const Weighted& to = polygon[(i + 1) % polygon.size()];
    const mpq_class first = height(from.point);
    const mpq_class last = height(to.point);
    if (first >= 0) kept.push_back(from);
    if (sgn(first) * sgn(last) < 0) kept.push_back(between(from, to, mpq_class(first / (first - last))));
  }
  return kept;
}

bool has_area(const Pair& pair) {
  const Vec n = cross(pair.corners[1] - pair.corners[0], pair.corners[2] - pair.corners[0]);
  return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

/// The corners that count: all, or the extreme ones of a triangle without area.
std::vector<Weighted> corners_of(const Pair& pair) {
  std::vector<Weighted> polygon;
  for (std::size_t k = 0; k < 3; ++k) {
    polygon.push_back({pair.corners[k], {k == 0 ? 1 : 0, k == 1 ? 1 : 0, k == 2 ? 1 : 0}});
  }
  if (has_area(pair)) return polygon;
  const auto by_place = [](const Weighted& x, const Weighted& y) { return x.point < y.point; };
  return {*std::min_element(polygon.begin(), polygon.end(), by_place),
          *std::max_element(polygon.begin(), polygon.end(), by_place)};
}

/// The weights of the point of the triangle in the box that is nearest to the box's centre at t.
std::optional<Vec> touched_weights(const Pair& moving, const mpq_class& t) {
  // In units in which the centre is whole, too: common divisors of other numbers take long to find.
  const mpq_class unit(t.get_den());
  const Pair pair = {moving.start * unit,
                     moving.step * unit,
                     moving.extents * unit,
                     {moving.corners[0] * unit, moving.corners[1] * unit, moving.corners[2] * unit}};
  const Vec centre = along(pair.start, mpq_class(t.get_num()), moving.step);
  std::vector<Weighted> polygon = corners_of(pair);
  if (has_area(pair)) {
    const Vec ab = pair.corners[1] - pair.corners[0];
    const Vec ac = pair.corners[2] - pair.corners[0];
    const Vec n = cross(ab, ac);
    const Vec w = centre - pair.corners[0];
    const mpq_class nn = dot(n, n);
    const mpq_class u = dot(n, cross(w, ac));
    const mpq_class v = dot(n, cross(ab, w));
    const Vec gap = along(ab * u, v, ac) - w * nn;
    bool is_there = u >= 0 && v >= 0 && u + v <= nn;
    for (std::size_t i = 0; i < 3; ++i) is_there &= abs(gap[i]) <= pair.extents[i] * nn;
    if (is_there) return Vec{(nn - u - v) / nn, u / nn, v / nn};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    polygon = cut(polygon, [&](const Vec& x) { return mpq_class(centre[i] + pair.extents[i] - x[i]); });
    polygon = cut(polygon, [&](const Vec& x) { return mpq_class(x[i] - centre[i] + pair.extents[i]); });
  }
  std::optional<Weighted> best;
  mpq_class best_distance;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Weighted& from = polygon[i];
    const Weighted& to = polygon[(i + 1) % polygon.size()];
    const Vec e = to.point - from.point;
    const mpq_class ee = dot(e, e);
    mpq_class share = 0;
    if (ee != 0) share = std::clamp<mpq_class>(dot(centre - from.point, e) / ee, 0, 1);
    const Weighted nearest = between(from, to, share);
    const Vec gap = centre - nearest.point;
    const mpq_class distance = dot(gap, gap);
    if (best && distance >= best_distance) continue;
    best = nearest;
    best_distance = distance;
  }
  return best ? std::optional(best->weights) : std::nullopt;
}

/// Whether a number in [0, 1] rounds to x, ties to even.
template <typename Scalar>
bool rounds_to(const mpq_class& exact, Scalar x) {
  if (!(x >= 0 && x <= 1) || std::signbit(x)) return false;
  using Word = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  const bool is_even = (std::bit_cast<Word>(x) & 1) == 0;
  const mpq_class value(double{x});
  const mpq_class below = (value + mpq_class(double{std::nextafter(x, Scalar{-1})})) / 2;
  const mpq_class above = (value + mpq_class(double{std::nextafter(x, Scalar{2})})) / 2;
  return is_even ? exact >= below && exact <= above : exact > below && exact < above;
}

Feature feature_of(const Vec& weights) {
  const bool no_a = weights[0] == 0;
  const bool no_b = weights[1] == 0;
  const bool no_c = weights[2] == 0;
  if (no_b && no_c) return Feature::corner_a;
  if (no_a && no_c) return Feature::corner_b;
  if (no_a && no_b) return Feature::corner_c;
  return no_c ? Feature::edge_ab : no_a ? Feature::edge_bc : no_b ? Feature::edge_ca : Feature::face;
}

SweptTruth truth_of(const Pair& pair) {
  const std::optional<mpq_class> t = first_time(pair);
  if (!t) return {};
  const Vec weights = touched_weights(pair, *t).value();
  const auto number = [](const mpq_class& x) { return OneRootNumber{x.get_num(), 0, 0, x.get_den()}; };
  // (P - Q t)² = 0 at t = P/Q.
  const mpz_class& p = t->get_num();
  const mpz_class& q = t->get_den();
  return {true, *t == 0, {q * q, -p * q, p * p}, number(weights[1]), number(weights[2]), feature_of(weights)};
}

}  // namespace

template <typename Scalar>
std::optional<std::string> find_error(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const Pair pair = convert(box, triangle);
  const std::optional<mpq_class> t = first_time(pair);
  if (!t) return answer ? std::optional<std::string>("a hit, but they do not touch") : std::nullopt;
  if (!answer) return "a miss, but they touch";
  if (answer->started_touching != (*t == 0)) return "started_touching is wrong";
  if (!rounds_to(*t, answer->t)) return "t is wrong";
  const std::optional<Vec> weights = touched_weights(pair, *t);
  if (!weights) return "the judge finds no point";
  if (!rounds_to((*weights)[1], answer->u)) return "u is wrong";
  if (!rounds_to((*weights)[2], answer->v)) return "v is wrong";
  if (answer->feature != feature_of(*weights)) return "the feature is wrong";
  return std::nullopt;
}

SweptTruth truth_of(const WholeBoxPair& pair) {
  const auto rational = [](const WholeVector& x) { return Vec{x[0], x[1], x[2]}; };
  return truth_of(Pair{rational(pair.start),
                       rational(pair.step),
                       rational(pair.half_extents),
                       {rational(pair.corners[0]), rational(pair.corners[1]), rational(pair.corners[2])}});
}

template <typename Scalar>
SweptTruth truth_of(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle) {
  return truth_of(convert(box, triangle));
}

template <typename Scalar>
bool comes_before(const SweptBox<Scalar>& box, const Triangle<Scalar>& x, const Triangle<Scalar>& y) {
  return first_time(convert(box, x)).value() < first_time(convert(box, y)).value();
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                \
  template std::optional<std::string> find_error(const SweptBox<Scalar>&, const Triangle<Scalar>&, \
                                                 const std::optional<ShapeHit<Scalar>>&);          \
  template SweptTruth truth_of(const SweptBox<Scalar>&, const Triangle<Scalar>&);                  \
  template bool comes_before(const SweptBox<Scalar>&, const Triangle<Scalar>&, const Triangle<Scalar>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
