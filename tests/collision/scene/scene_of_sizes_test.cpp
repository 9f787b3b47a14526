#include "scene_of_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "crosscheck/scene_judge.hpp"
#include "support/case_count.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/scene_text.hpp"

namespace surehit::test::scene_of_sizes_test {
namespace {

template <typename Scalar>
class SceneOfSizes : public testing::Test {
 protected:
  static constexpr std::size_t instances = 5000;

  SceneOfSizes() : drawn(draw_scene_of_sizes<Scalar>(instances, random)), judged(drawn) {}

  Random random{20261128};
  DrawnScene<Scalar> drawn;
  JudgedScene<Scalar> judged;
};

/// Each instance of a scene in a scene of its own, which needs no tree.
template <typename Scalar>
class LoneInstances {
 public:
  explicit LoneInstances(const DrawnScene<Scalar>& drawn, const std::vector<InstanceId>& ids) : ids_(ids) {
    std::vector<std::shared_ptr<Collider<Scalar>>> colliders;
    for (const DrawnMesh& mesh : drawn.meshes) colliders.push_back(collider_of<Scalar>(mesh));
    for (const auto& [mesh, placement] : drawn.instances) {
      scenes_.emplace_back().add(colliders[mesh], placement.pose);
      scenes_.back().commit();
    }
  }

  /// Returns all hits, by instance and then as they come.
  [[nodiscard]] std::vector<SceneHit<Scalar>> all_hits(const Segment<Scalar>& path) const {
    std::vector<SceneHit<Scalar>> all;
    std::vector<SceneHit<Scalar>> hits;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      scenes_[i].all_hits(path, hits);
      for (SceneHit<Scalar>& hit : hits) {
        hit.instance = ids_[i];
        all.push_back(hit);
      }
    }
    return all;
  }

 private:
  const std::vector<InstanceId>& ids_;
  std::vector<Scene<Scalar>> scenes_;
};

/// Returns the part of a segment from which on it is in a box, in double, or 2 if it misses the box.
template <typename Scalar>
double entry_into(const Box<double>& box, const Segment<Scalar>& path) {
  double enters = 0;
  double leaves = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double start = double{path.start[axis]};
    const double way = double{path.end[axis]} - start;
    const double low = (box.low[axis] - start) / way;
    const double high = (box.high[axis] - start) / way;
    enters = std::max(enters, std::min(low, high));
    leaves = std::min(leaves, std::max(low, high));
  }
  return enters <= leaves ? enters : 2;
}
TYPED_TEST_SUITE(SceneOfSizes, Scalars, ScalarNames);

/// All answers are those of the exact world triangles, also where a path is aimed at corners and edges.
TYPED_TEST(SceneOfSizes, answers_as_the_oracle_does) {
  std::vector<SceneQuestion<TypeParam>> questions;
  const std::size_t count = case_count(20);
  for (const auto& path : draw_paths_of_sizes(this->drawn, count, this->random)) questions.push_back({path});
  ScenePathDrawer<TypeParam> drawer(this->drawn, this->judged.oracle, this->judged.ids, this->random);
  while (questions.size() < 2 * count) {
    SceneQuestion<TypeParam> question{drawer.draw()};
    const auto hits = this->judged.oracle.all_hits(question.path);
    if (!hits.empty() && this->random.one_in(2))
      question.options = draw_scene_options(hits[this->random.below(hits.size())], this->random);
    questions.push_back(question);
  }
  EXPECT_EQ(scene_difference(this->judged.scene, this->judged.oracle, questions), "");
}

/// A path meets in the scene what it meets in each instance alone.
TYPED_TEST(SceneOfSizes, has_the_hits_of_its_instances) {
  const LoneInstances<TypeParam> alone(this->drawn, this->judged.ids);
  const Scene<TypeParam>& scene = this->judged.scene;
  const auto paths = draw_paths_of_sizes(this->drawn, case_count(600), this->random);
  std::vector<SceneHit<TypeParam>> firsts(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  scene.first_hits(paths, firsts);
  scene.any_hits(paths, blocked);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SCOPED_TRACE(hex_text(Path<TypeParam>(paths[i])));
    auto expected = alone.all_hits(paths[i]);
    std::vector<SceneHit<TypeParam>> hits;
    scene.all_hits(paths[i], hits);
    const auto is_before = [](const auto& x, const auto& y) {
      return std::pair(x.instance, x.triangle) < std::pair(y.instance, y.triangle);
    };
    ASSERT_EQ(hits.size(), expected.size());
    const SceneHit<TypeParam> first = hits.empty() ? SceneHit<TypeParam>{} : hits.front();
    EXPECT_TRUE(std::is_sorted(hits.begin(), hits.end(), [](const auto& x, const auto& y) { return x.t < y.t; }));
    std::sort(hits.begin(), hits.end(), is_before);
    std::sort(expected.begin(), expected.end(), is_before);
    for (std::size_t hit = 0; hit < hits.size(); ++hit) EXPECT_TRUE(same_bits(hits[hit], expected[hit]));
    EXPECT_TRUE(same_bits(firsts[i], first));
    EXPECT_TRUE(same_bits(scene.first_hit(paths[i]).value_or(SceneHit<TypeParam>{}), first));
    EXPECT_EQ(blocked[i], hits.empty() ? 0 : 1);
    EXPECT_EQ(scene.any_hit(paths[i]), !hits.empty());
  }
}

TYPED_TEST(SceneOfSizes, meets_few_instances_in_vain) {
  const Scene<TypeParam>& scene = this->judged.scene;
  const auto paths = draw_paths_of_sizes(this->drawn, 1000 / case_step(), this->random);
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  QueryStatistics first_in_batch;
  QueryStatistics any_in_batch;
  scene.first_hits(paths, hits, {.statistics = &first_in_batch});
  scene.any_hits(paths, blocked, {.statistics = &any_in_batch});
  QueryStatistics first;
  QueryStatistics any;
  QueryStatistics all;
  std::uint64_t before_hit = 0;  // Boxes in which the paths are before their first hits.
  std::uint64_t met = 0;
  std::vector<Box<double>> boxes;
  for (std::size_t i = 0; i < this->drawn.instances.size(); ++i) boxes.push_back(box_of_instance(this->drawn, i));
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::vector<SceneHit<TypeParam>> found;
    static_cast<void>(scene.first_hit(paths[i], {}, &first));
    static_cast<void>(scene.any_hit(paths[i], {}, &any));
    scene.all_hits(paths[i], found, {}, &all);
    for (const Box<double>& box : boxes) {
      const double enters = entry_into(box, paths[i]);
      met += enters <= 1 ? 1 : 0;
      before_hit += enters <= std::min(1.0, double{hits[i].t}) ? 1 : 0;
    }
  }
  // A path that misses the box of a mesh in its own frame passes by, so it meets fewer instances than boxes.
  EXPECT_LE(all.instances, met);
  // The walk goes from node to node in order, but not from instance to instance. So it meets some that the hit hides.
  for (const QueryStatistics& of : {first, first_in_batch}) EXPECT_LE(4 * of.instances, 5 * before_hit);
  // Any hit ends a path, whichever comes first.
  for (const QueryStatistics& of : {any, any_in_batch}) EXPECT_LE(of.instances, before_hit);
  this->RecordProperty("met", static_cast<int>(met));
  this->RecordProperty("before_hit", static_cast<int>(before_hit));
  this->RecordProperty("first", static_cast<int>(first.instances));
  this->RecordProperty("any", static_cast<int>(any.instances));
  this->RecordProperty("all", static_cast<int>(all.instances));
}

}  // namespace
}  // namespace surehit::test::scene_of_sizes_test
