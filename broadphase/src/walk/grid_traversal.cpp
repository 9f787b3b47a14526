#include "walk/grid_traversal.hpp"

#include <limits>

#include "support/exact_difference.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Pair = detail::DoublePair;
using detail::exact_difference;

// WALK.md proves that the walk misses nothing. L1 to L12 are its lemmas. L9 bounds the errors of what is clipped here.

/// A start that is moved ends up at most twice this far from the box's low corner (L10).
constexpr double near = 4;
/// A start farther away than this cannot be moved within the padding (L10).
constexpr double max_start = 0x1p60;

/// The path start + tau rate in the scaled frame, counted from the box's low corner.
struct ScaledPath {
  std::array<Pair, 3> start;
  std::array<Pair, 3> rate;
  int t_exponent = 0;                     ///< tau is t 2^t_exponent - origin[0] - origin[1].
  std::array<double, 2> origin = {0, 0};  ///< The tau by which each of the two steps moved the start.

  template <typename Scalar>
  ScaledPath(const GridFrame& frame, const Path<Scalar>& path) {
    // The direction of a ray or line is scaled, so that its maximum component is in [1, 2). So t is scaled too.
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

  /// Moves the start along the path until it is near the box (L10). Returns whether the path can be clipped.
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
    if (largest_rate == 0) return ClippedPath::Status::miss;  // The path is a point far from the box.
    for (double& step : origin) {
      step = (0.5 - start[fastest][0]) / rate[fastest][0];
      // The fastest axis does not come near the box at any tau that a double can hold.
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
void ClippedPath::clip_in_double(const GridFrame& frame, const Path<Scalar>& path, double first_t,
                                 double last_t) noexcept {
  if (!path.start.allFinite() || !path.toward.allFinite()) return;
  tau = {{1, 1, 1}, {0, 0, 0}};
  auto& unit = tau.unit;
  auto& origin = tau.origin;
  std::array<double, 3> from;
  std::array<double, 3> by;
  double fastest = 0;
  double distance = 0;  // In cells, as `fastest`.
  bool is_near = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double scaled = frame.scaled(path.start[i]);
    from[axis] = scaled - frame.origin[axis];
    by[axis] = detail::direction_of(path.kind, scaled, frame.scaled(path.toward[i]));
    const double cells = std::fabs(from[axis]) * frame.scale[axis];
    distance = std::max(distance, cells);
    fastest = std::max(fastest, std::fabs(by[axis]) * frame.scale[axis]);
    is_near &= cells <= far_widths * frame.resolution(axis);
  }
  const bool is_plain = is_near && fastest <= too_fast &&
                        (path.has_end() || (fastest >= double{slow} && distance <= max_t_to_grid * fastest));
  if (!is_plain) {
    ScaledPath scaled(frame, path);
    status = scaled.clip();
    if (status != Status::clipped) return;
    fastest = 0;  // Times 2^-64, so that it does not overflow.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = scaled.start[axis][0];
      fastest = std::max(fastest, std::fabs(scaled.rate[axis][0] * 0x1p-64 * frame.scale[axis]));
    }
    const int exponent = fastest > 0 ? -std::ilogb(fastest) - 64 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) by[axis] = std::ldexp(scaled.rate[axis][0], exponent);
    for (std::size_t i = 0; i < 2; ++i) origin[i] = std::ldexp(scaled.origin[i], -exponent);
    const int t_exponent = scaled.t_exponent - exponent;
    const int third = t_exponent / 3;  // One double may not hold 2^t_exponent.
    unit = {std::ldexp(1.0, third), std::ldexp(1.0, third), std::ldexp(1.0, t_exponent - 2 * third)};
  }
  clip_scaled(frame, from, by, first_t, last_t);
}

bool MovedPath::is_precise_in(const GridFrame& frame) const noexcept {
  bool is_precise = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double error = frame.scaled(position_error[axis]) * frame.scale[axis];
    const double distance = std::fabs(frame.scaled(start[axis]) - frame.origin[axis]) * frame.scale[axis];
    is_precise &=
        error <= 0x1p-23 * frame.resolution(axis) && distance <= ClippedPath::far_widths * frame.resolution(axis);
  }
  return is_precise;
}

void ClippedPath::clip_in_double(const GridFrame& frame, const MovedPath& path, double first_t,
                                 double last_t) noexcept {
  tau = {{1, 1, 1}, {path.moved_t, 0, 0}};
  std::array<double, 3> from;
  std::array<double, 3> by;
  double fastest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    from[axis] = frame.scaled(path.start[axis]) - frame.origin[axis];
    by[axis] = frame.scaled(path.direction[axis]);
    fastest = std::max(fastest, std::fabs(by[axis]) * frame.scale[axis]);
  }
  if (!path.is_precise_in(frame) || !(fastest <= 0x1p900)) {
    status = Status::too_far;
    return;
  }
  if (fastest > 0 && !(fastest >= 1 && fastest <= 0x1p40)) {
    // Each unit of tau is then between 1 and 2 cells on the fastest axis.
    const int exponent = -std::ilogb(fastest);
    for (double& rate_on_axis : by) rate_on_axis = std::ldexp(rate_on_axis, exponent);
    const int half = -exponent / 2;  // One double may not hold 2^-exponent.
    tau.unit = {std::ldexp(1.0, half), std::ldexp(1.0, -exponent - half), 1};
    tau.origin[0] = path.moved_t * tau.unit[0] * tau.unit[1];
    if (!std::isfinite(tau.origin[0])) {
      status = Status::too_far;
      return;
    }
  }
  clip_scaled(frame, from, by, first_t, last_t);
}

inline void ClippedPath::clip_scaled(const GridFrame& frame, std::array<double, 3>& from, std::array<double, 3>& by,
                                     double first_t, double last_t) noexcept {
  const auto& unit = tau.unit;
  auto& origin = tau.origin;
  const auto at = [&](double t) { return t * unit[0] * unit[1] * unit[2] - origin[0] - origin[1]; };
  // Rounded outward: a little before the first t, and a little beyond the last t.
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
    if (by[axis] < double{min_rate}) {  // L11
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
  end = moves ? tau.beyond(last_t) : 0;
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

// L12
float WalkParameter::beyond(double t) const noexcept {
  const double scaled = t * unit[0] * unit[1] * unit[2];
  const double exact = scaled - origin[0] - origin[1] - origin[2];
  const double rounding = std::fabs(scaled) + std::fabs(origin[0]) + std::fabs(origin[1]) + std::fabs(origin[2]);
  return static_cast<float>(exact + rounding * 0x1p-50 + std::fabs(exact) * 0x1p-22 + 0x1p-140);
}

template void ClippedPath::clip_in_double(const GridFrame&, const Path<float>&, double, double) noexcept;
template void ClippedPath::clip_in_double(const GridFrame&, const Path<double>&, double, double) noexcept;

}  // namespace surehit
