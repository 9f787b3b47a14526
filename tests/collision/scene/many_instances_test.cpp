#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_text.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::many_instances_test {
namespace {

/// Scenes with as many instances as worlds have.
template <typename Scalar>
class ManyInstances : public testing::Test {
 protected:
  /// Instances of one collider on a square grid, `side` in each direction and 2 apart.
  std::vector<InstanceId> add_square(int side) {
    std::vector<InstanceId> ids;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) ids.push_back(scene.add(floor, Pose<Scalar>::translated(place(x, y))));
    }
    return ids;
  }

  static Vector3<Scalar> place(int x, int y) { return {static_cast<Scalar>(2 * x), static_cast<Scalar>(2 * y), 0}; }

  static Segment<Scalar> onto(const Vector3<Scalar>& place) {
    const auto segment = through_stack<Scalar>(1, -1);
    return {segment.start + place, segment.end + place};
  }

  std::shared_ptr<Collider<Scalar>> floor = stack_collider<Scalar>(1);
  Scene<Scalar> scene;
};
TYPED_TEST_SUITE(ManyInstances, Scalars, ScalarNames);

TYPED_TEST(ManyInstances, hundred_thousand_on_a_plane_are_each_found) {
  constexpr int side = 317;
  const auto ids = this->add_square(side);
  EXPECT_EQ(this->scene.instance_count(), 100'489U);
  EXPECT_EQ(this->floor.use_count(), 100'490);
  this->scene.commit();
  std::vector<Segment<TypeParam>> segments;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) segments.push_back(this->onto(this->place(x, y)));
  }
  segments.resize(case_count(segments.size()), this->onto({0, 0, 0}));
  std::vector<SceneHit<TypeParam>> hits(segments.size());
  this->scene.first_hits(segments, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_EQ(hits[i].instance, ids[i]);
    ASSERT_EQ(hits[i].t, TypeParam{0.5});
  }
  // Along a row, through all of its instances.
  std::vector<SceneHit<TypeParam>> row;
  this->scene.all_hits(Ray<TypeParam>{{-1, 0, 0}, {1, 0, 0}}, row);
  EXPECT_EQ(row.size(), static_cast<std::size_t>(side));
}

TYPED_TEST(ManyInstances, ten_thousand_in_one_place_are_all_hit_in_order) {
  for (int i = 0; i < 10'000; ++i) this->scene.add(this->floor);
  this->scene.commit();
  std::vector<SceneHit<TypeParam>> hits;
  this->scene.all_hits(through_stack<TypeParam>(1, -1), hits);
  ASSERT_EQ(hits.size(), 10'000U);
  for (std::size_t i = 1; i < hits.size(); ++i) ASSERT_LT(hits[i - 1].instance, hits[i].instance);
  EXPECT_EQ(this->scene.first_hit(through_stack<TypeParam>(1, -1))->instance, hits[0].instance);
}

TYPED_TEST(ManyInstances, a_batch_answers_a_path_that_has_a_hundred_boxes_ahead) {
  // Each instance is in front of all larger ones, and the path goes between its two triangles.
  GeneratedMesh<TypeParam> gap;
  gap.add({{-1, -1, -1}, {-1, -1, 1}, {1, -1, -1}});
  gap.add({{1, 1, 1}, {1, 1, -1}, {-1, 1, 1}});
  const auto pair = std::make_shared<Collider<TypeParam>>(gap.view());
  for (int i = 0; i < 120; ++i) {
    const auto size = static_cast<TypeParam>(std::exp2(i / 2.0));
    Pose<TypeParam> pose = Pose<TypeParam>::translated({TypeParam(1.25) * size, 0, 0});
    pose.linear *= size / 8;
    this->scene.add(pair, pose);
  }
  GeneratedMesh<TypeParam> triangle;
  triangle.add({{1, -9, -9}, {1, 9, -9}, {1, 0, 18}});
  Pose<TypeParam> far;
  far.linear *= static_cast<TypeParam>(0x1p61);
  const InstanceId wall = this->scene.add(std::make_shared<Collider<TypeParam>>(triangle.view()), far);
  this->scene.commit();
  const std::vector<Segment<TypeParam>> segments(40, {{0, 0, 0}, {static_cast<TypeParam>(0x1p62), 0, 0}});
  std::vector<SceneHit<TypeParam>> hits(segments.size());
  std::vector<std::uint8_t> blocked(segments.size());
  QueryStatistics statistics;
  this->scene.first_hits(segments, hits, {.statistics = &statistics});
  this->scene.any_hits(segments, blocked);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_EQ(hits[i].instance, wall);
    ASSERT_EQ(hits[i].t, TypeParam(0.5));
    ASSERT_EQ(blocked[i], 1);
  }
  EXPECT_EQ(statistics.paths, segments.size());
}

TYPED_TEST(ManyInstances, few_changes_among_many_are_seen_after_each_commit) {
  constexpr int side = 100;
  const auto ids = this->add_square(side);
  this->scene.commit();
  Random random(3);
  for (int tick = 0; tick < 50; ++tick) {
    // Some come up by 8, and go back in the next tick.
    std::vector<int> moved;
    for (int i = 0; i < 20; ++i) moved.push_back(static_cast<int>(random.below(ids.size())));
    for (const TypeParam height : {TypeParam{8}, TypeParam{0}}) {
      for (const int i : moved) {
        const auto place = this->place(i % side, i / side);
        this->scene.set_pose(ids[static_cast<std::size_t>(i)],
                             Pose<TypeParam>::translated({place[0], place[1], height}));
      }
      this->scene.commit();
      for (const int i : moved) {
        auto place = this->place(i % side, i / side);
        ASSERT_EQ(this->scene.any_hit(this->onto(place)), height == 0);
        place[2] = height;
        const auto hit = this->scene.first_hit(this->onto(place));
        ASSERT_TRUE(hit);
        ASSERT_EQ(hit->instance, ids[static_cast<std::size_t>(i)]);
      }
    }
  }
}

TYPED_TEST(ManyInstances, removed_ones_are_gone_and_new_ones_are_found) {
  const auto ids = this->add_square(100);
  this->scene.commit();
  for (std::size_t i = 0; i < ids.size(); i += 2) this->scene.remove(ids[i]);
  this->scene.commit();
  EXPECT_EQ(this->scene.instance_count(), ids.size() / 2);
  for (int i = 0; i < 10'000; i += 97) {
    const auto place = this->place(i % 100, i / 100);
    ASSERT_EQ(this->scene.any_hit(this->onto(place)), i % 2 == 1);
  }
  std::vector<InstanceId> later;
  for (int i = 0; i < 3000; ++i)
    later.push_back(this->scene.add(this->floor, at_height<TypeParam>(static_cast<TypeParam>(3 * i + 10))));
  this->scene.commit();
  for (int i = 0; i < 3000; i += 31) {
    const auto hit = this->scene.first_hit(this->onto({0, 0, static_cast<TypeParam>(3 * i + 10)}));
    ASSERT_TRUE(hit);
    ASSERT_EQ(hit->instance, later[static_cast<std::size_t>(i)]);
  }
}

TYPED_TEST(ManyInstances, some_come_and_go_in_each_tick) {
  constexpr int side = 40;
  auto ids = this->add_square(side);
  this->scene.commit();
  std::vector<Segment<TypeParam>> segments;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) segments.push_back(this->onto(this->place(x, y)));
  }
  const auto expect_found = [&](const SceneQueries<TypeParam>& scene, const std::vector<InstanceId>& expected) {
    std::vector<SceneHit<TypeParam>> hits(segments.size());
    scene.first_hits(segments, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i].instance, expected[i]) << i;
    const bool has_last = expected.back() != InstanceId{};
    ASSERT_EQ(scene.any_hit(this->onto(this->place(side - 1, side - 1))), has_last);
  };
  Random random(7);
  for (int tick = 0; tick < 60; ++tick) {
    const auto snapshot = this->scene.snapshot();
    const auto before = ids;
    for (int i = 0; i < 50; ++i) {
      const std::size_t at = random.below(ids.size());
      if (ids[at] == InstanceId{}) {
        const int place = static_cast<int>(at);
        ids[at] = this->scene.add(this->floor, Pose<TypeParam>::translated(this->place(place % side, place / side)));
      } else {
        this->scene.remove(ids[at]);
        ids[at] = {};
      }
    }
    this->scene.commit();
    expect_found(this->scene, ids);
    // Every other tick, the next commit finds no one else that has this state.
    if (tick % 2 == 0) expect_found(snapshot, before);
    if (this->HasFatalFailure()) return;
  }
}

/// The origin must not come into the box, neither where it is near enough for the frame of the tree nor where it is
/// not.
TYPED_TEST(ManyInstances, box_is_as_before_when_one_in_the_middle_has_gone) {
  constexpr int side = 20;
  for (int distance : {1, 1000}) {
    Scene<TypeParam> scene;
    std::vector<InstanceId> ids;
    for (int i = 0; i < side * side; ++i) {
      const Vector3<TypeParam> at = this->place(distance + i % side, distance + i / side);
      ids.push_back(scene.add(this->floor, Pose<TypeParam>::translated({at[0], at[1], at[0]})));
    }
    scene.commit();
    const auto box = scene.box();
    scene.remove(ids[side * side / 2 + side / 2]);
    scene.commit();
    EXPECT_EQ(scene.box().low, box.low);
    EXPECT_EQ(scene.box().high, box.high);
    scene.set_collider(ids[3 * side + 4], std::make_shared<Collider<TypeParam>>());
    scene.commit();
    EXPECT_EQ(scene.box().low, box.low);
    EXPECT_EQ(scene.box().high, box.high);
  }
}

}  // namespace
}  // namespace surehit::test::many_instances_test
