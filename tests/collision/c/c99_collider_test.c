// A program in C99 that asks colliders all that they can be asked.

#include <string.h>
#include <surehit/surehit.h>

#include "expect.h"

static const double nothing = 0;

static const float floor_vertices[] = {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0};
static const uint32_t floor_triangles[] = {0, 1, 2, 0, 2, 3};
static const uint16_t small_triangles[] = {0, 1, 2, 0, 2, 3};

static surehit_meshf floor_mesh(void) {
  surehit_meshf mesh = {floor_vertices, 4, 0, floor_triangles, 2, 0, 4};
  return mesh;
}

static surehit_pathf segment(float x, float y, float high, float low) {
  surehit_pathf path = {{x, y, high}, {x, y, low}, SUREHIT_SEGMENT};
  return path;
}

static void single_queries(const surehit_colliderf* level) {
  const surehit_pathf down = segment(5, 5, 1, -1);
  const surehit_pathf beside = segment(11, 5, 1, -1);
  surehit_query_optionsf options = surehit_query_optionsf_default();
  surehit_statistics statistics = {0};
  surehit_hitf hit;
  surehit_hitf hits[3];
  surehit_vector3f point;
  size_t count = 0;
  uint8_t blocked = 2;
  float max_t = 0;

  EXPECT(surehit_colliderf_first_hit(level, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.t == 0.5F && hit.triangle == 0 && hit.side == SUREHIT_FRONT);
  options.ignored_triangle = 0;
  statistics.size = sizeof statistics;
  EXPECT(surehit_colliderf_first_hit(level, &down, &options, NULL, &statistics, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 1 && statistics.paths == 1);
  EXPECT(surehit_colliderf_first_hit(level, &beside, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE);

  EXPECT(surehit_colliderf_any_hit(level, &down, NULL, NULL, NULL, &blocked) == SUREHIT_OK && blocked == 1);
  EXPECT(surehit_colliderf_any_hit(level, &beside, NULL, NULL, NULL, &blocked) == SUREHIT_OK && blocked == 0);

  EXPECT(surehit_colliderf_all_hits(level, &down, NULL, NULL, NULL, hits, 3, &count) == SUREHIT_OK);
  EXPECT(count == 2 && hits[0].triangle == 0 && hits[1].triangle == 1);
  hits[1].triangle = 7;
  EXPECT(surehit_colliderf_all_hits(level, &down, NULL, NULL, NULL, hits, 1, &count) == SUREHIT_OK);
  EXPECT(count == 2 && hits[1].triangle == 7);
  EXPECT(surehit_colliderf_all_hits(level, &down, NULL, NULL, NULL, NULL, 0, &count) == SUREHIT_OK && count == 2);

  EXPECT(surehit_colliderf_first_hit(level, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(surehit_colliderf_last_free_point(level, &down, &hit, NULL, NULL, &point) == SUREHIT_OK);
  EXPECT(point.x == 5 && point.y == 5 && point.z > 0 && point.z < 0.001F);
  EXPECT(surehit_colliderf_max_t_keeping(level, &down, &hit, &max_t) == SUREHIT_OK && max_t == 0.5F);
}

static void batches(const surehit_colliderf* level) {
  // Numbers of a path side by side, points in two arrays, and points of a polyline.
  const float packed[] = {5, 5, 1, 5, 5, -1, 11, 5, 1, 11, 5, -1};
  const float starts[] = {5, 5, 1, 11, 5, 1};
  const float ends[] = {5, 5, -1, 11, 5, -1};
  const float polyline[] = {5, 5, 1, 5, 5, -1, 6, 6, 1};
  const surehit_pathsf paths[] = {{packed, NULL, 2, 0, 0, SUREHIT_SEGMENT}, {starts, ends, 2, 0, 0, SUREHIT_SEGMENT}};
  const surehit_pathsf corners = {polyline, polyline + 3, 2, 3 * sizeof(float), 0, SUREHIT_SEGMENT};
  const surehit_pathsf none = {NULL, NULL, 0, 0, 0, SUREHIT_RAY};
  surehit_query_optionsf own[2];
  surehit_batch_optionsf options = {0};
  surehit_statistics statistics = {0};
  surehit_hitf hits[2];
  uint8_t blocked[2];
  size_t i = 0;

  for (i = 0; i < 2; ++i) {
    EXPECT(surehit_colliderf_first_hits(level, &paths[i], NULL, hits) == SUREHIT_OK);
    EXPECT(hits[0].triangle == 0 && hits[0].t == 0.5F && hits[1].triangle == SUREHIT_NO_TRIANGLE);
    EXPECT(surehit_colliderf_any_hits(level, &paths[i], NULL, blocked) == SUREHIT_OK);
    EXPECT(blocked[0] == 1 && blocked[1] == 0);
  }
  EXPECT(surehit_colliderf_first_hits(level, &none, NULL, NULL) == SUREHIT_OK);
  EXPECT(surehit_colliderf_first_hits(level, &corners, NULL, hits) == SUREHIT_OK);
  EXPECT(hits[0].side == SUREHIT_FRONT && hits[1].side == SUREHIT_BACK);

  own[0] = own[1] = surehit_query_optionsf_default();
  own[0].culling = SUREHIT_CULL_FRONT;
  statistics.size = sizeof statistics;
  options.size = sizeof options;
  options.path_options = own;
  options.statistics = &statistics;
  EXPECT(surehit_colliderf_any_hits(level, &corners, &options, blocked) == SUREHIT_OK);
  EXPECT(blocked[0] == 0 && blocked[1] == 1 && statistics.paths == 2);
}

static void changes(void) {
  const uint32_t masks[] = {1, 2};
  const float raised[] = {0, 0, 0.5F, 10, 0, 0.5F, 10, 10, 0.5F, 0, 10, 0.5F};
  const surehit_pathf down = segment(2, 1, 1, -1);
  surehit_meshf mesh = floor_mesh();
  surehit_build_options build = {0};
  surehit_grid_summary grid = {0};
  surehit_colliderf* level = NULL;
  surehit_colliderf* copy = NULL;
  surehit_trianglef corners;
  surehit_vector3f normal;
  surehit_boxf box;
  surehit_hitf hit;
  uint32_t mask = 0;
  size_t number = 0;

  EXPECT(surehit_colliderf_create(NULL, NULL, &level) == SUREHIT_OK);
  EXPECT(surehit_colliderf_triangle_count(level, &number) == SUREHIT_OK && number == 0);
  build.size = sizeof build;
  build.masks = masks;
  build.mask_count = 2;
  mesh.triangles = small_triangles;
  mesh.index_size = 2;
  EXPECT(surehit_colliderf_build(level, &mesh, &build) == SUREHIT_OK);
  EXPECT(surehit_colliderf_triangle_count(level, &number) == SUREHIT_OK && number == 2);
  EXPECT(surehit_colliderf_mask(level, 1, &mask) == SUREHIT_OK && mask == 2);
  EXPECT(surehit_colliderf_set_mask(level, 0, 0) == SUREHIT_OK);
  EXPECT(surehit_colliderf_first_hit(level, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == SUREHIT_NO_TRIANGLE);
  EXPECT(surehit_colliderf_set_masks(level, NULL, 0) == SUREHIT_OK);
  EXPECT(surehit_colliderf_rebuild_vertices(level, raised, 4, 0, NULL) == SUREHIT_OK);
  EXPECT(surehit_colliderf_first_hit(level, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 0 && hit.t == 0.25F);
  EXPECT(surehit_colliderf_copy(level, &copy) == SUREHIT_OK);
  mesh = floor_mesh();
  EXPECT(surehit_colliderf_rebuild(level, &mesh, NULL) == SUREHIT_OK);
  EXPECT(surehit_colliderf_box(level, &box) == SUREHIT_OK && box.high.x == 10 && box.high.z == 0);
  EXPECT(surehit_colliderf_box(copy, &box) == SUREHIT_OK && box.high.z == 0.5F);
  EXPECT(surehit_colliderf_triangle(level, 1, &corners) == SUREHIT_OK && corners.c.y == 10);
  EXPECT(surehit_colliderf_normal(level, 1, &normal) == SUREHIT_OK && normal.z == 1);
  grid.size = sizeof grid;
  EXPECT(surehit_colliderf_grid_summary(level, &grid) == SUREHIT_OK && grid.entries >= 2);
  EXPECT(surehit_colliderf_memory_bytes(level, &number) == SUREHIT_OK && number > 0);
  EXPECT(surehit_colliderf_destroy(copy) == SUREHIT_OK);
  EXPECT(surehit_colliderf_destroy(level) == SUREHIT_OK);
  EXPECT(surehit_colliderf_destroy(NULL) == SUREHIT_OK);
}

static void doubles(void) {
  const double vertices[] = {0, 0, 0, 1e300, 0, 0, 0, 1e300, 0};
  const surehit_meshd mesh = {vertices, 3, 0, floor_triangles, 1, 0, 0};
  const surehit_pathd ray = {{1, 1, 1e-300}, {0, 0, -1e-300}, SUREHIT_RAY};
  surehit_colliderd* level = NULL;
  surehit_hitd hit;
  EXPECT(surehit_colliderd_create(&mesh, NULL, &level) == SUREHIT_OK);
  EXPECT(surehit_colliderd_first_hit(level, &ray, NULL, NULL, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 0 && hit.t == 1);
  EXPECT(surehit_colliderd_destroy(level) == SUREHIT_OK);
}

static void pairs(void) {
  const surehit_trianglef triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const surehit_pathf down = segment(1, 2, 1, -1);
  surehit_meshf mesh = floor_mesh();
  surehit_hitf hit;
  surehit_vector3f vector;
  surehit_boxf box;
  float number = 0;
  EXPECT(surehit_trianglef_intersect(&triangle, &down, NULL, &hit) == SUREHIT_OK);
  EXPECT(hit.triangle == 0 && hit.t == 0.5F && hit.u == 0.25F && hit.v == 0.5F);
  EXPECT(surehit_trianglef_max_t_keeping(&triangle, &down, &hit, &number) == SUREHIT_OK && number == 0.5F);
  EXPECT(surehit_trianglef_normal(&triangle, &vector) == SUREHIT_OK && vector.z == 1);
  EXPECT(surehit_pathf_point(&down, &hit, &vector) == SUREHIT_OK && vector.y == 2 && vector.z == 0);
  EXPECT(surehit_pathf_distance(&down, &hit, &number) == SUREHIT_OK && number == 1);
  EXPECT(surehit_meshf_check(&mesh) == SUREHIT_OK);
  EXPECT(surehit_meshf_box(&mesh, &box) == SUREHIT_OK && box.low.x == 0 && box.high.y == 10);
}

static void errors(surehit_colliderf* level) {
  const float bad_vertices[] = {0, 0, 0, 1, 0, 0, 0, (float)(0 / nothing), 0};
  const surehit_pathf down = segment(5, 5, 1, -1);
  surehit_meshf mesh = floor_mesh();
  surehit_hitf hit;
  mesh.vertices = bad_vertices;
  mesh.vertex_count = 3;
  mesh.triangle_count = 1;
  EXPECT(surehit_colliderf_build(level, &mesh, NULL) == SUREHIT_NON_FINITE_VERTEX);
  EXPECT(surehit_last_error_status() == SUREHIT_NON_FINITE_VERTEX && surehit_last_error_element() == 2);
  EXPECT(strstr(surehit_last_error(), "surehit_colliderf_build: vertex 2: y is ") == surehit_last_error());
  EXPECT(surehit_colliderf_first_hit(NULL, &down, NULL, NULL, NULL, &hit) == SUREHIT_NULL_POINTER);
  EXPECT(strcmp(surehit_last_error(), "surehit_colliderf_first_hit: collider is null") == 0);
  EXPECT(surehit_colliderf_first_hit(level, &down, NULL, NULL, NULL, &hit) == SUREHIT_OK && hit.triangle == 0);
}

int main(void) {
  const surehit_meshf mesh = floor_mesh();
  surehit_colliderf* level = NULL;
  EXPECT(surehit_check_abi(SUREHIT_C_ABI) == SUREHIT_OK);
  EXPECT(surehit_last_error()[0] == 0);
  EXPECT(surehit_version() == 1000000 * SUREHIT_VERSION_MAJOR + 1000 * SUREHIT_VERSION_MINOR + SUREHIT_VERSION_PATCH);
  EXPECT(surehit_colliderf_create(&mesh, NULL, &level) == SUREHIT_OK);
  single_queries(level);
  batches(level);
  changes();
  doubles();
  pairs();
  errors(level);
  EXPECT(surehit_colliderf_destroy(level) == SUREHIT_OK);
  EXPECT(surehit_colliderf_destroy(level) == SUREHIT_INVALID_HANDLE);
  return failures;
}
