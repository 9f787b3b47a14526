#include <variant>

#include "exact/placed_point.hpp"
#include "scene/committed_scene.hpp"
#include "scene/instance_triangle.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/contact_normal.hpp"
#include "shape/sphere_contact.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/scene_queries.hpp"

// Where shapes touch the triangles of a scene, and in which direction.

namespace surehit {
namespace {

/// Returns what `use(triangle)` returns for the placed triangle of a hit, or zero if there is none.
template <typename Scalar, typename Use>
Vector3<Scalar> of_touched_triangle(const detail::CommittedScene<Scalar>& scene, const SceneShapeHit<Scalar>& hit,
                                    const Use& use) {
  const detail::CommittedInstance<Scalar>* const instance = detail::instance_of(scene, hit);
  if (instance == nullptr) return Vector3<Scalar>::Zero();
  return detail::use_triangle(instance->mesh, instance->placed.placement, hit.triangle, use);
}

}  // namespace

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::contact_point(const SceneShapeHit<Scalar>& hit) const noexcept {
  const FloatingPointEnvironment environment;
  const auto is_share = [](Scalar x) { return x >= 0 && x <= 1; };
  if (!is_share(hit.t) || !is_share(hit.u) || !is_share(hit.v)) return Vector3<Scalar>::Zero();
  return of_touched_triangle(committed(), hit, [&](const detail::PlacedTriangle<Scalar>& triangle) {
    return detail::exact_placed_point(triangle, hit.t, hit.u, hit.v);
  });
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::contact_normal(const SweptShape<Scalar>& shape,
                                                     const SceneShapeHit<Scalar>& hit) const noexcept {
  return of_touched_triangle(committed(), hit, [&](const detail::PlacedTriangle<Scalar>& triangle) {
    return std::visit([&](const auto& any) { return detail::normal_of_contact(any, triangle); }, shape);
  });
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                          \
  template Vector3<Scalar> SceneQueries<Scalar>::contact_point(const SceneShapeHit<Scalar>&) const noexcept; \
  template Vector3<Scalar> SceneQueries<Scalar>::contact_normal(const SweptShape<Scalar>&,                   \
                                                                const SceneShapeHit<Scalar>&) const noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
