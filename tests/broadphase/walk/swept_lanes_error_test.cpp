#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "swept_error.hpp"
#include "walk/swept_lanes.hpp"

namespace surehit::test::swept_lanes_error_test {
namespace {

/// Beside what W6 says that a box in lanes is off by: some eps of the number R of top cells. Its reach is larger by 96
/// of them.
class SweptLanesError : public SweptError {
 protected:
  static constexpr double eps = 0x1p-24;

  /// Puts a box into the first lane. Returns false if it cannot walk there, or has nothing to walk.
  [[nodiscard]] static bool enter(SweptLanes& lanes, const BoxAtCell& box) {
    SweptLanes::Entering entering = {};
    for (std::size_t i = 0; i < 3; ++i) {
      entering.start[i][0] = box.swept.start[i];
      entering.end[i][0] = box.swept.end[i];
      entering.half_extents[i][0] = box.swept.half_extents[i];
    }
    lanes.end[0] = static_cast<float>(box.limit);
    std::uint32_t apart = 0;
    return lanes.enter(entering, 1, apart) == 1 && apart == 0;
  }

  /// More steps than any walk makes.
  [[nodiscard]] std::size_t max_steps() const {
    const auto& cells = grid_.frame().cells;
    return 2 * (std::size_t{cells[0]} + cells[1] + cells[2]) + 8;
  }

  /// Whether the walk of a box in lanes comes to the list of its cell.
  [[nodiscard]] bool visits_list(const BoxAtCell& box, const CellSlab* slabs = nullptr) const {
    SweptLanes lanes(grid_, slabs);
    if (!enter(lanes, box)) return false;
    SweptLanes::Arrivals arrivals;
    for (std::size_t step = max_steps(); step > 0; --step) {
      lanes.step(1, arrivals);
      for (std::size_t k = 0; k < SweptLanes::max_cells; ++k) {
        if ((arrivals.lists[k] & 1) != 0 && arrivals.words[k][0] == leaves_[box.leaf].word.bits()) return true;
      }
      if (arrivals.ended != 0) return false;
    }
    ADD_FAILURE() << "The walk does not end.";
    return false;
  }

  /// A box in top cells, mirrored as its lane is, with 96 eps R more reach.
  struct MirroredBox {
    ExactPoint start, way, reach;
    [[nodiscard]] mpq_class side(std::size_t axis, int sign, const mpq_class& t) const {
      return mpq_class(start[axis] + t * way[axis] + sign * reach[axis]);
    }
  };
  [[nodiscard]] MirroredBox mirrored(const BoxAtCell& box, std::uint32_t octant) const {
    const GridFrame& frame = grid_.frame();
    auto [start, way, reach] = exact(box.swept);
    for (std::size_t i = 0; i < 3; ++i) {
      start[i] /= frame.division;
      way[i] /= frame.division;
      reach[i] = reach[i] / frame.division + 96 * eps * frame.cells[i];
      if ((octant >> i & 1) == 0) continue;
      start[i] = frame.cells[i] - start[i];
      way[i] = -way[i];
    }
    return {start, way, reach};
  }
  /// Returns the share of so many eps R by which a place on an axis is off.
  [[nodiscard]] double share_of_roundings(std::size_t axis, const mpq_class& error, double roundings) const {
    return mpq_class(error / (roundings * eps * grid_.frame().cells[axis])).get_d();
  }

  /// Whether a cell is a top cell with a list and no inner grid.
  [[nodiscard]] bool is_plain(const LeafCell& leaf) const {
    return leaf.size == grid_.frame().division && !leaf.word.has_inner_grid();
  }
  /// Grows a box on its axis until it just does not come to its list. Returns false if it always comes, or never.
  template <typename Visits>
  [[nodiscard]] bool grow(BoxAtCell& box, const Visits& visits) const {
    if (!is_plain(leaves_[box.leaf])) return false;
    double& half = box.swept.half_extents[box.axis];
    const double most = half_of(box.axis, 0.44 * grid_.frame().division);
    const auto visits_with = [&](double x) {
      half = x;
      return visits(box);
    };
    if (visits_with(0) || !visits_with(most)) return false;
    half = last_before(0, most, visits_with);
    return true;
  }
};

TEST_F(SweptLanesError, of_crossings_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const auto share_of = [&](const BoxAtCell& box) {
    SweptLanes lanes(grid_, nullptr);
    if (!enter(lanes, box)) return 0.0;
    const MirroredBox exact = mirrored(box, lanes.octant[0]);
    double worst = 0;
    if (lanes.t[0] > 0) {
      // The box has come to the grid on its last axis.
      double last = 1e9;
      for (std::size_t i = 0; i < 3; ++i) {
        if (exact.way[i] > 0) last = std::min(last, share_of_roundings(i, exact.side(i, 1, lanes.t[0]), 23));
      }
      worst = std::fabs(last);
    }
    SweptLanes::Arrivals arrivals;
    for (std::size_t step = max_steps(); step > 0; --step) {
      const float before = lanes.t[0];
      const auto horizon = lanes.horizon;
      lanes.step(1, arrivals);
      if (arrivals.ended != 0) break;
      if (lanes.t[0] <= before) continue;
      // It crosses a plane, and none before.
      double first = -1e9;
      for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class beyond = exact.side(i, 1, lanes.t[0]) - horizon[i][0];
        first = std::max(first, share_of_roundings(i, beyond, 23));
      }
      worst = std::max(worst, std::fabs(first));
    }
    return worst;
  };
  expect_within_bound("W6_of_crossings", worst(193, 1500, 0, 0.4, share_of));
}

// The box is moved along an axis until one of its sides comes to the next cell, at the t when it comes to the grid.
TEST_F(SweptLanesError, of_positions_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const auto share_of = [&](BoxAtCell box) {
    const std::size_t i = box.axis;
    SweptLanes lanes(grid_, nullptr);
    const double way = box.swept.end[i] - box.swept.start[i];
    const auto cell_from = [&](double start) -> std::optional<float> {
      box.swept.start[i] = start;
      box.swept.end[i] = start + way;
      if (!enter(lanes, box)) return std::nullopt;
      return lanes.horizon[i][0];
    };
    double from = box.swept.start[i];
    const auto first = cell_from(from);
    const float t = lanes.t[0];
    const std::uint32_t octant = lanes.octant[0];
    // The end of a short way may be rounded to the start, and then the axis is not mirrored.
    const auto is_alike = [&] { return lanes.t[0] == t && lanes.octant[0] == octant; };
    double to = from + half_of(i, 0.7 * grid_.frame().division);
    const auto last = cell_from(to);
    if (!first || !last || std::fabs(*first - *last) != 1 || !is_alike()) return 0.0;
    const double enough = half_of(i, 0x1p-12 * eps);
    while (to - from > enough) {
      const double middle = from + (to - from) / 2;
      if (middle <= from || middle >= to) break;
      const auto cell = cell_from(middle);
      if (!cell || !is_alike()) return 0.0;
      (*cell == *first ? from : to) = middle;
    }
    if (cell_from(from) != first) return 0.0;
    const MirroredBox exact = mirrored(box, lanes.octant[0]);
    const float plane = std::max(*first, *last) - (i == 0 ? 0.0F : 1.0F);
    const mpq_class error = exact.side(i, i == 0 ? -1 : 1, t) - plane;
    return std::fabs(share_of_roundings(i, error, 14));
  };
  expect_within_bound("W6_of_positions", worst(197, 3000, 0, 0.4, share_of));
}

TEST_F(SweptLanesError, of_the_box_of_a_list_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const auto share_of = [&](BoxAtCell box) {
    box.limit = static_cast<float>(box.limit);
    if (!grow(box, [&](const BoxAtCell& grown) { return visits_list(grown); })) return 0.0;
    const GridFrame& frame = grid_.frame();
    ExactPoint margin;
    for (std::size_t i = 0; i < 3; ++i) margin[i] = 96 * eps * frame.resolution(i);
    // Of 56 eps R, 32 are those of the list itself.
    const mpq_class growth = growth_to_meet(gaps_to_list(box, {0, 0, 0}, margin), mpq_class(box.limit));
    return std::fabs(mpq_class((1 - growth) * 96 / 24).get_d());
  };
  expect_within_bound("W6_of_the_box_of_a_list", worst(199, 1000, 0, 0.4, share_of));
}

// The box begins and ends in the middle of the list's box, so only the slab says when it comes.
TEST_F(SweptLanesError, of_the_slab_of_a_list_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  std::vector<CellSlab> slabs;
  const auto share_of = [&](BoxAtCell box) {
    const LeafCell& leaf = leaves_[box.leaf];
    const GridFrame& frame = grid_.frame();
    box.limit = static_cast<float>(box.limit);
    const ExactBox listed = leaf.listed_box(grid_);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [start, way, half] = exact(box.swept);
      const mpq_class end = start[i] + way[i] * mpq_class(box.limit);
      if (start[i] <= listed.low[i] || start[i] >= listed.high[i]) return 0.0;
      if (end <= listed.low[i] || end >= listed.high[i]) return 0.0;
    }
    slabs.assign(grid_.lists().size() + 64, box.slab);
    if (!grow(box, [&](const BoxAtCell& grown) { return visits_list(grown, slabs.data()); })) return 0.0;
    const auto [start, way, half] = exact(box.swept);
    const ExactSlab placed = leaf.placed(box.slab);
    const mpq_class first = placed.height_of(start);
    const mpq_class last = first + (placed.height_of(way) - placed.height_of({0, 0, 0})) * mpq_class(box.limit);
    mpq_class beyond =
        std::max(mpq_class(placed.low - std::max(first, last)), mpq_class(std::min(first, last) - placed.high));
    mpq_class size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      beyond -= abs(placed.normal[i]) * half[i];
      size += abs(placed.normal[i]) * frame.resolution(i);
    }
    if (size == 0) return 0.0;
    return std::fabs(mpq_class((96 - beyond / (eps * size)) / 34).get_d());
  };
  expect_within_bound("W6_of_the_slab_of_a_list", worst(223, 1500, 0, 0.4, share_of));
}

}  // namespace
}  // namespace surehit::test::swept_lanes_error_test
