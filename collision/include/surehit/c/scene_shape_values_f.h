#ifndef SUREHIT_C_SCENE_SHAPE_VALUES_F_H
#define SUREHIT_C_SCENE_SHAPE_VALUES_F_H

/// @file
/// Hits, options and filters of moving shapes in scenes of the C interface in float.

#include "surehit/c/shape_values_f.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where a moving shape first touches a triangle of a scene. All but the instance is as in `surehit_shape_hitf`, for
/// the exact image of the triangle.
typedef struct surehit_scene_shape_hitf {
  float t;                       ///< The lowest parameter at which they touch, in [0, 1]. Zero is +0.
  float u;                       ///< The weight of corner b, in [0, 1].
  float v;                       ///< The weight of corner c, in [0, 1].
  uint32_t triangle;             ///< The triangle's index in its mesh. `SUREHIT_NO_TRIANGLE` means a miss.
  uint8_t feature;               ///< The `surehit_feature` that has the touched point.
  uint8_t started_touching;      ///< 1 if they touch at t = 0 already.
  surehit_instance_id instance;  ///< The instance that has the triangle. Its index is `SUREHIT_NO_INSTANCE` in a miss.
} surehit_scene_shape_hitf;

/// What narrows a query of a moving shape in a scene. Begin with `surehit_scene_shape_query_optionsf_default()`. A
/// struct of zeros hits nothing.
typedef struct surehit_scene_shape_query_optionsf {
  float max_t;             ///< The maximum exact t that counts. With a NaN or a negative number, nothing is hit.
  uint8_t culling;         ///< A `surehit_culling`, by the side from which the shape moves against a placed triangle.
  uint32_t mask;           ///< Leaves out triangles whose mask shares no bit with this.
  uint32_t instance_mask;  ///< Leaves out instances whose mask shares no bit with this.
  surehit_instance_id ignored_instance;  ///< Leaves out this instance, or one triangle of it.
  uint32_t ignored_triangle;             ///< Leaves out this triangle of `ignored_instance`, and keeps its others.
  uint8_t ignore_start_contact;          ///< 1 leaves out triangles that the shape touches at its start.
} surehit_scene_shape_query_optionsf;

/// Decides whether a hit of a moving shape in a scene counts, as `surehit_accept_shape_hitf` does.
typedef int32_t (*surehit_accept_scene_shape_hitf)(void* user, size_t shape, const surehit_scene_shape_hitf* hit);

/// A filter of hits of moving shapes in a scene.
typedef struct surehit_scene_shape_filterf {
  surehit_accept_scene_shape_hitf accept;  ///< The function that decides. It must not be null.
  void* user;                              ///< Anything. `accept` gets it.
} surehit_scene_shape_filterf;

/// How a batch of moving shapes is answered by a scene. Each pointer may be null.
typedef struct surehit_scene_shape_batch_optionsf {
  size_t size;                                        ///< The size of this struct.
  const surehit_scene_shape_query_optionsf* options;  ///< The options of all shapes. Null means the defaults.
  const surehit_scene_shape_query_optionsf*
      path_options;  ///< The options of each shape, one after the other, in place of `options`.
  const surehit_scene_shape_filterf* filter;  ///< Decides which hits count.
  const surehit_executor* executor;           ///< Spreads the batch over threads, in tasks of some hundred shapes.
  surehit_statistics* statistics;             ///< The batch adds its work to these.
} surehit_scene_shape_batch_optionsf;

/// Returns the options that leave out only what has a mask of 0.
SUREHIT_C_API surehit_scene_shape_query_optionsf surehit_scene_shape_query_optionsf_default(void);

#ifdef __cplusplus
}
#endif

#endif
