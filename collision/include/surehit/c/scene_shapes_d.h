#ifndef SUREHIT_C_SCENE_SHAPES_D_H
#define SUREHIT_C_SCENE_SHAPES_D_H

/// @file
/// Queries of moving shapes in scenes of the C interface in double.
///
/// Distances are those of the scene, whatever the poses are. While a shape moves, instances with a motion move too.

#include "surehit/c/scene_d.h"
#include "surehit/c/scene_shape_values_d.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Sets `hit` to the hit of a moving shape with the lowest exact t, see `surehit_colliderd_shape_first_hit`. Among hits
/// with equal t, the lowest instance index comes first, and then the lowest triangle id.
SUREHIT_C_API surehit_status surehit_scened_shape_first_hit(
    const surehit_scened* scene, const surehit_swept_shaped* shape, const surehit_scene_shape_query_optionsd* options,
    const surehit_scene_shape_filterd* filter, surehit_statistics* statistics, surehit_scene_shape_hitd* hit);

/// Sets `blocked` to 1 if the shape has a hit that the filter accepts, and to 0 otherwise, see
/// `surehit_colliderd_shape_any_hit`.
SUREHIT_C_API surehit_status surehit_scened_shape_any_hit(const surehit_scened* scene,
                                                          const surehit_swept_shaped* shape,
                                                          const surehit_scene_shape_query_optionsd* options,
                                                          const surehit_scene_shape_filterd* filter,
                                                          surehit_statistics* statistics, uint8_t* blocked);

/// Sets `hit_count` to the number of placed triangles that the shape touches, and `hits` to the first `capacity` of
/// their hits, in order. All else is as in `surehit_colliderd_all_hits`.
SUREHIT_C_API surehit_status surehit_scened_shape_all_hits(
    const surehit_scened* scene, const surehit_swept_shaped* shape, const surehit_scene_shape_query_optionsd* options,
    const surehit_scene_shape_filterd* filter, surehit_statistics* statistics, surehit_scene_shape_hitd* hits,
    size_t capacity, size_t* hit_count);

/// Sets `hits[i]` to the first hit of shape i, with the same bits as `surehit_scened_shape_first_hit`. There must be
/// room for one hit a shape. All else is as in `surehit_colliderd_first_hits`.
SUREHIT_C_API surehit_status surehit_scened_shape_first_hits(const surehit_scened* scene,
                                                             const surehit_swept_shapesd* shapes,
                                                             const surehit_scene_shape_batch_optionsd* options,
                                                             surehit_scene_shape_hitd* hits);

/// Sets `blocked[i]` to 1 if shape i has a hit, and to 0 otherwise.
SUREHIT_C_API surehit_status surehit_scened_shape_any_hits(const surehit_scened* scene,
                                                           const surehit_swept_shapesd* shapes,
                                                           const surehit_scene_shape_batch_optionsd* options,
                                                           uint8_t* blocked);

/// Sets `touches` to 1 if the shape has a contact at its start that the filter accepts, and to 0 otherwise, see
/// `surehit_colliderd_shape_overlaps`.
SUREHIT_C_API surehit_status surehit_scened_shape_overlaps(const surehit_scened* scene,
                                                           const surehit_swept_shaped* shape,
                                                           const surehit_scene_shape_query_optionsd* options,
                                                           const surehit_scene_shape_filterd* filter,
                                                           surehit_statistics* statistics, uint8_t* touches);

/// Sets `t` to the maximum number below the exact t of a hit, see `surehit_colliderd_shape_last_free_t`. If the
/// instance moves, it is then at its pose plus t times its motion.
///
/// `hit` must be one of the shape's hits in this scene. Fails with `SUREHIT_STALE_ID` if its instance is not there, or
/// was removed since the last commit.
SUREHIT_C_API surehit_status surehit_scened_shape_last_free_t(const surehit_scened* scene,
                                                              const surehit_swept_shaped* shape,
                                                              const surehit_scene_shape_hitd* hit, double* t);

/// Sets `point` to where the centre of the shape may stop, see `surehit_colliderd_shape_last_free_point`. A moving
/// instance goes the same share of its way.
SUREHIT_C_API surehit_status surehit_scened_shape_last_free_point(const surehit_scened* scene,
                                                                  const surehit_swept_shaped* shape,
                                                                  const surehit_scene_shape_hitd* hit,
                                                                  const surehit_scene_shape_query_optionsd* options,
                                                                  const surehit_scene_shape_filterd* filter,
                                                                  surehit_vector3d* point);

/// Sets `point` to the touched point of a hit, where the instance is at the hit's t. This is M (a + u (b - a) +
/// v (c - a)) + m + t d. The corners a, b and c are those of the mesh, M and m are the pose, and d is the motion.
///
/// Each coordinate is the exact one for the t, u and v of the hit, rounded once to nearest. They are rounded too, so
/// each adds at most half an ulp of 1: u and v times a placed edge, and t times the motion.
///
/// `hit` must be one of the hits in this scene. Fails with `SUREHIT_STALE_ID` if its instance is not there, or was
/// removed since the last commit. The point is zero if the instance is not committed yet. Allocates nothing.
SUREHIT_C_API surehit_status surehit_scened_shape_contact_point(const surehit_scened* scene,
                                                                const surehit_scene_shape_hitd* hit,
                                                                surehit_vector3d* point);

/// Sets `normal` to the unit direction in which the triangle of a hit pushes the shape where they first touch, see
/// `surehit_triangled_shape_contact_normal`. It is that of the exact image, before any corner is rounded, and its error
/// is the same. If the instance moves, it is as the instance sees the shape.
///
/// `hit` must be one of the shape's hits in this scene. Only its ids are used. Fails as
/// `surehit_scened_shape_contact_point` does. Takes some ten microseconds, and allocates nothing.
SUREHIT_C_API surehit_status surehit_scened_shape_contact_normal(const surehit_scened* scene,
                                                                 const surehit_swept_shaped* shape,
                                                                 const surehit_scene_shape_hitd* hit,
                                                                 surehit_vector3d* normal);

#ifdef __cplusplus
}
#endif

#endif
