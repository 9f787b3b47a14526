#ifndef SUREHIT_C_COLLIDER_F_H
#define SUREHIT_C_COLLIDER_F_H

/// @file
/// Colliders of the C interface in float.

#include "surehit/c/values_f.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh that answers where paths first meet it. It copies what it needs of the mesh.
///
/// The answers are those of exact real arithmetic on the given numbers, for every finite input. They depend on the
/// input alone. Scenes share a collider, and keep it after its handle is destroyed.
typedef struct surehit_colliderf surehit_colliderf;

/// Makes a collider of a mesh, and sets `collider` to it. Without a mesh, which is null then, every query misses.
/// Destroy it with `surehit_colliderf_destroy`.
///
/// Fails as `surehit_colliderf_build` does.
SUREHIT_C_API surehit_status surehit_colliderf_create(const surehit_meshf* mesh, const surehit_build_options* options,
                                                      surehit_colliderf** collider);

/// Makes a copy of a collider, and sets `copy` to it. Takes time and memory linear in its memory.
SUREHIT_C_API surehit_status surehit_colliderf_copy(const surehit_colliderf* collider, surehit_colliderf** copy);

/// Gives up a collider. Its memory is freed when no scene has it any more. No query of it may run. Null is allowed.
///
/// Destroying it again fails with `SUREHIT_INVALID_HANDLE`, and so does every other use. This can be told until 1,000
/// more handles have been destroyed.
SUREHIT_C_API surehit_status surehit_colliderf_destroy(surehit_colliderf* collider);

/// Replaces the mesh, the masks and the options. Takes time and memory linear in the triangles and vertices.
///
/// Fails with the first status of 100 to 199 that is true of the mesh or its masks, with `SUREHIT_TOO_LARGE`, or with
/// `SUREHIT_OUT_OF_MEMORY`. After any failure, the collider is as before.
SUREHIT_C_API surehit_status surehit_colliderf_build(surehit_colliderf* collider, const surehit_meshf* mesh,
                                                     const surehit_build_options* options);

/// Does the same for a mesh whose triangles change often. It reuses the memory of the builds before, and keeps the
/// memory of two meshes.
SUREHIT_C_API surehit_status surehit_colliderf_rebuild(surehit_colliderf* collider, const surehit_meshf* mesh,
                                                       const surehit_build_options* options);

/// Moves the vertices, for a mesh that deforms each tick. Triangles, masks and options stay. `stride` is in bytes, and
/// 0 means side by side. Takes about as long as a build, and keeps the memory of two meshes.
///
/// Fails unless there are as many vertices as before, and all are finite. The collider is then as before.
SUREHIT_C_API surehit_status surehit_colliderf_rebuild_vertices(surehit_colliderf* collider, const float* vertices,
                                                                size_t vertex_count, size_t stride,
                                                                const surehit_executor* executor);

/// Sets the mask of one triangle, such as a door that opens. No query may run at the same time. Takes constant time,
/// except for the first time after a build without masks.
///
/// Fails with `SUREHIT_OUT_OF_RANGE` if there is no such triangle.
SUREHIT_C_API surehit_status surehit_colliderf_set_mask(surehit_colliderf* collider, uint32_t triangle, uint32_t mask);

/// Sets the masks of all triangles. They are copied. No masks, with a count of 0, means all bits for all triangles.
///
/// Fails with `SUREHIT_MASKS_DO_NOT_MATCH` if there is not one mask for each triangle.
SUREHIT_C_API surehit_status surehit_colliderf_set_masks(surehit_colliderf* collider, const uint32_t* masks,
                                                         size_t mask_count);

/// Sets `mask` to the mask of a triangle.
SUREHIT_C_API surehit_status surehit_colliderf_mask(const surehit_colliderf* collider, uint32_t triangle,
                                                    uint32_t* mask);

/// Sets `hit` to the hit with the lowest exact t, and among equal ones to that of the lowest triangle id. Only hits
/// that the filter accepts count. The hit's triangle is `SUREHIT_NO_TRIANGLE` if the path misses.
///
/// Allocates nothing. After `SUREHIT_STOPPED`, the hit is a miss.
SUREHIT_C_API surehit_status surehit_colliderf_first_hit(const surehit_colliderf* collider, const surehit_pathf* path,
                                                         const surehit_query_optionsf* options,
                                                         const surehit_filterf* filter, surehit_statistics* statistics,
                                                         surehit_hitf* hit);

/// Sets `blocked` to 1 if the path has a hit that the filter accepts, and to 0 otherwise. It is cheaper than
/// `surehit_colliderf_first_hit`. Allocates nothing. After `SUREHIT_STOPPED`, `blocked` is 0.
SUREHIT_C_API surehit_status surehit_colliderf_any_hit(const surehit_colliderf* collider, const surehit_pathf* path,
                                                       const surehit_query_optionsf* options,
                                                       const surehit_filterf* filter, surehit_statistics* statistics,
                                                       uint8_t* blocked);

/// Sets `hit_count` to the number of triangles that the path meets, and `hits` to the first `capacity` of their hits.
/// They are in the order of exact t, and then of triangle ids. Only hits that the filter accepts count.
///
/// If `hit_count` is above `capacity`, ask again with more room. `hits` may be null if `capacity` is 0. It allocates
/// temporary memory for all hits. After `SUREHIT_STOPPED`, `hit_count` is 0.
SUREHIT_C_API surehit_status surehit_colliderf_all_hits(const surehit_colliderf* collider, const surehit_pathf* path,
                                                        const surehit_query_optionsf* options,
                                                        const surehit_filterf* filter, surehit_statistics* statistics,
                                                        surehit_hitf* hits, size_t capacity, size_t* hit_count);

/// Sets `hits[i]` to the first hit of path i, with the same bits as `surehit_colliderf_first_hit`. There must be room
/// for one hit a path, and the hits must not overlap the paths.
///
/// A batch of some dozen paths or more is much faster than single calls. It allocates nothing itself, except for some
/// bytes if there is an executor. After `SUREHIT_STOPPED`, the hits mean nothing.
SUREHIT_C_API surehit_status surehit_colliderf_first_hits(const surehit_colliderf* collider,
                                                          const surehit_pathsf* paths,
                                                          const surehit_batch_optionsf* options, surehit_hitf* hits);

/// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise. All else is as in `surehit_colliderf_first_hits`.
SUREHIT_C_API surehit_status surehit_colliderf_any_hits(const surehit_colliderf* collider, const surehit_pathsf* paths,
                                                        const surehit_batch_optionsf* options, uint8_t* blocked);

/// Sets `point` to where a point that moves along a segment may stop, in front of the hit. The way from the start to it
/// has no hit under these options and this filter, so a step that ends there never tunnels.
///
/// The path must be a segment, else it fails with `SUREHIT_INVALID_VALUE`. `hit` must be its first hit under the same
/// options. If no point before the hit is free, it is the start. Takes at most 24 queries in float, and 53 in double.
/// After `SUREHIT_STOPPED`, the point is the start.
SUREHIT_C_API surehit_status surehit_colliderf_last_free_point(const surehit_colliderf* collider,
                                                               const surehit_pathf* segment, const surehit_hitf* hit,
                                                               const surehit_query_optionsf* options,
                                                               const surehit_filterf* filter, surehit_vector3f* point);

/// Sets `max_t` to the limit that keeps a hit: the smallest number that is not below its exact t. hit.t itself was
/// rounded, and loses the hit in half of all cases. `hit` must be one of the path's hits in this collider.
SUREHIT_C_API surehit_status surehit_colliderf_max_t_keeping(const surehit_colliderf* collider,
                                                             const surehit_pathf* path, const surehit_hitf* hit,
                                                             float* max_t);

/// Sets `count` to the number of triangles.
SUREHIT_C_API surehit_status surehit_colliderf_triangle_count(const surehit_colliderf* collider, size_t* count);

/// Sets `triangle` to the corners of a triangle, as they were given.
SUREHIT_C_API surehit_status surehit_colliderf_triangle(const surehit_colliderf* collider, uint32_t id,
                                                        surehit_trianglef* triangle);

/// Sets `normal` to the unit normal of a triangle, see `surehit_trianglef_normal`.
SUREHIT_C_API surehit_status surehit_colliderf_normal(const surehit_colliderf* collider, uint32_t id,
                                                      surehit_vector3f* normal);

/// Sets `box` to the smallest box around all triangles. It is empty if there are none.
SUREHIT_C_API surehit_status surehit_colliderf_box(const surehit_colliderf* collider, surehit_boxf* box);

/// Sets `summary` to the size of the grid. Its member `size` must be set before.
SUREHIT_C_API surehit_status surehit_colliderf_grid_summary(const surehit_colliderf* collider,
                                                            surehit_grid_summary* summary);

/// Sets `bytes` to the memory that the collider has allocated.
SUREHIT_C_API surehit_status surehit_colliderf_memory_bytes(const surehit_colliderf* collider, size_t* bytes);

#ifdef __cplusplus
}
#endif

#endif
