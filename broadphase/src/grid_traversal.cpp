#include "surehit/grid_traversal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surehit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An unevaluated sum of two doubles, the second below half an ulp of the first.
using Pair = std::array<double, 2>;

/// x - y without error (Knuth; Shewchuk 1997, theorem 7).
Pair exact_difference(double x, double y) {
  const double difference = x - y;
  const double y_part = x - difference;
  const double x_part = difference + y_part;
  return {difference, (x - x_part) + (y_part - y)};
}

// Why the walk misses nothing.
//
// In the frame of the grid, an axis of the path is x(tau) = p + tau r. The walk knows p* and r* near p and r. On that
// axis it takes plane X_i to be crossed at the double
//     tau_i = fl(fl(X_i - p*) / r*),
// which is monotone in i, since X_i is and both roundings are. A cell is visited for the tau between the crossings of
// its two planes on each axis; from one cell to the next the walk takes the least of the three crossings ahead. So the
// visited cells cut the range of tau into closed intervals without gaps, whatever the roundings, and all that needs
// proof is that in the interval of a cell the exact path is in the cell's padded box. At tau_i it is off the plane by
//     |x(tau_i) - X_i| <= |p - p*| + |tau_i| |r - r*| + 2 u |X_i - p*| (1 + u),
// where r* is r rounded once, so that |tau_i| |r - r*| <= u |tau_i r*| (1 + u) and |tau_i r*| is |X_i - p*| but for
// roundings:
//     |x(tau_i) - X_i| <= |p - p*| + 4 u (|X_i| + |p*|).
// X_i is at most 1 and the margin; p is exact to u |p| if the path starts near, and if it does not, p* is a rounded
// point of the path (below), no farther than 8. Underflow of the quotient is off by 2^-1075 r, below 2^-50. The error
// is thus below 2^-42: far below the 2^-33 of the padding that is the path's. On an axis with r = 0 the cell is the one
// of p*, and the same bound holds. The first cell is the one of the rounded place at which the walk begins, which is
// off by no more; if that puts it a cell behind or ahead of the crossings, its interval begins there all the same.
//
// A triangle that the path meets at tau is met in the box, hence at a tau within the crossings of the grid's outer
// planes, which stand off the box by the margin of two paddings; so it lies in the interval of a visited cell, at a
// point that is in that cell's padded box, and is listed there. The walk ends when a cell's entry exceeds `end_`, and
// all that is not yet visited lies at or beyond that entry, exactly: tau stands for the exact parameter, not for a
// rounded place.
//
// A path that starts farther than `near` from the box is placed anew, at the tau where it passes 0.5 on the axis on
// which it moves fastest: if it meets the box at all, it is there within 2 of the box on every axis. The new place is
// start + tau rate, with start, rate and their product as sums of two doubles without error; what is lost is 8 u^2
// |start| in the sums of the low parts, and 2 u of the result. tau itself is rounded, so that the place is off 0.5 by
// up to u |start|, which is exact as a place but may be far: a second step of the same kind from there ends at 0.5 but
// for roundings. With |start| <= `farthest` the steps lose below 2^-43.
constexpr double near = 4;
constexpr double farthest = 0x1p60;

}  // namespace

template <typename Scalar>
GridTraversal::GridTraversal(const Grid& grid, const Path<Scalar>& path, double first_t, double last_t) noexcept
    : grid_(&grid) {
  if (grid.cell_count() == 0) return;
  const GridFrame& frame = grid.frame();
  const bool is_segment = path.kind == PathKind::segment;

  // The direction of a ray or a line is scaled to a greatest component in [1, 2); t is scaled to make up for it.
  int rate_exponent = frame.exponent;
  if (!is_segment) {
    const double largest = std::max(
        {std::fabs(double{path.toward[0]}), std::fabs(double{path.toward[1]}), std::fabs(double{path.toward[2]})});
    if (largest > 0) rate_exponent = -std::ilogb(largest);
    t_exponent_ = frame.exponent - rate_exponent;
  }

  std::array<Pair, 3> start;
  std::array<Pair, 3> rate;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double from = frame.scaled(path.start[i]);
    start[axis] = exact_difference(from, frame.origin[axis]);
    rate[axis] = is_segment ? exact_difference(frame.scaled(path.toward[i]), from)
                            : Pair{std::ldexp(double{path.toward[i]}, rate_exponent), 0};
  }
  if (!place(start, rate)) return;
  entry_ = tau(first_t, -infinity);
  end_ = tau(last_t, infinity);
  enter();
}

/// Chooses base and rate on each axis. False if there is nothing to walk: the path misses the box, or is unclipped.
bool GridTraversal::place(std::array<Pair, 3> start, const std::array<Pair, 3>& rate) noexcept {
  double distance = 0;
  double largest_rate = 0;
  std::size_t fastest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::fabs(rate[axis][0]);
    distance = std::max(distance, std::fabs(start[axis][0]));
    if (size > largest_rate) {
      largest_rate = size;
      fastest = axis;
    }
    if (!(std::fabs(start[axis][0]) <= farthest && size < infinity)) {
      unclipped_ = true;
      return false;
    }
    axes_[axis].base = start[axis][0];
    axes_[axis].rate = rate[axis][0];
  }
  if (distance <= near) return true;
  if (largest_rate == 0) return false;  // a point that far off
  for (double& step : base_tau_) {
    step = (0.5 - axes_[fastest].base) / rate[fastest][0];
    if (!std::isfinite(step)) return false;  // not even the fastest axis comes near in any tau that a double holds
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double move = step * rate[axis][0];
      const double move_error = std::fma(step, rate[axis][0], -move);
      const Pair sum = exact_difference(start[axis][0], -move);
      start[axis] = {sum[0] + (sum[1] + (move_error + (start[axis][1] + step * rate[axis][1]))), 0};
      axes_[axis].base = start[axis][0];
    }
  }
  return std::max({std::fabs(axes_[0].base), std::fabs(axes_[1].base), std::fabs(axes_[2].base)}) <= 2 * near;
}

double GridTraversal::tau(double t, double outward) const noexcept {
  if (t_exponent_ == 0 && base_tau_[0] == 0) return t;
  double tau = std::nextafter(std::ldexp(t, t_exponent_), outward);
  for (const double step : base_tau_) tau = std::nextafter(tau - step, outward);
  return tau;
}

double GridTraversal::crossing(std::size_t axis, std::uint32_t cell, bool behind) const noexcept {
  const Axis& on = axes_[axis];
  return (grid_->frame().plane(axis, cell + (behind == (on.rate > 0) ? 1 : 0)) - on.base) / on.rate;
}

/// Finds the first cell: where the path enters the grid.
void GridTraversal::enter() noexcept {
  const GridFrame& frame = grid_->frame();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Axis& on = axes_[axis];
    const std::uint32_t highest = frame.resolution[axis] - 1;
    if (on.rate == 0) {
      if (!(frame.plane(axis, 0) <= on.base && on.base <= frame.plane(axis, highest + 1))) return;
      on.index = on.last = frame.cell_at(axis, on.base);
      on.exit = infinity;
      continue;
    }
    on.last = on.rate > 0 ? highest : 0;
    on.step = on.rate > 0 ? 1 : -1;
    entry_ = std::max(entry_, crossing(axis, highest - on.last, false));
    end_ = std::min(end_, crossing(axis, on.last, true));
  }
  if (!(entry_ <= end_)) return;

  for (std::size_t axis = 0; axis < 3; ++axis) {
    Axis& on = axes_[axis];
    if (on.rate == 0) continue;
    on.index = frame.cell_at(axis, on.base + entry_ * on.rate);
    on.exit = crossing(axis, on.index, true);
  }
  cell_ = grid_->cell_index({axes_[0].index, axes_[1].index, axes_[2].index});
  at_end_ = false;
}

void GridTraversal::advance() noexcept {
  std::size_t axis = axes_[0].exit < axes_[1].exit ? 0 : 1;
  if (axes_[2].exit < axes_[axis].exit) axis = 2;
  Axis& on = axes_[axis];
  entry_ = on.exit;
  at_end_ = on.index == on.last || !(entry_ <= end_);
  if (at_end_) return;
  on.index += static_cast<std::uint32_t>(on.step);
  on.exit = crossing(axis, on.index, true);
  cell_ = grid_->cell_index({axes_[0].index, axes_[1].index, axes_[2].index});
}

void GridTraversal::shorten(double t) noexcept { end_ = std::min(end_, tau(t, infinity)); }

template GridTraversal::GridTraversal(const Grid&, const Path<float>&, double, double) noexcept;
template GridTraversal::GridTraversal(const Grid&, const Path<double>&, double, double) noexcept;

}  // namespace surehit
