#include "surehit/hit.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "exact/exact_contact.hpp"
#include "query/path_range.hpp"
#include "support/floating_point_environment.hpp"
#include "walk/direction.hpp"

namespace surehit {
namespace {

/// Returns the point at t, rounded once, or NaN if the path or t is not finite.
template <typename Scalar>
Vector3<Scalar> point_of(const Path<Scalar>& path, Scalar t) {
  const FloatingPointEnvironment environment;
  if (!detail::is_finite(path) || !std::isfinite(t)) {
    return Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN());
  }
  return detail::exact_point(path, t);
}

/// Returns |t| |D|, computed in a wider type. In that type nothing overflows or underflows. All of its roundings
/// together are less than one rounding of Scalar.
template <typename Scalar>
[[gnu::noinline]] Scalar distance_of(const Path<Scalar>& path, Scalar t) {
  using Wide = std::conditional_t<std::is_same_v<Scalar, float>, double, long double>;
  Wide sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Wide way = detail::direction_of(path.kind, Wide{path.start[axis]}, Wide{path.toward[axis]});
    sum += way * way;
  }
  return static_cast<Scalar>(std::fabs(Wide{t}) * std::sqrt(sum));
}

// Let eps = 2^-53 be the unit roundoff of double, and let n be a component of the exact unit normal.
//
// Each component of the cross product is rounded once, so it is off by eps of itself. This turns the vector, and moves
// n by at most 2 n (1 - n^2) eps. The sum of squares has three roundings, which are 1.5 eps of the length. The root and
// the quotient have one rounding each. To first order, that is (2 n (1 - n^2) + 3.5 n) eps, at most 3.6 eps for n up to
// 1. So a double is off by less than 4 eps = 2 ulp(1). For float, one more rounding adds at most ulp(1) / 2 of float.
template <typename Scalar>
[[gnu::noinline]] Vector3<Scalar> unit_normal(const Triangle<Scalar>& triangle) {
  const Vector3<double> cross = detail::exact_cross(triangle);
  const double length = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
  if (length == 0) return Vector3<Scalar>::Zero();
  return {static_cast<Scalar>(cross[0] / length), static_cast<Scalar>(cross[1] / length),
          static_cast<Scalar>(cross[2] / length)};
}

}  // namespace

template <FloatOrDouble Scalar>
Vector3<Scalar> point(const std::type_identity_t<Path<Scalar>>& path, const Hit<Scalar>& hit) noexcept {
  return point_of<Scalar>(path, hit.t);
}

template <FloatOrDouble Scalar>
Scalar distance(const std::type_identity_t<Path<Scalar>>& path, const Hit<Scalar>& hit) noexcept {
  const FloatingPointEnvironment environment;
  return distance_of<Scalar>(path, hit.t);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> normal(const Triangle<Scalar>& triangle) noexcept {
  const FloatingPointEnvironment environment;
  return unit_normal(triangle);
}

#define SUREHIT_INSTANTIATE(Scalar)                                                             \
  template SUREHIT_API Vector3<Scalar> point(const Path<Scalar>&, const Hit<Scalar>&) noexcept; \
  template SUREHIT_API Scalar distance(const Path<Scalar>&, const Hit<Scalar>&) noexcept;       \
  template SUREHIT_API Vector3<Scalar> normal(const Triangle<Scalar>&) noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
