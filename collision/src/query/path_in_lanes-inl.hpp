// Walks one path in many lanes. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PATH_IN_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PATH_IN_LANES_INL
#undef SUREHIT_PATH_IN_LANES_INL
#else
#define SUREHIT_PATH_IN_LANES_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "query/list_visit-inl.hpp"
#include "query/query.hpp"
#include "walk/grid_traversal.hpp"
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "walk/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns true if the path is at least `min_cells` top cells long from tau `enters` on. The lengths on all axes are
/// added.
HWY_INLINE bool is_long(float min_cells, const Grid& grid, const ClippedPath& clipped, float enters) {
  const float rate = clipped.rate[0] + clipped.rate[1] + clipped.rate[2];
  const float way = (std::min(clipped.end, clipped.exit) - enters) * rate;
  return way >= min_cells * static_cast<float>(grid.frame().division) && way < 0x1p20F;
}

#if HWY_TARGET != HWY_SCALAR
// The next functions walk one path in many lanes, for a visitor that is done with any hit. All lanes load their cells
// at the same time, so the path waits less. For a first hit, most of what the later lanes find would not be needed.

/// Gives the visitor the triangles that the path may meet in the cells of these lanes, until the visitor is done.
template <typename AnyPath, typename Visitor>
HWY_INLINE void visit_cells(const Query<float>& query, const PathRange<float>& range, const AnyPath& path,
                            const KernelInput<float>& input, const LaneWalk& walk, const LaneWalk::Cells& cells,
                            std::uint32_t walking, const WalkingPaths& lanes, Visitor& visitor) {
  query.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking));
  std::uint32_t arriving = LaneWalk::in_lists(cells, walking);
  if (arriving != 0) arriving = walk.meet_lists(cells, arriving, lanes);
  if (arriving == 0) return;
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> words;
  hn::Store(cells.word, BitsTag(), words.data());
  for (; arriving != 0 && !visitor.is_done(); arriving &= arriving - 1) {
    const CellWord word(words[static_cast<std::size_t>(std::countr_zero(arriving))]);
    visit_cell(query, range, path, input, word, visitor);
  }
}

/// Cuts a path into pieces, and walks one piece in each lane. It begins at tau `enters`. The grid must have no levels.
template <typename AnyPath, typename Visitor>
HWY_NOINLINE void walk_in_pieces(float enters, const Query<float>& query, const AnyPath& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk walk(query.grid, query.mesh.slabs());
  WalkingPaths pieces;
  walk.cut(clipped, enters, pieces);
  const KernelInput<float> input(path, range, query.grid.frame());
  auto walking = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(BitsTag())) - 1);
  while (walking != 0) {
    const LaneWalk::Cells cells = walk.look_in<false>(pieces, walking);
    visit_cells(query, range, path, input, walk, cells, walking, pieces, visitor);
    if (visitor.is_done()) return;
    walking = walk.advance(cells, walking, pieces);
  }
}

/// Visits all cells of a path from tau `enters` on, one cell in each lane. The grid must have no levels. No cell waits
/// for another one, but the walk cannot leap.
template <typename AnyPath, typename Visitor>
HWY_NOINLINE void walk_all_cells(float enters, const Query<float>& query, const AnyPath& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk walk(query.grid, query.mesh.slabs());
  const LaneWalk::Crossings crossings(clipped, enters);
  WalkingPaths lanes;
  walk.begin_crossings(clipped, lanes);
  const KernelInput<float> input(path, range, query.grid.frame());
  float from = 0;
  do {
    const std::uint32_t walking = walk.enter_crossings(crossings, from, lanes);
    const LaneWalk::Cells cells = walk.look_in<false>(lanes, walking);
    visit_cells(query, range, path, input, walk, cells, walking, lanes, visitor);
    from += static_cast<float>(hn::Lanes(FloatTag()));
  } while (from <= crossings.last && !visitor.is_done());
}

/// Walks the path in lanes if it is long enough for this to be faster. Returns true if it walked. If many cells have
/// lists, it is faster to visit all cells. If few cells have lists, it is faster to leap over the others. If nearly all
/// lists are in inner grids, a single walk is faster, because lanes would wait for the one that enters an inner grid.
/// Measurements chose a single walk for grids with levels too.
template <typename AnyPath, typename Visitor>
HWY_INLINE bool walk_in_lanes(float enters, const Query<float>& query, const AnyPath& path,
                              const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  constexpr float min_cells_in_pieces = 12;
  constexpr float min_cells_at_once = 4;
  constexpr std::size_t full_share = 4;  // More than one top cell in this many must have a list.
  const Grid& grid = query.grid;
  if (grid.is_mostly_inner() || grid.levels() > 0) return false;
  const bool takes_all = LaneWalk::can_enter_crossings && grid.lists().size() * full_share > grid.top().size();
  if (!is_long(takes_all ? min_cells_at_once : min_cells_in_pieces, grid, clipped, enters)) return false;
  if (takes_all) {
    walk_all_cells(enters, query, path, range, clipped, visitor);
  } else {
    walk_in_pieces(enters, query, path, range, clipped, visitor);
  }
  return true;
}
#endif

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
