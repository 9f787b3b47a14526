#ifndef SUREHIT_C_VALUES_F_H
#define SUREHIT_C_VALUES_F_H

/// @file
/// Points, paths, hits, meshes, options and filters of the C interface in float.

#include "surehit/c/options.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A point or a vector, in the mesh's unit of length.
typedef struct surehit_vector3f {
  float x;  ///< The coordinate on the first axis.
  float y;  ///< The coordinate on the second axis.
  float z;  ///< The coordinate on the third axis.
} surehit_vector3f;

/// A box with edges along the axes. It is empty if `low` is above `high` on any axis.
typedef struct surehit_boxf {
  surehit_vector3f low;   ///< The minimum on each axis.
  surehit_vector3f high;  ///< The maximum on each axis.
} surehit_boxf;

/// A triangle with its edges and corners. It may be degenerate.
typedef struct surehit_trianglef {
  surehit_vector3f a;  ///< The corner at which u and v are 0.
  surehit_vector3f b;  ///< The corner of weight u.
  surehit_vector3f c;  ///< The corner of weight v.
} surehit_trianglef;

/// A segment, a ray or a line. Any finite numbers are allowed. A path with a NaN or an infinity hits nothing.
typedef struct surehit_pathf {
  surehit_vector3f start;   ///< The start of a segment, or the origin of a ray or a line.
  surehit_vector3f toward;  ///< The end of a segment, or the direction of a ray or a line.
  uint32_t kind;            ///< A `surehit_path_kind`.
} surehit_pathf;

/// Paths of one kind in memory that the caller owns. Strides are in bytes.
///
/// Paths of six numbers side by side are read fastest: `{numbers, NULL, count, 0, 0, kind}`.
typedef struct surehit_pathsf {
  const float* starts;   ///< The three numbers of the first start or origin. May be null if `count` is 0.
  const float* towards;  ///< Those of the first end or direction. Null means that they follow each start.
  size_t count;          ///< The number of paths.
  size_t start_stride;   ///< From one start to the next. 0 means side by side: 3 numbers, or 6 without `towards`.
  size_t toward_stride;  ///< From one end or direction to the next. 0 means 3 numbers. Not used without `towards`.
  uint32_t kind;         ///< A `surehit_path_kind`.
} surehit_pathsf;

/// Where a path first meets a triangle. t, u and v are the exact values, each rounded once to nearest.
///
/// The contact is start + t (end - start), or origin + t direction. It is also a + u (b - a) + v (c - a). It is not
/// promised that the rounded numbers give a point on the triangle. In a miss, only `triangle` means something.
typedef struct surehit_hitf {
  float t;            ///< The lowest parameter at which the path meets the triangle. Zero is +0.
  float u;            ///< The weight of corner b, in [0, 1].
  float v;            ///< The weight of corner c, in [0, 1].
  uint32_t triangle;  ///< The triangle's id: its index in the mesh. `SUREHIT_NO_TRIANGLE` means a miss.
  uint8_t side;       ///< The `surehit_side` at which the path arrives.
} surehit_hitf;

/// A triangle mesh in memory that the caller owns. Strides are in bytes. 0 means side by side.
///
/// The id of a triangle is its index, from 0 on. Degenerate and equal triangles, holes and unused vertices are allowed.
typedef struct surehit_meshf {
  const float* vertices;   ///< The three coordinates of the first vertex. All vertices must be finite.
  size_t vertex_count;     ///< The number of vertices.
  size_t vertex_stride;    ///< From one vertex to the next.
  const void* triangles;   ///< The three indices of the first triangle.
  size_t triangle_count;   ///< The number of triangles, which is at most 2^32 - 2.
  size_t triangle_stride;  ///< From one triangle to the next.
  uint32_t index_size;     ///< The size of an index without sign, in bytes: 2 or 4. 0 means 4.
} surehit_meshf;

/// What narrows a query of a collider. Begin with `surehit_query_optionsf_default()`. A struct of zeros hits nothing.
typedef struct surehit_query_optionsf {
  float min_t;                   ///< The minimum exact t that counts. With a NaN, nothing is hit.
  float max_t;                   ///< The maximum exact t that counts. hit.t may lose the hit, see `max_t_keeping`.
  uint8_t culling;               ///< A `surehit_culling`.
  uint32_t mask;                 ///< Leaves out triangles whose mask shares no bit with this.
  uint32_t ignored_triangle;     ///< Leaves out this triangle. `SUREHIT_NO_TRIANGLE` leaves out none.
  uint8_t ignore_start_contact;  ///< 1 leaves out triangles that exactly contain the start of a segment or a ray.
  uint8_t ignore_end_contact;    ///< 1 leaves out triangles that exactly contain the end of a segment.
} surehit_query_optionsf;

/// Decides whether a hit counts: returns a `surehit_verdict`. `path` is the index of the path in its batch, or 0.
///
/// A query may ask about hits in any order, about hits after the first one, and about a hit more than once. The answer
/// must depend on the arguments alone. With an executor, several threads may call it at the same time. It must not
/// throw, and must not jump out.
typedef int32_t (*surehit_accept_hitf)(void* user, size_t path, const surehit_hitf* hit);

/// A filter of hits.
typedef struct surehit_filterf {
  surehit_accept_hitf accept;  ///< The function that decides. It must not be null.
  void* user;                  ///< Anything. `accept` gets it.
} surehit_filterf;

/// How a batch is answered. Each pointer may be null.
typedef struct surehit_batch_optionsf {
  size_t size;                            ///< The size of this struct.
  const surehit_query_optionsf* options;  ///< The options of all paths. Null means the defaults.
  const surehit_query_optionsf*
      path_options;                  ///< The options of each path, one after the other, in place of `options`.
  const surehit_filterf* filter;     ///< Decides which hits count.
  const surehit_executor* executor;  ///< Spreads the batch over threads, in tasks of some thousand paths.
  surehit_statistics* statistics;    ///< The batch adds its work to these.
} surehit_batch_optionsf;

/// Returns the options that leave out only triangles whose mask is 0.
SUREHIT_C_API surehit_query_optionsf surehit_query_optionsf_default(void);

#ifdef __cplusplus
}
#endif

#endif
