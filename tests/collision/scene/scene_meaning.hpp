#pragma once

#include <gtest/gtest.h>

#include <algorithm>
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

  /// A ball above (1/4, 1/4), from one height to another.
  static SweptSphere<Scalar> falling(Scalar from, Scalar to, Scalar radius) {
    const auto [start, end] = across(from, to);
    return {start, end, radius};
  }

  /// Adds five instances of one mesh, which is the unit triangle twice, and returns their ids in order.
  std::vector<InstanceId> add_equal_triangles() {
    GeneratedMesh<Scalar> twice;
    for (int i = 0; i < 2; ++i) twice.add(unit_triangle<Scalar>());
    const auto collider = std::make_shared<Collider<Scalar>>(twice.view());
    std::vector<InstanceId> ids;
    for (int i = 0; i < 5; ++i) ids.push_back(scene.add(collider));
    std::sort(ids.begin(), ids.end());
    return ids;
  }

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
