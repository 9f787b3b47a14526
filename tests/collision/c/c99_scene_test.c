// A program in C99 that asks scenes all that they can be asked.

#include <surehit/surehit.h>

#include "expect.h"

static const float tile_vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const uint32_t tile_triangles[] = {0, 1, 2};

static surehit_colliderf* make_tile(void) {
  const surehit_meshf mesh = {tile_vertices, 3, 0, tile_triangles, 1, 0, 4};
  surehit_colliderf* tile = NULL;
  EXPECT(surehit_colliderf_create(&mesh, NULL, &tile) == SUREHIT_OK);
  return tile;
}

static int32_t accept_instance(void* user, size_t path, const surehit_scene_hitf* hit) {
  (void)path;
  return hit->instance.index == *(const uint32_t*)user ? SUREHIT_ACCEPT : SUREHIT_REJECT;
}

static void instances(surehit_scenef* scene, surehit_colliderf* tile) {
  const surehit_vector3f up = {0, 0, 0.5F};
  surehit_posef pose = surehit_posef_identity();
  surehit_instance_id ids[2];
  surehit_instance_id all[2];
  surehit_vector3f vector;
  surehit_trianglef corners;
  surehit_boxf box;
  uint64_t user_data = 0;
  uint32_t mask = 0;
  uint8_t is_there = 0;
  size_t number = 0;

  EXPECT(surehit_scenef_add(scene, tile, NULL, SUREHIT_ALL_BITS, 7, &ids[0]) == SUREHIT_OK);
  pose.translation.z = -1;
  EXPECT(surehit_scenef_add(scene, tile, &pose, 2, 8, &ids[1]) == SUREHIT_OK);
  EXPECT(surehit_scenef_instance_count(scene, &number) == SUREHIT_OK && number == 2);
  EXPECT(surehit_scenef_instances(scene, all, 1, &number) == SUREHIT_OK && number == 2);
  EXPECT(all[0].index == ids[0].index && all[0].generation == ids[0].generation);
  EXPECT(surehit_scenef_pose(scene, ids[1], &pose) == SUREHIT_OK && pose.translation.z == -1 && pose.x_axis.x == 1);
  EXPECT(surehit_scenef_user_data(scene, ids[1], &user_data) == SUREHIT_OK && user_data == 8);
  EXPECT(surehit_scenef_mask(scene, ids[1], &mask) == SUREHIT_OK && mask == 2);
  EXPECT(surehit_scenef_set_mask(scene, ids[1], 3) == SUREHIT_OK);
  EXPECT(surehit_scenef_set_collider(scene, ids[1], tile) == SUREHIT_OK);
  EXPECT(surehit_scenef_mask(scene, ids[1], &mask) == SUREHIT_OK && mask == 3);
  EXPECT(surehit_scenef_set_motion(scene, ids[1], &up) == SUREHIT_OK);
  EXPECT(surehit_scenef_motion(scene, ids[1], &vector) == SUREHIT_OK && vector.z == 0.5F);
  EXPECT(surehit_scenef_triangle_count(scene, ids[0], &number) == SUREHIT_OK && number == 1);
  EXPECT(surehit_scenef_triangle(scene, ids[1], 0, &corners) == SUREHIT_OK && corners.b.z == -1);
  EXPECT(surehit_scenef_normal(scene, ids[1], 0, &vector) == SUREHIT_OK && vector.z == 1);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scenef_box(scene, &box) == SUREHIT_OK && box.low.z <= -1 && box.high.x >= 1);
  EXPECT(surehit_scenef_memory_bytes(scene, &number) == SUREHIT_OK && number > 0);

  EXPECT(surehit_scenef_remove(scene, ids[0]) == SUREHIT_OK);
  EXPECT(surehit_scenef_contains(scene, ids[0], &is_there) == SUREHIT_OK && is_there == 0);
  EXPECT(surehit_scenef_contains(scene, ids[1], &is_there) == SUREHIT_OK && is_there == 1);
  EXPECT(surehit_scenef_mask(scene, ids[0], &mask) == SUREHIT_STALE_ID);
  EXPECT(surehit_last_error_element() == ids[0].index);
  EXPECT(surehit_scenef_remove(scene, ids[1]) == SUREHIT_OK);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
}

static void queries(surehit_scenef* scene, surehit_colliderf* tile) {
  const surehit_pathf down = {{0.25F, 0.25F, 1}, {0.25F, 0.25F, -3}, SUREHIT_SEGMENT};
  const float numbers[] = {0.25F, 0.25F, 1, 0.25F, 0.25F, -3, 2, 2, 1, 2, 2, -3};
  const surehit_pathsf paths = {numbers, NULL, 2, 0, 0, SUREHIT_SEGMENT};
  const surehit_vector3f shift = {0, 0, -1};
  surehit_scene_query_optionsf options = surehit_scene_query_optionsf_default();
  surehit_scene_query_optionsf own[2];
  surehit_scene_batch_optionsf batch = {0};
  surehit_instance_id ids[2];
  surehit_scene_filterf filter;
  surehit_posef pose = surehit_posef_rigid(0, 0, 0, 1, shift);
  surehit_scene_hitf hit;
  surehit_scene_hitf hits[2];
  surehit_vector3f point;
  uint8_t blocked[2] = {2, 2};
  size_t count = 0;

  EXPECT(surehit_scenef_add(scene, tile, NULL, SUREHIT_ALL_BITS, 0, &ids[0]) == SUREHIT_OK);
  EXPECT(surehit_scenef_add(scene, tile, &pose, 2, 0, &ids[1]) == SUREHIT_OK);
  pose.translation.z = -2;
  EXPECT(surehit_scenef_set_pose(scene, ids[1], &pose) == SUREHIT_OK);
  EXPECT(surehit_scenef_first_hit(scene, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE && hit.instance.index == SUREHIT_NO_INSTANCE);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);

  EXPECT(surehit_scenef_first_hit(scene, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.25F && hit.triangle == 0 && hit.side == SUREHIT_FRONT && hit.instance.index == ids[0].index);
  EXPECT(surehit_scenef_last_free_point(scene, &down, &hit, NULL, NULL, &point) == SUREHIT_OK);
  EXPECT(point.z > 0 && point.z < 0.001F);
  options.ignored_instance = ids[0];
  EXPECT(surehit_scenef_first_hit(scene, &down, &options, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.75F && hit.instance.index == ids[1].index);
  filter.accept = accept_instance;
  filter.user = &ids[1].index;
  EXPECT(surehit_scenef_first_hit(scene, &down, NULL, &filter, NULL, &hit) == SUREHIT_OK && hit.t == 0.75F);
  EXPECT(surehit_scenef_any_hit(scene, &down, NULL, &filter, NULL, blocked) == SUREHIT_OK && blocked[0] == 1);
  EXPECT(surehit_scenef_all_hits(scene, &down, NULL, NULL, NULL, hits, 2, &count) == SUREHIT_OK && count == 2);
  EXPECT(hits[0].instance.index == ids[0].index && hits[1].instance.index == ids[1].index);

  EXPECT(surehit_scenef_first_hits(scene, &paths, NULL, hits) == SUREHIT_OK);
  EXPECT(hits[0].t == 0.25F && hits[1].triangle == SUREHIT_NO_TRIANGLE);
  own[0] = own[1] = options;
  own[0].instance_mask = 1;
  batch.size = sizeof batch;
  batch.path_options = own;
  EXPECT(surehit_scenef_any_hits(scene, &paths, &batch, blocked) == SUREHIT_OK);
  EXPECT(blocked[0] == 0 && blocked[1] == 0);
}

static void snapshots(surehit_scenef* scene, surehit_colliderf* tile) {
  const surehit_pathf down = {{0.25F, 0.25F, 1}, {0.25F, 0.25F, -3}, SUREHIT_SEGMENT};
  surehit_scenef* snapshot = NULL;
  surehit_instance_id id;
  surehit_scene_hitf hit;
  EXPECT(surehit_scenef_add(scene, tile, NULL, SUREHIT_ALL_BITS, 0, &id) == SUREHIT_OK);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scenef_snapshot(scene, &snapshot) == SUREHIT_OK);
  EXPECT(surehit_scenef_remove(scene, id) == SUREHIT_OK);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scenef_first_hit(scene, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE);
  EXPECT(surehit_scenef_first_hit(snapshot, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.25F && hit.instance.index == id.index);
  EXPECT(surehit_scenef_commit(snapshot, NULL) == SUREHIT_INVALID_HANDLE);
  EXPECT(surehit_scenef_destroy(snapshot) == SUREHIT_OK);
}

static void large_world(surehit_colliderf* tile) {
  const surehit_pathd down = {{1e9 + 0.25, 0.25, 1}, {1e9 + 0.25, 0.25, -1}, SUREHIT_SEGMENT};
  surehit_posed pose = surehit_posed_identity();
  surehit_instance_id id;
  surehit_scened* scene = NULL;
  surehit_scene_hitd hit;
  pose.translation.x = 1e9;
  EXPECT(surehit_scened_create(&scene) == SUREHIT_OK);
  EXPECT(surehit_scened_add_colliderf(scene, tile, &pose, SUREHIT_ALL_BITS, 0, &id) == SUREHIT_OK);
  EXPECT(surehit_scened_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scened_first_hit(scene, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.5 && hit.u == 0.25 && hit.v == 0.25);
  EXPECT(surehit_scened_set_colliderf(scene, id, tile) == SUREHIT_OK);
  EXPECT(surehit_scened_destroy(scene) == SUREHIT_OK);
}

static void errors(surehit_scenef* scene, surehit_colliderf* tile) {
  const double zero = 0;
  surehit_posef pose = surehit_posef_identity();
  surehit_instance_id id;
  pose.y_axis.z = (float)(0 / zero);
  EXPECT(surehit_scenef_add(scene, tile, &pose, 1, 0, &id) == SUREHIT_NON_FINITE_POSE);
  EXPECT(surehit_last_error_element() == 5);
  pose.y_axis.z = 1e30F;
  EXPECT(surehit_scenef_add(scene, tile, &pose, 1, 0, &id) == SUREHIT_POSE_OUT_OF_RANGE);
  EXPECT(surehit_last_error_element() == 5);
  pose.y_axis = pose.x_axis;
  EXPECT(surehit_scenef_add(scene, tile, &pose, 1, 0, &id) == SUREHIT_SINGULAR_POSE);
}

int main(void) {
  surehit_colliderf* tile = make_tile();
  surehit_scenef* scene = NULL;
  EXPECT(surehit_scenef_create(&scene) == SUREHIT_OK);
  instances(scene, tile);
  snapshots(scene, tile);
  large_world(tile);
  // A scene keeps its colliders.
  queries(scene, tile);
  errors(scene, tile);
  EXPECT(surehit_colliderf_destroy(tile) == SUREHIT_OK);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scenef_destroy(scene) == SUREHIT_OK);
  EXPECT(surehit_scenef_destroy(scene) == SUREHIT_INVALID_HANDLE);
  return failures;
}
