#include "filter/plane_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "support/rounding_flags.hpp"
#include "walk/direction.hpp"

namespace surehit::detail {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A difference of two points, without the axis of the plane.
struct PlaneVector {
  double x, y;
};

/// Returns the component of x × y on the axis of the plane.
///
/// PC1. The computed value is off by at most 8 eps (|x.x y.y| + |x.y y.x|), where eps = 2^-53. This includes the
///     roundings of the differences, and those of the bound. The smallest normal number covers underflow.
/// Proof. Each product passes through four roundings: two differences, the product and the sum. This is 4 eps, up to
///     terms in eps^2. The bound itself has three roundings, so 5 eps would be enough. Each product and the bound lose
///     at most 2^-1075 by underflow.
///
/// PC2. If each product has a factor that is zero, the value is an exact zero.
/// Proof. A difference is computed as zero only if it is zero.
Bounded cross(const PlaneVector& x, const PlaneVector& y) {
  if ((x.x == 0 || y.y == 0) && (x.y == 0 || y.x == 0)) return exact(0);
  const double first = x.x * y.y;
  const double second = x.y * y.x;
  return {first - second, (std::fabs(first) + std::fabs(second)) * 0x1p-50 + std::numeric_limits<double>::min()};
}

/// Returns the axis that is perpendicular to a plane with the triangle and the path, if there is one.
template <typename Scalar>
std::optional<Eigen::Index> axis_of_plane(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Scalar height = triangle.a[axis];
    const bool stays = path.kind == PathKind::segment ? path.toward[axis] == height : path.toward[axis] == 0;
    if (stays && path.start[axis] == height && triangle.b[axis] == height && triangle.c[axis] == height) return axis;
  }
  return std::nullopt;
}

/// The weight of a corner at the line's point at t, times the normal's size: s + t d.
///
/// PC3. The line's point at t is in the triangle if and only if no weight is negative.
/// Proof. A weight is the signed area between the point and the edge opposite the corner, with the sign of the
/// triangle.
///
/// PC4. Each weight with d > 0 bounds t from below, and each one with d < 0 from above, by -s / d. The maximum of the
///     lower bounds of intervals is a lower bound of the maximum, and so on for upper bounds and for minima.
///     So `first` and `last` hold the ends of the interval in which no weight is negative.
///
/// PC5. The pair is a miss if this interval is certain to be empty, or to be beside the range. It is a hit if
///     the interval and the range are certain to overlap. The first contact is at the larger one of the two lower ends.
///
/// PC6. Let the interval begin with -s / d of one weight, and let this be certain. Another weight is s' + t d' there.
///     This is (s' d - s d') / d, and the weight itself is zero.
///
/// PC7. If a point is at a corner, the weights by both edges of this corner are zero there. The arithmetic may not see
///     this, because both products of `cross` are rounded.
///
/// PC8. Let e be the weight at t = 1 of a segment. If s < 0 and e < 0, the pair is a miss in the range [0, 1]. If s < 0
///     and e = 0, the contact can only be at t = 1. Then it is a hit if no weight is negative there. If no weight is
///     negative at t = 0, the first contact is there.
/// Proof. The weight is linear in t. In the second case it is negative at all t below 1.
struct PlaneWeight {
  Bounded s, d;
};

/// The parameters at which no weight is negative: [first, last]. Each end has a lower and an upper bound.
struct PlaneInterval {
  double first_lower = -unlimited;
  double first_upper = -unlimited;
  double last_lower = unlimited;
  double last_upper = unlimited;
  std::size_t entry = 0;     ///< The index of the weight that is zero at `first`.
  bool knows_entry = false;  ///< True if no other lower bound may be as large.

  /// Adds the condition s + t d >= 0, as weight `index`. Returns false if the signs are not certain.
  bool add(const PlaneWeight& weight, std::size_t index) {
    const std::optional<int> direction = weight.d.sign();
    if (!direction) return false;
    if (*direction == 0) {
      const std::optional<int> side = weight.s.sign();
      if (side && *side < 0) last_upper = -unlimited;  // No t satisfies it.
      return side.has_value();
    }
    const auto [lower, upper] = BoundedQuotients(weight.d).of(-weight.s);
    if (!std::isfinite(lower) || !std::isfinite(upper)) return false;
    if (*direction > 0) {
      if (lower > first_upper) entry = index;
      knows_entry = lower > first_upper || (knows_entry && upper < first_lower);
      first_lower = std::max(first_lower, lower);
      first_upper = std::max(first_upper, upper);
    } else {
      last_lower = std::min(last_lower, lower);
      last_upper = std::min(last_upper, upper);
    }
    return true;
  }

  /// Returns whether the interval contains t, if this is certain.
  [[nodiscard]] std::optional<bool> contains(double t) const {
    if (first_upper <= t && last_lower >= t) return true;
    if (first_lower > t || last_upper < t) return false;
    return std::nullopt;
  }
};

/// Returns whether no weight is negative at an end of the path, if this is certain.
std::optional<bool> are_positive(const std::array<Bounded, 3>& weights) {
  bool are_certain = true;
  for (const Bounded& weight : weights) {
    if (weight.value < -weight.radius) return false;
    are_certain &= weight.value > weight.radius || (weight.value == 0 && weight.radius == 0);
  }
  return are_certain ? std::optional(true) : std::nullopt;
}

/// Returns the weight at t.
Bounded weight_at(double t, const PlaneWeight& weight) { return weight.s + exact(t) * weight.d; }

/// Returns the weight where `entry` is zero, times `entry.d` (PC6).
Bounded weight_at_entry(const PlaneWeight& entry, const PlaneWeight& weight) {
  return &weight == &entry ? exact(0) : weight.s * entry.d - entry.s * weight.d;
}

/// Sets the quotients u and v.
void set_quotients(BoundedContact& result, const Bounded& u, const Bounded& v, const Bounded& denominator) {
  result.u_scaled = u;
  result.v_scaled = v;
  result.by_det = BoundedQuotients(denominator);
}

}  // namespace

template <typename Scalar>
BoundedContact plane_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                             const PathRange<Scalar>& range) {
  const std::optional<Eigen::Index> axis = axis_of_plane(path, triangle);
  if (!axis) return {};
  const Eigen::Index x = (*axis + 1) % 3;
  const Eigen::Index y = (*axis + 2) % 3;
  const auto difference = [&](const Vector3<Scalar>& to, const Vector3<Scalar>& from) -> PlaneVector {
    return {double{to[x]} - double{from[x]}, double{to[y]} - double{from[y]}};
  };
  const PlaneVector d = {direction_of(path.kind, double{path.start[x]}, double{path.toward[x]}),
                         direction_of(path.kind, double{path.start[y]}, double{path.toward[y]})};
  const Bounded normal = cross(difference(triangle.b, triangle.a), difference(triangle.c, triangle.a));
  const std::optional<int> side = normal.sign();
  if (!side || *side == 0 || (d.x == 0 && d.y == 0)) return {};
  // The weights of b, c and a, each by the edge opposite the corner.
  const std::array<const Vector3<Scalar>*, 4> corners = {&triangle.c, &triangle.a, &triangle.b, &triangle.c};
  std::array<PlaneWeight, 3> weights;
  std::array<Bounded, 3> starts;
  std::array<Bounded, 3> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<Scalar>& from = *corners[i];
    const Vector3<Scalar>& to = *corners[i + 1];
    const auto weight_of = [&](const Vector3<Scalar>& point) {
      const auto is_at = [&](const Vector3<Scalar>& corner) { return point[x] == corner[x] && point[y] == corner[y]; };
      return is_at(from) || is_at(to) ? exact(0) : cross(difference(to, from), difference(point, from));  // PC7
    };
    weights[i] = {weight_of(path.start), cross(difference(to, from), d)};
    if (*side < 0) weights[i] = {-weights[i].s, -weights[i].d};
    starts[i] = weights[i].s;
    if (path.has_end()) ends[i] = *side < 0 ? -weight_of(path.toward) : weight_of(path.toward);
  }
  BoundedContact result;
  result.u_scaled.radius = result.v_scaled.radius = unlimited;
  const Bounded size = *side < 0 ? -normal : normal;
  std::optional<bool> at_start = path.has_start() ? are_positive(starts) : false;
  std::optional<bool> at_end = path.has_end() ? are_positive(ends) : false;
  if (path.has_end() && range.first == 0 && range.last == 1) {  // PC8
    bool is_behind = false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (starts[i].sign() != -1) continue;
      const std::optional<int> at_one = ends[i].sign();
      if (at_one == -1 || (at_one == 0 && at_end == false)) {
        result.verdict = Verdict::miss;
        return result;
      }
      is_behind |= at_one == 0;
    }
    const bool is_known = (at_start == true && at_end) || (is_behind && at_end == true);
    if (is_known) {
      const double t = *at_start ? 0 : 1;
      result.verdict = Verdict::hit;
      result.contact = {t, t, Side::edge_on, *at_start, *at_end};
      const std::array<Bounded, 3>& there = *at_start ? starts : ends;
      set_quotients(result, there[0], there[1], size);
      return result;
    }
  }
  PlaneInterval interval;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!interval.add(weights[i], i)) return {};
  }
  const double first = range.first;
  const double last = range.last;
  // PC5
  if (interval.first_lower > std::min(interval.last_upper, last) || interval.last_upper < first) {
    result.verdict = Verdict::miss;
    return result;
  }
  const bool meets = interval.first_upper <= std::min(interval.last_lower, last) && interval.last_lower >= first;
  if (!at_start) at_start = interval.contains(0);
  if (!at_end) at_end = interval.contains(1);
  if (!meets || !at_start || !at_end) return result;
  result.verdict = Verdict::hit;
  result.contact = {std::max(interval.first_lower, first), std::max(interval.first_upper, first), Side::edge_on,
                    *at_start, *at_end};
  if (interval.first_upper <= first) {
    set_quotients(result, weight_at(first, weights[0]), weight_at(first, weights[1]), size);
  } else if (interval.knows_entry && interval.first_lower >= first) {
    const PlaneWeight& entry = weights[interval.entry];
    const Bounded denominator = size * entry.d;
    if (denominator.sign() != 1) return result;  // Its sign must be certain.
    set_quotients(result, weight_at_entry(entry, weights[0]), weight_at_entry(entry, weights[1]), denominator);  // PC6
  }
  return result;
}

template BoundedContact plane_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact plane_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);

}  // namespace surehit::detail
