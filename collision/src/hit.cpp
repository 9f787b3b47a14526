#include "surehit/hit.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "exact/exact_contact.hpp"
#include "query/path_range.hpp"
#include "support/floating_point_environment.hpp"

namespace surehit {
namespace {

template <typename Scalar>
Vector3<Scalar> point_of(const Path<Scalar>& path, Scalar t) {
  const FloatingPointEnvironment environment;
  if (!detail::is_finite(path) || !std::isfinite(t)) {
    return Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN());
  }
  return detail::exact_point(path, t);
}

/// In a wider type: there is neither overflow nor underflow, and its own roundings come to less than one of Scalar.
template <typename Scalar>
[[gnu::noinline]] Scalar distance_of(const Path<Scalar>& path, Scalar t) {
  using Wide = std::conditional_t<std::is_same_v<Scalar, float>, double, long double>;
  Wide sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Wide way = path.has_end() ? Wide{path.toward[axis]} - Wide{path.start[axis]} : Wide{path.toward[axis]};
    sum += way * way;
  }
  return static_cast<Scalar>(std::fabs(Wide{t}) * std::sqrt(sum));
}

// The cross product arrives with its largest component in [1/2, 1) and each component within half an ulp of double. The
// sum of squares, the root and the quotients add a few roundings of 2^-53 each, and the last one is to Scalar: in all
// below 2^-50 + ulp(1)/2, and for double below 8 roundings of 2^-53 of a component that is at most 1: 2 ulp(1).
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
