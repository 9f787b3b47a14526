#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grid_walk.hpp"
#include "support/neighbour.hpp"

namespace surehit::test {

/// The worst rounding errors of walks: how far the exact path is from the cells and cubes that are visited, beside a
/// bound on that.
template <typename Scalar>
class WalkError : public GridWalk<Scalar> {
 protected:
  using Exact = std::array<mpq_class, 3>;

  /// A segment as the walk sees it: mirrored, and from x to x + d. Its part from `first` to `last` is at least two
  /// paddings inside the outer planes.
  struct Course {
    Exact x;
    Exact d;
    mpq_class first = 0;
    mpq_class last = 1;
  };

  [[nodiscard]] Course course(const Path<Scalar>& path, std::uint32_t octant) const {
    const GridFrame& frame = this->grid_.frame();
    const ExactPoint start = in_frame(frame, path.start);
    const ExactPoint end = in_frame(frame, path.toward);
    Course course;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mpq_class stop = frame.resolution(axis);
      const mpq_class margin = 2 * mpq_class(frame.padding(axis));
      const bool is_mirrored = (octant >> axis & 1) != 0;
      mpq_class& x = course.x[axis];
      mpq_class& d = course.d[axis];
      x = is_mirrored ? mpq_class(stop - start[axis]) : start[axis];
      d = is_mirrored ? mpq_class(start[axis] - end[axis]) : mpq_class(end[axis] - start[axis]);
      if (d == 0) {
        if (x < margin || x > stop - margin) course.last = -1;
        continue;
      }
      course.first = std::max(course.first, mpq_class((margin - x) / d));
      course.last = std::min(course.last, mpq_class((stop - margin - x) / d));
    }
    return course;
  }

  /// A visited cell or cube, mirrored like the path.
  struct VisitedBox {
    Exact low;
    Exact high;
  };

  /// Returns the cells and cubes that a walk visits.
  [[nodiscard]] std::vector<VisitedBox> visited_boxes(const ClippedPath& clipped) const {
    std::vector<VisitedBox> boxes;
    for (GridTraversal traversal(this->grid_, clipped); !traversal.at_end(); traversal.advance()) {
      const CellWord word = traversal.word();
      const bool is_far = boxes.empty() || word.distance(clipped.octant) >= GridTraversal::min_leap ||
                          static_cast<std::uint32_t>(traversal.size()) != this->grid_.frame().division;
      const auto leap = static_cast<std::int32_t>(word.is_empty() && is_far ? word.distance(clipped.octant) : 1);
      VisitedBox box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = traversal.low()[axis];
        box.high[axis] = box.low[axis] + leap * traversal.size();
      }
      boxes.push_back(box);
    }
    return boxes;
  }

  /// Returns the share of a bound by which the boxes must grow to cover the path from end to end. The bound is that of
  /// `roundings` roundings of a number as large as the grid's resolution. One box is left and the next one is entered
  /// at the same parameter if plane k of the one and plane j of the other are crossed there:
  /// (high_k + g b_k - x_k) / d_k = (low_j - g b_j - x_j) / d_j.
  [[nodiscard]] double share_for(const std::vector<VisitedBox>& boxes, const Course& course, int roundings) const {
    if (boxes.empty()) {
      ADD_FAILURE() << "visits nothing";
      return 0;
    }
    const GridFrame& frame = this->grid_.frame();
    Exact bound;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bound[axis] = mpq_class(frame.resolution(axis)) * roundings * 0x1p-24;
    }
    mpq_class worst = 0;
    const auto place = [&](std::size_t axis, const mpq_class& t) {
      return mpq_class(course.x[axis] + t * course.d[axis]);
    };
    for (std::size_t i = 1; i < boxes.size(); ++i) {
      const Exact& high = boxes[i - 1].high;
      const Exact& next = boxes[i].low;
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
          const mpq_class weight = bound[k] * course.d[j] + bound[j] * course.d[k];
          if (weight == 0) continue;
          const mpq_class gap = (next[j] - course.x[j]) * course.d[k] - (high[k] - course.x[k]) * course.d[j];
          worst = std::max(worst, mpq_class(gap / weight));
        }
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      worst = std::max(worst, mpq_class((boxes.front().low[axis] - place(axis, course.first)) / bound[axis]));
      worst = std::max(worst, mpq_class((place(axis, course.last) - boxes.back().high[axis]) / bound[axis]));
    }
    return worst.get_d();
  }

  /// Returns the share of a walk's bound that a path needs.
  [[nodiscard]] virtual double worst_share(const Path<Scalar>& path) const = 0;

  [[nodiscard]] virtual GridOptions draw_options(Random& random) const {
    return random.one_in(3) ? this->nested() : this->uniform();
  }

  /// A grid of another position and size.
  void place_anew(Random& random) {
    const auto factor = std::ldexp(1 + random.unit<Scalar>(), static_cast<int>(random.between(-3, 3)));
    const Scalar far = std::ldexp(factor, static_cast<int>(random.between(-4, 4)));
    Vector3<Scalar> offset;
    for (Scalar& x : offset) x = far * random.symmetric<Scalar>();
    this->place_ground(factor, offset, draw_options(random));
  }

  /// Within a few widths of the grid, where the position is rounded most.
  Vector3<Scalar> draw_point(Random& random) const {
    const Box<Scalar> box = box_of(this->mesh_.view());
    Vector3<Scalar> point;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Scalar width = box.high[axis] - box.low[axis];
      point[axis] = box.low[axis] + width * (random.one_in(2) ? 3 * random.unit<Scalar>() - 1 : random.unit<Scalar>());
    }
    return point;
  }

  /// About as much as roundings of float to a number of size 1.
  template <typename Number>
  static Number tiny(Random& random) {
    return std::ldexp(random.symmetric<Number>(), static_cast<int>(random.between(-28, -16)));
  }

  /// Past an edge or a corner of cells, as near as rounding allows: only there can the walk take a wrong turn.
  Segment<Scalar> draw_segment(Random& random) const {
    const GridFrame& frame = this->grid_.frame();
    const Vector3<Scalar> start = draw_point(random);
    Vector3<Scalar> through = draw_point(random);
    const std::uint64_t free_axis = random.below(4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis == free_axis) continue;
      const std::uint32_t stop = frame.resolution(axis);
      const double place = static_cast<double>(random.below(stop + 1)) + stop * tiny<double>(random);
      through[static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(out_of_frame(frame, axis, place));
    }
    return {start, through + (through - start) * (2 * random.unit<Scalar>())};
  }

  Segment<Scalar> changed(Random& random, Segment<Scalar> segment) const {
    Vector3<Scalar>& point = random.one_in(2) ? segment.start : segment.end;
    const auto axis = static_cast<Eigen::Index>(random.below(3));
    switch (random.below(3)) {
      case 0:
        point[axis] = draw_point(random)[axis];
        break;
      case 1:
        point[axis] += (segment.end[axis] - segment.start[axis]) * tiny<Scalar>(random);
        break;
      default:
        point[axis] = neighbour(point[axis], static_cast<int>(random.between(-4, 4)));
    }
    return segment;
  }

  /// The worst share of all starts, each one made worse step by step.
  double climb(std::size_t starts, std::size_t steps) {
    Random random(71);
    double worst = 0;
    for (; starts > 0 && !this->HasFailure(); --starts) {
      place_anew(random);
      Segment<Scalar> best = draw_segment(random);
      double best_share = 0;
      for (std::size_t step = case_count(steps); step > 0; --step) {
        const Segment<Scalar> next = best_share == 0 ? draw_segment(random) : changed(random, best);
        if (const double share = worst_share(next); share > best_share) {
          best = next;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
    return worst;
  }

  /// Returns the max of what `share_of` says of segments and of numbers that it draws itself.
  template <typename Share>
  double draw_worst(std::size_t grids, std::size_t paths, const Share& share_of) {
    Random random(72);
    double worst = 0;
    for (; grids > 0 && !this->HasFailure(); --grids) {
      place_anew(random);
      for (std::size_t i = case_count(paths); i > 0; --i)
        worst = std::max(worst, share_of(draw_segment(random), random));
    }
    return worst;
  }
  double draw_worst(std::size_t grids, std::size_t paths) {
    return draw_worst(grids, paths, [this](const Segment<Scalar>& segment, Random&) { return worst_share(segment); });
  }

  void expect_below_one(double share) {
    testing::Test::RecordProperty("worst_share", std::to_string(share));
    EXPECT_LT(share, 1);
  }
};

}  // namespace surehit::test
