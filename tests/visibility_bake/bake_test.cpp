#include "visibility_bake/bake.hpp"

#include <gtest/gtest.h>

#include "examples/temporary_folder.hpp"
#include "small_level.hpp"
#include "visibility_bake/cells.hpp"

namespace surehit::example::bake_test {
namespace {

class Bake : public testing::Test {
 protected:
  const Mesh<float> mesh_ = test::level_with_a_door();
  const Colliderf collider_{mesh_.view()};
  const PairPlan plan_{
      collider_,
      reachable_floors(collider_, find_floors(collider_, {.spacing = 0.5f}), {1, 1, 0}, {.spacing = 0.5f}),
      {.range = 6, .samples = 5, .cell_width = 0.5f}};
  const test::TemporaryFolder folder_;
  const Checkpoint checkpoint_{folder_.at("checkpoint"), 1};

  [[nodiscard]] Visibility baked(unsigned threads, Visibility begun) const {
    bake(collider_, plan_, checkpoint_, {.threads = threads}, begun);
    return begun;
  }
  [[nodiscard]] Visibility baked(unsigned threads = 1) const { return baked(threads, Visibility(plan_.cell_count())); }
};

TEST_F(Bake, says_what_single_queries_say) {
  const Visibility visibility = baked();
  std::vector<Visibility::Figures> figures(plan_.cell_count());
  std::size_t seen = 0;
  for (std::uint32_t a = 0; a < plan_.cell_count(); ++a) {
    EXPECT_TRUE(visibility.sees(a, a));
    for (const std::uint32_t b : plan_.partners(a)) {
      std::uint64_t clear = 0;
      for (std::uint32_t sample = 0; sample < 5; ++sample) clear += !collider_.any_hit(plan_.segment(a, b, sample));
      EXPECT_EQ(visibility.sees(a, b), clear > 0);
      EXPECT_EQ(visibility.sees(b, a), clear > 0);
      seen += clear > 0;
      for (const std::uint32_t cell : {a, b}) {
        ++figures[cell].cells_in_range;
        figures[cell].cells_seen += clear > 0;
        figures[cell].clear_segments += clear;
      }
    }
  }
  EXPECT_GT(seen, 1'000u);
  for (std::uint32_t cell = 0; cell < plan_.cell_count(); ++cell) {
    EXPECT_EQ(visibility.figures(cell), figures[cell]) << cell;
    EXPECT_TRUE(visibility.has_row(cell));
  }
  EXPECT_EQ(visibility.row_count(), plan_.cell_count());
}

TEST_F(Bake, sees_through_the_door_alone) {
  const Visibility visibility = baked();
  const auto cell_at = [&](float x, float y) {
    std::uint32_t best = 0;
    for (std::uint32_t cell = 0; cell < plan_.cell_count(); ++cell) {
      const auto distance = [&](std::uint32_t i) { return (plan_.floors()[i] - Vector3f(x, y, 0)).norm(); };
      if (distance(cell) < distance(best)) best = cell;
    }
    return best;
  };
  EXPECT_TRUE(visibility.sees(cell_at(3, 1.5f), cell_at(5, 1.5f)));
  EXPECT_FALSE(visibility.sees(cell_at(3, 3.5f), cell_at(5, 3.5f)));
  EXPECT_TRUE(visibility.sees(cell_at(1, 3.5f), cell_at(3, 0.5f)));
}

TEST_F(Bake, is_the_same_for_any_number_of_threads) {
  const Visibility alone = baked();
  EXPECT_EQ(baked(2), alone);
  EXPECT_EQ(baked(7), alone);
}

TEST_F(Bake, adds_the_rows_that_are_missing) {
  const Visibility all = baked();
  Visibility some(plan_.cell_count());
  for (std::uint32_t cell = plan_.cell_count(); cell-- > 0;) {
    if (cell % 3 != 1) some.add(bake_row(collider_, plan_, cell));
  }
  EXPECT_NE(some, all);
  checkpoint_.save(some);
  Visibility loaded = checkpoint_.load(plan_.cell_count());
  EXPECT_EQ(loaded, some);
  EXPECT_EQ(baked(2, loaded), all);
  EXPECT_EQ(baked(1, all), all) << "nothing is missing";
}

TEST_F(Bake, saves_checkpoints) {
  Visibility visibility(plan_.cell_count());
  bake(collider_, plan_, checkpoint_, {.checkpoint_seconds = 0}, visibility);
  EXPECT_EQ(checkpoint_.load(plan_.cell_count()), visibility);
  EXPECT_EQ(folder_.file_count(), 1u);
  checkpoint_.remove();
  EXPECT_EQ(folder_.file_count(), 0u);
  EXPECT_EQ(checkpoint_.load(plan_.cell_count()), Visibility(plan_.cell_count()));
}

}  // namespace
}  // namespace surehit::example::bake_test
