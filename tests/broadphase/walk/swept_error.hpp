#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/hill_climb.hpp"
#include "support/moving_gap.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "surehit/box.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::test {

/// A moving box, a cell with a list and a slab, and what comes after which t does not count.
struct BoxAtCell {
  SweptExtents swept;
  std::size_t leaf;  ///< The number of the cell among those that are not divided.
  std::size_t axis;  ///< One of the three.
  double limit;
  CellSlab slab;  ///< It need not hold the triangles of the list.
};

/// Searches for boxes whose walks round as badly as possible.
class SweptError : public testing::Test {
 protected:
  using Gap = MovingGap<mpq_class>;

  /// Makes a grid of another position and size.
  void place_anew(Random& random, std::uint32_t crowded) {
    const auto exponent = static_cast<int>(random.between(-3, 3));
    const float factor = std::ldexp(1 + random.unit<float>(), exponent);
    const float far = std::ldexp(factor, static_cast<int>(random.between(-4, 4)));
    Vector3<float> offset;
    for (float& x : offset) x = far * random.symmetric<float>();
    mesh_ = placed(scattered_triangles<float>(60, 0.2F, random), factor, offset);
    const auto cells = [&] { return static_cast<std::uint32_t>(random.between(2, 12)); };
    grid_ = Grid(mesh_.view(), box_of(mesh_.view()), {.resolution = {cells(), cells(), cells()}, .crowded = crowded});
    leaves_.clear();
    for (const LeafCell& leaf : LeafCells(grid_)) {
      if (!leaf.word.is_empty()) leaves_.push_back(leaf);
    }
  }

  [[nodiscard]] double half_of(std::size_t axis, double in_cells) const {
    return std::ldexp(in_cells / grid_.frame().scale[axis], -grid_.frame().exponent);
  }

  /// Draws a box that comes near to a list in some cell.
  [[nodiscard]] BoxAtCell draw(Random& random, double largest_reach) const {
    const GridFrame& frame = grid_.frame();
    BoxAtCell box;
    box.leaf = random.below(leaves_.size());
    box.axis = random.below(3);
    box.limit = random.one_in(2) ? 1 : random.unit<double>();
    std::array<std::int32_t, 3> normal;
    for (std::int32_t& x : normal) x = static_cast<std::int32_t>(random.between(-15, 15));
    const auto height = static_cast<std::int32_t>(random.between(-60, 60));
    box.slab = CellSlab::between(normal, height, height);
    const ExactBox listed = leaves_[box.leaf].listed_box(grid_);
    const double t = random.one_in(6) ? 0 : box.limit * random.unit<double>();
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = listed.low[i].get_d();
      const double high = listed.high[i].get_d();
      const double size = std::ldexp(largest_reach, -static_cast<int>(random.below(12)));
      const double reach = size * random.unit<double>();
      const double place = random.one_in(3) ? low - reach : random.one_in(2) ? high + reach : (low + high) / 2;
      const double length = std::ldexp(1.0 * frame.resolution(i), static_cast<int>(random.between(-30, 8)));
      const double way = random.one_in(5) ? 0 : length * random.symmetric<double>();
      box.swept.start[i] = out_of_frame(frame, i, place - t * way);
      box.swept.end[i] = out_of_frame(frame, i, place + (1 - t) * way);
      box.swept.half_extents[i] = half_of(i, reach);
    }
    return box;
  }

  /// Changes a number of a box.
  [[nodiscard]] BoxAtCell changed(Random& random, BoxAtCell box, double largest_reach) const {
    auto& [start, end, half_extents] = box.swept;
    const std::size_t i = random.below(3);
    const BoxAtCell other = draw(random, largest_reach);
    const auto change = [&](double& x) {
      const int exponent = -static_cast<int>(random.below(50));
      x = random.one_in(2) ? neighbour(x, static_cast<int>(random.between(-40, 40)))
                           : x * (1 + std::ldexp(random.symmetric<double>(), exponent));
    };
    switch (random.below(8)) {
      case 0:
        start[i] = other.swept.start[i];
        break;
      case 1:
        end[i] = start[i] + (end[i] - start[i]) * std::ldexp(random.unit<double>(), 1);
        break;
      case 2:
        half_extents[i] = other.swept.half_extents[i];
        break;
      case 3:
        box.limit = random.one_in(4) ? 1 : random.unit<double>();
        break;
      case 4:
        box.slab = other.slab;
        break;
      default:
        change(random.one_in(2) ? start[i] : random.one_in(2) ? end[i] : half_extents[i]);
    }
    return box;
  }

  /// A box in finest cells, in rationals.
  struct ExactSwept {
    ExactPoint start, way, half;
  };
  [[nodiscard]] ExactSwept exact(const SweptExtents& swept) const {
    const GridFrame& frame = grid_.frame();
    const auto place_of = [&](const std::array<double, 3>& x) {
      return in_frame(frame, Vector3<double>(x[0], x[1], x[2]));
    };
    ExactSwept result = {place_of(swept.start), place_of(swept.end), {}};
    for (std::size_t i = 0; i < 3; ++i) {
      result.way[i] -= result.start[i];
      result.half[i] = scaled_exactly(swept.half_extents[i], frame.exponent) * frame.scale[i];
    }
    return result;
  }

  /// Returns the gaps between a box and that of a list, in finest cells. `slack` is how much larger a box is made than
  /// it is, beside what it is off by.
  [[nodiscard]] std::vector<Gap> gaps_to_list(const BoxAtCell& box, const ExactPoint& slack,
                                              const ExactPoint& margin) const {
    const ExactBox listed = leaves_[box.leaf].listed_box(grid_);
    const auto [start, way, half] = exact(box.swept);
    std::vector<Gap> gaps;
    for (std::size_t i = 0; i < 3; ++i) {
      const mpq_class reach = half[i] + slack[i];
      gaps.push_back({listed.low[i] - start[i] - reach, -way[i], margin[i]});
      gaps.push_back({start[i] - listed.high[i] - reach, way[i], margin[i]});
    }
    return gaps;
  }

  /// Returns the last number from `low` on where something is not reached yet. It must be reached at `high`. None of
  /// them is negative.
  template <typename IsReached>
  static double last_before(double low, double high, const IsReached& is_reached) {
    auto from = std::bit_cast<std::uint64_t>(low);
    auto to = std::bit_cast<std::uint64_t>(high);
    while (to - from > 1) {
      const std::uint64_t middle = from + (to - from) / 2;
      (is_reached(std::bit_cast<double>(middle)) ? to : from) = middle;
    }
    return std::bit_cast<double>(from);
  }

  /// Climbs in several grids.
  template <typename ShareOf>
  double worst(std::uint64_t seed, std::size_t steps, std::uint32_t crowded, double largest_reach,
               const ShareOf& share_of) {
    Random random(seed);
    double worst = 0;
    for (int grid = 0; grid < 10; ++grid) {
      place_anew(random, crowded);
      const double share = climb_to_worst(
          1, steps, [&] { return draw(random, largest_reach); },
          [&](const BoxAtCell& box) { return changed(random, box, largest_reach); }, share_of);
      worst = std::max(worst, share);
    }
    return worst;
  }

  GeneratedMesh<float> mesh_;
  Grid grid_;
  std::vector<LeafCell> leaves_;  ///< Those that are not empty.
};

}  // namespace surehit::test
