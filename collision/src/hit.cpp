#include "surehit/hit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/exact_contact.hpp"
#include "path_range.hpp"
#include "support/exact_difference.hpp"
#include "support/floating_point_environment.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"
#include "unit_of_cross.hpp"
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

/// Returns |t| |D|. In double, nothing overflows or underflows for floats, and its roundings are far below those of
/// float.
float scaled_distance(const Path<float>& path, float t) {
  double sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double way = detail::direction_of(path.kind, double{path.start[axis]}, double{path.toward[axis]});
    sum += way * way;
  }
  return static_cast<float>(std::fabs(double{t}) * std::sqrt(sum));
}

/// Returns |t| |D| for a finite path and t. There is no wider type that all machines have, so that a pair of doubles
/// holds D, its square, and its length. D is scaled until its largest component is in [1, 2), and t has its exponent
/// taken out. So neither overflows.
///
/// Let eps be 2^-53. The pair of the square is off by less than 64 eps^2 of it, and that of the length by less than 64
/// eps^2 of it too. The result is one sum, rounded once, so it is off by eps (1 + 2^-40). A denormal result is rounded
/// once more.
double scaled_distance(const Path<double>& path, double t) {
  bool overflows = false;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    overflows |= !std::isfinite(detail::direction_of(path.kind, path.start[axis], path.toward[axis]));
  }
  const double half = overflows ? 0.5 : 1;
  std::array<detail::DoublePair, 3> d;
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    d[axis] = detail::exact_difference(half * path.toward[i], path.has_end() ? half * path.start[i] : 0);
    largest = std::max(largest, std::fabs(d[axis][0]));
  }
  if (largest == 0 || t == 0) return 0;
  const int exponent = std::ilogb(largest);
  detail::DoublePair sum = {0, 0};
  for (const auto& [high, low] : d) {
    const double way = std::ldexp(high, -exponent);
    const double square = way * way;
    const double rest = std::fma(way, way, -square) + 2 * way * std::ldexp(low, -exponent);
    const auto [more, error] = detail::exact_difference(sum[0], -square);
    sum = {more, sum[1] + (error + rest)};
  }
  const double root = std::sqrt(sum[0]);
  const double root_rest = (std::fma(-root, root, sum[0]) + sum[1]) / (2 * root);
  int t_exponent = 0;
  const double factor = std::frexp(std::fabs(t), &t_exponent);
  const double product = root * factor;
  const double length = product + (std::fma(root, factor, -product) + root_rest * factor);
  return std::ldexp(length, exponent + t_exponent + (overflows ? 1 : 0));
}

/// Returns |t| |D|, or NaN or infinity if D or t is not finite.
template <typename Scalar>
SUREHIT_NOINLINE Scalar distance_of(const Path<Scalar>& path, Scalar t) {
  const bool are_finite =
      detail::is_finite(path.toward) && (!path.has_end() || detail::is_finite(path.start)) && std::isfinite(t);
  if (are_finite) return scaled_distance(path, t);
  Scalar sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    sum += std::fabs(detail::direction_of(path.kind, path.start[axis], path.toward[axis]));
  }
  return std::fabs(t) * sum;
}

}  // namespace

// Let eps = 2^-53 be the unit roundoff of double, and let n be a component of the exact unit normal.
//
// Each component of the cross product is rounded once, so it is off by eps of itself. This turns the vector, and moves
// n by at most 2 n (1 - n^2) eps. The sum of squares has three roundings, which are 1.5 eps of the length. The root and
// the quotient have one rounding each. To first order, that is (2 n (1 - n^2) + 3.5 n) eps, at most 3.6 eps for n up to
// 1. So a double is off by less than 4 eps = 2 ulp(1). For float, one more rounding adds at most ulp(1) / 2 of float.
template <typename Scalar>
Vector3<Scalar> detail::unit_of_cross(const Vector3<double>& cross) {
  const double length = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
  if (length == 0) return Vector3<Scalar>::Zero();
  return {static_cast<Scalar>(cross[0] / length), static_cast<Scalar>(cross[1] / length),
          static_cast<Scalar>(cross[2] / length)};
}

template Vector3<float> detail::unit_of_cross<float>(const Vector3<double>&);
template Vector3<double> detail::unit_of_cross<double>(const Vector3<double>&);

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
  return detail::unit_of_cross<Scalar>(detail::exact_cross(triangle));
}

#define SUREHIT_INSTANTIATE(Scalar)                                                             \
  template SUREHIT_API Vector3<Scalar> point(const Path<Scalar>&, const Hit<Scalar>&) noexcept; \
  template SUREHIT_API Scalar distance(const Path<Scalar>&, const Hit<Scalar>&) noexcept;       \
  template SUREHIT_API Vector3<Scalar> normal(const Triangle<Scalar>&) noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
