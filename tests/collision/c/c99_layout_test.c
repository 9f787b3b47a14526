// The sizes and places that programs in other languages rely on, where pointers have 64 bits. A struct with `size` may
// grow at its end, and then these change. No other struct may change.

#include <stddef.h>
#include <stdint.h>
#include <surehit/surehit.h>

#define PIN(name, condition) typedef char pinned_##name[(condition) ? 1 : -1]
#define PIN_SIZE(type, bytes) PIN(size_of_##type, sizeof(type) == (bytes))
#define PIN_PLACE(type, member, bytes) PIN(place_of_##type##_##member, offsetof(type, member) == (bytes))

PIN_SIZE(surehit_status, 4);
PIN_SIZE(surehit_path_kind, 4);
PIN_SIZE(surehit_side, 4);
PIN_SIZE(surehit_culling, 4);
PIN_SIZE(surehit_shape_kind, 4);
PIN_SIZE(surehit_feature, 4);
PIN_SIZE(surehit_verdict, 4);
PIN_SIZE(surehit_instance_id, 8);

PIN_SIZE(surehit_vector3f, 12);
PIN_SIZE(surehit_boxf, 24);
PIN_SIZE(surehit_trianglef, 36);
PIN_SIZE(surehit_pathf, 28);
PIN_PLACE(surehit_pathf, toward, 12);
PIN_PLACE(surehit_pathf, kind, 24);
PIN_SIZE(surehit_hitf, 20);
PIN_PLACE(surehit_hitf, triangle, 12);
PIN_PLACE(surehit_hitf, side, 16);
PIN_SIZE(surehit_query_optionsf, 24);
PIN_PLACE(surehit_query_optionsf, culling, 8);
PIN_PLACE(surehit_query_optionsf, mask, 12);
PIN_PLACE(surehit_query_optionsf, ignored_triangle, 16);
PIN_PLACE(surehit_query_optionsf, ignore_start_contact, 20);
PIN_PLACE(surehit_query_optionsf, ignore_end_contact, 21);
PIN_SIZE(surehit_swept_shapef, 44);
PIN_PLACE(surehit_swept_shapef, half, 24);
PIN_PLACE(surehit_swept_shapef, radius, 36);
PIN_PLACE(surehit_swept_shapef, kind, 40);
PIN_SIZE(surehit_swept_spheref, 28);
PIN_PLACE(surehit_swept_spheref, radius, 24);
PIN_SIZE(surehit_swept_boxf, 36);
PIN_PLACE(surehit_swept_boxf, half_extents, 24);
PIN_SIZE(surehit_swept_capsulef, 40);
PIN_PLACE(surehit_swept_capsulef, half_axis, 24);
PIN_PLACE(surehit_swept_capsulef, radius, 36);
PIN_SIZE(surehit_shape_hitf, 20);
PIN_PLACE(surehit_shape_hitf, triangle, 12);
PIN_PLACE(surehit_shape_hitf, feature, 16);
PIN_PLACE(surehit_shape_hitf, started_touching, 17);
PIN_SIZE(surehit_shape_query_optionsf, 20);
PIN_PLACE(surehit_shape_query_optionsf, culling, 4);
PIN_PLACE(surehit_shape_query_optionsf, mask, 8);
PIN_PLACE(surehit_shape_query_optionsf, ignored_triangle, 12);
PIN_PLACE(surehit_shape_query_optionsf, ignore_start_contact, 16);
PIN_SIZE(surehit_posef, 48);
PIN_PLACE(surehit_posef, translation, 36);
PIN_SIZE(surehit_scene_hitf, 28);
PIN_PLACE(surehit_scene_hitf, instance, 20);
PIN_SIZE(surehit_scene_query_optionsf, 36);
PIN_PLACE(surehit_scene_query_optionsf, instance_mask, 16);
PIN_PLACE(surehit_scene_query_optionsf, ignored_instance, 20);
PIN_PLACE(surehit_scene_query_optionsf, ignored_triangle, 28);
PIN_PLACE(surehit_scene_query_optionsf, ignore_start_contact, 32);
PIN_SIZE(surehit_scene_shape_hitf, 28);
PIN_PLACE(surehit_scene_shape_hitf, feature, 16);
PIN_PLACE(surehit_scene_shape_hitf, started_touching, 17);
PIN_PLACE(surehit_scene_shape_hitf, instance, 20);
PIN_SIZE(surehit_scene_shape_query_optionsf, 32);
PIN_PLACE(surehit_scene_shape_query_optionsf, culling, 4);
PIN_PLACE(surehit_scene_shape_query_optionsf, mask, 8);
PIN_PLACE(surehit_scene_shape_query_optionsf, instance_mask, 12);
PIN_PLACE(surehit_scene_shape_query_optionsf, ignored_instance, 16);
PIN_PLACE(surehit_scene_shape_query_optionsf, ignored_triangle, 24);
PIN_PLACE(surehit_scene_shape_query_optionsf, ignore_start_contact, 28);

PIN_SIZE(surehit_vector3d, 24);
PIN_SIZE(surehit_boxd, 48);
PIN_SIZE(surehit_triangled, 72);
PIN_SIZE(surehit_pathd, 56);
PIN_PLACE(surehit_pathd, toward, 24);
PIN_PLACE(surehit_pathd, kind, 48);
PIN_SIZE(surehit_hitd, 32);
PIN_PLACE(surehit_hitd, triangle, 24);
PIN_PLACE(surehit_hitd, side, 28);
PIN_SIZE(surehit_query_optionsd, 32);
PIN_PLACE(surehit_query_optionsd, culling, 16);
PIN_PLACE(surehit_query_optionsd, mask, 20);
PIN_PLACE(surehit_query_optionsd, ignored_triangle, 24);
PIN_PLACE(surehit_query_optionsd, ignore_start_contact, 28);
PIN_PLACE(surehit_query_optionsd, ignore_end_contact, 29);
PIN_SIZE(surehit_swept_shaped, 88);
PIN_PLACE(surehit_swept_shaped, half, 48);
PIN_PLACE(surehit_swept_shaped, radius, 72);
PIN_PLACE(surehit_swept_shaped, kind, 80);
PIN_SIZE(surehit_swept_sphered, 56);
PIN_PLACE(surehit_swept_sphered, radius, 48);
PIN_SIZE(surehit_swept_boxd, 72);
PIN_PLACE(surehit_swept_boxd, half_extents, 48);
PIN_SIZE(surehit_swept_capsuled, 80);
PIN_PLACE(surehit_swept_capsuled, half_axis, 48);
PIN_PLACE(surehit_swept_capsuled, radius, 72);
PIN_SIZE(surehit_shape_hitd, 32);
PIN_PLACE(surehit_shape_hitd, triangle, 24);
PIN_PLACE(surehit_shape_hitd, feature, 28);
PIN_PLACE(surehit_shape_hitd, started_touching, 29);
PIN_SIZE(surehit_shape_query_optionsd, 24);
PIN_PLACE(surehit_shape_query_optionsd, culling, 8);
PIN_PLACE(surehit_shape_query_optionsd, mask, 12);
PIN_PLACE(surehit_shape_query_optionsd, ignored_triangle, 16);
PIN_PLACE(surehit_shape_query_optionsd, ignore_start_contact, 20);
PIN_SIZE(surehit_posed, 96);
PIN_PLACE(surehit_posed, translation, 72);
PIN_SIZE(surehit_scene_hitd, 40);
PIN_PLACE(surehit_scene_hitd, instance, 32);
PIN_SIZE(surehit_scene_query_optionsd, 48);
PIN_PLACE(surehit_scene_query_optionsd, instance_mask, 24);
PIN_PLACE(surehit_scene_query_optionsd, ignored_instance, 28);
PIN_PLACE(surehit_scene_query_optionsd, ignored_triangle, 36);
PIN_PLACE(surehit_scene_query_optionsd, ignore_start_contact, 40);
PIN_SIZE(surehit_scene_shape_hitd, 40);
PIN_PLACE(surehit_scene_shape_hitd, feature, 28);
PIN_PLACE(surehit_scene_shape_hitd, started_touching, 29);
PIN_PLACE(surehit_scene_shape_hitd, instance, 32);
PIN_SIZE(surehit_scene_shape_query_optionsd, 40);
PIN_PLACE(surehit_scene_shape_query_optionsd, culling, 8);
PIN_PLACE(surehit_scene_shape_query_optionsd, mask, 12);
PIN_PLACE(surehit_scene_shape_query_optionsd, instance_mask, 16);
PIN_PLACE(surehit_scene_shape_query_optionsd, ignored_instance, 20);
PIN_PLACE(surehit_scene_shape_query_optionsd, ignored_triangle, 28);
PIN_PLACE(surehit_scene_shape_query_optionsd, ignore_start_contact, 32);

#if UINTPTR_MAX == UINT64_MAX
PIN_SIZE(surehit_executor, 16);
PIN_SIZE(surehit_statistics, 80);
PIN_PLACE(surehit_statistics, unclipped, 72);
PIN_SIZE(surehit_build_options, 56);
PIN_PLACE(surehit_build_options, masks, 8);
PIN_PLACE(surehit_build_options, executor, 24);
PIN_PLACE(surehit_build_options, cells_per_triangle, 32);
PIN_PLACE(surehit_build_options, crowded, 52);
PIN_SIZE(surehit_grid_summary, 48);
PIN_PLACE(surehit_grid_summary, levels, 44);
PIN_SIZE(surehit_pathsf, 48);
PIN_PLACE(surehit_pathsf, kind, 40);
PIN_SIZE(surehit_meshf, 56);
PIN_PLACE(surehit_meshf, index_size, 48);
PIN_SIZE(surehit_filterf, 16);
PIN_SIZE(surehit_batch_optionsf, 48);
PIN_PLACE(surehit_batch_optionsf, statistics, 40);
PIN_SIZE(surehit_scene_batch_optionsf, 48);
PIN_SIZE(surehit_swept_shapesf, 24);
PIN_PLACE(surehit_swept_shapesf, kind, 16);
PIN_SIZE(surehit_shape_filterf, 16);
PIN_SIZE(surehit_shape_batch_optionsf, 48);
PIN_PLACE(surehit_shape_batch_optionsf, statistics, 40);
PIN_SIZE(surehit_scene_shape_filterf, 16);
PIN_SIZE(surehit_scene_shape_batch_optionsf, 48);
PIN_PLACE(surehit_scene_shape_batch_optionsf, statistics, 40);
PIN_SIZE(surehit_pathsd, 48);
PIN_SIZE(surehit_meshd, 56);
PIN_SIZE(surehit_explained_cell, 88);
PIN_PLACE(surehit_explained_cell, first_candidate, 64);
PIN_PLACE(surehit_explained_cell, is_inner, 81);
PIN_SIZE(surehit_explained_candidate, 88);
PIN_PLACE(surehit_explained_candidate, triangle, 80);
PIN_PLACE(surehit_explained_candidate, outcome, 87);
PIN_SIZE(surehit_explained_hitf, 48);
PIN_PLACE(surehit_explained_hitf, ordered_by, 40);
PIN_SIZE(surehit_explained_hitd, 56);
PIN_SIZE(surehit_explainerf, 40);
PIN_PLACE(surehit_explainerf, user, 32);
PIN_SIZE(surehit_batch_optionsd, 48);
#endif

int main(void) { return 0; }
