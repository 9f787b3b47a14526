#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "scene_meaning.hpp"
#include "support/neighbour.hpp"

namespace surehit::test::scene_options_test {
namespace {

/// What the options of queries and batches mean.
template <typename Scalar>
class SceneOptions : public SceneMeaning<Scalar> {};
TYPED_TEST_SUITE(SceneOptions, Scalars, ScalarNames);

TYPED_TEST(SceneOptions, instance_masks_leave_out_instances) {
  const auto wall = this->add({}, {.mask = 1});
  const auto glass = this->add({}, {.mask = 2});
  this->add({}, {.mask = 0});
  this->scene.commit();
  const auto path = this->across(1, -1);
  EXPECT_EQ(this->all(path).size(), 2U);
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 1}), TypeParam{0.5}, Side::front, wall);
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 2}), TypeParam{0.5}, Side::front, glass);
  EXPECT_FALSE(this->scene.any_hit(path, {.instance_mask = 4}));
  EXPECT_FALSE(this->scene.any_hit(path, {.instance_mask = 0}));
  this->scene.set_mask(glass, 5);
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 4}), TypeParam{0.5}, Side::front, glass);
}

TYPED_TEST(SceneOptions, masks_leave_out_triangles) {
  const auto id = this->scene.add(stack_collider<TypeParam>(3, {1, 2, 0}), {}, {.mask = 4});
  this->scene.commit();
  const auto path = this->across(3, -1);
  EXPECT_EQ(this->all(path).size(), 2U);
  this->expect_hit(this->scene.first_hit(path, {.mask = 1}), TypeParam{0.75}, Side::front, id, 0);
  this->expect_hit(this->scene.first_hit(path, {.mask = 2}), TypeParam{0.5}, Side::front, id, 1);
  EXPECT_FALSE(this->scene.any_hit(path, {.mask = 4}));
  EXPECT_FALSE(this->scene.any_hit(path, {.mask = 1, .instance_mask = 1}));
}

TYPED_TEST(SceneOptions, ignored_instance_is_left_out) {
  const auto upper = this->add(at_height<TypeParam>(1));
  const auto lower = this->add();
  this->scene.commit();
  const auto path = this->across(2, -2);
  this->expect_hit(this->scene.first_hit(path), this->quarter, Side::front, upper);
  this->expect_hit(this->scene.first_hit(path, {.ignored_instance = upper}), TypeParam{0.5}, Side::front, lower);
}

TYPED_TEST(SceneOptions, ignored_triangle_is_one_of_the_ignored_instance) {
  const auto stack = stack_collider<TypeParam>(2);
  const auto upper = this->scene.add(stack, at_height<TypeParam>(2));
  const auto lower = this->scene.add(stack);
  this->scene.commit();
  const auto path = this->across(4, -4);
  const auto hits = this->all(path, {.ignored_instance = upper, .ignored_triangle = 1});
  ASSERT_EQ(hits.size(), 3U);
  this->expect_hit(hits[0], this->quarter, Side::front, upper, 0);
  this->expect_hit(hits[1], TypeParam{0.375}, Side::front, lower, 1);
  // Without an ignored instance it means nothing.
  EXPECT_EQ(this->all(path, {.ignored_triangle = 1}).size(), 4U);
}

TYPED_TEST(SceneOptions, stale_ignored_instance_leaves_out_nothing) {
  const auto old = this->add();
  this->scene.remove(old);
  this->scene.commit();
  const auto later = this->add();
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, -1), {.ignored_instance = old}), TypeParam{0.5}, Side::front,
                   later);
}

TYPED_TEST(SceneOptions, limits_are_exact) {
  this->add(with_rows<TypeParam>({3, 0, 0}, {0, 3, 0}, {0, 0, 3}));
  this->scene.commit();
  const TypeParam half{0.5};
  EXPECT_TRUE(this->scene.any_hit(this->across(1, -1), {.min_t = half, .max_t = half}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.min_t = neighbour(half, 1)}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.max_t = neighbour(half, -1)}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.min_t = std::numeric_limits<TypeParam>::quiet_NaN()}));
}

TYPED_TEST(SceneOptions, filter_sees_the_hit_and_its_instance) {
  const auto upper = this->add(at_height<TypeParam>(1));
  const auto lower = this->add();
  this->scene.commit();
  const auto path = this->across(2, -2);
  std::vector<SceneHit<TypeParam>> seen;
  const auto is_lower = [&](const SceneHit<TypeParam>& hit) {
    seen.push_back(hit);
    return hit.instance == lower;
  };
  this->expect_hit(this->scene.first_hit(path, is_lower), TypeParam{0.5}, Side::front, lower);
  for (const auto& hit : seen) {
    this->expect_hit(hit, hit.instance == upper ? this->quarter : TypeParam{0.5}, Side::front, hit.instance);
  }
  EXPECT_TRUE(this->scene.any_hit(path, is_lower));
  std::vector<SceneHit<TypeParam>> hits;
  this->scene.all_hits(path, hits, is_lower);
  ASSERT_EQ(hits.size(), 1U);
  this->expect_hit(hits[0], TypeParam{0.5}, Side::front, lower);
}

TYPED_TEST(SceneOptions, batch_ends_with_the_shortest_of_its_spans) {
  this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(3, this->across(1, -1));
  const std::vector<SceneQueryOptions<TypeParam>> options(2);
  std::vector<SceneHit<TypeParam>> hits(4);
  std::vector<std::uint8_t> blocked(4, 7);
  this->scene.first_hits(paths, hits, {.path_options = options});
  this->scene.any_hits(paths, blocked, {.path_options = options});
  EXPECT_EQ(hits[1].triangle, 0U);
  EXPECT_EQ(hits[2].triangle, no_triangle);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 1, 7, 7}));
  this->scene.first_hits(paths, hits);
  EXPECT_EQ(hits[2].triangle, 0U);
  EXPECT_EQ(hits[3].triangle, no_triangle);
}

TYPED_TEST(SceneOptions, each_path_of_a_batch_has_its_options) {
  this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneQueryOptions<TypeParam>> options(paths.size());
  for (std::size_t i = 0; i < paths.size(); i += 3) options[i].max_t = TypeParam(0.25);
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  this->scene.first_hits(paths, hits, {.path_options = options});
  this->scene.any_hits(paths, blocked, {.path_options = options});
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, i % 3 == 0 ? no_triangle : 0U);
    EXPECT_EQ(blocked[i], i % 3 == 0 ? 0 : 1);
  }
}

TYPED_TEST(SceneOptions, filter_of_a_batch_sees_the_path) {
  const auto id = this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  const auto is_third = [](std::size_t path, const SceneHit<TypeParam>&) { return path % 3 == 0; };
  this->scene.first_hits(paths, hits, {.filter = is_third});
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i].instance, i % 3 == 0 ? id : InstanceId{});
}

TYPED_TEST(SceneOptions, statistics_count_each_path_once) {
  for (int i = 0; i < 3; ++i) this->add(at_height<TypeParam>(static_cast<TypeParam>(i)));
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  QueryStatistics statistics;
  this->scene.first_hits(paths, hits, {.statistics = &statistics});
  EXPECT_EQ(statistics.paths, 40U);
  static_cast<void>(this->scene.first_hit(paths[0], {}, &statistics));
  static_cast<void>(this->scene.any_hit(paths[0], {}, &statistics));
  this->scene.all_hits(paths[0], hits, {}, &statistics);
  EXPECT_EQ(statistics.paths, 43U);
}

}  // namespace
}  // namespace surehit::test::scene_options_test
