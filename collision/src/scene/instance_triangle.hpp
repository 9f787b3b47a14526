#pragma once

#include <cstddef>
#include <cstdint>

#include "collider_state.hpp"
#include "exact/exact_contact.hpp"
#include "placement.hpp"
#include "scene/committed_scene.hpp"
#include "support/floating_point_environment.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/triangle.hpp"
#include "unit_of_cross.hpp"

namespace surehit::detail {

/// Returns the number of triangles of a mesh.
template <typename Scalar>
[[nodiscard]] std::size_t triangle_count(const InstanceMesh<Scalar>& mesh) noexcept {
  return mesh.own != nullptr ? mesh.own->mesh.triangle_count() : mesh.floats->mesh.triangle_count();
}

/// Returns the instance that has the triangle of a hit, or null if none has. The hit may be of any instance, committed
/// or not, because a caller in another language may bring any.
template <typename Scalar>
[[nodiscard]] const CommittedInstance<Scalar>* instance_of(const CommittedScene<Scalar>& scene,
                                                           const SceneShapeHit<Scalar>& hit) noexcept {
  const CommittedInstance<Scalar>* const instance = scene.find(hit.instance);
  return instance != nullptr && hit.triangle < triangle_count(instance->mesh) ? instance : nullptr;
}

/// Calls `use(triangle)` for a triangle of a mesh that is placed there.
template <typename Scalar, typename Use>
auto use_triangle(const InstanceMesh<Scalar>& mesh, const Placement<Scalar>& placement, std::uint32_t triangle,
                  const Use& use) {
  const FloatingPointEnvironment environment;
  const auto placed = [&](const auto& local) {
    return use(PlacedTriangle<Scalar>{
        {local.a.template cast<Scalar>(), local.b.template cast<Scalar>(), local.c.template cast<Scalar>()},
        placement});
  };
  return mesh.own != nullptr ? placed(mesh.own->mesh.triangle(triangle)) : placed(mesh.floats->mesh.triangle(triangle));
}

/// Returns the corners of a placed triangle, each coordinate rounded once.
template <typename Scalar>
[[nodiscard]] Triangle<Scalar> placed_corners(const InstanceMesh<Scalar>& mesh, const Placement<Scalar>& placement,
                                              std::uint32_t triangle) noexcept {
  return use_triangle(mesh, placement, triangle,
                      [](const auto& placed) -> Triangle<Scalar> { return exact_corners(placed); });
}

/// Returns the unit normal of a placed triangle.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> placed_normal(const InstanceMesh<Scalar>& mesh, const Placement<Scalar>& placement,
                                            std::uint32_t triangle) noexcept {
  return use_triangle(mesh, placement, triangle,
                      [](const auto& placed) -> Vector3<Scalar> { return unit_of_cross<Scalar>(exact_cross(placed)); });
}

}  // namespace surehit::detail
