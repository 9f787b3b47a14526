#ifndef SUREHIT_C_OPTIONS_H
#define SUREHIT_C_OPTIONS_H

/// @file
/// What the C interface has for float and double alike: kinds, ids, executors, statistics and options of a build.

#include "surehit/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The id that no triangle has. In a hit it means a miss.
#define SUREHIT_NO_TRIANGLE UINT32_MAX
/// The index that no instance has.
#define SUREHIT_NO_INSTANCE UINT32_MAX
/// The mask that has all bits.
#define SUREHIT_ALL_BITS UINT32_MAX

/// The kinds of paths.
typedef enum surehit_path_kind {
  SUREHIT_SEGMENT = 0,  ///< The points from the start to the end, both included. t is in [0, 1].
  SUREHIT_RAY = 1,      ///< The points from the start in a direction. t is 0 or more, in units of the direction.
  SUREHIT_LINE = 2      ///< The points through the start along a direction, both ways.
} surehit_path_kind;

/// The kinds of moving shapes.
typedef enum surehit_shape_kind {
  SUREHIT_SWEPT_SPHERE = 0,  ///< A ball. A batch has 7 numbers for each, as in `surehit_swept_spheref`.
  SUREHIT_SWEPT_BOX = 1,     ///< A box with edges along the axes. A batch has 9 numbers, as in `surehit_swept_boxf`.
  SUREHIT_SWEPT_CAPSULE = 2  ///< A capsule. A batch has 10 numbers for each, as in `surehit_swept_capsulef`.
} surehit_shape_kind;

/// The parts of a triangle with corners a, b and c.
typedef enum surehit_feature {
  SUREHIT_FACE = 0,      ///< The inside of the triangle.
  SUREHIT_EDGE_AB = 1,   ///< The inside of the edge from a to b.
  SUREHIT_EDGE_BC = 2,   ///< The inside of the edge from b to c.
  SUREHIT_EDGE_CA = 3,   ///< The inside of the edge from c to a.
  SUREHIT_CORNER_A = 4,  ///< Corner a.
  SUREHIT_CORNER_B = 5,  ///< Corner b.
  SUREHIT_CORNER_C = 6   ///< Corner c.
} surehit_feature;

/// The sides of a triangle with corners a, b and c. Its normal is (b - a) × (c - a).
typedef enum surehit_side {
  SUREHIT_EDGE_ON = 0,  ///< The path is in the triangle's plane, or has length zero, or the triangle is degenerate.
  SUREHIT_FRONT = 1,    ///< The path arrives from the side to which the normal points.
  SUREHIT_BACK = 2      ///< The path arrives from the other side.
} surehit_side;

/// Which hits a query leaves out because of their side.
typedef enum surehit_culling {
  SUREHIT_CULL_NONE = 0,  ///< The query keeps all hits.
  SUREHIT_CULL_BACK = 1,  ///< The query keeps only front hits. It leaves out edge-on ones too.
  SUREHIT_CULL_FRONT = 2  ///< The query keeps only back hits. It leaves out edge-on ones too.
} surehit_culling;

/// What a filter says about a hit.
typedef enum surehit_verdict {
  SUREHIT_STOP = -1,   ///< The query should end, and fail with `SUREHIT_STOPPED`. The filter is not asked again.
  SUREHIT_REJECT = 0,  ///< The hit does not count.
  SUREHIT_ACCEPT = 1   ///< The hit counts.
} surehit_verdict;

/// Does a task of an executor. `work` is what the executor was given, and `index` is below its count.
typedef void (*surehit_task)(void* work, size_t index);

/// Runs tasks. It calls `task(work, i)` once for each i below `count`, on any threads and in any order. It returns
/// after all calls have returned. It must not throw, and must not jump out.
///
/// A task that it leaves out is done after it returns, on the calling thread. A call with an index that was done
/// before, or that is out of range, does nothing. `task` must not be called after it has returned.
typedef void (*surehit_run_tasks)(void* user, size_t count, surehit_task task, void* work);

/// Spreads a batch, a build or a commit over threads. The result has the same bits as without it.
typedef struct surehit_executor {
  surehit_run_tasks run;  ///< The function that runs the tasks. It must not be null.
  void* user;             ///< Anything. `run` gets it.
} surehit_executor;

/// The work of queries. A query adds to the statistics that it is given, and never resets them. Threads that run at
/// the same time need statistics of their own.
///
/// The numbers are not promised. They may differ between machines and versions.
typedef struct surehit_statistics {
  size_t size;               ///< The size of this struct.
  uint64_t paths;            ///< The number of paths.
  uint64_t cells;            ///< The number of steps in grids.
  uint64_t candidates;       ///< The number of triangles in the lists that paths met.
  uint64_t undecided;        ///< The number of candidates that the kernel did not decide.
  uint64_t exact_decisions;  ///< The number of times that exact arithmetic decided whether a path meets a triangle.
  uint64_t exact_orders;     ///< The number of times that it decided which of two hits comes first.
  uint64_t exact_roundings;  ///< The number of times that it rounded t, u and v.
  uint64_t instances;        ///< The number of instances that paths came near. It is 0 for a collider.
  uint64_t unclipped;        ///< The number of paths that were tested against all triangles.
} surehit_statistics;

/// How a collider is built. Only `masks` can change an answer.
typedef struct surehit_build_options {
  size_t size;                       ///< The size of this struct.
  const uint32_t* masks;             ///< One mask for each triangle, or null for all bits. They are copied.
  size_t mask_count;                 ///< The number of masks: the number of triangles, or 0.
  const surehit_executor* executor;  ///< Spreads the build over threads. Null for none.
  double cells_per_triangle;         ///< The number of top cells a triangle. 0 means 1.
  uint32_t resolution_x;             ///< The number of top cells along x. 0 leaves it to the grid.
  uint32_t resolution_y;             ///< The number of top cells along y.
  uint32_t resolution_z;             ///< The number of top cells along z.
  uint32_t crowded;                  ///< A cell with more triangles is divided. 0 means 128. UINT32_MAX means never.
} surehit_build_options;

/// The size of a grid. All numbers are 0 if the mesh has no triangles.
typedef struct surehit_grid_summary {
  size_t size;            ///< The size of this struct.
  size_t cells;           ///< The number of cells.
  size_t entries;         ///< The number of entries in all lists.
  size_t memory_bytes;    ///< The memory of cells and lists, in bytes.
  uint32_t resolution_x;  ///< The number of top cells along x.
  uint32_t resolution_y;  ///< The number of top cells along y.
  uint32_t resolution_z;  ///< The number of top cells along z.
  uint32_t levels;        ///< The number of levels of divided cells below the top cells.
} surehit_grid_summary;

/// Names an instance of a scene. An id of a removed instance is never that of another one.
typedef struct surehit_instance_id {
  uint32_t index;       ///< Low indices come first among hits with equal exact t.
  uint32_t generation;  ///< How often the index has been used before.
} surehit_instance_id;

#ifdef __cplusplus
}
#endif

#endif
