// How near a path comes to an instance that it is called beside. Errors take up the rest of the margins of POSES.md.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "collision/rational_determinants.hpp"
#include "placed_path_climb.hpp"
#include "placed_path_shares.hpp"
#include "scene/instance_frame.hpp"
#include "support/exact_oracle.hpp"
#include "support/scalars.hpp"

namespace surehit::test::placed_path_margin_test {
namespace {

using detail::InstanceFrame;

/// The largest box around the middle of a mesh for which the path is called beside the instance. At the edge between
/// both answers, all errors are told from the margin that is there for them. Returns nothing if there is no such edge.
template <typename Scalar, typename IsBeside>
std::optional<PathAndInstance<Scalar>> at_the_edge(const PathAndInstance<Scalar>& drawn, const IsBeside& is_beside) {
  PathAndInstance<Scalar> sized = drawn;
  const Vector3<double> middle = (drawn.box.high + drawn.box.low) / 2;
  const Vector3<double> half = (drawn.box.high - drawn.box.low) / 2;
  const auto is_beside_at = [&](double scale) {
    sized.box = {middle - scale * half, middle + scale * half};
    return is_beside(sized);
  };
  double beside = 0x1p-60;
  double near = 0x1p60;
  if (!is_beside_at(beside) || is_beside_at(near)) return std::nullopt;
  for (;;) {
    const double between = near > 2 * beside ? std::sqrt(near) * std::sqrt(beside) : beside + (near - beside) / 2;
    if (between <= beside || between >= near) break;
    (is_beside_at(between) ? beside : near) = between;
  }
  is_beside_at(beside);
  return sized;
}

/// What is exact of a path's distance from the anchor.
template <typename Scalar>
struct ExactDistance {
  ExactDistance(const PathAndInstance<Scalar>& drawn, const InstanceFrame& frame)
      : from(exact(drawn.path.start) - AnchorError(drawn, frame).anchor) {
    const mpq_class length = dot(drawn.direction, drawn.direction);
    t = length > 0 ? mpq_class(-dot(from, drawn.direction) / length) : mpq_class(0);
    if (std::isfinite(drawn.range.first)) t = std::max(t, mpq_class(double{drawn.range.first}));
    if (std::isfinite(drawn.range.last)) t = std::min(t, mpq_class(double{drawn.range.last}));
    const ExactVector nearest_point = from + t * drawn.direction;
    square = dot(nearest_point, nearest_point);
    // A segment's t becomes a multiple of 2^-20, and otherwise a float.
    mpq_class rounded = t;
    if (drawn.path.has_end()) {
      rounded = std::nearbyint(mpq_class(t * 0x1p20).get_d()) * 0x1p-20;
    } else if (abs(t) < mpq_class(0x1p100)) {
      rounded = double{nearest<float>(t)};
    }
    rounding = abs(t - rounded);
  }

  ExactVector from;    ///< The start, less the anchor.
  mpq_class t;         ///< Where the path is nearest to the anchor in its range.
  mpq_class square;    ///< The square of its distance there.
  mpq_class rounding;  ///< What rounding moves this t by.
};

/// Returns the share that errors take up of the margin around an instance, if the path is called beside the ball around
/// it (I5). It is 1 where the path touches the ball.
template <typename Scalar>
double share_of_margin(const PathAndInstance<Scalar>& drawn, Way way, bool is_at_end) {
  const auto edge = at_the_edge(
      drawn, [&](const PathAndInstance<Scalar>& sized) { return Placed<Scalar>(sized, way).is_beside_ball; });
  if (!edge) return 0;
  const InstanceFrame frame = InstanceFrame::of(edge->placement, edge->box);
  const ExactDistance<Scalar> exactly(*edge, frame);
  if (is_at_end && exactly.rounding != 0) return 0;
  const mpq_class radius(frame.radius);
  const bool is_careful = drawn.placement.moves && drawn.path.has_end();
  const mpq_class room = radius * mpq_class(0x1p-20) + mpq_class(is_careful ? frame.anchor_slack : frame.near_slack) +
                         AnchorError::sum(exactly.from) * mpq_class(0x1p-44) +
                         2 * exactly.rounding * largest_of(edge->direction);
  const mpq_class outside = exactly.square - radius * radius;
  return share_without(outside / (radius + std::sqrt(exactly.square.get_d())), room);
}

/// Returns the same share where a start was moved again, in the frame of the mesh. The room is what is known of its
/// margin from the last placement, and from how far away the first one was.
template <typename Scalar>
double share_of_margin_again(const PathAndInstance<Scalar>& drawn) {
  const auto edge =
      at_the_edge(drawn, [](const PathAndInstance<Scalar>& sized) { return Placed<Scalar>(sized).is_beside; });
  if (!edge) return 0;
  const Placed<Scalar> placed(*edge);
  if (placed.is_beside_ball) return 0;
  const auto& path = placed.path();
  const ExactVector way = edge->inverse_matrix * edge->direction;
  const mpq_class length = dot(way, way);
  if (length == 0) return 0;
  const ExactVector from = edge->local_at(0) - exact(placed.frame.anchor);
  const mpq_class t = std::clamp(mpq_class(-dot(from, way) / length), mpq_class(double{edge->range.first}),
                                 mpq_class(double{edge->range.last}));
  const ExactVector nearest_point = from + t * way;
  const mpq_class square = dot(nearest_point, nearest_point);
  const ExactVector half = half_size(*edge, placed.frame);
  const double radius = std::sqrt(mpq_class(dot(half, half)).get_d());
  const double speed = std::sqrt(length.get_d());
  const mpq_class first_t = ExactDistance<Scalar>(*edge, placed.frame).t;
  const double first_reach = mpq_class(largest_of(from + first_t * way) + largest_of(half)).get_d();
  const double room = radius * 0x1p-20 + 4 * path.start_error + speed * t.get_d() * 0x1p-50 +
                      first_reach * (0x1p-36 + 8 * path.direction_error / speed);
  const mpq_class outside = square - dot(half, half);
  return share_without(outside / mpq_class(radius + std::sqrt(square.get_d())), mpq_class(room));
}

template <typename Scalar>
class PlacedPathMargin : public PlacedPathClimb<Scalar> {};
TYPED_TEST_SUITE(PlacedPathMargin, Scalars, ScalarNames);

/// I5.
TYPED_TEST(PlacedPathMargin, of_a_distance_stays_within_its_margin_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_on = [](Way way, bool is_at_end) {
    return [=](const Drawn& drawn) { return share_of_margin(drawn, way, is_at_end); };
  };
  const auto draw_still = [&] { return this->still(this->draw()); };
  const auto draw_moving = [&] { return this->moving(this->draw()); };
  // The path comes from far away, and its nearest point is its end. So t is not rounded.
  const auto end_near = [&](Drawn drawn) {
    const auto& pose = drawn.placement.pose;
    const Vector3<double> middle = (drawn.box.low + drawn.box.high) / 2;
    const Vector3<TypeParam> target = pose.linear * middle.template cast<TypeParam>() + pose.translation;
    drawn.path = Segment<TypeParam>{this->vector(std::exp2(real(this->random_, 0, 60))),
                                    target + this->vector(std::exp2(real(this->random_, -10, 10)))};
    if (drawn.placement.moves) drawn.path.toward += drawn.share * drawn.placement.motion;
    drawn.range = {0, 1};
    drawn.set_exact();
    return drawn;
  };
  // The path is long and leads past the anchor. So the rounding of t counts.
  const auto long_way = [&](Drawn drawn) {
    const auto& pose = drawn.placement.pose;
    const Vector3<double> middle = (drawn.box.low + drawn.box.high) / 2;
    const Vector3<TypeParam> target = pose.linear * middle.template cast<TypeParam>() + pose.translation;
    const Vector3<TypeParam> way = this->vector(std::exp2(real(this->random_, 0, 40)));
    const Vector3<TypeParam> start = target - this->random_.template unit<TypeParam>() * way + this->vector(1);
    drawn.path.start = start;
    drawn.path.toward = drawn.path.has_end() ? Vector3<TypeParam>(start + way) : way;
    drawn.set_exact();
    return drawn;
  };
  this->climb(
      "margin", share_on(Way::usual, false), [&] { return long_way(draw_still()); }, 10, 100);
  this->climb(
      "margin_at_an_end", share_on(Way::usual, true), [&] { return end_near(draw_still()); }, 10, 100);
  this->climb(
      "margin_carefully", share_on(Way::usual, false), [&] { return long_way(draw_moving()); }, 10, 100);
  this->climb(
      "margin_carefully_at_an_end", share_on(Way::usual, true), [&] { return end_near(draw_moving()); }, 10, 100);
  this->climb_side_by_side("margin", share_on(Way::side_by_side, false), [&] { return long_way(draw_still()); });
}

/// I5 in the frame of the mesh.
TYPED_TEST(PlacedPathMargin,
           of_a_start_that_is_moved_again_stays_within_its_margin_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto draw = [&] {
    Drawn drawn = this->draw();
    drawn.placement.pose = draw_pose<TypeParam>(SceneFamily::nearly_singular, this->random_);
    drawn.path = Segment<TypeParam>{this->vector(1), this->vector(1)};
    drawn.range = {0, 1};
    return this->moving(drawn);
  };
  const auto share = [](const Drawn& drawn) { return share_of_margin_again(drawn); };
  this->climb("margin_again", share, draw, 10, 100);
}

/// Returns how much of its allowances a box must be left with, so that the exact path just touches it: 0 if it must be
/// left with none.
template <typename Scalar>
mpq_class allowance_to_touch(const PathAndInstance<Scalar>& drawn, const std::array<mpq_class, 3>& allowances) {
  // How far outside of each side the path is, in units of the allowance, is linear in t.
  struct Side {
    mpq_class at_zero, slope;
  };
  std::array<Side, 6> sides;
  const ExactVector start = drawn.local_at(0);
  const ExactVector way = drawn.inverse_matrix * drawn.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    sides[2 * i] = {(start[i] - mpq_class(drawn.box.high[axis])) / allowances[i], way[i] / allowances[i]};
    sides[2 * i + 1] = {(mpq_class(drawn.box.low[axis]) - start[i]) / allowances[i], -way[i] / allowances[i]};
  }
  std::optional<mpq_class> least;
  const auto include = [&](const mpq_class& t) {
    if (std::isfinite(drawn.range.first) && t < mpq_class(double{drawn.range.first})) return;
    if (std::isfinite(drawn.range.last) && t > mpq_class(double{drawn.range.last})) return;
    mpq_class farthest = sides[0].at_zero + t * sides[0].slope;
    for (const Side& side : sides) farthest = std::max(farthest, mpq_class(side.at_zero + t * side.slope));
    if (!least || farthest < *least) least = farthest;
  };
  // The farthest side is the nearest to the path where two of them change places, or at an end.
  for (const Scalar end : {drawn.range.first, drawn.range.last}) {
    if (std::isfinite(end)) include(mpq_class(double{end}));
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (sides[i].slope == sides[j].slope) continue;
      include((sides[j].at_zero - sides[i].at_zero) / (sides[i].slope - sides[j].slope));
    }
  }
  return least.value_or(1);
}

/// Returns the share that errors take up of the allowances of the box, if the path is called beside it (I10). It is 1
/// where the path touches the box.
template <typename Scalar>
double share_of_box(const PathAndInstance<Scalar>& drawn, Way way) {
  const auto edge =
      at_the_edge(drawn, [&](const PathAndInstance<Scalar>& sized) { return Placed<Scalar>(sized, way).is_beside; });
  if (!edge) return 0;
  const Placed<Scalar> placed(*edge, way);
  const mpq_class radius(placed.frame.radius);
  if (ExactDistance<Scalar>(*edge, placed.frame).square > radius * radius) return 0;  // I5 may have said it.
  const mpq_class offset_size = mpq_class(placed.path().start_size) - mpq_class(placed.frame.anchor_size);
  std::array<mpq_class, 3> allowances;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(placed.path().moved.position_error[i])) return 0;
    const mpq_class half(placed.frame.half_size[i]);
    const mpq_class sizes =
        way == Way::usual ? mpq_class(mpq_class(placed.path().start_size) + 3 * half) : mpq_class(offset_size + half);
    allowances[i] = mpq_class(placed.path().moved.position_error[i]) + mpq_class(0x1p-45) * sizes;
  }
  return share_without(allowance_to_touch(*edge, allowances), 1);
}

/// I10.
TYPED_TEST(PlacedPathMargin, of_the_box_stays_within_its_allowance_where_hill_climbing_makes_it_worst) {
  const auto share_on = [](Way way) { return [way](const auto& drawn) { return share_of_box(drawn, way); }; };
  const auto draw_still = [&] { return this->still(this->draw()); };
  this->climb("box", share_on(Way::usual), draw_still, 10, 150);
  this->climb_side_by_side("box", share_on(Way::side_by_side), draw_still);
}

}  // namespace
}  // namespace surehit::test::placed_path_margin_test
