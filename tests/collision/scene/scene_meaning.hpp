#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test {

/// One test for each sentence about what a hit in a scene means.
template <typename Scalar>
class SceneMeaning : public testing::Test {
 protected:
  using Answer = std::optional<SceneHit<Scalar>>;
  static constexpr Scalar quarter{0.25};

  InstanceId add(const Pose<Scalar>& pose = {}, const InstanceOptions& options = {}) {
    return scene.add(floor, pose, options);
  }

  /// Above (1/4, 1/4), from one height to another.
  static Segment<Scalar> across(Scalar from, Scalar to) { return through_stack<Scalar>(from, to); }

  static void expect_hit(const Answer& answer, Scalar t, Side side, InstanceId instance, std::uint32_t triangle = 0) {
    ASSERT_TRUE(answer);
    const SceneHit<Scalar> expected{{t, quarter, quarter, triangle, side}, instance};
    EXPECT_TRUE(same_bits(*answer, expected)) << hex_text(*answer);
  }

  std::vector<SceneHit<Scalar>> all(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options = {}) const {
    std::vector<SceneHit<Scalar>> hits;
    scene.all_hits(path, hits, options);
    return hits;
  }

  std::shared_ptr<Collider<Scalar>> floor = stack_collider<Scalar>(1);
  Scene<Scalar> scene;
};

}  // namespace surehit::test
