// A program in C99 that asks scenes about moving shapes.

#include <surehit/surehit.h>

#include "expect.h"

static const float tile_vertices[] = {0, 0, 0, 8, 0, 0, 0, 8, 0};
static const uint32_t tile_triangles[] = {0, 1, 2};

static int32_t accept_instance(void* user, size_t shape, const surehit_scene_shape_hitf* hit) {
  (void)shape;
  return hit->instance.index == *(const uint32_t*)user ? SUREHIT_ACCEPT : SUREHIT_REJECT;
}

static void single_queries(const surehit_scenef* scene, const surehit_instance_id* ids) {
  const surehit_swept_shapef ball = {{2, 1, 3}, {2, 1, -5}, {0, 0, 0}, 1, SUREHIT_SWEPT_SPHERE};
  const surehit_swept_shapef box = {{2, 1, 3}, {2, 1, -5}, {1, 1, 1}, 0, SUREHIT_SWEPT_BOX};
  const surehit_swept_shapef rests = {{2, 1, 1}, {2, 1, 1}, {0, 0, 0}, 1, SUREHIT_SWEPT_SPHERE};
  surehit_scene_shape_query_optionsf options = surehit_scene_shape_query_optionsf_default();
  surehit_scene_shape_filterf filter;
  surehit_scene_shape_hitf hit;
  surehit_scene_shape_hitf hits[2];
  surehit_vector3f point;
  surehit_statistics statistics = {0};
  uint32_t index = ids[1].index;
  uint8_t answer = 2;
  size_t count = 0;
  float t = -1;

  EXPECT(surehit_scenef_shape_first_hit(scene, &ball, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.25F && hit.u == 0.25F && hit.v == 0.125F && hit.feature == SUREHIT_FACE);
  EXPECT(hit.triangle == 0 && hit.started_touching == 0 && hit.instance.index == ids[0].index);
  EXPECT(surehit_scenef_shape_last_free_t(scene, &ball, &hit, &t) == SUREHIT_OK && t < 0.25F && t > 0.2499F);
  EXPECT(surehit_scenef_shape_last_free_point(scene, &ball, &hit, NULL, NULL, &point) == SUREHIT_OK);
  EXPECT(point.x == 2 && point.z > 1 && point.z < 1.0001F);
  EXPECT(surehit_scenef_shape_contact_point(scene, &hit, &point) == SUREHIT_OK);
  EXPECT(point.x == 2 && point.y == 1 && point.z == 0);
  EXPECT(surehit_scenef_shape_contact_normal(scene, &ball, &hit, &point) == SUREHIT_OK);
  EXPECT(point.x == 0 && point.y == 0 && point.z == 1);
  EXPECT(surehit_scenef_shape_first_hit(scene, &box, NULL, NULL, NULL, &hit) == SUREHIT_OK && hit.t == 0.25F);

  options.ignored_instance = ids[0];
  EXPECT(surehit_scenef_shape_first_hit(scene, &ball, &options, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.5F && hit.instance.index == ids[1].index);
  options.instance_mask = 1;
  EXPECT(surehit_scenef_shape_first_hit(scene, &ball, &options, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE && hit.instance.index == SUREHIT_NO_INSTANCE);

  filter.accept = accept_instance;
  filter.user = &index;
  statistics.size = sizeof statistics;
  EXPECT(surehit_scenef_shape_any_hit(scene, &ball, NULL, &filter, &statistics, &answer) == SUREHIT_OK);
  EXPECT(answer == 1 && statistics.paths == 1 && statistics.instances == 2);
  EXPECT(surehit_scenef_shape_all_hits(scene, &ball, NULL, NULL, NULL, hits, 2, &count) == SUREHIT_OK && count == 2);
  EXPECT(hits[0].instance.index == ids[0].index && hits[1].instance.index == ids[1].index);
  EXPECT(surehit_scenef_shape_overlaps(scene, &rests, NULL, NULL, NULL, &answer) == SUREHIT_OK && answer == 1);
  EXPECT(surehit_scenef_shape_overlaps(scene, &rests, NULL, &filter, NULL, &answer) == SUREHIT_OK && answer == 0);
  EXPECT(surehit_scenef_shape_overlaps(scene, &ball, NULL, NULL, NULL, &answer) == SUREHIT_OK && answer == 0);
}

static void batches(const surehit_scenef* scene) {
  const surehit_swept_capsulef capsules[] = {{{2, 1, 4}, {2, 1, -4}, {0, 0, 1}, 1},
                                             {{20, 1, 4}, {20, 1, 0}, {0, 0, 1}, 1}};
  const surehit_swept_shapesf shapes = {&capsules[0].start.x, 2, SUREHIT_SWEPT_CAPSULE};
  surehit_scene_shape_query_optionsf own[2];
  surehit_scene_shape_batch_optionsf options = {0};
  surehit_scene_shape_hitf hits[2];
  uint8_t blocked[2] = {2, 2};

  EXPECT(surehit_scenef_shape_first_hits(scene, &shapes, NULL, hits) == SUREHIT_OK);
  EXPECT(hits[0].t == 0.25F && hits[1].triangle == SUREHIT_NO_TRIANGLE);
  own[0] = own[1] = surehit_scene_shape_query_optionsf_default();
  own[0].max_t = 0.125F;
  options.size = sizeof options;
  options.path_options = own;
  EXPECT(surehit_scenef_shape_any_hits(scene, &shapes, &options, blocked) == SUREHIT_OK);
  EXPECT(blocked[0] == 0 && blocked[1] == 0);
}

/// A lift that comes up to a ball at rest.
static void moving_instance(surehit_colliderf* tile) {
  const surehit_swept_shaped rests = {{2, 1, 3}, {2, 1, 3}, {0, 0, 0}, 1, SUREHIT_SWEPT_SPHERE};
  const surehit_vector3d up = {0, 0, 4};
  surehit_scene_shape_hitd hit;
  surehit_vector3d point;
  surehit_scened* scene = NULL;
  surehit_instance_id id;
  EXPECT(surehit_scened_create(&scene) == SUREHIT_OK);
  EXPECT(surehit_scened_add_colliderf(scene, tile, NULL, SUREHIT_ALL_BITS, 0, &id) == SUREHIT_OK);
  EXPECT(surehit_scened_set_motion(scene, id, &up) == SUREHIT_OK);
  EXPECT(surehit_scened_commit(scene, NULL) == SUREHIT_OK);
  EXPECT(surehit_scened_shape_first_hit(scene, &rests, NULL, NULL, NULL, &hit) == SUREHIT_OK && hit.t == 0.5);
  EXPECT(surehit_scened_shape_contact_point(scene, &hit, &point) == SUREHIT_OK && point.z == 2);
  EXPECT(surehit_scened_shape_contact_normal(scene, &rests, &hit, &point) == SUREHIT_OK && point.z == 1);
  EXPECT(surehit_scened_destroy(scene) == SUREHIT_OK);
}

int main(void) {
  const surehit_meshf mesh = {tile_vertices, 3, 0, tile_triangles, 1, 0, 4};
  surehit_posef pose = surehit_posef_identity();
  surehit_colliderf* tile = NULL;
  surehit_scenef* scene = NULL;
  surehit_instance_id ids[2];

  EXPECT(surehit_colliderf_create(&mesh, NULL, &tile) == SUREHIT_OK);
  EXPECT(surehit_scenef_create(&scene) == SUREHIT_OK);
  EXPECT(surehit_scenef_add(scene, tile, NULL, SUREHIT_ALL_BITS, 0, &ids[0]) == SUREHIT_OK);
  pose.translation.z = -2;
  EXPECT(surehit_scenef_add(scene, tile, &pose, 2, 0, &ids[1]) == SUREHIT_OK);
  EXPECT(surehit_scenef_commit(scene, NULL) == SUREHIT_OK);
  single_queries(scene, ids);
  batches(scene);
  moving_instance(tile);
  EXPECT(surehit_scenef_destroy(scene) == SUREHIT_OK);
  EXPECT(surehit_colliderf_destroy(tile) == SUREHIT_OK);
  return failures;
}
