#include "surehit/hit.hpp"

#include <cmath>
#include <limits>

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

template <typename Scalar>
Vector3<Scalar> point(const Segment<Scalar>& segment, const Hit<Scalar>& hit) noexcept {
  return point_of<Scalar>(segment, hit.t);
}

template <typename Scalar>
Vector3<Scalar> point(const Ray<Scalar>& ray, const Hit<Scalar>& hit) noexcept {
  return point_of<Scalar>(ray, hit.t);
}

template <typename Scalar>
Vector3<Scalar> point(const Line<Scalar>& line, const Hit<Scalar>& hit) noexcept {
  return point_of<Scalar>(line, hit.t);
}

template <typename Scalar>
Vector3<Scalar> normal(const TriangleMeshView<Scalar>& mesh, std::uint32_t triangle) noexcept {
  const FloatingPointEnvironment environment;
  return unit_normal(mesh.triangle(triangle));
}

#define SUREHIT_INSTANTIATE(Scalar)                                                    \
  template Vector3<Scalar> point(const Segment<Scalar>&, const Hit<Scalar>&) noexcept; \
  template Vector3<Scalar> point(const Ray<Scalar>&, const Hit<Scalar>&) noexcept;     \
  template Vector3<Scalar> point(const Line<Scalar>&, const Hit<Scalar>&) noexcept;    \
  template Vector3<Scalar> normal(const TriangleMeshView<Scalar>&, std::uint32_t) noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
