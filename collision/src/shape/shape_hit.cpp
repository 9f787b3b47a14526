#include "surehit/shape_hit.hpp"

#include <algorithm>
#include <type_traits>

#include "path_range.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/contact_normal.hpp"
#include "shape/shape_narrowphase.hpp"
#include "shape/sphere_contact.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/intersect.hpp"

namespace surehit {
namespace {

template <typename Shape, typename Scalar>
std::optional<ShapeHit<Scalar>> intersect_shape(const Shape& shape, const Triangle<Scalar>& triangle,
                                                const ShapeQueryOptions<Scalar>& options) {
  if (!detail::is_valid(shape) || !detail::is_finite(triangle) || !(options.max_t >= 0)) return std::nullopt;
  QueryStatistics statistics;
  const detail::ShapeNarrowphase<Shape> narrowphase(shape, options, statistics);
  detail::ShapeCandidate<Shape> candidate{0, triangle, {}};
  if (!narrowphase.find_contact(triangle, 1, candidate.contact)) return std::nullopt;
  return narrowphase.hit(candidate);
}

/// Returns a + u (b - a) + v (c - a) on one axis. In double, a float has no roundings that count. Rounded weights may
/// have a sum above 1, so the result is kept between the corners.
///
/// N3. In double, it is off by less than 4 ulp of the largest of the three numbers.
/// Proof. Let this number be in [1, 2), as a power of two changes no rounding. A rounding below 4 is off by at most an
///     ulp, one below 2 by half an ulp, and one below 1 by a quarter. The differences count as their weights do: 1 ulp.
///     The sum of the products is below 4: 1 ulp. The last sum is kept below 2: half an ulp. The products are below 4
///     together. If one reaches 2 and the other is below 1, they are off by 1.25 ulp, and 1 ulp if neither reaches 2.
///     If the other reaches 1, they are off by 1.5 ulp, but a difference reaches 3. Then |a| reaches 1, so the last sum
///     is one of whole ulps, and exact. In all cases, that is 3.75 ulp at most. Below 2^-1021, sums that stay
///     below it are exact, and a product below 2^-1022 is off by half an ulp: that is 3.5 ulp at most. What a quarter
///     of a denormal loses is nothing beside 2^1020.
template <typename Scalar>
Scalar weighted(Scalar a, Scalar b, Scalar c, const ShapeHit<Scalar>& hit) {
  const auto [low, high] = std::minmax({double{a}, double{b}, double{c}});
  // A quarter of large numbers keeps differences from overflowing. Elsewhere it would round denormals.
  const double share = std::is_same_v<Scalar, double> && std::max(-low, high) > 0x1p1020 ? 0.25 : 1;
  const double first = share * a;
  const double sum = (first + (hit.u * (share * b - first) + hit.v * (share * c - first))) / share;
  return static_cast<Scalar>(std::clamp(sum, low, high));
}

}  // namespace

template <FloatOrDouble Scalar>
Vector3<Scalar> contact_point(const Triangle<Scalar>& triangle, const ShapeHit<Scalar>& hit) noexcept {
  const FloatingPointEnvironment environment;
  const auto& [a, b, c] = triangle;
  return {weighted(a[0], b[0], c[0], hit), weighted(a[1], b[1], c[1], hit), weighted(a[2], b[2], c[2], hit)};
}

template <FloatOrDouble Scalar>
Vector3<Scalar> contact_normal(const std::type_identity_t<SweptShape<Scalar>>& shape,
                               const Triangle<Scalar>& triangle) noexcept {
  const FloatingPointEnvironment environment;
  if (!detail::is_finite(triangle)) return Vector3<Scalar>::Zero();
  return std::visit([&](const auto& any) { return detail::normal_of_contact(any, triangle); }, shape);
}

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> intersect(const std::type_identity_t<SweptShape<Scalar>>& shape,
                                          const Triangle<Scalar>& triangle,
                                          const std::type_identity_t<ShapeQueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  return std::visit([&](const auto& any) { return intersect_shape(any, triangle, options); }, shape);
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                  \
  template SUREHIT_API Vector3<Scalar> contact_point(const Triangle<Scalar>&, const ShapeHit<Scalar>&) noexcept;     \
  template SUREHIT_API Vector3<Scalar> contact_normal(const SweptShape<Scalar>&, const Triangle<Scalar>&) noexcept;  \
  template SUREHIT_API std::optional<ShapeHit<Scalar>> intersect(const SweptShape<Scalar>&, const Triangle<Scalar>&, \
                                                                 const ShapeQueryOptions<Scalar>&) noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
