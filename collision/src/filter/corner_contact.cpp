#include "filter/corner_contact.hpp"

#include <cmath>
#include <optional>

#include "filter/bounded.hpp"
#include "filter/double_kernel-inl.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of one lane, since this stage has one pair at a time.
using CornerLane = hn::CappedTag<double, 1>;
using CornerVector = HWY_NAMESPACE::Vectors<CornerLane>;

template <typename Scalar>
CornerVector in_corner_lane(const Vector3<Scalar>& x) {
  const CornerLane d;
  return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
}

/// The corners of a triangle.
enum class Corner { a, b, c };

/// Returns the corner at a point, if there is one.
template <typename Scalar>
std::optional<Corner> corner_at(const Vector3<Scalar>& point, const Triangle<Scalar>& triangle) {
  const auto is_at = [&](const Vector3<Scalar>& corner) {
    return point[0] == corner[0] && point[1] == corner[1] && point[2] == corner[2];
  };
  if (is_at(triangle.a)) return Corner::a;
  if (is_at(triangle.b)) return Corner::b;
  if (is_at(triangle.c)) return Corner::c;
  return std::nullopt;
}

/// Returns the sign of det, or 0 if it is not certain (K4 in kernel_bound.hpp).
template <typename Scalar>
int sign_of_det(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  const CornerLane d;
  const CornerVector start = in_corner_lane<Scalar>(path.start);
  const CornerVector direction =
      HWY_NAMESPACE::directions_of<CornerLane>(path.kind, start, in_corner_lane<Scalar>(path.toward));
  const HWY_NAMESPACE::DoubleDeterminants<CornerLane> of(d, start, direction, in_corner_lane<Scalar>(triangle.a),
                                                         in_corner_lane<Scalar>(triangle.b),
                                                         in_corner_lane<Scalar>(triangle.c));
  const double det = hn::GetLane(of.det);
  const double radius = hn::GetLane(of.radius(of.det_size));
  return det > radius ? 1 : det < -radius ? -1 : 0;
}

/// Returns true if the corners are certain not to be on one line: their normal is not zero on some axis.
template <typename Scalar>
bool spans_plane(const Triangle<Scalar>& triangle) {
  const auto difference = [&](const Vector3<Scalar>& to, Eigen::Index axis) {
    return exact(to[axis]) - exact(triangle.a[axis]);
  };
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Index x = (axis + 1) % 3;
    const Eigen::Index y = (axis + 2) % 3;
    const Bounded normal =
        difference(triangle.b, x) * difference(triangle.c, y) - difference(triangle.b, y) * difference(triangle.c, x);
    if (std::fabs(normal.value) > normal.radius) return true;
  }
  return false;
}

/// Returns a contact at a corner.
template <typename Scalar>
CornerContact<Scalar> contact_at(Corner corner, double t, Side side) {
  CornerContact<Scalar> result;
  result.verdict = Verdict::hit;
  result.contact.t_lower = result.contact.t_upper = t;
  result.contact.side = side;
  result.u = corner == Corner::b ? Scalar{1} : Scalar{0};
  result.v = corner == Corner::c ? Scalar{1} : Scalar{0};
  return result;
}

}  // namespace

// CC1. Let det be certain not to be zero, and let the start or the end of the path be a corner. Then the path's line
//     crosses the triangle's plane there and nowhere else, at t = 0 or t = 1. The pair is a hit if the range has this
//     t, with the weights of the corner, and a miss otherwise.
// Proof. The corner is in the plane, and the line has one point in the plane because det is not zero.
//
// CC2. Let both ends of a segment be corners, at two points, and let the triangle span a plane. Then det is exactly
//     zero, and the triangle contains the segment. If the range begins at 0, the first contact is at t = 0.
// Proof. The direction is an edge or its opposite, so it is perpendicular to the normal. The triangle is convex.
//
// CC3. If the triangle spans a plane, the weights of a corner are unique: one is 1, and the others are 0.
template <typename Scalar>
CornerContact<Scalar> corner_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                     const PathRange<Scalar>& range) {
  const std::optional<Corner> at_start = corner_at<Scalar>(path.start, triangle);
  const std::optional<Corner> at_end = path.has_end() ? corner_at<Scalar>(path.toward, triangle) : std::nullopt;
  if (!at_start && !at_end) return {};
  if (at_start && at_end) {
    if (*at_start == *at_end || range.first != 0 || range.last < 0 || !spans_plane(triangle)) return {};
    CornerContact<Scalar> result = contact_at<Scalar>(*at_start, 0, Side::edge_on);  // CC2
    result.contact.at_start = result.contact.at_end = true;
    return result;
  }
  const int sign = sign_of_det(path, triangle);
  if (sign == 0) return {};
  // CC1
  const Scalar t = at_start ? Scalar{0} : Scalar{1};
  CornerContact<Scalar> result =
      contact_at<Scalar>(at_start ? *at_start : *at_end, double{t}, sign > 0 ? Side::front : Side::back);
  if (t < range.first || t > range.last) result.verdict = Verdict::miss;
  result.contact.at_start = at_start && path.has_start();
  result.contact.at_end = at_end.has_value();
  return result;
}

template CornerContact<float> corner_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template CornerContact<double> corner_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);

}  // namespace surehit::detail
