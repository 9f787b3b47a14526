// How close the errors of an instance come to the bounds of POSES.md.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "collision/rational_determinants.hpp"
#include "placed_path_climb.hpp"
#include "placed_path_shares.hpp"
#include "scene/instance_frame.hpp"
#include "support/exact_oracle.hpp"
#include "support/scalars.hpp"

namespace surehit::test::instance_frame_error_test {
namespace {

using detail::InstanceFrame;

constexpr double eps = 0x1p-53;

template <typename Scalar>
class InstanceFrameError : public PlacedPathClimb<Scalar> {};
TYPED_TEST_SUITE(InstanceFrameError, Scalars, ScalarNames);

/// I1, in double and where integers compute the inverse.
TYPED_TEST(InstanceFrameError, of_the_inverse_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
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
TYPED_TEST(InstanceFrameError, of_the_anchor_stays_within_its_bounds_where_hill_climbing_makes_it_worst) {
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
TYPED_TEST(InstanceFrameError, of_the_radius_and_the_box_stays_within_their_room_where_hill_climbing_makes_it_worst) {
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

}  // namespace
}  // namespace surehit::test::instance_frame_error_test
