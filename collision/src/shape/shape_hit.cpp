#include "surehit/shape_hit.hpp"

#include "path_range.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
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

}  // namespace

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> intersect(const std::type_identity_t<SweptShape<Scalar>>& shape,
                                          const Triangle<Scalar>& triangle,
                                          const std::type_identity_t<ShapeQueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  return std::visit([&](const auto& any) { return intersect_shape(any, triangle, options); }, shape);
}

template SUREHIT_API std::optional<ShapeHit<float>> intersect(const SweptShape<float>&, const Triangle<float>&,
                                                              const ShapeQueryOptions<float>&) noexcept;
template SUREHIT_API std::optional<ShapeHit<double>> intersect(const SweptShape<double>&, const Triangle<double>&,
                                                               const ShapeQueryOptions<double>&) noexcept;

}  // namespace surehit
