#include "walk/grid_traversal.hpp"

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
// Counted in finest cells, an axis of the path is x(tau) = P + tau D with D >= 0, mirrored if need be. The walk knows
// floats p and r near P and D; R is the axis's resolution and u = 2^-24. It holds for itself, at some tau, a finest
// cell c, and takes plane X to be crossed at the float
//     tau_X = fl(fl(X - p) fl(1 / r)),
// at which the exact path is off the plane by no more than the three roundings, |p - P| and tau |r - D|:
//     |x(tau_X) - X| <= 3 u R + |p - P| + 2 u R =: e.
// From a cell, or a cube of cells that are empty, it goes on to the least tau at which a plane ahead of it is crossed.
// There, on each axis, either that plane is crossed (the new c is X), or the cell stays the same (in a step), or c
// becomes the whole part of the rounded place fl(p + tau r), off by u R for either rounding, but never less than where
// the old cell begins: where planes of two axes are crossed at the same rounded tau, one after the other, a place
// rounded down would hold the walk between two cells for ever. By induction x(tau) >= c - e on every axis when a cell
// is entered, and x(tau) <= X + e until it is left, since tau does not exceed tau_X; where a rounded crossing comes
// before the last one, tau stays, and the interval is empty. So the intervals of tau cut the path without a gap, and in
// each of them the exact path lies in the visited cell or cube grown by e. A step that ends in a divided cell finds the
// finest one in the same way, and keeps it within that cell.
//
// With |p - P| (next), e is below 16 u R, half the padding. A triangle that the path meets at tau is met
// in the box, which the outer planes stand off by two paddings, so at a tau of the interval of some cell or cube; the
// point where it is met is within e of that cell, or of some cell of that cube, which is then in the grid and lists the
// triangle. That cell is the visited one: a cube has only cells that list nothing. A leap that lands one cell off for a
// rounding is no exception: c then begins up to e before or behind the path, as above. The walk ends when tau reaches
// `end`, or where it leaves the grid: where the first of the outer planes is crossed, as computed like any other, or a
// leap's place is rounded up to one, which by the paddings is beyond all that the path meets. All that is not yet
// visited lies at or beyond that tau, exactly: tau stands for the exact parameter, not for a rounded place.
//
// A list whose triangles take up only a part of its cell, the box B, need not be met by a path that passes B by. The
// point where a triangle is met, within e of the cell, lies in the triangle's box, so within e of B, on every axis. The
// planes of B are taken one padding farther out, which is more than e and the three roundings, u R each, that moving
// them costs: so the exact path is beyond each near plane and before each far one at that tau, and these are crossed,
// as computed, before and after it. It lies between 0 and `end` like every tau that counts.
//
// Nor need it be met by a path that passes by a slab, H(x) = n (x - m) in [l, h] with m the cell's centre, that holds
// what of the triangles lies within half a padding of the cell, and so each point where one of them is met. There H is
// in [l, h] on the exact path, so on the path from p by r, which is off by less than half a padding on each axis, it is
// so with a slack of half of S, the sum over the axes of a padding times |n|. On that path H is linear in tau, and the
// tau lies between those where the padded box is entered and left, as computed: so H is not beyond the same plane by
// more at both of these. Computed, it is off by 3 u R on each axis for the way from m (start, product and sum) times
// |n|, by as much for its own products and sums, and the plane by 2 u R more for S and its sum with that: by 8 u R,
// where the other half of S has 16.
//
// A path may stand in all of its cells at once instead (`LaneWalk::stand`): at the tau where it begins, and at tau_X of
// each plane X beyond the cell of the rounded place where it begins, up to the whole part of the one where it ends. At
// such a tau, c is the whole part of fl(p + tau r'), rounded once, on each axis, where
//     r' = fl(r (1 + 4 u)) >= r (1 + 4 u) (1 - u).
// So no plane Y that is crossed by then, as computed, is beyond c: with tau >= tau_Y >= (1 - u)^3 (Y - p) / r,
//     p + tau r' >= p + (1 - u)^4 (1 + 4 u) (Y - p) >= Y - 10 u^2 Y,
// which is rounded to Y or more, since the float before Y is u Y or more away. (In double the inverse is rounded apart
// from the rate. With m in [1, 2) the mantissa of r, their product is no less than 1 - u / m - u m / 2 then, instead of
// 1 - u; and r' is r (1 + 4 u / m) for m up to 1.25, r (1 + 6 u / m) up to 1.75 and r (1 + 8 u / m) beyond, so that the
// sum is no less than Y - 0.23 u Y, which is rounded to Y or more as well.) Nor is the cell where the path begins
// beyond c there, as its place is fl(p + fl(tau r)), and fl(tau r) <= (1 + u) tau r <= tau r'. So it does not matter
// that a plane beyond that cell may be crossed before the path begins, as computed. But c may be ahead of the path by
// more than in a step: with w the way that the path has in the grid on the axis, by 5 u w for r' and u R for the sum,
// instead of 3 u w for a rounded crossing. So x(tau) >= c - e' with e' = e + 2 u w + u R, below 19 u R. As above x <= c
// + 1 + e until some lane's plane is crossed next, or the path has ended: a plane that is crossed before, but that has
// no lane, is beyond the rounded place of the end, so that the path comes no more than e beyond it. Again the intervals
// cut the path without a gap. A point where a triangle is met is within e' of some cell here, which lists the triangle,
// since that is what e' may be in grid_frame.cpp. A box's planes are farther out by a padding, and what the cell and
// their crossings are off, |p - P| aside, which both have in common, is 7 u w + u R and 5 u w: with the three roundings
// half of that. A slab holds the triangles as they are, but for its last places, which no point within half a padding
// of the cell is beyond: one that is 3 u R farther out on each axis is beyond them by 3 u R times |n|, and of the slack
// 8 are left.
//
// For the same reason a path meets nothing whose first cell begins a cube of empty ones that holds the cell of the
// rounded place where it ends, or leaves the grid, as well (`ClippedPath::stays_in_empty_space`): on every axis all of
// it that counts lies within e of the cells from the one to the other, since what it has beyond the rounded tau of an
// outer plane is by the paddings beyond all that it meets. Of these cells none that is in the grid lists anything, and
// a point that is met is within e of such a one.
//
// The boxes of the grid's cover hold those of the lists, and their planes are taken as far out. So tau lies between
// where the first of them is entered and the last one left, as computed, and the walk may begin there instead of at 0,
// as after a leap: at the whole part of the rounded place. That is out of the grid, where the planes stand a padding
// outside, only if an outer plane is crossed before: by the paddings beyond all that the path meets. Then the walk
// begins in the last cell, lest it look outside, and ends with its first step.
//
// With w <= R the way that the path has in the grid on an axis, what is left of these is 3 u w for the crossing and 2 u
// w for the rate, and |p - P| is what follows.
//
// The place where the walk begins. In float, a start is within one width of the grid, so that P is at most 2 R by size:
// 6 u R for its three roundings, or 5 u R with that of mirroring, which is exact where P is R / 2 or more; the way to
// the grid is at most 2 R - w, its rate is off by 2 u of itself and the product and the sum are rounded, 4 u (2 R - w)
// + u R; and what enters the grid by its rounded crossing is clamped into it, 3 u (2 R - w) at most. With the above
// that stays below 16 u R for every w: p is not clipped better than to 15 u R. In double, a start within `near` of a
// box [0, w] with w <= 1, and w >= 2^-20 on an axis that is divided, is off by a few 2^-53, in cells less than 2^-29 R,
// one that is clipped anew by 2^-43, less than 2^-22 R = 4 u R, and either by u R when it is rounded to float at last
// and 3 u R when it is clamped.
//
// A path is taken to stand still on an axis if its rate is below `min_rate`. In the grid, tau is at most 2^37 on a
// path that needs no scaling (a start within 2 R of the grid, at `slow` or faster; 1 on a segment), and 2^39 on one
// that is scaled to a rate of 1 or more (a start within 8 2^35 cells): it moves by less than 2^-27 cells, an eighth of
// u R.
//
// A path that starts farther than `near` from the box is clipped anew, at the tau where it passes 0.5 on the axis on
// which it moves fastest: if it meets the box at all, it is there within 2 of the box on every axis. The new place is
// start + tau rate, with start, rate and their product as sums of two doubles without error; what is lost is 8 v^2
// |start| in the sums of the low parts, v = 2^-53, and 2 v of the result. tau itself is rounded, so that the place is
// off 0.5 by up to v |start|, which is exact as a place but may be far: a second step of the same kind from there ends
// at 0.5 but for roundings. With |start| <= `max_start` the steps lose below 2^-43.
constexpr double near = 4;
constexpr double max_start = 0x1p60;

/// start + tau rate in the scaled frame, relative to the box's low corner.
struct ScaledPath {
  std::array<Pair, 3> start;
  std::array<Pair, 3> rate;
  int t_exponent = 0;  ///< tau = t 2^t_exponent - origin[0] - origin[1]
  std::array<double, 2> origin = {0, 0};

  template <typename Scalar>
  ScaledPath(const GridFrame& frame, const Path<Scalar>& path) {
    // The direction of a ray or a line is scaled to a greatest component in [1, 2); t is scaled to make up for it.
    int rate_exponent = frame.exponent;
    if (!path.has_end()) {
      const double largest = std::max(
          {std::fabs(double{path.toward[0]}), std::fabs(double{path.toward[1]}), std::fabs(double{path.toward[2]})});
      if (largest > 0) rate_exponent = -std::ilogb(largest);
      t_exponent = frame.exponent - rate_exponent;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const double from = frame.scaled(path.start[i]);
      start[axis] = exact_difference(from, frame.origin[axis]);
      rate[axis] = path.has_end() ? exact_difference(frame.scaled(path.toward[i]), from)
                                  : Pair{std::ldexp(double{path.toward[i]}, rate_exponent), 0};
    }
  }

  /// Brings the start near the box.
  ClippedPath::Status clip() {
    double distance = 0;
    double largest_rate = 0;
    std::size_t fastest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = std::fabs(rate[axis][0]);
      if (!(std::fabs(start[axis][0]) <= max_start && size < infinity)) return ClippedPath::Status::too_far;
      distance = std::max(distance, std::fabs(start[axis][0]));
      if (size > largest_rate) {
        largest_rate = size;
        fastest = axis;
      }
    }
    if (distance <= near) return ClippedPath::Status::clipped;
    if (largest_rate == 0) return ClippedPath::Status::miss;  // a point that far off
    for (double& step : origin) {
      step = (0.5 - start[fastest][0]) / rate[fastest][0];
      // Not even the fastest axis comes near in any tau that a double holds.
      if (!std::isfinite(step)) return ClippedPath::Status::miss;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double move = step * rate[axis][0];
        const double move_error = std::fma(step, rate[axis][0], -move);
        const Pair sum = exact_difference(start[axis][0], -move);
        start[axis] = {sum[0] + (sum[1] + (move_error + (start[axis][1] + step * rate[axis][1]))), 0};
      }
    }
    const double left = std::max({std::fabs(start[0][0]), std::fabs(start[1][0]), std::fabs(start[2][0])});
    return left <= 2 * near ? ClippedPath::Status::clipped : ClippedPath::Status::miss;
  }
};

}  // namespace

template <typename Scalar>
void ClippedPath::place_in_double(const GridFrame& frame, const Path<Scalar>& path, double first_t,
                                  double last_t) noexcept {
  if (!path.start.allFinite() || !path.toward.allFinite()) return;
  unit = {1, 1, 1};
  origin = {0, 0, 0};
  std::array<double, 3> from;
  std::array<double, 3> by;
  double fastest = 0;
  double distance = 0;
  bool is_near_in_cells = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double scaled = frame.scaled(path.start[i]);
    from[axis] = scaled - frame.origin[axis];
    by[axis] = path.has_end() ? frame.scaled(path.toward[i]) - scaled : frame.scaled(path.toward[i]);
    distance = std::max(distance, std::fabs(from[axis]));
    fastest = std::max(fastest, std::fabs(by[axis]) * frame.scale[axis]);
    is_near_in_cells &= std::fabs(from[axis]) * frame.scale[axis] <= 2.0 * frame.resolution(axis);
  }
  const bool is_plain =
      distance <= near && is_near_in_cells && fastest <= double{fast} && (fastest >= double{slow} || path.has_end());
  if (!is_plain) {
    ScaledPath scaled(frame, path);
    status = scaled.clip();
    if (status != Status::clipped) return;
    fastest = 0;  // times 2^-64, lest it overflow
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = scaled.start[axis][0];
      fastest = std::max(fastest, std::fabs(scaled.rate[axis][0] * 0x1p-64 * frame.scale[axis]));
    }
    const int exponent = fastest > 0 ? -std::ilogb(fastest) - 64 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) by[axis] = std::ldexp(scaled.rate[axis][0], exponent);
    for (std::size_t i = 0; i < 2; ++i) origin[i] = std::ldexp(scaled.origin[i], -exponent);
    const int t_exponent = scaled.t_exponent - exponent;
    const int third = t_exponent / 3;  // one double may not hold 2^t_exponent
    unit = {std::ldexp(1.0, third), std::ldexp(1.0, third), std::ldexp(1.0, t_exponent - 2 * third)};
  }

  const auto at = [&](double t) { return t * unit[0] * unit[1] * unit[2] - origin[0] - origin[1]; };
  // A little before the first and beyond the last.
  double enters = at(first_t);
  double leaves = at(last_t);
  enters -= (std::fabs(enters) + std::fabs(origin[0])) * 0x1p-50;
  leaves += (std::fabs(leaves) + std::fabs(origin[0])) * 0x1p-50;
  std::array<double, 3> inverse;
  bool moves = false;
  bool passes = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double stop = frame.resolution(axis);
    from[axis] = from[axis] * frame.scale[axis] + double{frame.margin[axis]};
    by[axis] *= frame.scale[axis];
    if (by[axis] < 0) {
      from[axis] = stop - from[axis];
      by[axis] = -by[axis];
      octant |= std::uint32_t{1} << axis;
    }
    if (by[axis] < double{min_rate}) {
      by[axis] = 0;
      inverse[axis] = double{max_inverse};
      passes &= 0 <= from[axis] && from[axis] <= stop;
      continue;
    }
    moves = true;
    inverse[axis] = 1 / by[axis];
    enters = std::max(enters, -from[axis] * inverse[axis]);
    leaves = std::min(leaves, (stop - from[axis]) * inverse[axis]);
  }
  status = passes && enters <= leaves ? Status::clipped : Status::miss;
  if (status == Status::miss) return;
  if (!moves) enters = 0;
  origin[2] = enters;
  end = moves ? beyond_in_double(last_t) : 0;
  exit = moves ? static_cast<float>(leaves - enters) : 0;
  rate = detail::all_lanes(0.0F);
  inverse_rate = detail::all_lanes(max_inverse);
  start = frame.float_margin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto stop = static_cast<float>(frame.resolution(axis));
    const auto entered = static_cast<float>(from[axis] + enters * by[axis]);
    start[axis] = std::clamp(entered, 0.0F, stop * (1 - 0x1p-24F));
    rate[axis] = static_cast<float>(by[axis]);
    inverse_rate[axis] = static_cast<float>(inverse[axis]);
  }
}

float ClippedPath::beyond_in_double(double t) const noexcept {
  const double scaled = t * unit[0] * unit[1] * unit[2];
  const double tau = scaled - origin[0] - origin[1] - origin[2];
  const double rounding = std::fabs(scaled) + std::fabs(origin[0]) + std::fabs(origin[1]) + std::fabs(origin[2]);
  return static_cast<float>(tau + rounding * 0x1p-50 + std::fabs(tau) * 0x1p-22 + 0x1p-140);
}

template void ClippedPath::place_in_double(const GridFrame&, const Path<float>&, double, double) noexcept;
template void ClippedPath::place_in_double(const GridFrame&, const Path<double>&, double, double) noexcept;

}  // namespace surehit
