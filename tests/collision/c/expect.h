#ifndef SUREHIT_TESTS_EXPECT_H
#define SUREHIT_TESTS_EXPECT_H

#include <stdio.h>

// What a test in C expects. Its main function returns `failures`.

static int failures = 0;

static void expect_that(int holds, const char* what, int line) {
  if (holds) return;
  fprintf(stderr, "line %d does not hold: %s\n", line, what);
  ++failures;
}

#define EXPECT(condition) expect_that((condition) ? 1 : 0, #condition, __LINE__)

#endif
