#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <map>
#include <vector>

#include "determinism.hpp"
#include "level/level.hpp"
#include "support/case_count.hpp"
#include "support/path_drawer.hpp"

namespace surehit::test::level_determinism_test {
namespace {

/// 10,000 questions about the built-in level, or more: a million with SUREHIT_TEST_PERCENT=10000.
class LevelDeterminism : public testing::Test {
 protected:
  static Questions<float> drawn(const TriangleMeshViewf& mesh) {
    PathDrawer<float> drawer(mesh, 20261121);
    Questions<float> questions = {asked_options<float>(), {}, 8};
    for (std::size_t i = case_count(10'000); i > 0; --i) {
      const Path<float> path = drawer.random().one_in(50) ? drawer.draw_from_afar(0x1p20F) : drawer.draw();
      questions.all.push_back({path, drawer.random().one_in(10) ? 1 + drawer.random().below(2) : 0});
    }
    return questions;
  }

  const example::Level level = example::build_level();
  const std::vector<std::uint32_t> masks = asked_masks(level.mesh.triangles.size());
  const Questions<float> questions = drawn(level.mesh.view());
  const Determinism<float> determinism{level.mesh.view(), masks, questions};
};

TEST_F(LevelDeterminism, answers_are_the_published_ones) {
  const std::map<std::size_t, std::uint64_t> published = {{10'000, 0x9d473006222795d0u},
                                                          {1'000'000, 0x7068700b900391cbu}};
  std::printf("%zu answers, %zu of them hits: %016" PRIx64 "\n", questions.all.size(),
              determinism.answers().hit_count(), determinism.answers().hash());
  EXPECT_GT(determinism.answers().hit_count(), questions.all.size() / 2);
  const auto hash = published.find(questions.all.size());
  if (hash != published.end()) {
    EXPECT_EQ(determinism.answers().hash(), hash->second);
  }
}

TEST_F(LevelDeterminism, answers_are_the_same_on_every_instruction_set) {
  determinism.expect_same_of_every_instruction_set();
}

TEST_F(LevelDeterminism, answers_are_the_same_in_every_grid) {
  // A path meets all triangles there.
  EXPECT_EQ(determinism.expect_same_in({.resolution = {1, 1, 1}, .crowded = 0}, questions.all.size() / 500), 1U);
  determinism.expect_same_in({.resolution = {30, 40, 5}, .crowded = 0});
  EXPECT_GE(determinism.expect_same_in({.resolution = {2048, 2048, 2048}, .crowded = 1}), 1'000'000U);
}

TEST_F(LevelDeterminism, answers_are_the_same_of_any_number_of_threads) {
  determinism.expect_same_of_any_number_of_threads();
}

TEST_F(LevelDeterminism, answers_are_the_same_of_any_batch_size) { determinism.expect_same_of_any_batch_size(); }

TEST_F(LevelDeterminism, answers_are_the_same_in_any_order) { determinism.expect_same_in_any_order(); }

}  // namespace
}  // namespace surehit::test::level_determinism_test
