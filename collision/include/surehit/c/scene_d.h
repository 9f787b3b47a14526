#ifndef SUREHIT_C_SCENE_D_H
#define SUREHIT_C_SCENE_D_H

/// @file
/// Scenes of the C interface in double.

#include "surehit/c/collider_d.h"
#include "surehit/c/scene_values_d.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Many meshes, placed and moving, that are asked as one. An instance is the exact image of its mesh under its pose.
/// Among hits with equal exact t, the lowest instance index comes first, and then the lowest triangle id.
///
/// Changes take effect with the next commit. Until then, queries answer as before. Functions that tell about one
/// instance tell what was set last. They fail with `SUREHIT_STALE_ID` if the id is not that of an instance.
typedef struct surehit_scened surehit_scened;

/// Makes a scene without instances, and sets `scene` to it. Destroy it with `surehit_scened_destroy`.
SUREHIT_C_API surehit_status surehit_scened_create(surehit_scened** scene);

/// Frees a scene or a snapshot, and gives up its share of the colliders. None of its queries may run. Null is allowed.
/// It fails as `surehit_colliderd_destroy` does.
SUREHIT_C_API surehit_status surehit_scened_destroy(surehit_scened* scene);

/// Adds an instance of a collider, and sets `id` to its id. Without a pose, which is null then, the mesh stays where it
/// is. `mask` is for `instance_mask` of the options, and `SUREHIT_ALL_BITS` is usual. `user_data` is any number of
/// yours.
///
/// Fails with a status of 200 to 299 if the pose is invalid, or with `SUREHIT_OUT_OF_MEMORY`. The scene is then as
/// before. The collider may be rebuilt later. Then no query may run until the next commit.
SUREHIT_C_API surehit_status surehit_scened_add(surehit_scened* scene, const surehit_colliderd* collider,
                                                const surehit_posed* pose, uint32_t mask, uint64_t user_data,
                                                surehit_instance_id* id);

/// Removes an instance. Its collider stays until the commit.
SUREHIT_C_API surehit_status surehit_scened_remove(surehit_scened* scene, surehit_instance_id id);

/// Gives an instance another collider. Its id, pose, motion, mask and user data stay. Ask about the triangles of
/// earlier hits before this, because they are those of the other mesh.
SUREHIT_C_API surehit_status surehit_scened_set_collider(surehit_scened* scene, surehit_instance_id id,
                                                         const surehit_colliderd* collider);

/// Sets the pose of an instance. Does not end its motion. Fails as `surehit_scened_add` does.
SUREHIT_C_API surehit_status surehit_scened_set_pose(surehit_scened* scene, surehit_instance_id id,
                                                     const surehit_posed* pose);

/// Sets the motion of an instance. At parameter t of a segment, the instance is at its pose plus t times the motion.
/// Moving shapes see the motion too. Rays and lines see the instance at its pose. The motion stays until it is set
/// again. Zero ends it.
///
/// Fails with `SUREHIT_NON_FINITE_MOTION`.
SUREHIT_C_API surehit_status surehit_scened_set_motion(surehit_scened* scene, surehit_instance_id id,
                                                       const surehit_vector3d* motion);

/// Sets the mask of an instance.
SUREHIT_C_API surehit_status surehit_scened_set_mask(surehit_scened* scene, surehit_instance_id id, uint32_t mask);

/// Lets all changes since the last commit take effect. No query may run at the same time. Takes time linear in the
/// changes, and in the instances with a small constant.
SUREHIT_C_API surehit_status surehit_scened_commit(surehit_scened* scene, const surehit_executor* executor);

/// Sets `snapshot` to a new handle of what the scene has committed. Destroy it with `surehit_scened_destroy`. It is
/// fast, because it copies no instance. It may not run while the scene commits.
///
/// A snapshot stays the same while the scene is changed, committed or destroyed in another thread, and it may be asked
/// meanwhile. All functions that take a constant scene take a snapshot, except for `surehit_scened_memory_bytes`. They
/// tell what was committed. A snapshot of a snapshot has the same state. All other functions fail with
/// `SUREHIT_INVALID_HANDLE`.
///
/// It shares the colliders with the scene. No query of a snapshot may run while one of its colliders is rebuilt or gets
/// other masks. After a rebuild, no query of an older snapshot may run at all.
SUREHIT_C_API surehit_status surehit_scened_snapshot(const surehit_scened* scene, surehit_scened** snapshot);

/// Sets `count` to the number of instances, with those that are not yet committed.
SUREHIT_C_API surehit_status surehit_scened_instance_count(const surehit_scened* scene, size_t* count);

/// Sets `is_there` to 1 if the id is that of an instance, and to 0 otherwise.
SUREHIT_C_API surehit_status surehit_scened_contains(const surehit_scened* scene, surehit_instance_id id,
                                                     uint8_t* is_there);

/// Sets `id_count` to the number of instances, and `ids` to the first `capacity` of their ids, in order. `ids` may be
/// null if `capacity` is 0.
SUREHIT_C_API surehit_status surehit_scened_instances(const surehit_scened* scene, surehit_instance_id* ids,
                                                      size_t capacity, size_t* id_count);

/// Sets `pose` to the pose of an instance.
SUREHIT_C_API surehit_status surehit_scened_pose(const surehit_scened* scene, surehit_instance_id id,
                                                 surehit_posed* pose);

/// Sets `motion` to the motion of an instance. It is zero if none was set.
SUREHIT_C_API surehit_status surehit_scened_motion(const surehit_scened* scene, surehit_instance_id id,
                                                   surehit_vector3d* motion);

/// Sets `mask` to the mask of an instance.
SUREHIT_C_API surehit_status surehit_scened_mask(const surehit_scened* scene, surehit_instance_id id, uint32_t* mask);

/// Sets `user_data` to the number that was given when the instance was added.
SUREHIT_C_API surehit_status surehit_scened_user_data(const surehit_scened* scene, surehit_instance_id id,
                                                      uint64_t* user_data);

/// Sets `count` to the number of triangles of the instance's collider.
SUREHIT_C_API surehit_status surehit_scened_triangle_count(const surehit_scened* scene, surehit_instance_id id,
                                                           size_t* count);

/// Sets `triangle` to the corners of a placed triangle at t = 0. Each coordinate is the exact one, rounded once.
SUREHIT_C_API surehit_status surehit_scened_triangle(const surehit_scened* scene, surehit_instance_id id,
                                                     uint32_t triangle_id, surehit_triangled* triangle);

/// Sets `normal` to the unit normal of a placed triangle, within 2 ulp(1). It is that of the exact image.
SUREHIT_C_API surehit_status surehit_scened_normal(const surehit_scened* scene, surehit_instance_id id,
                                                   uint32_t triangle_id, surehit_vector3d* normal);

/// Sets `box` to a box around all committed instances, and around their ways during the step. It may be larger than
/// needed. It is empty if there are no triangles.
SUREHIT_C_API surehit_status surehit_scened_box(const surehit_scened* scene, surehit_boxd* box);

/// Sets `bytes` to the memory that the scene has allocated, without its colliders. A snapshot cannot be asked.
SUREHIT_C_API surehit_status surehit_scened_memory_bytes(const surehit_scened* scene, size_t* bytes);

/// Sets `hit` to the hit with the lowest exact t, see `surehit_colliderd_first_hit`.
SUREHIT_C_API surehit_status surehit_scened_first_hit(const surehit_scened* scene, const surehit_pathd* path,
                                                      const surehit_scene_query_optionsd* options,
                                                      const surehit_scene_filterd* filter,
                                                      surehit_statistics* statistics, surehit_scene_hitd* hit);

/// Sets `blocked` to 1 if the path has a hit, and to 0 otherwise, see `surehit_colliderd_any_hit`.
SUREHIT_C_API surehit_status surehit_scened_any_hit(const surehit_scened* scene, const surehit_pathd* path,
                                                    const surehit_scene_query_optionsd* options,
                                                    const surehit_scene_filterd* filter, surehit_statistics* statistics,
                                                    uint8_t* blocked);

/// Sets `hits` to the hits of all placed triangles that the path meets, in order, see `surehit_colliderd_all_hits`.
SUREHIT_C_API surehit_status surehit_scened_all_hits(const surehit_scened* scene, const surehit_pathd* path,
                                                     const surehit_scene_query_optionsd* options,
                                                     const surehit_scene_filterd* filter,
                                                     surehit_statistics* statistics, surehit_scene_hitd* hits,
                                                     size_t capacity, size_t* hit_count);

/// Sets `hits[i]` to the first hit of path i, see `surehit_colliderd_first_hits`.
SUREHIT_C_API surehit_status surehit_scened_first_hits(const surehit_scened* scene, const surehit_pathsd* paths,
                                                       const surehit_scene_batch_optionsd* options,
                                                       surehit_scene_hitd* hits);

/// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise.
SUREHIT_C_API surehit_status surehit_scened_any_hits(const surehit_scened* scene, const surehit_pathsd* paths,
                                                     const surehit_scene_batch_optionsd* options, uint8_t* blocked);

/// Sets `point` to where a point that moves along a segment may stop, see `surehit_colliderd_last_free_point`. A moving
/// instance goes the same share of its way.
SUREHIT_C_API surehit_status surehit_scened_last_free_point(const surehit_scened* scene, const surehit_pathd* segment,
                                                            const surehit_scene_hitd* hit,
                                                            const surehit_scene_query_optionsd* options,
                                                            const surehit_scene_filterd* filter,
                                                            surehit_vector3d* point);

#ifdef __cplusplus
}
#endif

#endif
