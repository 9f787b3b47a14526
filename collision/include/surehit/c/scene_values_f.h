#ifndef SUREHIT_C_SCENE_VALUES_F_H
#define SUREHIT_C_SCENE_VALUES_F_H

/// @file
/// Poses, hits, options and filters of scenes of the C interface in float.

#include "surehit/c/values_f.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where an instance is: a corner v of its mesh is at v.x x_axis + v.y y_axis + v.z z_axis + translation, in exact
/// arithmetic. No corner is rounded. So the axes are the columns of a matrix.
///
/// The axes may rotate, scale, mirror and shear. Each of their entries must be 0, or between 2^-64 and 2^64 in
/// magnitude. Their exact determinant must not be 0. The translation must be finite.
typedef struct surehit_posef {
  surehit_vector3f x_axis;       ///< Where the mesh's unit vector along x goes.
  surehit_vector3f y_axis;       ///< Where the one along y goes.
  surehit_vector3f z_axis;       ///< Where the one along z goes.
  surehit_vector3f translation;  ///< Where the mesh's origin is.
} surehit_posef;

/// Where a path first meets a triangle of a scene. All but the instance is as in `surehit_hitf`, for the exact image of
/// the triangle. So the side is that of the placed triangle, also where the pose mirrors it.
typedef struct surehit_scene_hitf {
  float t;                       ///< The lowest parameter at which the path meets the triangle.
  float u;                       ///< The weight of corner b.
  float v;                       ///< The weight of corner c.
  uint32_t triangle;             ///< The triangle's index in its mesh. `SUREHIT_NO_TRIANGLE` means a miss.
  uint8_t side;                  ///< The `surehit_side` at which the path arrives.
  surehit_instance_id instance;  ///< The instance that has the triangle. Its index is `SUREHIT_NO_INSTANCE` in a miss.
} surehit_scene_hitf;

/// What narrows a query of a scene. Begin with `surehit_scene_query_optionsf_default()`. A struct of zeros hits
/// nothing.
typedef struct surehit_scene_query_optionsf {
  float min_t;                           ///< The minimum exact t that counts.
  float max_t;                           ///< The maximum exact t that counts.
  uint8_t culling;                       ///< A `surehit_culling`, by the side of the placed triangle.
  uint32_t mask;                         ///< Leaves out triangles whose mask shares no bit with this.
  uint32_t instance_mask;                ///< Leaves out instances whose mask shares no bit with this.
  surehit_instance_id ignored_instance;  ///< Leaves out this instance, or one triangle of it.
  uint32_t ignored_triangle;             ///< Leaves out this triangle of `ignored_instance`, and keeps its others.
  uint8_t ignore_start_contact;          ///< 1 leaves out triangles that exactly contain the start.
  uint8_t ignore_end_contact;            ///< 1 leaves out triangles that exactly contain the end.
} surehit_scene_query_optionsf;

/// Decides whether a hit of a scene counts, see `surehit_accept_hitf`.
typedef int32_t (*surehit_accept_scene_hitf)(void* user, size_t path, const surehit_scene_hitf* hit);

/// A filter of hits of a scene.
typedef struct surehit_scene_filterf {
  surehit_accept_scene_hitf accept;  ///< The function that decides. It must not be null.
  void* user;                        ///< Anything. `accept` gets it.
} surehit_scene_filterf;

/// How a batch is answered by a scene. Each pointer may be null.
typedef struct surehit_scene_batch_optionsf {
  size_t size;                                       ///< The size of this struct.
  const surehit_scene_query_optionsf* options;       ///< The options of all paths. Null means the defaults.
  const surehit_scene_query_optionsf* path_options;  ///< The options of each path, in place of `options`.
  const surehit_scene_filterf* filter;               ///< Decides which hits count.
  const surehit_executor* executor;                  ///< Spreads the batch over threads.
  surehit_statistics* statistics;                    ///< The batch adds its work to these.
} surehit_scene_batch_optionsf;

/// Returns the pose that leaves a mesh where it is.
SUREHIT_C_API surehit_posef surehit_posef_identity(void);

/// Returns a pose that turns a mesh by a unit quaternion, and then moves it. The entries of its axes are rounded a few
/// times, and become 0 below 2^-64 in magnitude. The instance is the exact image under the rounded axes.
SUREHIT_C_API surehit_posef surehit_posef_rigid(float x, float y, float z, float w, surehit_vector3f translation);

/// Returns the options that leave out only what has a mask of 0.
SUREHIT_C_API surehit_scene_query_optionsf surehit_scene_query_optionsf_default(void);

#ifdef __cplusplus
}
#endif

#endif
