#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/scene_judge.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/scene_text.hpp"

namespace surehit::test::scene_comparison_test {
namespace {

template <typename Scalar>
std::string text_of(const DrawnScene<Scalar>& scene, const std::vector<InstanceId>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto& [mesh, placement] = scene.instances[i];
    text += hex_text(ids[i]) + " of mesh " + std::to_string(mesh) + ": " + hex_text(placement) + '\n';
  }
  return text;
}

/// Half of the questions have options that are hard for their hits.
template <typename Scalar>
std::vector<SceneQuestion<Scalar>> draw_questions(ScenePathDrawer<Scalar>& drawer, const SceneOracle<Scalar>& oracle,
                                                  std::size_t count, Random& random) {
  std::vector<SceneQuestion<Scalar>> questions;
  while (questions.size() < count) {
    SceneQuestion<Scalar> question{drawer.draw()};
    const auto hits = oracle.all_hits(question.path);
    if (!hits.empty() && random.one_in(2))
      question.options = draw_scene_options(hits[random.below(hits.size())], random);
    questions.push_back(question);
  }
  return questions;
}

class SceneComparison : public testing::TestWithParam<SceneFamily> {};

/// The definition is the test: all answers are those of the exact world triangles.
template <typename Scalar>
void check(SceneFamily family) {
  Random random(20261125 + static_cast<std::uint64_t>(family));
  std::size_t paths = 0;
  std::size_t hits = 0;
  for (std::size_t i = case_count(150); i > 0; --i) {
    const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
    const JudgedScene<Scalar> judged(drawn);
    ScenePathDrawer<Scalar> drawer(drawn, judged.oracle, judged.ids, random);
    const auto questions = draw_questions(drawer, judged.oracle, 12, random);
    ASSERT_EQ(scene_difference(judged.scene, judged.oracle, questions), "") << "scene " << i << '\n'
                                                                            << text_of(drawn, judged.ids);
    for (const auto& [path, options] : questions) hits += !judged.oracle.all_hits(path).empty();
    paths += questions.size();
  }
  // A family that turned into hits or misses alone would test little.
  if (paths < 80) return;
  EXPECT_GE(hits, paths / 5);
  EXPECT_GE(paths - hits, paths / 20);
}

TEST_P(SceneComparison, of_float_scenes) { check<float>(GetParam()); }
TEST_P(SceneComparison, of_double_scenes) { check<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Families, SceneComparison, testing::ValuesIn(all_scene_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class SceneComparisonOf : public testing::Test {
 protected:
  /// The world triangles of a scene of translations whose sums are exact, with those of the lowest id first.
  static GeneratedMesh<Scalar> flattened(const JudgedScene<Scalar>& judged, const DrawnScene<Scalar>& drawn) {
    GeneratedMesh<Scalar> mesh;
    for (const std::size_t i : by_id(judged.ids)) {
      const std::size_t count = drawn.meshes[drawn.instances[i].mesh].triangles.size();
      for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
        mesh.add(judged.oracle.triangle(judged.ids[i], triangle));
      }
    }
    return mesh;
  }

  static std::vector<std::size_t> by_id(const std::vector<InstanceId>& ids) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < ids.size(); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) { return ids[left] < ids[right]; });
    return order;
  }

  /// A scene of copies of one piece of ground, in whole numbers.
  static DrawnScene<Scalar> whole_translations(Random& random) {
    DrawnScene<Scalar> drawn;
    drawn.meshes.push_back(ground_piece(2, true, random));
    for (auto& vertex : drawn.meshes[0].vertices) vertex[2] = static_cast<double>(random.between(-1, 1));
    for (int i = 0; i < 6; ++i) {
      const auto whole = [&] { return static_cast<Scalar>(random.between(-2, 2)); };
      const Scalar x = whole();
      const Scalar y = whole();
      drawn.instances.push_back({0, {Pose<Scalar>::translated({x, y, whole()})}});
    }
    return drawn;
  }
};
TYPED_TEST_SUITE(SceneComparisonOf, Scalars, ScalarNames);

TYPED_TEST(SceneComparisonOf, translated_instances_are_one_flattened_collider) {
  Random random(7);
  for (std::size_t i = case_count(100); i > 0; --i) {
    const auto drawn = this->whole_translations(random);
    const JudgedScene<TypeParam> judged(drawn);
    const Collider<TypeParam> flat(this->flattened(judged, drawn).view());
    const auto order = this->by_id(judged.ids);
    const auto count = static_cast<std::uint32_t>(drawn.meshes[0].triangles.size());
    ScenePathDrawer<TypeParam> drawer(drawn, judged.oracle, judged.ids, random);
    for (int path_count = 0; path_count < 20; ++path_count) {
      const Path<TypeParam> path = drawer.draw();
      std::vector<SceneHit<TypeParam>> hits;
      std::vector<Hit<TypeParam>> expected;
      judged.scene.all_hits(path, hits);
      flat.all_hits(path, expected);
      ASSERT_EQ(hits.size(), expected.size()) << hex_text(path);
      for (std::size_t hit = 0; hit < hits.size(); ++hit) {
        const std::uint32_t triangle = expected[hit].triangle;
        SceneHit<TypeParam> placed{expected[hit], judged.ids[order[triangle / count]]};
        placed.triangle = triangle % count;
        ASSERT_TRUE(same_bits(hits[hit], placed)) << hex_text(path) << hex_text(hits);
      }
    }
  }
}

/// Adds, removes and sets in any order, with commits between. The result is judged by the ids that it has.
TYPED_TEST(SceneComparisonOf, any_order_of_changes_leads_to_the_same_answers) {
  Random random(9);
  for (std::size_t round = case_count(100); round > 0; --round) {
    const auto drawn = draw_scene<TypeParam>(SceneFamily::mixed, random);
    std::vector<std::shared_ptr<const Collider<TypeParam>>> colliders;
    for (const DrawnMesh& mesh : drawn.meshes) colliders.push_back(collider_of<TypeParam>(mesh));

    Scene<TypeParam> scene;
    std::vector<std::optional<InstanceId>> ids(drawn.instances.size());
    const auto change = [&](std::size_t i) {
      const auto& [mesh, placement] = drawn.instances[i];
      if (!ids[i]) {
        ids[i] = scene.add(colliders[mesh], draw_pose<TypeParam>(SceneFamily::rotations, random));
      } else if (random.one_in(3)) {
        scene.remove(*ids[i]);
        ids[i].reset();
      } else {
        scene.set_pose(*ids[i], draw_pose<TypeParam>(SceneFamily::mixed, random));
        scene.set_motion(*ids[i], {1, 2, 3});
        scene.set_collider(*ids[i], colliders[random.below(colliders.size())]);
        scene.set_mask(*ids[i], 0);
      }
    };
    for (int i = 0; i < 30; ++i) {
      change(random.below(ids.size()));
      if (random.one_in(6)) scene.commit();
    }

    SceneOracle<TypeParam> oracle;
    std::vector<InstanceId> final_ids;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto& [mesh, placement] = drawn.instances[i];
      if (!ids[i]) ids[i] = scene.add(colliders[mesh]);
      scene.set_collider(*ids[i], colliders[mesh]);
      scene.set_mask(*ids[i], placement.mask);
      scene.set_motion(*ids[i], placement.motion);
      scene.set_pose(*ids[i], placement.pose);
      final_ids.push_back(*ids[i]);
      oracle.add(*ids[i], drawn.meshes[mesh].view(), drawn.meshes[mesh].masks, placement);
    }
    scene.commit();
    ScenePathDrawer<TypeParam> drawer(drawn, oracle, final_ids, random);
    ASSERT_EQ(scene_difference(scene, oracle, draw_questions(drawer, oracle, 12, random)), "")
        << text_of(drawn, final_ids);
  }
}

}  // namespace
}  // namespace surehit::test::scene_comparison_test
