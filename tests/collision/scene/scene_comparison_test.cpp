#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
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
class SceneComparisonOf : public testing::Test {};
TYPED_TEST_SUITE(SceneComparisonOf, Scalars, ScalarNames);

/// The options of one path, which scenes and colliders both have.
template <typename Scalar>
struct BothOptions {
  SceneQueryOptions<Scalar> of_scene;
  QueryOptions<Scalar> of_flat;
};

/// A scene of translations whose sums are exact, and one collider of all of its world triangles. Those of the lowest id
/// come first.
template <typename Scalar>
class FlattenedScene {
 public:
  explicit FlattenedScene(const DrawnScene<Scalar>& drawn) : judged_(drawn) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < judged_.ids.size(); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t left, std::size_t right) { return judged_.ids[left] < judged_.ids[right]; });
    GeneratedMesh<Scalar> mesh;
    std::vector<std::uint32_t> masks;
    for (const std::size_t i : order) {
      const DrawnMesh& part = drawn.meshes[drawn.instances[i].mesh];
      for (std::uint32_t triangle = 0; triangle < part.triangles.size(); ++triangle) {
        mesh.add(judged_.oracle.triangle(judged_.ids[i], triangle));
        masks.push_back(part.masks.empty() ? ~std::uint32_t{0} : part.masks[triangle]);
        places_.emplace_back(judged_.ids[i], triangle);
      }
    }
    flat_ = Collider<Scalar>(mesh.view(), BuildOptions{{}, masks});
  }

  [[nodiscard]] const JudgedScene<Scalar>& judged() const { return judged_; }

  /// Returns options that are hard for a hit of the path. Both sides have them.
  [[nodiscard]] BothOptions<Scalar> draw_options(const Path<Scalar>& path, Random& random) const {
    BothOptions<Scalar> options;
    std::vector<SceneHit<Scalar>> hits;
    judged_.scene.all_hits(path, hits);
    if (hits.empty() || random.one_in(2)) return options;
    const SceneHit<Scalar>& hit = hits[random.below(hits.size())];
    SceneQueryOptions<Scalar>& scene = options.of_scene = draw_scene_options(hit, random);
    scene.instance_mask = ~std::uint32_t{0};
    if (scene.ignored_triangle == no_triangle) scene.ignored_triangle = hit.triangle;
    options.of_flat = {scene.min_t,
                       scene.max_t,
                       scene.culling,
                       scene.mask,
                       no_triangle,
                       scene.ignore_start_contact,
                       scene.ignore_end_contact};
    const auto place = std::find(places_.begin(), places_.end(), Place(scene.ignored_instance, scene.ignored_triangle));
    if (place != places_.end()) options.of_flat.ignored_triangle = static_cast<std::uint32_t>(place - places_.begin());
    return options;
  }

  /// Returns options that narrow a query in one way alone, or in none. Some batches have a fast way without one of
  /// them.
  [[nodiscard]] static std::vector<BothOptions<Scalar>> single_options(Random& random) {
    std::vector<BothOptions<Scalar>> options(5);
    options[1].of_scene.culling = options[1].of_flat.culling = random.one_in(2) ? Culling::back : Culling::front;
    options[2].of_scene.mask = options[2].of_flat.mask = random.one_in(2) ? 1 : 2;
    options[3].of_scene.max_t = options[3].of_flat.max_t = Scalar{0.5};
    options[4].of_scene.ignore_start_contact = options[4].of_flat.ignore_start_contact = true;
    return options;
  }

  /// Returns true if both sides say the same of one path. Adds up the hits.
  [[nodiscard]] bool agree_about(const Path<Scalar>& path, const BothOptions<Scalar>& options,
                                 std::size_t& hits) const {
    std::vector<SceneHit<Scalar>> answered;
    std::vector<Hit<Scalar>> expected;
    judged_.scene.all_hits(path, answered, options.of_scene);
    flat_.all_hits(path, expected, options.of_flat);
    hits += expected.size();
    if (answered.size() != expected.size()) return false;
    for (std::size_t i = 0; i < answered.size(); ++i) {
      if (!is_same(answered[i], expected[i])) return false;
    }
    const auto first = judged_.scene.first_hit(path, options.of_scene);
    const auto first_of_flat = flat_.first_hit(path, options.of_flat);
    if (first.has_value() == expected.empty() || first.has_value() != first_of_flat.has_value()) return false;
    if (judged_.scene.any_hit(path, options.of_scene) != first.has_value()) return false;
    if (!first) return true;
    return is_same(*first, *first_of_flat) && (path.kind != PathKind::segment || stop_alike(path, options, *first));
  }

  /// Returns true if both sides give a batch of paths the same answers, with each of the shared options and with those
  /// of each path.
  template <typename AnyPath>
  [[nodiscard]] bool agree_about_batch(const std::vector<AnyPath>& paths,
                                       const std::vector<BothOptions<Scalar>>& shared,
                                       const std::vector<BothOptions<Scalar>>& options) const {
    for (const auto& [scene, flat] : shared) {
      if (!agree_about_batch(paths, SceneBatchOptions<Scalar>{scene}, BatchOptions<Scalar>{flat})) return false;
    }
    std::vector<SceneQueryOptions<Scalar>> of_scene;
    std::vector<QueryOptions<Scalar>> of_flat;
    for (const auto& [scene, flat] : options) {
      of_scene.push_back(scene);
      of_flat.push_back(flat);
    }
    return agree_about_batch(paths, SceneBatchOptions<Scalar>{{}, of_scene}, BatchOptions<Scalar>{{}, of_flat});
  }

 private:
  using Place = std::pair<InstanceId, std::uint32_t>;

  /// Returns true if a hit of the scene is one of the collider, where that is in the scene.
  [[nodiscard]] bool is_same(const SceneHit<Scalar>& hit, const Hit<Scalar>& expected) const {
    SceneHit<Scalar> placed{expected, {}};
    if (expected.triangle != no_triangle) std::tie(placed.instance, placed.triangle) = places_[expected.triangle];
    return same_bits(hit, placed);
  }

  /// Returns true if a point stops at the same place in front of a hit.
  [[nodiscard]] bool stop_alike(const Path<Scalar>& path, const BothOptions<Scalar>& options,
                                const SceneHit<Scalar>& first) const {
    const Segment<Scalar> segment{path.start, path.toward};
    const auto flat_first = flat_.first_hit(path, options.of_flat);
    const auto stop = judged_.scene.last_free_point(segment, first, options.of_scene);
    const auto expected = flat_.last_free_point(segment, *flat_first, options.of_flat);
    return same_bits(stop[0], expected[0]) && same_bits(stop[1], expected[1]) && same_bits(stop[2], expected[2]);
  }

  template <typename AnyPath>
  [[nodiscard]] bool agree_about_batch(const std::vector<AnyPath>& paths, const SceneBatchOptions<Scalar>& of_scene,
                                       const BatchOptions<Scalar>& of_flat) const {
    std::vector<SceneHit<Scalar>> answered(paths.size());
    std::vector<Hit<Scalar>> expected(paths.size());
    std::vector<std::uint8_t> blocked(paths.size());
    judged_.scene.first_hits(paths, answered, of_scene);
    judged_.scene.any_hits(paths, blocked, of_scene);
    flat_.first_hits(paths, expected, of_flat);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (!is_same(answered[i], expected[i])) return false;
      if ((blocked[i] != 0) != (expected[i].triangle != no_triangle)) return false;
    }
    return true;
  }

  JudgedScene<Scalar> judged_;
  Collider<Scalar> flat_;
  std::vector<Place> places_;  ///< The instance and the triangle of each triangle of the collider.
};

/// Returns a mesh of whole numbers: a piece of ground, or one with a prop. Its grid has one list, or cells.
DrawnMesh whole_mesh(bool is_float, Random& random) {
  DrawnMesh mesh;
  if (random.one_in(4)) {
    mesh = ground_with_prop(is_float, random);
  } else {
    mesh = ground_piece(random.one_in(3) ? 12 : static_cast<std::uint32_t>(random.between(1, 3)), is_float, random);
    for (auto& vertex : mesh.vertices) vertex[2] = static_cast<double>(random.between(-1, 1));
  }
  if (random.one_in(2)) return mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    mesh.masks.push_back(static_cast<std::uint32_t>(random.below(4)));
  }
  return mesh;
}

/// Returns a scene of up to three meshes in whole numbers, near the origin or far from it. All sums are exact.
template <typename Scalar>
DrawnScene<Scalar> whole_translations(Random& random) {
  DrawnScene<Scalar> drawn;
  for (std::int64_t i = random.between(1, 3); i > 0; --i) {
    drawn.meshes.push_back(whole_mesh(std::is_same_v<Scalar, float> || random.one_in(2), random));
  }
  constexpr double distances[] = {0, 0, 1e5, 1e9};
  const double distance = distances[random.below(std::is_same_v<Scalar, float> ? 3 : 4)];
  for (std::int64_t i = random.one_in(3) ? 1 : random.between(2, 6); i > 0; --i) {
    const double side = random.one_in(4) ? -distance : distance;
    const auto whole = [&](double from) {
      return static_cast<Scalar>(from + static_cast<double>(random.between(-2, 2)));
    };
    const Scalar x = whole(side);
    const Scalar y = whole(-side);
    drawn.instances.push_back({random.below(drawn.meshes.size()), {Pose<Scalar>::translated({x, y, whole(side)})}});
  }
  return drawn;
}

TYPED_TEST(SceneComparisonOf, translated_instances_are_one_flattened_collider) {
  Random random(7);
  std::size_t paths = 0;
  std::size_t hits = 0;
  for (std::size_t i = case_count(320); i > 0; --i) {
    const auto drawn = whole_translations<TypeParam>(random);
    const FlattenedScene<TypeParam> both(drawn);
    ScenePathDrawer<TypeParam> drawer(drawn, both.judged().oracle, both.judged().ids, random);
    std::vector<BothOptions<TypeParam>> options;
    std::vector<Segment<TypeParam>> segments;
    std::vector<Ray<TypeParam>> rays;
    std::vector<Line<TypeParam>> lines;
    for (int path_count = 0; path_count < 20; ++path_count) {
      const Path<TypeParam> path = drawer.draw();
      options.push_back(both.draw_options(path, random));
      ASSERT_TRUE(both.agree_about(path, options.back(), hits)) << hex_text(path) << text_of(drawn, both.judged().ids);
      const bool is_segment = path.kind == PathKind::segment;
      const Vector3<TypeParam> way = is_segment ? path.toward - path.start : path.toward;
      segments.push_back({path.start, is_segment ? path.toward : path.start + path.toward});
      rays.push_back({path.start, way});
      lines.push_back({path.start, way});
    }
    const auto shared = both.single_options(random);
    ASSERT_TRUE(both.agree_about_batch(segments, shared, options)) << text_of(drawn, both.judged().ids);
    ASSERT_TRUE(both.agree_about_batch(rays, shared, options)) << text_of(drawn, both.judged().ids);
    ASSERT_TRUE(both.agree_about_batch(lines, shared, options)) << text_of(drawn, both.judged().ids);
    paths += 20;
  }
  EXPECT_GE(hits, paths / 2);
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
