#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "surehit/attributes.hpp"
#include "surehit/box.hpp"
#include "surehit/collider.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"

namespace surehit {

/// How a query comes to the triangles that its path may meet.
enum class ExplainedWalk : std::uint8_t {
  nowhere,        ///< No cell is looked at. The path comes to no part of the grid that has triangles.
  cells,          ///< The path walks from cell to cell.
  one_list,       ///< The mesh is so small that all of its triangles are in one list.
  all_triangles,  ///< The path starts too far away for the grid. All triangles are asked.
};

/// What a query finds in a cell.
enum class CellFinding : std::uint8_t {
  empty,        ///< No triangle. The walk may leap over a whole cube of empty cells.
  misses_box,   ///< Triangles, but the path misses the box around them.
  misses_slab,  ///< Triangles, but the path misses the two planes around them.
  list,         ///< Triangles that the path may meet.
};

/// A step of the walk. Its numbers are rounded, and are for people to look at.
struct ExplainedCell {
  Boxd box;                                  ///< The cell, or the cube of empty cells.
  double enters = 0;                         ///< The t at which the path enters the box.
  double leaves = 0;                         ///< The t at which the path leaves the box.
  CellFinding finding = CellFinding::empty;  ///< What is in the cell.
  bool is_inner = false;                     ///< True if the cell belongs to a grid inside a cell.
  std::size_t first_candidate = 0;           ///< The index of the first candidate of the cell's list.
  std::size_t candidate_count = 0;           ///< The number of candidates of the cell's list.
};

/// A number that the filter has computed, and its error bound.
struct FilterNumber {
  double value = 0;  ///< The computed number.
  double bound = 0;  ///< The exact number is at most this far away. It is infinite or NaN if nothing is known.
};

/// The five determinants of Möller and Trumbore as the filter computes them, in the type of the mesh. D is end - start,
/// E1 is b - a, E2 is c - a, and S is start - a. A hit has t = t_det / det, u = u_det / det and v = v_det / det.
///
/// For a path that starts far away, these are the numbers of its own start. A query may move the start along the path
/// first. So it may decide where these numbers do not.
struct FilterNumbers {
  FilterNumber det;    ///< E1·(D × E2).
  FilterNumber t_det;  ///< E2·(S × E1), called T elsewhere.
  FilterNumber u_det;  ///< S·(D × E2), called U elsewhere.
  FilterNumber v_det;  ///< D·(S × E1), called V elsewhere.
  FilterNumber w_det;  ///< det - u_det - v_det, called W elsewhere. It is for the weight 1 - u - v of corner a.
};

/// What the filter says of a path and a triangle. It is right whenever it says miss or hit.
enum class FilterVerdict : std::uint8_t {
  not_asked,  ///< The filter was not asked, because the grid was not.
  miss,       ///< They do not meet.
  hit,        ///< They meet.
  undecided,  ///< The bounds are larger than the numbers.
};

/// Which stage decides a path and a triangle.
enum class DecidedBy : std::uint8_t {
  options,         ///< The mask or the ignored triangle leaves the triangle out. Nothing is computed.
  filter,          ///< The filter, in the type of the mesh.
  coordinates,     ///< Comparisons: the path misses the triangle's box, or ends at a corner.
  doubles,         ///< The determinants in double, with a bound.
  plane,           ///< Two coordinates in double, in a plane that is perpendicular to an axis.
  running_bounds,  ///< Doubles, with bounds that follow each operation.
  integers,        ///< Exact integers.
};

/// The result for a path and a triangle.
enum class PairOutcome : std::uint8_t {
  left_out,          ///< The mask or the ignored triangle leaves the triangle out.
  miss,              ///< They do not meet within the limits of t.
  contact_left_out,  ///< They meet, but culling or an ignored end leaves the contact out.
  hit,               ///< They meet, and the hit counts.
};

/// A triangle that a query asks about. It is there once for each list that the path comes to and that has it.
struct ExplainedCandidate {
  std::uint32_t triangle = no_triangle;                     ///< The triangle's id.
  std::optional<FilterNumbers> numbers;                     ///< What the filter computes, if it is asked.
  FilterVerdict filter_verdict = FilterVerdict::not_asked;  ///< What the filter says.
  DecidedBy decided_by = DecidedBy::options;                ///< The stage that decides.
  PairOutcome outcome = PairOutcome::left_out;              ///< The result.
};

/// Why a hit comes after the one before it.
enum class OrderedBy : std::uint8_t {
  nothing,   ///< It is the first one.
  bounds,    ///< The bounds of both t do not overlap.
  exact_t,   ///< The bounds overlap, and the exact t is larger.
  triangle,  ///< The exact t are equal, and the id is larger.
};

/// A hit that the walk comes to.
template <FloatOrDouble Scalar>
struct ExplainedHit {
  Hit<Scalar> hit;                            ///< The hit as it is reported.
  double t_lower = 0;                         ///< The exact t is at least this.
  double t_upper = 0;                         ///< The exact t is at most this.
  OrderedBy ordered_by = OrderedBy::nothing;  ///< Why it is not earlier.
  bool is_rounded_by_integers = false;        ///< True if doubles do not decide how t, u and v are rounded.
};

/// All that a query for the first hit of a path does.
template <FloatOrDouble Scalar>
struct Explanation {
  ExplainedWalk walk = ExplainedWalk::nowhere;  ///< How the query comes to its triangles.
  std::vector<ExplainedCell> cells;             ///< The steps of the walk, in order.
  std::vector<ExplainedCandidate> candidates;   ///< The triangles that the query asks about, in order.
  /// The hits among the candidates, in the order of exact t and then of ids. The first one is that of the path. The
  /// walk ends when nothing earlier can follow, so later hits of the path may be missing.
  std::vector<ExplainedHit<Scalar>> hits;

  /// Returns what `Collider::first_hit` returns.
  [[nodiscard]] std::optional<Hit<Scalar>> first_hit() const {
    return hits.empty() ? std::nullopt : std::optional<Hit<Scalar>>(hits.front().hit);
  }
};

/// Explains how `collider.first_hit(path, options)` comes to its answer. It is for people who doubt an answer, and for
/// pictures. `Collider::first_hit` is not slower because of it.
///
/// The answer is the same, to the bit. The way to it is that of a single query without shortcuts: it decides each
/// candidate by itself, where a query may know enough before. The numbers of the filter are those of the path's own
/// start, on the best instruction set that the machine has. They may differ between machines and versions. The answer
/// may not. A query may move a start that is far away along the path first, and so decide where these numbers do not.
///
/// Allocates memory for what it tells, and may throw std::bad_alloc. No query may run while the collider changes.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Explanation<Scalar> explain(const Collider<Scalar>& collider,
                                                      const std::type_identity_t<Path<Scalar>>& path,
                                                      const std::type_identity_t<QueryOptions<Scalar>>& options = {});

extern template SUREHIT_API Explanation<float> explain(const Collider<float>&, const Path<float>&,
                                                       const QueryOptions<float>&);
extern template SUREHIT_API Explanation<double> explain(const Collider<double>&, const Path<double>&,
                                                        const QueryOptions<double>&);

using ExplainedHitf = ExplainedHit<float>;   ///< An explained hit in float.
using ExplainedHitd = ExplainedHit<double>;  ///< An explained hit in double.
using Explanationf = Explanation<float>;     ///< An explanation in float.
using Explanationd = Explanation<double>;    ///< An explanation in double.

}  // namespace surehit
