#pragma once

#include <surehit/surehit.h>

#include <cstddef>

namespace surehit::test {

/// The C interface for a Scalar, under names that are the same for both.
template <typename Scalar>
struct CFunctions;

#define SUREHIT_C_FUNCTIONS(Scalar, s)                                                                  \
  template <>                                                                                           \
  struct CFunctions<Scalar> {                                                                           \
    using ColliderHandle = surehit_collider##s;                                                         \
    using SceneHandle = surehit_scene##s;                                                               \
    using Vector = surehit_vector3##s;                                                                  \
    using Box = surehit_box##s;                                                                         \
    using Triangle = surehit_triangle##s;                                                               \
    using Path = surehit_path##s;                                                                       \
    using Paths = surehit_paths##s;                                                                     \
    using Hit = surehit_hit##s;                                                                         \
    using Mesh = surehit_mesh##s;                                                                       \
    using Options = surehit_query_options##s;                                                           \
    using BatchOptions = surehit_batch_options##s;                                                      \
    using Filter = surehit_filter##s;                                                                   \
    using Shape = surehit_swept_shape##s;                                                               \
    using Sphere = surehit_swept_sphere##s;                                                             \
    using SweptBox = surehit_swept_box##s;                                                              \
    using Capsule = surehit_swept_capsule##s;                                                           \
    using Shapes = surehit_swept_shapes##s;                                                             \
    using ShapeHit = surehit_shape_hit##s;                                                              \
    using ShapeOptions = surehit_shape_query_options##s;                                                \
    using ShapeBatchOptions = surehit_shape_batch_options##s;                                           \
    using ShapeFilter = surehit_shape_filter##s;                                                        \
    using ExplainedHit = surehit_explained_hit##s;                                                      \
    using Explainer = surehit_explainer##s;                                                             \
    using Pose = surehit_pose##s;                                                                       \
    using SceneHit = surehit_scene_hit##s;                                                              \
    using SceneOptions = surehit_scene_query_options##s;                                                \
    using SceneBatchOptions = surehit_scene_batch_options##s;                                           \
    using SceneFilter = surehit_scene_filter##s;                                                        \
    using SceneShapeHit = surehit_scene_shape_hit##s;                                                   \
    using SceneShapeOptions = surehit_scene_shape_query_options##s;                                     \
    using SceneShapeBatchOptions = surehit_scene_shape_batch_options##s;                                \
    using SceneShapeFilter = surehit_scene_shape_filter##s;                                             \
                                                                                                        \
    static constexpr auto default_options = surehit_query_options##s##_default;                         \
    static constexpr auto default_scene_options = surehit_scene_query_options##s##_default;             \
    static constexpr auto default_shape_options = surehit_shape_query_options##s##_default;             \
    static constexpr auto default_scene_shape_options = surehit_scene_shape_query_options##s##_default; \
    static constexpr auto intersect = surehit_triangle##s##_intersect;                                  \
    static constexpr auto max_t_keeping_of_triangle = surehit_triangle##s##_max_t_keeping;              \
    static constexpr auto normal_of_triangle = surehit_triangle##s##_normal;                            \
    static constexpr auto point = surehit_path##s##_point;                                              \
    static constexpr auto distance = surehit_path##s##_distance;                                        \
    static constexpr auto check_mesh = surehit_mesh##s##_check;                                         \
    static constexpr auto box_of_mesh = surehit_mesh##s##_box;                                          \
    static constexpr auto identity = surehit_pose##s##_identity;                                        \
    static constexpr auto rigid = surehit_pose##s##_rigid;                                              \
                                                                                                        \
    /* Colliders. */                                                                                    \
    static constexpr auto create = surehit_collider##s##_create;                                        \
    static constexpr auto copy = surehit_collider##s##_copy;                                            \
    static constexpr auto destroy = surehit_collider##s##_destroy;                                      \
    static constexpr auto build = surehit_collider##s##_build;                                          \
    static constexpr auto rebuild = surehit_collider##s##_rebuild;                                      \
    static constexpr auto rebuild_vertices = surehit_collider##s##_rebuild_vertices;                    \
    static constexpr auto set_mask = surehit_collider##s##_set_mask;                                    \
    static constexpr auto set_masks = surehit_collider##s##_set_masks;                                  \
    static constexpr auto mask = surehit_collider##s##_mask;                                            \
    static constexpr auto first_hit = surehit_collider##s##_first_hit;                                  \
    static constexpr auto any_hit = surehit_collider##s##_any_hit;                                      \
    static constexpr auto all_hits = surehit_collider##s##_all_hits;                                    \
    static constexpr auto first_hits = surehit_collider##s##_first_hits;                                \
    static constexpr auto any_hits = surehit_collider##s##_any_hits;                                    \
    static constexpr auto last_free_point = surehit_collider##s##_last_free_point;                      \
    static constexpr auto max_t_keeping = surehit_collider##s##_max_t_keeping;                          \
    static constexpr auto triangle_count = surehit_collider##s##_triangle_count;                        \
    static constexpr auto triangle = surehit_collider##s##_triangle;                                    \
    static constexpr auto normal = surehit_collider##s##_normal;                                        \
    static constexpr auto box = surehit_collider##s##_box;                                              \
    static constexpr auto grid_summary = surehit_collider##s##_grid_summary;                            \
    static constexpr auto memory_bytes = surehit_collider##s##_memory_bytes;                            \
    static constexpr auto explain = surehit_collider##s##_explain;                                      \
                                                                                                        \
    /* Moving shapes. */                                                                                \
    static constexpr auto shape_first_hit = surehit_collider##s##_shape_first_hit;                      \
    static constexpr auto shape_any_hit = surehit_collider##s##_shape_any_hit;                          \
    static constexpr auto shape_all_hits = surehit_collider##s##_shape_all_hits;                        \
    static constexpr auto shape_first_hits = surehit_collider##s##_shape_first_hits;                    \
    static constexpr auto shape_any_hits = surehit_collider##s##_shape_any_hits;                        \
    static constexpr auto shape_overlaps = surehit_collider##s##_shape_overlaps;                        \
    static constexpr auto shape_last_free_t = surehit_collider##s##_shape_last_free_t;                  \
    static constexpr auto shape_last_free_point = surehit_collider##s##_shape_last_free_point;          \
    static constexpr auto shape_intersect = surehit_triangle##s##_shape_intersect;                      \
    static constexpr auto contact_point = surehit_triangle##s##_shape_contact_point;                    \
    static constexpr auto contact_normal = surehit_triangle##s##_shape_contact_normal;                  \
                                                                                                        \
    /* Scenes. */                                                                                       \
    static constexpr auto create_scene = surehit_scene##s##_create;                                     \
    static constexpr auto destroy_scene = surehit_scene##s##_destroy;                                   \
    static constexpr auto add = surehit_scene##s##_add;                                                 \
    static constexpr auto remove = surehit_scene##s##_remove;                                           \
    static constexpr auto set_collider = surehit_scene##s##_set_collider;                               \
    static constexpr auto set_pose = surehit_scene##s##_set_pose;                                       \
    static constexpr auto set_motion = surehit_scene##s##_set_motion;                                   \
    static constexpr auto set_instance_mask = surehit_scene##s##_set_mask;                              \
    static constexpr auto commit = surehit_scene##s##_commit;                                           \
    static constexpr auto snapshot = surehit_scene##s##_snapshot;                                       \
    static constexpr auto instance_count = surehit_scene##s##_instance_count;                           \
    static constexpr auto contains = surehit_scene##s##_contains;                                       \
    static constexpr auto instances = surehit_scene##s##_instances;                                     \
    static constexpr auto pose = surehit_scene##s##_pose;                                               \
    static constexpr auto motion = surehit_scene##s##_motion;                                           \
    static constexpr auto instance_mask = surehit_scene##s##_mask;                                      \
    static constexpr auto user_data = surehit_scene##s##_user_data;                                     \
    static constexpr auto instance_triangle_count = surehit_scene##s##_triangle_count;                  \
    static constexpr auto placed_triangle = surehit_scene##s##_triangle;                                \
    static constexpr auto placed_normal = surehit_scene##s##_normal;                                    \
    static constexpr auto scene_box = surehit_scene##s##_box;                                           \
    static constexpr auto scene_memory_bytes = surehit_scene##s##_memory_bytes;                         \
    static constexpr auto scene_first_hit = surehit_scene##s##_first_hit;                               \
    static constexpr auto scene_any_hit = surehit_scene##s##_any_hit;                                   \
    static constexpr auto scene_all_hits = surehit_scene##s##_all_hits;                                 \
    static constexpr auto scene_first_hits = surehit_scene##s##_first_hits;                             \
    static constexpr auto scene_any_hits = surehit_scene##s##_any_hits;                                 \
    static constexpr auto scene_last_free_point = surehit_scene##s##_last_free_point;                   \
                                                                                                        \
    /* Moving shapes in scenes. */                                                                      \
    static constexpr auto scene_shape_first_hit = surehit_scene##s##_shape_first_hit;                   \
    static constexpr auto scene_shape_any_hit = surehit_scene##s##_shape_any_hit;                       \
    static constexpr auto scene_shape_all_hits = surehit_scene##s##_shape_all_hits;                     \
    static constexpr auto scene_shape_first_hits = surehit_scene##s##_shape_first_hits;                 \
    static constexpr auto scene_shape_any_hits = surehit_scene##s##_shape_any_hits;                     \
    static constexpr auto scene_shape_overlaps = surehit_scene##s##_shape_overlaps;                     \
    static constexpr auto scene_shape_last_free_t = surehit_scene##s##_shape_last_free_t;               \
    static constexpr auto scene_shape_last_free_point = surehit_scene##s##_shape_last_free_point;       \
    static constexpr auto scene_contact_point = surehit_scene##s##_shape_contact_point;                 \
    static constexpr auto scene_contact_normal = surehit_scene##s##_shape_contact_normal;               \
  };
SUREHIT_C_FUNCTIONS(float, f)
SUREHIT_C_FUNCTIONS(double, d)
#undef SUREHIT_C_FUNCTIONS

}  // namespace surehit::test
