#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/exact_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Parameters that count: those of the path's kind, where nothing else is said.
struct Range {
  template <typename Scalar>
  explicit Range(const Path<Scalar>& path)
      : first(path.has_start() ? 0 : -infinity), last(path.has_end() ? 1 : infinity) {}

  double first;
  double last;
};

/// By how much the walk may take the ends of the range for later and earlier: rounding of its parameter, which counts
/// from where the path is next to the grid.
template <typename Scalar>
Range widened(const Grid& grid, const Path<Scalar>& path, Range range) {
  const ExactPoint start = in_frame(grid.frame(), path.start);
  const ExactPoint toward = in_frame(grid.frame(), path.toward);
  const ExactPoint zero = in_frame<Scalar>(grid.frame(), {0, 0, 0});
  mpq_class distance = 0;
  mpq_class rate = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    distance = std::max(distance, mpq_class(abs(start[axis]) + grid.frame().resolution(axis)));
    rate = std::max(rate, mpq_class(abs(toward[axis] - (path.has_end() ? start[axis] : zero[axis]))));
  }
  double slack = rate == 0 ? 0 : mpq_class(distance / rate).get_d() * 0x1p-48;
  for (const double t : {range.first, range.last})
    slack = std::max(slack, std::isfinite(t) ? std::fabs(t) * 0x1p-48 : 0);
  range.first -= slack;
  range.last += slack;
  return range;
}

/// The leaves that a walk visits, and those of them with lists whose boxes it meets.
struct Walk {
  std::vector<std::size_t> visited;
  std::vector<std::size_t> met;
};

/// Walks of paths through the grid of a mesh. Each step is checked.
template <typename Scalar>
class GridWalk : public testing::Test {
 protected:
  explicit GridWalk(GeneratedMesh<Scalar> mesh) : mesh_(std::move(mesh)) {}
  GridWalk() : GridWalk(GeneratedMesh<Scalar>()) { place_ground(1, {0, 0, 0}); }

  static GridOptions uniform() { return {.resolution = {9, 8, 5}, .crowded = 0}; }
  static GridOptions nested() { return {.resolution = {3, 2, 1}, .crowded = 4}; }

  void place_ground(Scalar factor, const Vector3<Scalar>& offset, const GridOptions& options = uniform()) {
    Random random(20240229);
    const auto ground = rough_ground<Scalar>(6, 0.7F, random);
    build(placed<Scalar>(with_small_copy<Scalar>(ground, {0.3F, -0.2F, 0.1F}), factor, offset), options);
  }

  void build(GeneratedMesh<Scalar> mesh, const GridOptions& options) {
    mesh_ = std::move(mesh);
    grid_ = Grid(mesh_.view(), box_of(mesh_.view()), options);
    leaves_.emplace(grid_);
  }

  /// Walks all the way, and checks each cell against the exact path: the walk goes where the path goes, and nowhere
  /// else.
  Walk walk(const Path<Scalar>& path, Range range) {
    return walk_shortened(path, range, std::numeric_limits<std::size_t>::max(), infinity);
  }

  /// The same, where the path is made shorter on the way.
  Walk walk_shortened(const Path<Scalar>& path, Range& range, std::size_t steps, double t) {
    const ClippedPath clipped(grid_, path, range.first, range.last);
    EXPECT_NE(clipped.status, ClippedPath::Status::too_far) << hex_text(path);
    Walk walk;
    for (GridTraversal traversal(grid_, clipped); !traversal.at_end(); traversal.advance()) {
      const std::size_t leaf = expect_on_path(path, range, clipped, traversal);
      walk.visited.push_back(leaf);
      if (!traversal.word().is_empty()) {
        expect_box_on_path(path, range, (*leaves_)[leaf], traversal.meets_box());
        if (traversal.meets_box()) walk.met.push_back(leaf);
      }
      if (walk.visited.size() > max_steps()) {
        ADD_FAILURE() << "no end to the walk of " << hex_text(path);
        break;
      }
      if (walk.visited.size() != steps + 1) continue;
      traversal.shorten(t);
      range.last = std::min(range.last, t);
    }
    return walk;
  }

  /// The box of a list is met if the path passes through it, and only if it comes near.
  void expect_box_on_path(const Path<Scalar>& path, const Range& range, const LeafCell& leaf, bool is_met) const {
    constexpr double rounding_share = 16 * 0x1p-24;
    const ExactBox box = leaf.listed_box(grid_);
    if (is_met) {
      const Range wide = widened(grid_, path, range);
      const Growth growth = growth_by(grid_.frame(), GridFrame::padding_share + rounding_share);
      EXPECT_TRUE(meets_box(grid_.frame(), path, wide.first, wide.last, box.grown(growth)))
          << hex_text(path) << " is not near the box in the cell at " << leaf.low[0] << ", " << leaf.low[1] << ", "
          << leaf.low[2];
    } else {
      EXPECT_FALSE(meets_box(grid_.frame(), path, range.first, range.last, box))
          << hex_text(path) << " passes through the box in the cell at " << leaf.low[0] << ", " << leaf.low[1] << ", "
          << leaf.low[2];
    }
  }

  /// Returns the leaf that the walk is in.
  std::size_t expect_on_path(const Path<Scalar>& path, const Range& range, const ClippedPath& clipped,
                             const GridTraversal& traversal) const {
    std::array<std::uint32_t, 3> low;
    const auto size = static_cast<std::uint32_t>(traversal.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = static_cast<std::uint32_t>(traversal.low()[axis]);
      EXPECT_EQ(static_cast<float>(low[axis]), traversal.low()[axis]) << hex_text(path);
      if ((clipped.octant >> axis & 1) != 0) low[axis] = grid_.frame().resolution(axis) - low[axis] - size;
    }
    const std::optional<std::size_t> leaf = leaves_->at(low);
    if (!leaf) {
      ADD_FAILURE() << hex_text(path) << " stands in no cell at " << low[0] << ", " << low[1] << ", " << low[2];
      return 0;
    }
    EXPECT_EQ((*leaves_)[*leaf].size, size);
    EXPECT_EQ((*leaves_)[*leaf].word.bits(), traversal.word().bits());
    const ExactBox box = (*leaves_)[*leaf].box().grown(growth_by(grid_.frame(), GridFrame::padding_share));
    const Range wide = widened(grid_, path, range);
    EXPECT_TRUE(meets_box(grid_.frame(), path, wide.first, wide.last, box))
        << hex_text(path) << " is not in the cell at " << low[0] << ", " << low[1] << ", " << low[2];
    return *leaf;
  }

  /// Each step goes beyond a plane on some axis.
  [[nodiscard]] std::size_t max_steps() const {
    const GridFrame& frame = grid_.frame();
    return std::size_t{frame.resolution(0)} + frame.resolution(1) + frame.resolution(2) - 2;
  }

  /// Every triangle that the path exactly meets in the range is in a list whose box is met. Returns how many it meets.
  std::size_t expect_listed(const Path<Scalar>& path, const Range& range, const Walk& walk) const {
    std::set<std::uint32_t> listed;
    for (const std::size_t leaf : walk.met) {
      const std::vector<std::uint32_t> ids = triangles_in(grid_, (*leaves_)[leaf].word);
      listed.insert(ids.begin(), ids.end());
    }
    std::size_t met = 0;
    for (std::uint32_t id = 0; id < mesh_.triangles.size(); ++id) {
      const auto contact = exact_contact(path, mesh_.view().triangle(id));
      if (!contact) continue;
      if (std::isfinite(range.first) && contact->t < range.first) continue;
      if (std::isfinite(range.last) && contact->t > range.last) continue;
      ++met;
      EXPECT_TRUE(listed.contains(id)) << hex_text(path) << " from " << range.first << " to " << range.last
                                       << " loses triangle " << id;
    }
    return met;
  }

  void expect_found(const Path<Scalar>& path) { expect_found(path, Range(path)); }
  /// As the walk is told before it begins.
  void expect_found(const Path<Scalar>& path, const Range& range) {
    const std::size_t met = expect_listed(path, range, walk(path, range));
    met_ += met;
    const ClippedPath clipped(grid_, path, range.first, range.last);
    if (clipped.status == ClippedPath::Status::clipped && clipped.stays_in_empty_space(grid_, grid_.frame())) {
      ++stayed_;
      EXPECT_EQ(met, 0U) << hex_text(path) << " from " << range.first << " to " << range.last
                         << " does not stay in empty space";
    }
  }

  /// Paths of every kind, long and short.
  void scan(std::size_t paths) {
    PathDrawer<Scalar> drawer(mesh_.view(), 7);
    for (std::size_t i = 0; i < case_count(paths); ++i) expect_found(drawer.draw());
    EXPECT_GT(met_, 0U);
  }

  GeneratedMesh<Scalar> mesh_;
  Grid grid_;
  std::optional<LeafCells> leaves_;
  std::size_t met_ = 0;
  std::size_t stayed_ = 0;  ///< in empty space
};

}  // namespace surehit::test
