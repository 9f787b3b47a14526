#include "surehit/shape_hit.hpp"

#include "path_range.hpp"
#include "shape/sphere_narrowphase.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/intersect.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> intersect(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                          const std::type_identity_t<ShapeQueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  if (!detail::is_valid(sphere) || !detail::is_finite(triangle) || !(options.max_t >= 0)) return std::nullopt;
  QueryStatistics statistics;
  const detail::SphereNarrowphase<Scalar> narrowphase(sphere, options, statistics);
  detail::SphereCandidate<Scalar> candidate{0, triangle, {}};
  if (!narrowphase.find_contact(triangle, 1, candidate.contact)) return std::nullopt;
  return narrowphase.hit(candidate);
}

template SUREHIT_API std::optional<ShapeHit<float>> intersect(const SweptSphere<float>&, const Triangle<float>&,
                                                              const ShapeQueryOptions<float>&) noexcept;
template SUREHIT_API std::optional<ShapeHit<double>> intersect(const SweptSphere<double>&, const Triangle<double>&,
                                                               const ShapeQueryOptions<double>&) noexcept;

}  // namespace surehit
