// A program in C99 that asks how a query comes to its answer.

#include <surehit/surehit.h>

#include "expect.h"

typedef struct told {
  size_t cells;
  size_t candidates;
  size_t hits;
  size_t in_lists;
  uint32_t first_triangle;
  float first_t;
} told;

static void tell_cell(void* user, size_t index, const surehit_explained_cell* cell) {
  told* const to = (told*)user;
  EXPECT(index == to->cells++ && to->candidates == 0);
  EXPECT(cell->first_candidate + cell->candidate_count >= to->in_lists && cell->enters <= cell->leaves);
  to->in_lists += cell->candidate_count;
}

static void tell_candidate(void* user, size_t index, const surehit_explained_candidate* candidate) {
  told* const to = (told*)user;
  EXPECT(index == to->candidates++ && to->hits == 0);
  EXPECT(candidate->outcome == SUREHIT_PAIR_HIT || candidate->outcome == SUREHIT_PAIR_LEFT_OUT);
  EXPECT((candidate->decided_by == SUREHIT_BY_OPTIONS) == (candidate->outcome == SUREHIT_PAIR_LEFT_OUT));
  if (candidate->has_numbers != 0) EXPECT(candidate->det.value != 0 && candidate->det.bound >= 0);
}

static void tell_hit(void* user, size_t index, const surehit_explained_hitf* hit) {
  told* const to = (told*)user;
  EXPECT(index == to->hits++);
  EXPECT(hit->t_lower <= 0.5 && hit->t_upper >= 0.5);
  EXPECT(hit->ordered_by == (index == 0 ? SUREHIT_ORDER_NOTHING : SUREHIT_ORDER_TRIANGLE));
  if (index > 0) return;
  to->first_triangle = hit->hit.triangle;
  to->first_t = hit->hit.t;
}

int main(void) {
  const float vertices[] = {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  const surehit_meshf mesh = {vertices, 4, 0, triangles, 2, 0, 4};
  const surehit_pathf step = {{5, 5, 1}, {5, 5, -1}, SUREHIT_SEGMENT};
  surehit_query_optionsf options = surehit_query_optionsf_default();
  surehit_colliderf* level = NULL;
  told to = {0, 0, 0, 0, 0, 0};
  surehit_explainerf explainer = {0};
  uint32_t walk = 9;

  EXPECT(surehit_colliderf_create(&mesh, NULL, &level) == SUREHIT_OK);
  explainer.size = sizeof explainer;
  explainer.user = &to;
  EXPECT(surehit_colliderf_explain(level, &step, NULL, &explainer, &walk) == SUREHIT_OK);
  EXPECT(walk == SUREHIT_WALK_ONE_LIST && to.cells == 0);
  explainer.cell = tell_cell;
  explainer.candidate = tell_candidate;
  explainer.hit = tell_hit;
  EXPECT(surehit_colliderf_explain(level, &step, NULL, &explainer, &walk) == SUREHIT_OK);
  EXPECT(to.in_lists <= to.candidates && to.candidates == 2 && to.hits == 2);
  EXPECT(to.first_triangle == 0 && to.first_t == 0.5F);

  to.cells = to.candidates = to.hits = to.in_lists = 0;
  options.ignored_triangle = 0;
  EXPECT(surehit_colliderf_explain(level, &step, &options, &explainer, &walk) == SUREHIT_OK);
  EXPECT(to.hits == 1 && to.first_triangle == 1);

  walk = 9;
  EXPECT(surehit_colliderf_explain(level, &step, NULL, NULL, &walk) == SUREHIT_NULL_POINTER && walk == 9);
  EXPECT(surehit_colliderf_explain(level, &step, NULL, &explainer, NULL) == SUREHIT_NULL_POINTER);
  EXPECT(surehit_colliderf_explain(level, NULL, NULL, &explainer, &walk) == SUREHIT_NULL_POINTER);
  explainer.size = 8;
  EXPECT(surehit_colliderf_explain(level, &step, NULL, &explainer, &walk) == SUREHIT_INVALID_SIZE);
  EXPECT(surehit_colliderf_destroy(level) == SUREHIT_OK);
  return failures;
}
