#include "agents_tick/crowd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace surehit::example::crowd_test {
namespace {

TEST(Crowd, looks_into_vision_cones) {
  const Crowd crowd(200, 3);
  const std::vector<Look> looks = crowd.looks(1'000);
  ASSERT_EQ(looks.size(), 1'000u);
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>> different;
  for (const Look& look : looks) {
    different.insert({look.from, look.to, look.part});
    const Agent& viewer = crowd.agents()[look.from];
    const Vector3f away = crowd.agents()[look.to].foot - viewer.foot;
    EXPECT_LE(away.norm(), 60.01f);
    EXPECT_GE(away.normalized().dot(viewer.heading), 0.499f);
  }
  EXPECT_EQ(different.size(), looks.size());
}

TEST(Crowd, has_no_more_looks_than_the_cones_hold) {
  const Crowd crowd(10, 3);
  EXPECT_LE(crowd.looks(100'000).size(), 3u * 10 * 9);
}

TEST(Crowd, walks_through_nothing) {
  Town town(1);
  Crowd crowd(500, 1);
  const SceneQueryOptionsf options{.instance_mask = blocks_movement};
  std::size_t turned = 0;
  for (std::uint32_t tick = 0; tick < 60; ++tick) {
    const std::vector<Agent> before = crowd.agents();
    crowd.walk(town, {});
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Agent& after = crowd.agents()[i];
      const Vector3f up(0, 0, 0.5f);
      ASSERT_FALSE(town.scene().any_hit(Segmentf{before[i].foot + up, after.foot + up}, options)) << tick << ' ' << i;
      turned += before[i].heading != after.heading;
    }
  }
  EXPECT_GT(turned, 50u);
}

}  // namespace
}  // namespace surehit::example::crowd_test
