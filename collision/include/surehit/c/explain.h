#ifndef SUREHIT_C_EXPLAIN_H
#define SUREHIT_C_EXPLAIN_H

/// @file
/// What an explanation of the C interface has for float and double alike.

#include "surehit/c/values_d.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How a query comes to the triangles that its path may meet.
typedef enum surehit_explained_walk {
  SUREHIT_WALK_NOWHERE = 0,       ///< No cell is looked at. The path comes to no part of the grid that has triangles.
  SUREHIT_WALK_CELLS = 1,         ///< The path walks from cell to cell.
  SUREHIT_WALK_ONE_LIST = 2,      ///< The mesh is so small that all of its triangles are in one list.
  SUREHIT_WALK_ALL_TRIANGLES = 3  ///< The path starts too far away for the grid. All triangles are asked.
} surehit_explained_walk;

/// What a query finds in a cell.
typedef enum surehit_cell_finding {
  SUREHIT_CELL_EMPTY = 0,        ///< No triangle. The walk may leap over a whole cube of empty cells.
  SUREHIT_CELL_MISSES_BOX = 1,   ///< Triangles, but the path misses the box around them.
  SUREHIT_CELL_MISSES_SLAB = 2,  ///< Triangles, but the path misses the two planes around them.
  SUREHIT_CELL_LIST = 3          ///< Triangles that the path may meet.
} surehit_cell_finding;

/// What the filter says of a path and a triangle.
typedef enum surehit_filter_verdict {
  SUREHIT_FILTER_NOT_ASKED = 0,  ///< The filter was not asked, because the grid was not.
  SUREHIT_FILTER_MISS = 1,       ///< They do not meet.
  SUREHIT_FILTER_HIT = 2,        ///< They meet.
  SUREHIT_FILTER_UNDECIDED = 3   ///< The bounds are larger than the numbers.
} surehit_filter_verdict;

/// Which stage decides a path and a triangle.
typedef enum surehit_decided_by {
  SUREHIT_BY_OPTIONS = 0,         ///< The mask or the ignored triangle leaves the triangle out. Nothing is computed.
  SUREHIT_BY_FILTER = 1,          ///< The filter, in the type of the mesh.
  SUREHIT_BY_COORDINATES = 2,     ///< Comparisons: the path misses the triangle's box, or ends at a corner.
  SUREHIT_BY_DOUBLES = 3,         ///< The determinants in double, with a bound.
  SUREHIT_BY_PLANE = 4,           ///< Two coordinates in double, in a plane that is perpendicular to an axis.
  SUREHIT_BY_RUNNING_BOUNDS = 5,  ///< Doubles, with bounds that follow each operation.
  SUREHIT_BY_INTEGERS = 6         ///< Exact integers.
} surehit_decided_by;

/// The result for a path and a triangle.
typedef enum surehit_pair_outcome {
  SUREHIT_PAIR_LEFT_OUT = 0,          ///< The mask or the ignored triangle leaves the triangle out.
  SUREHIT_PAIR_MISS = 1,              ///< They do not meet within the limits of t.
  SUREHIT_PAIR_CONTACT_LEFT_OUT = 2,  ///< They meet, but culling or an ignored end leaves the contact out.
  SUREHIT_PAIR_HIT = 3                ///< They meet, and the hit counts.
} surehit_pair_outcome;

/// Why a hit comes after the one before it.
typedef enum surehit_ordered_by {
  SUREHIT_ORDER_NOTHING = 0,  ///< It is the first one.
  SUREHIT_ORDER_BOUNDS = 1,   ///< The bounds of both t do not overlap.
  SUREHIT_ORDER_EXACT_T = 2,  ///< The bounds overlap, and the exact t is larger.
  SUREHIT_ORDER_TRIANGLE = 3  ///< The exact t are equal, and the id is larger.
} surehit_ordered_by;

/// A step of the walk. Its numbers are rounded, and are for people to look at.
typedef struct surehit_explained_cell {
  surehit_boxd box;        ///< The cell, or the cube of empty cells.
  double enters;           ///< The t at which the path enters the box.
  double leaves;           ///< The t at which the path leaves the box.
  size_t first_candidate;  ///< The index of the first candidate of the cell's list.
  size_t candidate_count;  ///< The number of candidates of the cell's list.
  uint8_t finding;         ///< A `surehit_cell_finding`.
  uint8_t is_inner;        ///< 1 if the cell belongs to a grid inside a cell.
} surehit_explained_cell;

/// A number that the filter has computed, and its error bound.
typedef struct surehit_filter_number {
  double value;  ///< The computed number.
  double bound;  ///< The exact number is at most this far away. It is infinite or NaN if nothing is known.
} surehit_filter_number;

/// A triangle that a query asks about, with the determinants of Möller and Trumbore as the filter computes them. They
/// are all 0 if `has_numbers` is 0. A hit has t = t_det / det, u = u_det / det and v = v_det / det.
typedef struct surehit_explained_candidate {
  surehit_filter_number det;    ///< That of the path's way and two edges.
  surehit_filter_number t_det;  ///< That of t.
  surehit_filter_number u_det;  ///< That of the weight of corner b.
  surehit_filter_number v_det;  ///< That of the weight of corner c.
  surehit_filter_number w_det;  ///< That of the weight of corner a: det - u_det - v_det.
  uint32_t triangle;            ///< The triangle's id.
  uint8_t has_numbers;          ///< 1 if the filter was asked.
  uint8_t filter_verdict;       ///< A `surehit_filter_verdict`.
  uint8_t decided_by;           ///< A `surehit_decided_by`.
  uint8_t outcome;              ///< A `surehit_pair_outcome`.
} surehit_explained_candidate;

/// Tells of the cell with this index.
typedef void (*surehit_tell_cell)(void* user, size_t index, const surehit_explained_cell* cell);
/// Tells of the candidate with this index.
typedef void (*surehit_tell_candidate)(void* user, size_t index, const surehit_explained_candidate* candidate);

#ifdef __cplusplus
}
#endif

#endif
