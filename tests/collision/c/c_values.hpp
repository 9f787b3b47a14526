#pragma once

#include <cstdint>

#include "c_functions.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

template <typename Scalar>
typename CFunctions<Scalar>::Vector in_c(const Vector3<Scalar>& x) {
  return {x[0], x[1], x[2]};
}

template <typename Scalar>
typename CFunctions<Scalar>::Path in_c(const Path<Scalar>& path) {
  return {in_c(path.start), in_c(path.toward), static_cast<std::uint32_t>(path.kind)};
}

template <typename Scalar>
typename CFunctions<Scalar>::Triangle in_c(const Triangle<Scalar>& triangle) {
  return {in_c(triangle.a), in_c(triangle.b), in_c(triangle.c)};
}

template <typename Scalar>
typename CFunctions<Scalar>::Hit in_c(const Hit<Scalar>& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<std::uint8_t>(hit.side)};
}

template <typename Scalar>
typename CFunctions<Scalar>::SceneHit in_c(const SceneHit<Scalar>& hit) {
  return {hit.t,
          hit.u,
          hit.v,
          hit.triangle,
          static_cast<std::uint8_t>(hit.side),
          {hit.instance.index, hit.instance.generation}};
}

template <typename Scalar>
typename CFunctions<Scalar>::Shape in_c(const SweptSphere<Scalar>& sphere) {
  return {in_c(sphere.start), in_c(sphere.end), {}, sphere.radius, SUREHIT_SWEPT_SPHERE};
}

template <typename Scalar>
typename CFunctions<Scalar>::Shape in_c(const SweptBox<Scalar>& box) {
  return {in_c(box.start), in_c(box.end), in_c(box.half_extents), 0, SUREHIT_SWEPT_BOX};
}

template <typename Scalar>
typename CFunctions<Scalar>::Shape in_c(const SweptCapsule<Scalar>& capsule) {
  return {in_c(capsule.start), in_c(capsule.end), in_c(capsule.half_axis), capsule.radius, SUREHIT_SWEPT_CAPSULE};
}

template <typename Scalar>
typename CFunctions<Scalar>::ShapeOptions in_c(const ShapeQueryOptions<Scalar>& options) {
  auto given = CFunctions<Scalar>::default_shape_options();
  given.max_t = options.max_t;
  given.culling = static_cast<std::uint8_t>(options.culling);
  given.mask = options.mask;
  given.ignored_triangle = options.ignored_triangle;
  given.ignore_start_contact = options.ignore_start_contact ? 1 : 0;
  return given;
}

template <typename Scalar>
typename CFunctions<Scalar>::Options in_c(const QueryOptions<Scalar>& options) {
  auto given = CFunctions<Scalar>::default_options();
  given.min_t = options.min_t;
  given.max_t = options.max_t;
  given.culling = static_cast<std::uint8_t>(options.culling);
  given.mask = options.mask;
  given.ignored_triangle = options.ignored_triangle;
  given.ignore_start_contact = options.ignore_start_contact ? 1 : 0;
  given.ignore_end_contact = options.ignore_end_contact ? 1 : 0;
  return given;
}

template <typename Scalar>
typename CFunctions<Scalar>::SceneOptions in_c(const SceneQueryOptions<Scalar>& options) {
  auto given = CFunctions<Scalar>::default_scene_options();
  given.min_t = options.min_t;
  given.max_t = options.max_t;
  given.culling = static_cast<std::uint8_t>(options.culling);
  given.mask = options.mask;
  given.instance_mask = options.instance_mask;
  given.ignored_instance = {options.ignored_instance.index, options.ignored_instance.generation};
  given.ignored_triangle = options.ignored_triangle;
  given.ignore_start_contact = options.ignore_start_contact ? 1 : 0;
  given.ignore_end_contact = options.ignore_end_contact ? 1 : 0;
  return given;
}

template <typename Scalar>
typename CFunctions<Scalar>::SceneShapeOptions in_c(const SceneShapeQueryOptions<Scalar>& options) {
  auto given = CFunctions<Scalar>::default_scene_shape_options();
  given.max_t = options.max_t;
  given.culling = static_cast<std::uint8_t>(options.culling);
  given.mask = options.mask;
  given.instance_mask = options.instance_mask;
  given.ignored_instance = {options.ignored_instance.index, options.ignored_instance.generation};
  given.ignored_triangle = options.ignored_triangle;
  given.ignore_start_contact = options.ignore_start_contact ? 1 : 0;
  return given;
}

inline Vector3<float> in_cpp(const surehit_vector3f& x) { return {x.x, x.y, x.z}; }
inline Vector3<double> in_cpp(const surehit_vector3d& x) { return {x.x, x.y, x.z}; }
inline Hit<float> in_cpp(const surehit_hitf& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)};
}
inline Hit<double> in_cpp(const surehit_hitd& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)};
}
inline ShapeHit<float> in_cpp(const surehit_shape_hitf& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0};
}
inline ShapeHit<double> in_cpp(const surehit_shape_hitd& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0};
}
inline SceneShapeHit<float> in_cpp(const surehit_scene_shape_hitf& hit) {
  return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0},
          {hit.instance.index, hit.instance.generation}};
}
inline SceneShapeHit<double> in_cpp(const surehit_scene_shape_hitd& hit) {
  return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0},
          {hit.instance.index, hit.instance.generation}};
}
inline SceneHit<float> in_cpp(const surehit_scene_hitf& hit) {
  return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)},
          {hit.instance.index, hit.instance.generation}};
}
inline SceneHit<double> in_cpp(const surehit_scene_hitd& hit) {
  return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)},
          {hit.instance.index, hit.instance.generation}};
}

}  // namespace surehit::test
