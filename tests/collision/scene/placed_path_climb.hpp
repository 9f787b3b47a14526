#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "collision/filter/on_every_instruction_set.hpp"
#include "path_and_instance.hpp"
#include "place_lanes_on_targets.hpp"
#include "scene/instance_frame.hpp"
#include "scene/placed_path.hpp"
#include "support/hill_climb.hpp"
#include "support/instruction_sets.hpp"
#include "support/random.hpp"

namespace surehit::test {

// What climbs from drawn paths and instances to those whose errors come close to the bounds of POSES.md. Rationals tell
// what is exact.

/// How a path is placed.
enum class Way : std::uint8_t { usual, carefully, side_by_side };

/// A path as an instance sees it.
template <typename Scalar>
class Placed {
 public:
  /// The case must outlive this.
  explicit Placed(const PathAndInstance<Scalar>& drawn, Way way = Way::usual)
      : frame(detail::InstanceFrame::of(drawn.placement, drawn.box)),
        scene_path_(drawn.path, drawn.range, drawn.share) {
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

  detail::InstanceFrame frame;
  bool is_near;
  bool is_beside;
  bool is_beside_ball;  ///< True if it is far from the ball around the instance. So nothing is asked of the box.

 private:
  detail::ScenePath<Scalar> scene_path_;
  std::optional<detail::PlacedPath<Scalar>> path_;
};

/// Returns the largest size of a coordinate.
inline mpq_class largest_of(const ExactVector& x) {
  return std::max({mpq_class(abs(x[0])), mpq_class(abs(x[1])), mpq_class(abs(x[2]))});
}

/// Returns the exact half of the mesh's box around the anchor.
template <typename Scalar>
ExactVector half_size(const PathAndInstance<Scalar>& drawn, const detail::InstanceFrame& frame) {
  ExactVector half;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const mpq_class above = mpq_class(drawn.box.high[axis]) - mpq_class(frame.anchor[i]);
    const mpq_class below = mpq_class(frame.anchor[i]) - mpq_class(drawn.box.low[axis]);
    half[i] = std::max(above, below);
  }
  return half;
}

/// Returns what is left of a share when `rest` of `room` is not taken up.
inline double share_without(const mpq_class& rest, const mpq_class& room) {
  return room > 0 ? std::max(0.0, mpq_class(1 - rest / room).get_d()) : 0;
}

/// The tests of a suite climb with one Scalar.
template <typename Scalar>
class PlacedPathClimb : public testing::Test {
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

}  // namespace surehit::test
