// How close the errors of a placed path come to the bounds of POSES.md. Each test climbs from drawn paths and instances
// to worse ones. Rationals tell what is exact.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "collision/filter/on_every_instruction_set.hpp"
#include "collision/rational_determinants.hpp"
#include "path_and_instance.hpp"
#include "place_lanes_on_targets.hpp"
#include "placed_path_shares.hpp"
#include "scene/placed_path.hpp"
#include "support/exact_oracle.hpp"
#include "support/hill_climb.hpp"
#include "support/instruction_sets.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::placed_path_error_test {
namespace {

using detail::InstanceFrame;

constexpr double eps = 0x1p-53;

/// How a path is placed.
enum class Way : std::uint8_t { usual, carefully, side_by_side };

/// A path as an instance sees it.
template <typename Scalar>
class Placed {
 public:
  /// The case must outlive this.
  explicit Placed(const PathAndInstance<Scalar>& drawn, Way way = Way::usual)
      : frame(InstanceFrame::of(drawn.placement, drawn.box)), scene_path_(drawn.path, drawn.range, drawn.share) {
    using Path = detail::PlacedPath<Scalar>;
    if (way == Way::usual) path_.emplace(scene_path_, drawn.placement, frame);
    if (way == Way::carefully) path_.emplace(scene_path_, drawn.placement, frame, typename Path::Carefully());
    if (way != Way::side_by_side) {
      is_near = path_->status == Path::Status::near;
      is_beside = path_->status == Path::Status::beside;
      is_beside_ball = is_beside && path_->reach == 0;
      return;
    }
    const PairToPlace<Scalar> pair = {&scene_path_, &frame};
    detail::PlacedLanes lanes;
    place_side_by_side<Scalar>({&pair, 1}, drawn.path.has_end(), lanes);
    is_near = (lanes.near & 1) != 0;
    is_beside = (lanes.beside & 1) != 0;
    is_beside_ball = is_beside && lanes.reach[0] > 16 * frame.largest_half_size;
    path_.emplace(scene_path_, drawn.placement, frame, lanes, 0);
  }

  /// It has numbers if it is near, or beside the box and not the ball.
  [[nodiscard]] const detail::PlacedPath<Scalar>& path() const { return *path_; }

  InstanceFrame frame;
  bool is_near;
  bool is_beside;
  bool is_beside_ball;  ///< True if it is far from the ball around the instance. So nothing is asked of the box.

 private:
  detail::ScenePath<Scalar> scene_path_;
  std::optional<detail::PlacedPath<Scalar>> path_;
};

mpq_class largest_of(const ExactVector& x) {
  return std::max({mpq_class(abs(x[0])), mpq_class(abs(x[1])), mpq_class(abs(x[2]))});
}

/// Returns the exact half of the mesh's box around the anchor.
template <typename Scalar>
ExactVector half_size(const PathAndInstance<Scalar>& drawn, const InstanceFrame& frame) {
  ExactVector half;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const mpq_class above = mpq_class(drawn.box.high[axis]) - mpq_class(frame.anchor[i]);
    const mpq_class below = mpq_class(frame.anchor[i]) - mpq_class(drawn.box.low[axis]);
    half[i] = std::max(above, below);
  }
  return half;
}

/// Returns the share that an error takes up of a rounding of x to double and a bound together.
double share_of_rounded(const ExactVector& error, const ExactVector& x, const mpq_class& bound) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class whole = mpq_class(eps) * abs(x[i]) + bound;
    if (error[i] != 0) largest = std::max(largest, mpq_class(abs(error[i]) / whole).get_d());
  }
  return largest;
}

/// Returns `middle_error` of an instance that is only translated. Its start is `middle`, and `start_error` is 11 eps of
/// that and twice `middle_error` (I7).
template <typename Scalar>
mpq_class middle_error_of(const Placed<Scalar>& placed) {
  const mpq_class size = largest_of(exact(placed.path().moved.start));
  return (mpq_class(placed.path().start_error) - mpq_class(11 * eps) * size) / 2;
}

/// Returns what is left of a share when `rest` of `room` is not taken up.
double share_without(const mpq_class& rest, const mpq_class& room) {
  return room > 0 ? std::max(0.0, mpq_class(1 - rest / room).get_d()) : 0;
}

template <typename Scalar>
class PlacedPathError : public testing::Test {
 protected:
  using Drawn = PathAndInstance<Scalar>;

  /// Draws an instance near the origin or up to 1e9 away, and a path.
  Drawn draw() {
    Drawn drawn = draw_path_and_instance<Scalar>(random_);
    if (random_.one_in(4)) move(drawn, 1e9);
    return drawn;
  }
  /// Draws an instance that is only translated, of a mesh around its origin. In its frame, the start that was moved is
  /// `middle` and the direction is `way`.
  Drawn draw_translated() {
    Drawn drawn = draw();
    drawn.placement.pose.linear.setIdentity();
    // Where numbers are of different sizes, sums of floats have roundings too.
    if (random_.one_in(2)) {
      drawn.placement.pose.translation *= static_cast<Scalar>(std::exp2(real(random_, -60, 0)));
      drawn.path.start = vector(1);
      drawn.path.toward = vector(1);
      drawn.box = {{-1, -1, -1}, {1, 1, 1}};
    }
    const Vector3<double> half = (drawn.box.high - drawn.box.low) / 2;
    const Vector3<double> middle = (drawn.box.high + drawn.box.low) / 2;
    drawn.placement.pose.translation += middle.template cast<Scalar>();
    drawn.box = {-half, half};
    drawn.set_exact();
    return drawn;
  }
  /// Draws a path that starts nearly at the anchor, which is the origin of the mesh. So its place in the box is off by
  /// what its direction is off.
  Drawn draw_from_anchor() {
    Drawn drawn = still(draw());
    const Vector3<double> half = (drawn.box.high - drawn.box.low) / 2;
    drawn.box = {-half, half};
    drawn.path.start = drawn.placement.pose.translation + vector(std::exp2(real(random_, -60, -10)));
    drawn.path.toward = vector(std::exp2(real(random_, 0, 10)));
    if (drawn.path.has_end()) drawn.path.toward += drawn.path.start;
    drawn.set_exact();
    return drawn;
  }
  /// Returns the case without a motion.
  static Drawn still(Drawn drawn) {
    drawn.placement.moves = false;
    drawn.placement.motion.setZero();
    drawn.set_exact();
    return drawn;
  }
  /// Returns it with a segment that moves against the instance.
  Drawn moving(Drawn drawn) {
    if (!drawn.path.has_end()) {
      drawn.path = Segment<Scalar>{drawn.path.start, drawn.path.start + drawn.path.toward};
      drawn.range = {0, 1};
    }
    if (!drawn.placement.moves) drawn.placement.motion = vector(1);
    drawn.placement.moves = true;
    drawn.set_exact();
    return drawn;
  }
  Scalar number(double size) { return static_cast<Scalar>(real(random_, -size, size)); }
  Vector3<Scalar> vector(double size) {
    const Scalar x = number(size);
    const Scalar y = number(size);
    return {x, y, number(size)};
  }

  /// Climbs to the max share, which must be below 1.
  template <typename ShareOf, typename Draw>
  double climb(const std::string& name, const ShareOf& share_of, const Draw& draw, std::size_t starts = 10,
               std::size_t steps = 200) {
    const auto changed_case = [&](const auto& drawn) { return changed(drawn, random_); };
    const double worst = climb_to_worst(starts, steps, draw, changed_case, share_of);
    expect_within_bound(name, worst);
    return worst;
  }
  template <typename ShareOf>
  double climb(const std::string& name, const ShareOf& share_of) {
    return climb(name, share_of, [&] { return draw(); });
  }
  /// Climbs on each instruction set, from fewer starts if there are many of them.
  template <typename ShareOf, typename Draw>
  void climb_side_by_side(const std::string& name, const ShareOf& share_of, const Draw& draw) {
    const std::size_t starts = std::max<std::size_t>(1, 8 / instruction_sets().size());
    const auto changed_case = [&](const Drawn& drawn) { return changed(drawn, random_); };
    double worst = 0;
    on_every_instruction_set(
        [&] { worst = std::max(worst, climb_to_worst(starts, 100, draw, changed_case, share_of)); });
    expect_within_bound(name + "_side_by_side", worst);
  }

  Random random_{20261128};

 private:
  void move(Drawn& drawn, double far) {
    const Vector3<Scalar> way = vector(far);
    drawn.placement.pose.translation += way;
    drawn.path.start += way;
    if (drawn.path.has_end()) drawn.path.toward += way;
    drawn.set_exact();
  }
};
TYPED_TEST_SUITE(PlacedPathError, Scalars, ScalarNames);

/// I1, in double and where integers compute the inverse.
TYPED_TEST(PlacedPathError, of_the_inverse_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_where = [](bool is_exact) {
    return [is_exact](const Drawn& drawn) {
      const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
      return frame.is_turned && (frame.inverse_error == eps) == is_exact ? share_of_inverse(drawn, frame) : 0;
    };
  };
  this->climb("inverse", share_where(false));
  this->climb("inverse_of_integers", share_where(true));
}

/// I2.
TYPED_TEST(PlacedPathError, of_the_anchor_stays_within_its_bounds_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_with = [](const auto& share_of_error) {
    return [share_of_error](const Drawn& drawn) {
      const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
      return share_of_error(AnchorError(drawn, frame), frame);
    };
  };
  this->climb("anchor", share_with([](const AnchorError& error, const InstanceFrame& frame) {
                return largest_share(error.with_rest, frame.largest_placed_anchor_error);
              }));
  this->climb("anchor_with_near_rest", share_with([](const AnchorError& error, const InstanceFrame& frame) {
                return share_of(AnchorError::sum(error.with_near_rest), frame.near_slack);
              }));
  this->climb("anchor_alone", share_with([](const AnchorError& error, const InstanceFrame& frame) {
                return share_of(AnchorError::sum(error.alone), frame.anchor_slack);
              }));
}

/// I3: what is left of the room for roundings where a corner is as far from the anchor as any can be. This room is
/// 2^-50 of half of the mesh, 2^-48 of the three numbers and of their length, and for the box 2^-50 of all sizes.
TYPED_TEST(PlacedPathError, of_the_radius_and_the_box_stays_within_their_room_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto reaches = [](const Drawn& drawn, const InstanceFrame& frame) {
    const ExactVector half = half_size(drawn, frame);
    ExactVector reach;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) reach[i] += abs(drawn.matrix[i][j]) * half[j];
    }
    return reach;
  };
  this->climb("radius", [&](const Drawn& drawn) {
    const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
    if (!frame.is_usable) return 0.0;
    const ExactVector reach = reaches(drawn, frame);
    const mpq_class square = mpq_class(frame.radius) * mpq_class(frame.radius);
    return share_without((square - dot(reach, reach)) / 2, square * mpq_class(0x1.2p-47));
  });
  this->climb("box", [&](const Drawn& drawn) {
    const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
    const ExactVector reach = reaches(drawn, frame);
    const AnchorError at(drawn, frame);
    const ExactVector motion = exact(drawn.placement.motion);
    double share = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(frame.low[i]) || !std::isfinite(frame.high[i])) continue;
      mpq_class sizes = reach[i] + abs(exact(drawn.placement.pose.translation)[i]) + abs(motion[i]);
      for (std::size_t j = 0; j < 3; ++j) sizes += abs(drawn.matrix[i][j] * mpq_class(frame.anchor[j]));
      const mpq_class room = mpq_class(0x1.4p-48) * reach[i] + mpq_class(0x1p-50) * sizes;
      const mpq_class low = at.anchor[i] - reach[i] + std::min(motion[i], mpq_class(0));
      const mpq_class high = at.anchor[i] + reach[i] + std::max(motion[i], mpq_class(0));
      share = std::max({share, share_without(low - mpq_class(frame.low[i]), room),
                        share_without(mpq_class(frame.high[i]) - high, room)});
    }
    return share;
  });
}

/// I4. `direction_error` of an instance that is only translated is 8 eps of the way and twice `way_error`.
TYPED_TEST(PlacedPathError, of_a_way_against_a_motion_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto draw = [&] {
    Drawn drawn = this->draw_translated();
    drawn.placement.motion = this->vector(std::exp2(real(this->random_, -30, 30)));
    drawn.placement.moves = true;
    // In half of all cases, the path moves with the instance. So its way is hardly more than what roundings leave.
    drawn.path.kind = PathKind::segment;
    drawn.path.start = drawn.placement.pose.translation;
    const Vector3<TypeParam> way = drawn.share * drawn.placement.motion;
    drawn.path.toward = drawn.path.start + (this->random_.one_in(2) ? way : this->vector(1));
    drawn.range = {0, 1};
    drawn.set_exact();
    return drawn;
  };
  const auto share = [](const Drawn& drawn) {
    const Placed<TypeParam> placed(drawn);
    if (!placed.is_near) return 0.0;
    const ExactVector way = exact(placed.path().moved.direction);
    const mpq_class way_error = (mpq_class(placed.path().direction_error) - mpq_class(8 * eps) * largest_of(way)) / 2;
    return share_of_rounded(drawn.direction - way, way, way_error);
  };
  this->climb("way", share, draw);
}

/// I6.
TYPED_TEST(PlacedPathError, of_a_start_that_was_moved_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_on = [](Way way) {
    return [way](const Drawn& drawn) {
      const Placed<TypeParam> placed(drawn, way);
      if (!placed.is_near) return 0.0;
      const ExactVector middle = exact(placed.path().moved.start);
      // If the errors were too large for the usual way, the path was placed carefully.
      if (way == Way::usual && middle_error_of(placed) < mpq_class(3 * eps) * largest_of(middle)) return 0.0;
      return share_of_rounded(drawn.local_at(mpq_class(placed.path().moved.moved_t)) - middle, middle,
                              middle_error_of(placed));
    };
  };
  // With a motion, segments are placed carefully anyway.
  const auto draw_still = [&] { return this->still(this->draw_translated()); };
  this->climb("middle", share_on(Way::usual), draw_still);
  this->climb("middle_carefully", share_on(Way::carefully), [&] { return this->draw_translated(); });
  this->climb_side_by_side("middle", share_on(Way::side_by_side), draw_still);
}

/// A segment that moves against an instance, and comes so close to the anchor at t that hardly anything is left of its
/// middle. The motion is what is nearest to this.
template <typename Scalar>
struct PathThroughAnchor {
  PathAndInstance<Scalar> drawn;
  mpq_class t;

  void set_motion() {
    const auto& path = drawn.path;
    const ExactVector middle =
        exact(path.start) - exact(drawn.placement.pose.translation) + t * (exact(path.toward) - exact(path.start));
    for (std::size_t i = 0; i < 3; ++i) {
      drawn.placement.motion[static_cast<Eigen::Index>(i)] =
          nearest<Scalar>(middle[i] / (t * mpq_class(double{drawn.share})));
    }
    drawn.set_exact();
  }
};

/// I6 where the errors are all that there is. Only what is beyond the last rounding counts.
TEST(PlacedPathThroughItsAnchor, stays_within_its_bound_where_hill_climbing_makes_the_error_worst) {
  Random random(5);
  const auto vector = [&](double size) {
    const double x = size * random.symmetric<double>();
    const double y = size * random.symmetric<double>();
    return Vector3<double>(x, y, size * random.symmetric<double>());
  };
  const auto draw = [&] {
    PathThroughAnchor<double> through;
    PathAndInstance<double>& drawn = through.drawn;
    drawn.placement.pose.translation = vector(std::exp2(real(random, -60, 0)));
    drawn.placement.moves = true;
    drawn.box = {{-1, -1, -1}, {1, 1, 1}};
    drawn.share = random.one_in(4) ? 1 : random.unit<double>();
    // For a segment, t is a multiple of 2^-20.
    const double t = std::ldexp(static_cast<double>(random.between(1, 1 << 20)), -20);
    through.t = t;
    const Vector3<double> start = vector(1);
    const Vector3<double> motion = vector(std::exp2(real(random, -60, 0)));
    drawn.path = Segment<double>{start, start + (drawn.placement.pose.translation - start) / t + drawn.share * motion};
    through.set_motion();
    return through;
  };
  const auto changed_case = [&](PathThroughAnchor<double> through) {
    PathAndInstance<double>& drawn = through.drawn;
    const std::size_t which = random.below(10);
    const auto axis = static_cast<Eigen::Index>(which % 3);
    double& number = which == 9  ? drawn.share
                     : which > 5 ? drawn.placement.pose.translation[axis]
                     : which > 2 ? drawn.path.start[axis]
                                 : drawn.path.toward[axis];
    number += number * std::ldexp(random.symmetric<double>(), -static_cast<int>(random.between(0, 53)));
    drawn.share = std::clamp(drawn.share, 0x1p-60, 1.0);
    through.set_motion();
    return through;
  };
  const auto share = [](const PathThroughAnchor<double>& through) {
    const Placed<double> placed(through.drawn);
    const mpq_class middle_error = middle_error_of(placed);
    if (!placed.is_near || middle_error < mpq_class(16 * eps) * largest_of(exact(placed.path().moved.start)))
      return 0.0;
    const ExactVector middle = exact(placed.path().moved.start);
    const ExactVector off = through.drawn.local_at(mpq_class(placed.path().moved.moved_t)) - middle;
    mpq_class beyond;
    for (std::size_t i = 0; i < 3; ++i)
      beyond = std::max(beyond, mpq_class(abs(off[i]) - mpq_class(eps) * abs(middle[i])));
    return mpq_class(beyond / middle_error).get_d();
  };
  expect_within_bound("middle_carefully_before_rounding", climb_to_worst(20, 400, draw, changed_case, share));
}

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

/// I5.
TYPED_TEST(PlacedPathError, of_a_distance_stays_within_its_margin_where_hill_climbing_makes_it_worst) {
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
TYPED_TEST(PlacedPathError, of_a_start_that_is_moved_again_stays_within_its_margin_where_hill_climbing_makes_it_worst) {
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

/// I7.
TYPED_TEST(PlacedPathError, in_the_mesh_stays_within_its_bounds_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  for (const auto& [name, share] : {std::pair("start", &PathShares::start),
                                    {"direction", &PathShares::direction},
                                    {"position", &PathShares::position},
                                    {"reach", &PathShares::reach}}) {
    const auto share_on = [share = share](Way way) {
      return [=](const Drawn& drawn) {
        const Placed<TypeParam> placed(drawn, way);
        return placed.is_near ? PathShares(drawn, placed.path()).*share : 0;
      };
    };
    const auto draw = [&] { return this->draw(); };
    this->climb(name, share_on(Way::usual), draw, 6, 150);
    this->climb(name + std::string("_carefully"), share_on(Way::carefully), draw, 6, 150);
    this->climb_side_by_side(name, share_on(Way::side_by_side), [&] { return this->still(draw()); });
  }
}

/// I7 where only the direction counts.
TYPED_TEST(PlacedPathError, from_the_anchor_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_on = [](Way way) {
    return [way](const Drawn& drawn) {
      const Placed<TypeParam> placed(drawn, way);
      return placed.is_near ? PathShares(drawn, placed.path()).position : 0;
    };
  };
  const auto draw = [&] { return this->draw_from_anchor(); };
  this->climb("position", share_on(Way::usual), draw);
  this->climb("position_carefully", share_on(Way::carefully), draw);
  this->climb_side_by_side("position", share_on(Way::side_by_side), draw);
}

/// Returns the largest share that the errors of a path take up of what its sizes grow by for them (I8).
template <typename MeshScalar, typename Scalar>
double share_of_growth(const PathAndInstance<Scalar>& drawn) {
  const Placed<Scalar> placed(drawn);
  if (!placed.is_near) return 0;
  const auto kernel = placed.path().template kernel_path<MeshScalar>();
  if (std::isinf(kernel.d_size)) return 0;
  const ExactVector start = exact(kernel.start);
  const ExactVector d = exact(kernel.d);
  const ExactVector exact_start = drawn.local_at(mpq_class(placed.path().moved.moved_t));
  const ExactVector exact_d = mpq_class(placed.path().kernel_scale()) * (drawn.inverse_matrix * drawn.direction);
  const mpq_class grown_s(double{kernel.reach});
  const mpq_class grown_d(double{kernel.d_size});
  double largest = 0;
  for (const std::array<unsigned, 3>& corners : {std::array{0u, 3u, 5u}, {7u, 4u, 2u}, {6u, 1u, 0u}, {1u, 7u, 4u}}) {
    const auto corner = [&](unsigned which) {
      Vector3<double> point;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        point[axis] = (which >> axis & 1) != 0 ? drawn.box.high[axis] : drawn.box.low[axis];
      }
      return point;
    };
    const Triangle<double> triangle{corner(corners[0]), corner(corners[1]), corner(corners[2])};
    const RationalDeterminants computed = rational_determinants(start, d, triangle);
    const RationalDeterminants exactly = rational_determinants(exact_start, exact_d, triangle);
    const mpq_class e = largest_of(exact(triangle.b) - exact(triangle.a));
    const mpq_class f = largest_of(exact(triangle.c) - exact(triangle.a));
    const mpq_class s = largest_of(start - exact(triangle.a));
    const mpq_class grown_by = grown_s * grown_d - s * largest_of(d);
    // K2 has 48 eps times each product of sizes.
    const mpq_class relative(24 * double{std::numeric_limits<MeshScalar>::epsilon()});
    const auto include = [&](const mpq_class& error, const mpq_class& sizes) {
      if (sizes > 0) largest = std::max(largest, mpq_class(abs(error) / (relative * sizes)).get_d());
    };
    include(exactly.det - computed.det, (grown_d - largest_of(d)) * e * f);
    include(exactly.height - computed.height, (grown_s - s) * e * f);
    include(exactly.u - computed.u, grown_by * f);
    include(exactly.v - computed.v, grown_by * e);
  }
  return largest;
}

TYPED_TEST(PlacedPathError, of_determinants_stays_within_what_sizes_grow_by_where_hill_climbing_makes_it_worst) {
  this->climb("kernel_of_floats", [](const auto& drawn) { return share_of_growth<float>(drawn); });
  this->climb("kernel_of_doubles", [](const auto& drawn) { return share_of_growth<double>(drawn); });
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
TYPED_TEST(PlacedPathError, of_the_box_stays_within_its_allowance_where_hill_climbing_makes_it_worst) {
  const auto share_on = [](Way way) { return [way](const auto& drawn) { return share_of_box(drawn, way); }; };
  const auto draw_still = [&] { return this->still(this->draw()); };
  this->climb("box", share_on(Way::usual), draw_still, 10, 150);
  this->climb_side_by_side("box", share_on(Way::side_by_side), draw_still);
}

}  // namespace
}  // namespace surehit::test::placed_path_error_test
