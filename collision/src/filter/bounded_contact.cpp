#include "filter/bounded_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter/double_kernel-inl.hpp"
#include "filter/kernel_bound.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using BoundedVector = std::array<Bounded, 3>;

template <typename Scalar>
BoundedVector difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {exact(x[0]) - exact(y[0]), exact(x[1]) - exact(y[1]), exact(x[2]) - exact(y[2])};
}

BoundedVector cross(const BoundedVector& x, const BoundedVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Bounded dot(const BoundedVector& x, const BoundedVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// The vectors of a pair.
struct PairVectors {
  BoundedVector s, d, e1, e2;
};

template <typename Scalar>
BoundedVector direction_of_path(const Path<Scalar>& path) {
  return path.has_end() ? difference<Scalar>(path.toward, path.start)
                        : BoundedVector{exact(path.toward[0]), exact(path.toward[1]), exact(path.toward[2])};
}

template <typename Scalar>
PairVectors vectors_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  return {difference<Scalar>(path.start, triangle.a), direction_of_path(path),
          difference<Scalar>(triangle.b, triangle.a), difference<Scalar>(triangle.c, triangle.a)};
}

/// Returns the vectors of a placed triangle, with the path as the instance sees it.
template <typename Scalar>
PairVectors vectors_of(const Path<Scalar>& path, const PlacedTriangle<Scalar>& triangle) {
  const Triangle<Scalar>& local = triangle.local;
  const Placement<Scalar>& placement = triangle.placement;
  const auto image = [&](const BoundedVector& x) {
    BoundedVector y;
    for (std::size_t row = 0; row < 3; ++row) {
      const auto entry = [&](Eigen::Index column) {
        return exact(placement.pose.linear(static_cast<Eigen::Index>(row), column));
      };
      y[row] = entry(0) * x[0] + entry(1) * x[1] + entry(2) * x[2];
    }
    return y;
  };
  const BoundedVector from_origin = difference<Scalar>(path.start, placement.pose.translation);
  const BoundedVector corner = image({exact(local.a[0]), exact(local.a[1]), exact(local.a[2])});
  PairVectors vectors{from_origin, direction_of_path(path), image(difference<Scalar>(local.b, local.a)),
                      image(difference<Scalar>(local.c, local.a))};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    vectors.s[axis] = from_origin[axis] - corner[axis];
    if (!placement.moves || !path.has_end()) continue;
    vectors.d[axis] =
        vectors.d[axis] - exact(triangle.share) * exact(placement.motion[static_cast<Eigen::Index>(axis)]);
  }
  return vectors;
}

/// The determinants. The signs of the last five decide.
struct Determinants {
  Bounded det;
  Bounded height;
  Bounded u;
  Bounded v;
  Bounded w;
  Bounded above_first;  ///< The lower end of the range: T - first det.
  Bounded below_last;   ///< The upper end of the range: last det - T.
};

/// Returns the verdict, and the contact of a hit. The five numbers are U, V, W and the two ends of the range.
///
/// BN5. The pair is a miss if two of the five numbers have certain and opposite signs. This holds for any det.
/// Proof. At a hit, K1 gives u det, v det, w det, (t - first) det and (last - t) det. No factor of det is negative.
///
/// BN6. The pair is a hit if all five signs and that of det are certain, det is not zero, and BN5 does not hold.
/// Proof. U, V and W sum to det, so one of them has the sign of det. Without BN5, all five have this sign or are zero.
///     So U / det, V / det and W / det are not negative, and T / det is in the range.
template <typename Scalar>
BoundedContact decide(const Determinants& of, const Path<Scalar>& path, const PathRange<Scalar>& range) {
  BoundedContact result;
  result.u_scaled = of.u;
  result.v_scaled = of.v;
  bool any_positive = false;
  bool any_negative = false;
  bool all_certain = true;
  const auto classify = [&](const Bounded& x) {
    any_positive |= x.value > x.radius;
    any_negative |= x.value < -x.radius;
    all_certain &= x.value > x.radius || x.value < -x.radius || (x.value == 0 && x.radius == 0);
  };
  classify(of.u);
  classify(of.v);
  classify(of.w);
  const bool has_first = range.first > -PathRange<Scalar>::infinity;
  const bool has_last = range.last < PathRange<Scalar>::infinity;
  if (has_first) classify(of.above_first);
  if (has_last) classify(of.below_last);
  if (any_positive && any_negative) {  // BN5
    result.verdict = Verdict::miss;
    return result;
  }
  const bool front = of.det.value > of.det.radius;
  const bool back = of.det.value < -of.det.radius;
  if (!all_certain || !(front || back)) return result;  // Otherwise it is a hit by BN6.
  result.by_det = BoundedQuotients(of.det);
  const auto [lower, upper] = result.by_det.of(of.height);
  if (!std::isfinite(lower) || !std::isfinite(upper)) return result;
  // All signs are certain here, so a value of 0 is exact.
  const auto vanishes = [](const Bounded& x) { return x.value == 0; };
  result.verdict = Verdict::hit;
  result.contact.t_lower = lower;
  result.contact.t_upper = upper;
  result.contact.side = front ? Side::front : Side::back;
  result.contact.at_start = path.has_start() && range.first == 0 && vanishes(of.above_first);
  result.contact.at_end = path.has_end() && range.last == 1 && vanishes(of.below_last);
  return result;
}

/// A vector of one lane, since these stages have one pair at a time.
using OneLane = hn::CappedTag<double, 1>;
using OneVector = HWY_NAMESPACE::Vectors<OneLane>;

template <typename Scalar>
OneVector lane_of(const Vector3<Scalar>& x) {
  const OneLane d;
  return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
}

}  // namespace

template <typename Scalar>
BoundedContact double_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                              const PathRange<Scalar>& range) {
  const double first = range.first > -PathRange<Scalar>::infinity ? double{range.first} : 0;
  const double last = range.last < PathRange<Scalar>::infinity ? double{range.last} : 0;
  if (!(std::max(std::fabs(first), std::fabs(last)) <= KernelBound<double>::largest_limit)) return {};
  const OneLane d;
  const OneVector start = lane_of<Scalar>(path.start);
  const OneVector direction = HWY_NAMESPACE::directions_of<OneLane>(path.kind, start, lane_of<Scalar>(path.toward));
  const HWY_NAMESPACE::DoubleDeterminants<OneLane> of(d, start, direction, lane_of<Scalar>(triangle.a),
                                                      lane_of<Scalar>(triangle.b), lane_of<Scalar>(triangle.c));
  const auto number = [](auto lane) { return hn::GetLane(lane); };
  const auto bounded = [&](double value, double sizes) { return Bounded{value, number(of.radius(hn::Set(d, sizes)))}; };
  const double det = number(of.det), height = number(of.height), u = number(of.u), v = number(of.v);
  const double det_size = number(of.det_size), height_size = number(of.height_size);
  const double u_size = number(of.u_size), v_size = number(of.v_size);
  return decide({bounded(det, det_size), bounded(height, height_size), bounded(u, u_size), bounded(v, v_size),
                 bounded(det - u - v, det_size + u_size + v_size),
                 bounded(height - first * det, height_size + std::fabs(first) * det_size),
                 bounded(last * det - height, height_size + std::fabs(last) * det_size)},
                path, range);
}

template <typename Scalar, typename AnyTriangle>
BoundedContact bounded_contact(const Path<Scalar>& path, const AnyTriangle& triangle, const PathRange<Scalar>& range) {
  const auto [s, d, e1, e2] = vectors_of(path, triangle);
  const BoundedVector p = cross(d, e2);
  const BoundedVector q = cross(s, e1);

  Determinants of;
  of.det = dot(e1, p);
  of.height = dot(e2, q);
  of.u = dot(s, p);
  of.v = dot(d, q);
  of.w = of.det - of.u - of.v;
  if (range.first > -PathRange<Scalar>::infinity) of.above_first = of.height - exact(range.first) * of.det;
  if (range.last < PathRange<Scalar>::infinity) of.below_last = exact(range.last) * of.det - of.height;
  return decide(of, path, range);
}

BoundedQuotients::BoundedQuotients(const Bounded& denominator) {
  const OneLane d;
  const auto by =
      HWY_NAMESPACE::Quotients<OneLane>::by(d, hn::Set(d, denominator.value), hn::Set(d, denominator.radius));
  inverse_ = hn::GetLane(by.inverse);
  radius_ = denominator.radius;
  max_inverse_ = hn::GetLane(by.max_inverse);
}

std::array<double, 2> BoundedQuotients::of(const Bounded& numerator) const {
  if (numerator.value == 0 && numerator.radius == 0) return {0, 0};
  const OneLane d;
  const HWY_NAMESPACE::Quotients<OneLane> by{hn::Set(d, inverse_), hn::Set(d, radius_), hn::Set(d, max_inverse_)};
  const auto interval = by.of(hn::Set(d, numerator.value), hn::Set(d, numerator.radius));
  return {hn::GetLane(interval.lower), hn::GetLane(interval.upper)};
}

template BoundedContact double_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact double_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);
template BoundedContact bounded_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact bounded_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);
template BoundedContact bounded_contact(const Path<float>&, const PlacedTriangle<float>&, const PathRange<float>&);
template BoundedContact bounded_contact(const Path<double>&, const PlacedTriangle<double>&, const PathRange<double>&);

}  // namespace surehit::detail
