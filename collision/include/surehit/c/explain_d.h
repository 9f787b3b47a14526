#ifndef SUREHIT_C_EXPLAIN_D_H
#define SUREHIT_C_EXPLAIN_D_H

/// @file
/// Explanations of queries of the C interface in double.

#include "surehit/c/collider_d.h"
#include "surehit/c/explain.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A hit that the walk comes to.
typedef struct surehit_explained_hitd {
  surehit_hitd hit;                ///< The hit as it is reported.
  double t_lower;                  ///< The exact t is at least this.
  double t_upper;                  ///< The exact t is at most this.
  uint8_t ordered_by;              ///< A `surehit_ordered_by`: why it is not earlier.
  uint8_t is_rounded_by_integers;  ///< 1 if doubles do not decide how t, u and v are rounded.
} surehit_explained_hitd;

/// Tells of the hit with this index.
typedef void (*surehit_tell_hitd)(void* user, size_t index, const surehit_explained_hitd* hit);

/// Who is told how a query comes to its answer. Each function may be null. It is called for one element after the
/// other, first for cells, then for candidates, and then for hits. What a pointer points to lasts for the call alone.
/// The functions must not throw, and must not jump out.
typedef struct surehit_explainerd {
  size_t size;                       ///< The size of this struct.
  surehit_tell_cell cell;            ///< Is told the steps of the walk, in order.
  surehit_tell_candidate candidate;  ///< Is told the triangles that the query asks about, in order.
  surehit_tell_hitd hit;             ///< Is told the hits among the candidates, in order. The first is the path's.
  void* user;                        ///< Anything. The functions get it.
} surehit_explainerd;

/// Explains how `surehit_colliderd_first_hit` comes to its answer without a filter. It is for people who doubt an
/// answer, and for pictures. Sets `walk` to a `surehit_explained_walk`, before it calls anything.
///
/// The answer is the same, to the bit. The way to it is that of a single query without shortcuts, and may differ
/// between machines and versions. The walk ends when nothing earlier can follow, so later hits may be missing. It
/// allocates temporary memory for all that it tells.
SUREHIT_C_API surehit_status surehit_colliderd_explain(const surehit_colliderd* collider, const surehit_pathd* path,
                                                       const surehit_query_optionsd* options,
                                                       const surehit_explainerd* explainer, uint32_t* walk);

#ifdef __cplusplus
}
#endif

#endif
