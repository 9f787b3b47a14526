#ifndef SUREHIT_C_SHAPE_VALUES_F_H
#define SUREHIT_C_SHAPE_VALUES_F_H

/// @file
/// Moving shapes, their hits, options and filters of the C interface in float.

#include "surehit/c/values_f.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A shape that moves in a straight line during one physics step, from its start at t = 0 to its end at t = 1.
///
/// It touches a triangle if their distance is zero, so a contact in a single point counts. Any finite numbers are
/// allowed. With a negative radius or extent, a NaN or an infinity, it touches nothing. Its end may be its start.
typedef struct surehit_swept_shapef {
  surehit_vector3f start;  ///< The centre at t = 0.
  surehit_vector3f end;    ///< The centre at t = 1.
  surehit_vector3f half;   ///< Half the size of a box, or half the axis of a capsule. Not used by a ball.
  float radius;            ///< The radius of a ball or a capsule, in the mesh's unit of length. Not used by a box.
  uint32_t kind;           ///< A `surehit_shape_kind`.
} surehit_swept_shapef;

/// A moving ball, as an array for a batch has it: seven numbers side by side.
typedef struct surehit_swept_spheref {
  surehit_vector3f start;  ///< The centre at t = 0.
  surehit_vector3f end;    ///< The centre at t = 1.
  float radius;            ///< The radius.
} surehit_swept_spheref;

/// A moving box, as an array for a batch has it: nine numbers side by side. It has all points whose difference from the
/// centre is at most `half_extents` on each axis.
typedef struct surehit_swept_boxf {
  surehit_vector3f start;         ///< The centre at t = 0.
  surehit_vector3f end;           ///< The centre at t = 1.
  surehit_vector3f half_extents;  ///< Half the size on each axis.
} surehit_swept_boxf;

/// A moving capsule, as an array for a batch has it: ten numbers side by side. It has all points within the radius of
/// the segment from the centre - `half_axis` to the centre + `half_axis`.
typedef struct surehit_swept_capsulef {
  surehit_vector3f start;      ///< The centre at t = 0.
  surehit_vector3f end;        ///< The centre at t = 1.
  surehit_vector3f half_axis;  ///< The way from the centre to an end of the segment.
  float radius;                ///< The radius.
} surehit_swept_capsulef;

/// Moving shapes of one kind, side by side in memory that the caller owns.
typedef struct surehit_swept_shapesf {
  const float* numbers;  ///< The numbers of the first shape, such as `&spheres[0].start.x`. Null if `count` is 0.
  size_t count;          ///< The number of shapes.
  uint32_t kind;         ///< A `surehit_shape_kind`.
} surehit_swept_shapesf;

/// Where a moving shape first touches a triangle. t, u and v are the exact values, each rounded once to nearest.
///
/// The touched point is a + u (b - a) + v (c - a). It is not promised that the shape at the rounded t touches the
/// triangle. In a miss, only `triangle` means something.
typedef struct surehit_shape_hitf {
  float t;                   ///< The lowest parameter at which they touch, in [0, 1]. Zero is +0.
  float u;                   ///< The weight of corner b, in [0, 1].
  float v;                   ///< The weight of corner c, in [0, 1].
  uint32_t triangle;         ///< The triangle's id: its index in the mesh. `SUREHIT_NO_TRIANGLE` means a miss.
  uint8_t feature;           ///< The `surehit_feature` that has the touched point.
  uint8_t started_touching;  ///< 1 if they touch at t = 0 already.
} surehit_shape_hitf;

/// What narrows a query of a moving shape. Begin with `surehit_shape_query_optionsf_default()`. A struct of zeros hits
/// nothing.
typedef struct surehit_shape_query_optionsf {
  float max_t;                   ///< The maximum exact t that counts. With a NaN or a negative number, nothing is hit.
  uint8_t culling;               ///< A `surehit_culling`, by the side from which the shape moves against a triangle.
  uint32_t mask;                 ///< Leaves out triangles whose mask shares no bit with this.
  uint32_t ignored_triangle;     ///< Leaves out this triangle. `SUREHIT_NO_TRIANGLE` leaves out none.
  uint8_t ignore_start_contact;  ///< 1 leaves out triangles that the shape touches at its start.
} surehit_shape_query_optionsf;

/// Decides whether a hit of a moving shape counts, as `surehit_accept_hitf` does. `shape` is the index of the shape in
/// its batch, or 0.
typedef int32_t (*surehit_accept_shape_hitf)(void* user, size_t shape, const surehit_shape_hitf* hit);

/// A filter of hits of moving shapes.
typedef struct surehit_shape_filterf {
  surehit_accept_shape_hitf accept;  ///< The function that decides. It must not be null.
  void* user;                        ///< Anything. `accept` gets it.
} surehit_shape_filterf;

/// How a batch of moving shapes is answered. Each pointer may be null.
typedef struct surehit_shape_batch_optionsf {
  size_t size;                                  ///< The size of this struct.
  const surehit_shape_query_optionsf* options;  ///< The options of all shapes. Null means the defaults.
  const surehit_shape_query_optionsf*
      path_options;                     ///< The options of each shape, one after the other, in place of `options`.
  const surehit_shape_filterf* filter;  ///< Decides which hits count.
  const surehit_executor* executor;     ///< Spreads the batch over threads, in tasks of some hundred shapes.
  surehit_statistics* statistics;       ///< The batch adds its work to these.
} surehit_shape_batch_optionsf;

/// Returns the options that leave out only triangles whose mask is 0.
SUREHIT_C_API surehit_shape_query_optionsf surehit_shape_query_optionsf_default(void);

#ifdef __cplusplus
}
#endif

#endif
