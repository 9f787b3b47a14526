// A program in C99 that asks colliders about moving shapes.

#include <surehit/surehit.h>

#include "expect.h"

static const float floor_vertices[] = {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0};
static const uint32_t floor_triangles[] = {0, 1, 2, 0, 2, 3};

static surehit_swept_shapef ball(float x, float y, float high, float low) {
  surehit_swept_shapef shape = {{x, y, high}, {x, y, low}, {0, 0, 0}, 1, SUREHIT_SWEPT_SPHERE};
  return shape;
}

static void single_queries(const surehit_colliderf* level) {
  const surehit_swept_shapef falls = ball(5.5F, 5, 3, -1);
  const surehit_swept_shapef rests = ball(5.5F, 5, 1, 1);
  const surehit_swept_shapef beside = ball(12, 4, 3, -1);
  const surehit_trianglef triangle = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  surehit_shape_query_optionsf options = surehit_shape_query_optionsf_default();
  surehit_statistics statistics = {0};
  surehit_shape_hitf hit;
  surehit_shape_hitf hits[2];
  surehit_vector3f point;
  size_t count = 0;
  uint8_t answer = 2;
  float t = -1;

  EXPECT(surehit_colliderf_shape_first_hit(level, &falls, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 0 && hit.t == 0.5F && hit.feature == SUREHIT_FACE && hit.started_touching == 0);
  EXPECT(surehit_colliderf_shape_last_free_t(level, &falls, &hit, &t) == SUREHIT_OK);
  EXPECT(t < 0.5F && t > 0.4999F);
  EXPECT(surehit_colliderf_shape_last_free_point(level, &falls, &hit, NULL, NULL, &point) == SUREHIT_OK);
  EXPECT(point.x == 5.5F && point.z > 1 && point.z < 1.0001F);
  EXPECT(surehit_trianglef_shape_intersect(&triangle, &falls, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 0 && hit.t == 0.5F);
  EXPECT(surehit_trianglef_shape_intersect(&triangle, &beside, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE);

  statistics.size = sizeof statistics;
  EXPECT(surehit_colliderf_shape_any_hit(level, &beside, NULL, NULL, &statistics, &answer) == SUREHIT_OK);
  EXPECT(answer == 0 && statistics.paths == 1);
  EXPECT(surehit_colliderf_shape_overlaps(level, &falls, NULL, NULL, NULL, &answer) == SUREHIT_OK && answer == 0);
  EXPECT(surehit_colliderf_shape_overlaps(level, &rests, NULL, NULL, NULL, &answer) == SUREHIT_OK && answer == 1);
  EXPECT(surehit_colliderf_shape_first_hit(level, &rests, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0 && hit.started_touching == 1);

  EXPECT(surehit_colliderf_shape_all_hits(level, &falls, NULL, NULL, NULL, hits, 2, &count) == SUREHIT_OK);
  EXPECT(count == 2 && hits[0].triangle == 0 && hits[1].triangle == 1 && hits[1].feature != SUREHIT_FACE);
  options.ignored_triangle = 0;
  options.max_t = 0.25F;
  EXPECT(surehit_colliderf_shape_any_hit(level, &falls, &options, NULL, NULL, &answer) == SUREHIT_OK && answer == 0);
}

static void boxes_and_capsules(const surehit_colliderf* level) {
  const surehit_swept_shapef box = {{5.5F, 5, 3}, {5.5F, 5, -1}, {1, 1, 1}, 0, SUREHIT_SWEPT_BOX};
  const surehit_swept_shapef capsule = {{5.5F, 5, 4}, {5.5F, 5, 0}, {0, 0, 1}, 1, SUREHIT_SWEPT_CAPSULE};
  const surehit_swept_boxf boxes[] = {{{5.5F, 5, 3}, {5.5F, 5, -1}, {1, 1, 1}}, {{15, 5, 3}, {15, 5, -1}, {1, 1, 1}}};
  const surehit_swept_capsulef capsules[] = {{{5.5F, 5, 4}, {5.5F, 5, 0}, {0, 0, 1}, 1}};
  const surehit_swept_shapesf shapes = {&boxes[0].start.x, 2, SUREHIT_SWEPT_BOX};
  const surehit_swept_shapesf others = {&capsules[0].start.x, 1, SUREHIT_SWEPT_CAPSULE};
  surehit_shape_hitf hits[2];

  EXPECT(surehit_colliderf_shape_first_hit(level, &box, NULL, NULL, NULL, &hits[0]) == SUREHIT_OK);
  EXPECT(hits[0].t == 0.5F && hits[0].triangle == 0);
  EXPECT(surehit_colliderf_shape_first_hit(level, &capsule, NULL, NULL, NULL, &hits[0]) == SUREHIT_OK);
  EXPECT(hits[0].t == 0.5F && hits[0].triangle == 0);
  EXPECT(surehit_colliderf_shape_first_hits(level, &shapes, NULL, hits) == SUREHIT_OK);
  EXPECT(hits[0].t == 0.5F && hits[1].triangle == SUREHIT_NO_TRIANGLE);
  EXPECT(surehit_colliderf_shape_first_hits(level, &others, NULL, hits) == SUREHIT_OK && hits[0].t == 0.5F);
}

static void batches(const surehit_colliderf* level) {
  const surehit_swept_spheref spheres[] = {{{5.5F, 5, 3}, {5.5F, 5, -1}, 1}, {{12, 4, 3}, {12, 4, -1}, 1}};
  const surehit_swept_shapesf shapes = {&spheres[0].start.x, 2, SUREHIT_SWEPT_SPHERE};
  const surehit_swept_shapesf none = {NULL, 0, SUREHIT_SWEPT_SPHERE};
  surehit_shape_query_optionsf own[2];
  surehit_shape_batch_optionsf options = {0};
  surehit_shape_hitf hits[2];
  uint8_t blocked[2];

  EXPECT(surehit_colliderf_shape_first_hits(level, &shapes, NULL, hits) == SUREHIT_OK);
  EXPECT(hits[0].triangle == 0 && hits[0].t == 0.5F && hits[1].triangle == SUREHIT_NO_TRIANGLE);
  EXPECT(surehit_colliderf_shape_any_hits(level, &shapes, NULL, blocked) == SUREHIT_OK);
  EXPECT(blocked[0] == 1 && blocked[1] == 0);
  EXPECT(surehit_colliderf_shape_first_hits(level, &none, NULL, NULL) == SUREHIT_OK);

  own[0] = own[1] = surehit_shape_query_optionsf_default();
  own[0].culling = SUREHIT_CULL_FRONT;
  options.size = sizeof options;
  options.path_options = own;
  EXPECT(surehit_colliderf_shape_any_hits(level, &shapes, &options, blocked) == SUREHIT_OK && blocked[0] == 0);
}

int main(void) {
  const surehit_meshf mesh = {floor_vertices, 4, 0, floor_triangles, 2, 0, 4};
  surehit_colliderf* level = NULL;

  EXPECT(surehit_colliderf_create(&mesh, NULL, &level) == SUREHIT_OK);
  single_queries(level);
  boxes_and_capsules(level);
  batches(level);
  EXPECT(surehit_colliderf_destroy(level) == SUREHIT_OK);
  return failures;
}
