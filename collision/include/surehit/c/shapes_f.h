#ifndef SUREHIT_C_SHAPES_F_H
#define SUREHIT_C_SHAPES_F_H

/// @file
/// Queries of moving shapes of the C interface in float.

#include "surehit/c/collider_f.h"
#include "surehit/c/shape_values_f.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Sets `hit` to the hit of a moving shape with the lowest exact t, and then with the lowest triangle id. Only hits
/// that the filter accepts count. The hit's triangle is `SUREHIT_NO_TRIANGLE` if the shape touches nothing.
///
/// Allocates nothing. After `SUREHIT_STOPPED`, the hit is a miss.
SUREHIT_C_API surehit_status surehit_colliderf_shape_first_hit(const surehit_colliderf* collider,
                                                               const surehit_swept_shapef* shape,
                                                               const surehit_shape_query_optionsf* options,
                                                               const surehit_shape_filterf* filter,
                                                               surehit_statistics* statistics, surehit_shape_hitf* hit);

/// Sets `blocked` to 1 if the shape has a hit that the filter accepts, and to 0 otherwise. It is cheaper than
/// `surehit_colliderf_shape_first_hit`. Allocates nothing. After `SUREHIT_STOPPED`, `blocked` is 0.
SUREHIT_C_API surehit_status surehit_colliderf_shape_any_hit(const surehit_colliderf* collider,
                                                             const surehit_swept_shapef* shape,
                                                             const surehit_shape_query_optionsf* options,
                                                             const surehit_shape_filterf* filter,
                                                             surehit_statistics* statistics, uint8_t* blocked);

/// Sets `hit_count` to the number of triangles that the shape touches, and `hits` to the first `capacity` of their
/// hits. All else is as in `surehit_colliderf_all_hits`.
SUREHIT_C_API surehit_status surehit_colliderf_shape_all_hits(const surehit_colliderf* collider,
                                                              const surehit_swept_shapef* shape,
                                                              const surehit_shape_query_optionsf* options,
                                                              const surehit_shape_filterf* filter,
                                                              surehit_statistics* statistics, surehit_shape_hitf* hits,
                                                              size_t capacity, size_t* hit_count);

/// Sets `hits[i]` to the first hit of shape i, with the same bits as `surehit_colliderf_shape_first_hit`. There must be
/// room for one hit a shape. All else is as in `surehit_colliderf_first_hits`.
SUREHIT_C_API surehit_status surehit_colliderf_shape_first_hits(const surehit_colliderf* collider,
                                                                const surehit_swept_shapesf* shapes,
                                                                const surehit_shape_batch_optionsf* options,
                                                                surehit_shape_hitf* hits);

/// Sets `blocked[i]` to 1 if shape i has a hit, and to 0 otherwise.
SUREHIT_C_API surehit_status surehit_colliderf_shape_any_hits(const surehit_colliderf* collider,
                                                              const surehit_swept_shapesf* shapes,
                                                              const surehit_shape_batch_optionsf* options,
                                                              uint8_t* blocked);

/// Sets `touches` to 1 if the shape has a contact at its start that the filter accepts, and to 0 otherwise. Its end
/// plays no part, and neither do `max_t`, `culling` and `ignore_start_contact`. The filter is given the hits of the
/// shape at rest. Allocates nothing. After `SUREHIT_STOPPED`, `touches` is 0.
SUREHIT_C_API surehit_status surehit_colliderf_shape_overlaps(const surehit_colliderf* collider,
                                                              const surehit_swept_shapef* shape,
                                                              const surehit_shape_query_optionsf* options,
                                                              const surehit_shape_filterf* filter,
                                                              surehit_statistics* statistics, uint8_t* touches);

/// Sets `t` to the maximum number below the exact t of a hit. There the shape has not touched the triangle yet. For
/// the first hit, it has touched nothing until then. `hit` must be one of the shape's hits in this collider.
///
/// The result is 0 if they touch at the start, or if no number is between 0 and the exact t.
SUREHIT_C_API surehit_status surehit_colliderf_shape_last_free_t(const surehit_colliderf* collider,
                                                                 const surehit_swept_shapef* shape,
                                                                 const surehit_shape_hitf* hit, float* t);

/// Sets `point` to where the centre of the shape may stop, in front of its first hit under these options. The way from
/// the start to it has no hit, so the shape touches nothing there. It is the start if no float before the hit is free.
///
/// Only `t` of the hit is used. Allocates nothing. After `SUREHIT_STOPPED`, the point is the start.
SUREHIT_C_API surehit_status surehit_colliderf_shape_last_free_point(
    const surehit_colliderf* collider, const surehit_swept_shapef* shape, const surehit_shape_hitf* hit,
    const surehit_shape_query_optionsf* options, const surehit_shape_filterf* filter, surehit_vector3f* point);

/// Sets `hit` to where a moving shape first touches one triangle. `options->mask` and `options->ignored_triangle` are
/// not used. The hit's triangle is 0, or `SUREHIT_NO_TRIANGLE` if they do not touch.
SUREHIT_C_API surehit_status surehit_trianglef_shape_intersect(const surehit_trianglef* triangle,
                                                               const surehit_swept_shapef* shape,
                                                               const surehit_shape_query_optionsf* options,
                                                               surehit_shape_hitf* hit);

/// Sets `point` to the touched point of a triangle, a + u (b - a) + v (c - a). Both weights are rounded once. So
/// each adds at most half an ulp of 1 times its edge. The sum adds at most 4 ulp of the triangle's largest coordinate.
/// Fails with `SUREHIT_INVALID_VALUE` if a corner is not finite.
SUREHIT_C_API surehit_status surehit_trianglef_shape_contact_point(const surehit_trianglef* triangle,
                                                                   const surehit_shape_hitf* hit,
                                                                   surehit_vector3f* point);

/// Sets `normal` to the unit direction in which a triangle pushes a shape where they first touch. It is zero if they do
/// not touch, or if nothing tells a direction. Each component is within 8 ulp(1) of the true one in double, and within
/// 1 in float. Takes some ten microseconds.
SUREHIT_C_API surehit_status surehit_trianglef_shape_contact_normal(const surehit_trianglef* triangle,
                                                                    const surehit_swept_shapef* shape,
                                                                    surehit_vector3f* normal);

#ifdef __cplusplus
}
#endif

#endif
