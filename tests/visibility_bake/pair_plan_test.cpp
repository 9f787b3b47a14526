#include "visibility_bake/pair_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "small_level.hpp"
#include "visibility_bake/cells.hpp"

namespace surehit::example::pair_plan_test {
namespace {

class PairPlanTest : public testing::Test {
 protected:
  const Mesh<float> mesh_ = test::level_with_a_door();
  const Colliderf collider_{mesh_.view()};
  const std::vector<Vector3f> floors_ = find_floors(collider_, {.spacing = 0.5f});

  [[nodiscard]] PairPlan plan(const PairOptions& options = {}) const { return {collider_, floors_, options}; }
};

TEST_F(PairPlanTest, has_each_pair_in_range_once) {
  const PairPlan plan = this->plan({.range = 3});
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::size_t longest = 0;
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    const auto partners = plan.partners(cell);
    longest = std::max(longest, partners.size());
    EXPECT_TRUE(std::ranges::is_sorted(partners));
    for (const std::uint32_t partner : partners) EXPECT_TRUE(pairs.insert(std::minmax(cell, partner)).second);
  }
  std::size_t in_range = 0;
  for (std::uint32_t a = 0; a < plan.cell_count(); ++a) {
    for (std::uint32_t b = a + 1; b < plan.cell_count(); ++b) in_range += (floors_[a] - floors_[b]).norm() <= 3;
  }
  EXPECT_EQ(pairs.size(), in_range);
  EXPECT_LT(longest * plan.cell_count(), 3 * in_range) << "rows are about as long as each other";
}

TEST_F(PairPlanTest, eyes_are_in_their_cells) {
  const PairPlan plan = this->plan({.cell_width = 0.5f, .eye_height = 1.6f});
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    const Vector3f middle = floors_[cell] + Vector3f(0, 0, 1.6f);
    EXPECT_EQ(plan.eye(cell, 0), middle);
    for (std::uint32_t number = 1; number < PairPlan::eyes_of_a_cell; ++number) {
      const Vector3f offset = plan.eye(cell, number) - floors_[cell];
      EXPECT_LE(offset.head<2>().cwiseAbs().maxCoeff(), 0.2501f);
      EXPECT_GE(offset.z(), 0.3999f);
      EXPECT_LE(offset.z(), 1.6001f);
      EXPECT_FALSE(collider_.any_hit(Segmentf{middle, plan.eye(cell, number)})) << "no eye is behind a wall";
    }
  }
}

TEST_F(PairPlanTest, eyes_are_below_a_ceiling) {
  SolidBuilder builder(1);
  builder.add_box({0, 0, -1}, {8, 4, 0});
  builder.add_box({0, 0, 1.2f}, {4, 4, 1.4f});
  const Mesh<float> mesh = builder.take();
  const Colliderf collider(mesh.view());
  const PairPlan plan(collider, {{2, 2, 0}, {6, 2, 0}}, {.cell_width = 0.5f, .eye_height = 1.6f});
  for (std::uint32_t number = 0; number < PairPlan::eyes_of_a_cell; ++number) {
    EXPECT_GE(plan.eye(0, number).z(), 0.2999f);
    EXPECT_LT(plan.eye(0, number).z(), 1.2f);
  }
  EXPECT_GT(plan.eye(0, 0).z(), 1.1999f);
  EXPECT_EQ(plan.eye(1, 0), Vector3f(6, 2, 1.6f));
}

TEST_F(PairPlanTest, segments_of_a_pair_differ) {
  const PairPlan plan = this->plan();
  constexpr std::uint32_t all = PairPlan::eyes_of_a_cell * PairPlan::eyes_of_a_cell;
  std::set<std::tuple<float, float, float, float, float, float>> segments;
  for (std::uint32_t sample = 0; sample < all; ++sample) {
    const Segmentf segment = plan.segment(3, 90, sample);
    segments.emplace(segment.start.x(), segment.start.y(), segment.start.z(), segment.end.x(), segment.end.y(),
                     segment.end.z());
  }
  EXPECT_EQ(segments.size(), std::size_t{all});
}

TEST_F(PairPlanTest, fingerprints_tell_plans_apart) {
  const std::uint64_t fingerprint = plan().fingerprint(collider_);
  EXPECT_EQ(plan().fingerprint(collider_), fingerprint);
  EXPECT_NE(plan({.range = 21}).fingerprint(collider_), fingerprint);
  EXPECT_NE(plan({.samples = 9}).fingerprint(collider_), fingerprint);
  EXPECT_NE(plan({.cell_width = 2}).fingerprint(collider_), fingerprint);
  EXPECT_NE(plan({.eye_height = 1}).fingerprint(collider_), fingerprint);
  std::vector<Vector3f> moved = floors_;
  moved.back().x() += 0.125f;
  EXPECT_NE(PairPlan(collider_, moved, {}).fingerprint(collider_), fingerprint);
  Mesh<float> other = mesh_;
  other.vertices.back()[1] = std::nextafter(other.vertices.back()[1], 9.0f);
  EXPECT_NE(plan().fingerprint(Colliderf(other.view())), fingerprint);
}

}  // namespace
}  // namespace surehit::example::pair_plan_test
