#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::one_instance_test {
namespace {

/// The meshes are in [-1, 1]³, and their grids have many cells.
std::vector<GeneratedMesh<float>> draw_meshes(Random& random) {
  return {rough_ground<float>(24, 0.25F, random), rough_ground<float>(12, 0, random),
          scattered_triangles<float>(600, 0.25F, random), smooth_bowl<float>(400)};
}

std::vector<Posef> poses() {
  Posef turned = with_rows<float>({0.6F, -0.8F, 0}, {0.8F, 0.6F, 0}, {0, 0, 1});
  turned.translation = {10, -20, 30};
  Posef far = turned;
  far.translation = {1e7F, -3e6F, 0.5F};
  Posef mirrored = with_rows<float>({0, 0.3F, 2}, {1.7F, 0.1F, 0}, {0.1F, 3, 0.2F});
  mirrored.translation = {-5, 0.1F, 7};
  const Posef tiny = with_rows<float>({0x1p-40F, 0, 0}, {0, 0x1p-40F, 0}, {0, 0, 0x1p-40F});
  const Posef huge = with_rows<float>({0, 0x1p40F, 0}, {0x1p40F, 0, 0}, {0, 0, 0x1p40F});
  // It is nearly singular, so errors are large in the frame of the mesh.
  const Posef flat = with_rows<float>({1, 1, 0}, {1, 1.000001F, 0}, {0, 0, 1});
  return {Posef{}, Posef::translated({1000.1F, -20, 3}), turned, far, mirrored, tiny, huge, flat};
}

/// Draws segments near the instance. Some end exactly at a placed vertex, as well as floats can tell.
std::vector<Segmentf> draw_segments(const GeneratedMesh<float>& mesh, const Posef& pose, std::size_t count,
                                    Random& random) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto placed = [&](const Vector3f& local) {
    const Vector3d point = pose.linear.cast<double>() * local.cast<double>() + pose.translation.cast<double>();
    return Vector3f(point.cast<float>());
  };
  const auto draw = [&](float size) {
    const auto number = [&] { return size * random.symmetric<float>(); };
    return Vector3f(number(), number(), number());
  };
  const auto vertex = [&] { return mesh.vertices[random.below(mesh.vertices.size())]; };
  std::vector<Segmentf> segments;
  while (segments.size() < count) {
    const Vector3f start = draw(1.5F);
    switch (random.below(7)) {
      case 0:
        segments.push_back({placed(start), placed(start + draw(0.125F))});
        break;
      case 1:
        segments.push_back({placed(start), placed(vertex())});
        break;
      case 2:
        segments.push_back({placed(vertex()), placed(start)});
        break;
      case 3:
        segments.push_back({placed(draw(1000)), placed(start)});
        break;
      case 4:
        segments.push_back({placed(2 * vertex() - start), placed(start)});
        break;
      default:
        segments.push_back({placed(start), placed(draw(1.5F))});
    }
  }
  segments[random.below(count)].end = segments[0].start;
  segments[random.below(count)] = {placed(draw(1)), {0, infinity, 0}};
  segments[random.below(count)].start.x() = std::numeric_limits<float>::quiet_NaN();
  segments[random.below(count)].end = {3e38F, -3e38F, 1};
  return segments;
}

void expect_answers_of_single_queries(const Scenef& scene, const std::vector<Segmentf>& segments,
                                      const SceneQueryOptionsf& options, std::size_t& hit_count) {
  std::vector<SceneHitf> hits(segments.size(), SceneHitf{{.t = 7, .triangle = 3}, {}});
  std::vector<std::uint8_t> blocked(segments.size(), 7);
  QueryStatistics statistics;
  scene.first_hits(segments, hits, {.options = options, .statistics = &statistics});
  EXPECT_EQ(statistics.paths, segments.size());
  scene.any_hits(segments, blocked, {.options = options, .statistics = &statistics});
  EXPECT_EQ(statistics.paths, 2 * segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto expected = scene.first_hit(segments[i], options);
    EXPECT_TRUE(same_bits(hits[i], expected.value_or(SceneHitf{}))) << i;
    EXPECT_EQ(blocked[i], expected ? 1 : 0) << i;
    hit_count += expected ? 1 : 0;
  }
}

/// A scene with one instance has batches of its own. Single queries do without them.
TEST(OneInstance, HasTheSameAnswersInBatches) {
  Random random(20261126);
  for (std::size_t round = case_count(2); round > 0; --round) {
    for (const GeneratedMesh<float>& mesh : draw_meshes(random)) {
      const auto collider = std::make_shared<Colliderf>(mesh.view());
      for (const Posef& pose : poses()) {
        Scenef scene;
        const InstanceId id = scene.add(collider, pose);
        scene.commit();
        std::size_t hits = 0;
        const auto segments = draw_segments(mesh, pose, 300, random);
        expect_answers_of_single_queries(scene, segments, {}, hits);
        EXPECT_GT(hits, segments.size() / 20);
        const auto few = draw_segments(mesh, pose, 5 + random.below(60), random);
        expect_answers_of_single_queries(scene, few, {}, hits);
        expect_answers_of_single_queries(scene, few, {.max_t = 0.5F}, hits);
        expect_answers_of_single_queries(scene, few, {.culling = Culling::back}, hits);
        expect_answers_of_single_queries(scene, few, {.ignored_instance = id, .ignored_triangle = 1}, hits);
        expect_answers_of_single_queries(scene, few, {.ignored_instance = id}, hits);
        expect_answers_of_single_queries(scene, few, {.mask = 0}, hits);
        expect_answers_of_single_queries(scene, few, {.instance_mask = 0}, hits);
        scene.set_motion(id, pose.linear * Vector3f(0.25F, 0.5F, 0.125F));
        scene.commit();
        expect_answers_of_single_queries(scene, few, {}, hits);
      }
    }
  }
}

/// Options of each path, filters and masks of triangles may leave a hit out, which these batches cannot do.
TEST(OneInstance, LeavesOutWhatIsAskedFor) {
  Random random(5);
  const auto mesh = scattered_triangles<float>(600, 0.25F, random);
  std::vector<std::uint32_t> masks;
  while (masks.size() < mesh.triangles.size()) masks.push_back(static_cast<std::uint32_t>(random.below(4)));
  std::vector<SceneQueryOptionsf> own_options(300);
  for (SceneQueryOptionsf& own : own_options) own.max_t = random.unit<float>();
  const auto is_even = [](const SceneHitf& hit) { return hit.triangle % 2 == 0; };
  for (const bool has_masks : {false, true}) {
    const std::span<const std::uint32_t> own_masks = std::span(masks).first(has_masks ? masks.size() : 0);
    const auto collider = std::make_shared<Colliderf>(mesh.view(), BuildOptions{.masks = own_masks});
    Scenef scene;
    scene.add(collider, poses()[2]);
    scene.commit();
    const auto placed = draw_segments(mesh, poses()[2], own_options.size(), random);
    std::vector<SceneHitf> own(placed.size());
    std::vector<SceneHitf> even(placed.size());
    std::vector<SceneHitf> masked(placed.size());
    scene.first_hits(placed, own, {.path_options = own_options});
    scene.first_hits(placed, even, {.filter = is_even});
    scene.first_hits(placed, masked, {.options = {.mask = 2}});
    std::vector<std::uint8_t> blocked(placed.size());
    scene.any_hits(placed, blocked, {.options = {.mask = 2}});
    for (std::size_t i = 0; i < placed.size(); ++i) {
      EXPECT_TRUE(same_bits(own[i], scene.first_hit(placed[i], own_options[i]).value_or(SceneHitf{}))) << i;
      EXPECT_TRUE(same_bits(even[i], scene.first_hit(placed[i], is_even).value_or(SceneHitf{}))) << i;
      EXPECT_TRUE(same_bits(masked[i], scene.first_hit(placed[i], {.mask = 2}).value_or(SceneHitf{}))) << i;
      EXPECT_EQ(blocked[i] != 0, scene.any_hit(placed[i], {.mask = 2})) << i;
    }
    const auto is_hit = [](const SceneHitf& hit) { return hit.triangle != SceneHitf{}.triangle; };
    EXPECT_GT(std::count_if(even.begin(), even.end(), is_hit), 20);
    EXPECT_GT(std::count_if(masked.begin(), masked.end(), is_hit), 20);
  }
}

/// Compares the queries that the collider of an instance in place may answer with `all_hits`, which asks the instance.
template <typename Scalar>
void expect_what_all_hits_finds(const Scene<Scalar>& scene, const std::vector<Path<Scalar>>& paths,
                                const SceneQueryOptions<Scalar>& options, std::size_t& hit_count) {
  std::vector<Segment<Scalar>> segments;
  std::vector<SceneHit<Scalar>> expected;
  std::vector<SceneHit<Scalar>> expected_even;
  std::vector<SceneHit<Scalar>> all;
  const auto is_even = [](const SceneHit<Scalar>& hit) { return hit.triangle % 2 == 0; };
  for (const Path<Scalar>& path : paths) {
    scene.all_hits(path, all, options);
    const SceneHit<Scalar> first = all.empty() ? SceneHit<Scalar>{} : all.front();
    EXPECT_TRUE(same_bits(scene.first_hit(path, options).value_or(SceneHit<Scalar>{}), first)) << hex_text(path);
    EXPECT_EQ(scene.any_hit(path, options), !all.empty()) << hex_text(path);
    if (path.kind != PathKind::segment) continue;
    hit_count += all.empty() ? 0 : 1;
    segments.push_back({path.start, path.toward});
    expected.push_back(first);
    const auto even = std::find_if(all.begin(), all.end(), is_even);
    expected_even.push_back(even == all.end() ? SceneHit<Scalar>{} : *even);
  }
  std::vector<SceneHit<Scalar>> hits(segments.size(), SceneHit<Scalar>{{.t = 7, .triangle = 3}, {}});
  std::vector<std::uint8_t> blocked(segments.size(), 7);
  QueryStatistics statistics;
  scene.first_hits(segments, hits, {.options = options, .statistics = &statistics});
  scene.any_hits(segments, blocked, {.options = options, .statistics = &statistics});
  EXPECT_EQ(statistics.paths, 2 * segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_TRUE(same_bits(hits[i], expected[i])) << hex_text(Path<Scalar>(segments[i]));
    EXPECT_EQ(blocked[i] != 0, expected[i].triangle != no_triangle) << hex_text(Path<Scalar>(segments[i]));
  }
  std::vector<SceneHit<Scalar>> even_hits(segments.size());
  scene.first_hits(segments, even_hits, {.options = options, .filter = is_even});
  // Where each path has options of its own, the others mean nothing.
  const std::vector<SceneQueryOptions<Scalar>> own_options(segments.size(), options);
  scene.first_hits(segments, hits, {.options = {.mask = 0}, .path_options = own_options});
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_TRUE(same_bits(even_hits[i], expected_even[i])) << hex_text(Path<Scalar>(segments[i]));
    EXPECT_TRUE(same_bits(hits[i], expected[i])) << hex_text(Path<Scalar>(segments[i]));
  }
}

template <typename Scalar>
void ask_instance_in_place(Random& random) {
  const auto mesh = scattered_triangles<Scalar>(600, Scalar(0.25), random);
  std::vector<std::uint32_t> masks;
  while (masks.size() < mesh.triangles.size()) masks.push_back(static_cast<std::uint32_t>(random.below(4)));
  const auto collider = std::make_shared<Collider<Scalar>>(mesh.view(), BuildOptions{.masks = masks});
  Scene<Scalar> scene;
  scene.remove(scene.add(std::make_shared<Collider<Scalar>>(mesh.view())));
  const InstanceId id = scene.add(collider);
  PathDrawer<Scalar> drawer(mesh.view(), 4);
  std::vector<Path<Scalar>> paths;
  while (paths.size() < 3 * 700) paths.push_back(drawer.draw());
  // In place, a little beside, mirrored, and in motion.
  Pose<Scalar> mirrored;
  mirrored.linear(0, 0) = -1;
  for (const Pose<Scalar>& pose : {Pose<Scalar>{}, Pose<Scalar>::translated({0, 0, Scalar(0x1p-20)}), mirrored}) {
    for (const bool moves : {false, true}) {
      scene.set_pose(id, pose);
      scene.set_motion(id, {0, moves ? Scalar(0.5) : Scalar{0}, 0});
      scene.commit();
      const auto some = std::vector(paths.begin(), paths.begin() + (moves ? 200 : 2100));
      std::size_t hits = 0;
      std::uint32_t triangle = no_triangle;  // One that a path hits first.
      for (std::size_t i = 0; i < some.size() && triangle == no_triangle; ++i) {
        if (const auto hit = scene.first_hit(some[i])) triangle = hit->triangle;
      }
      expect_what_all_hits_finds<Scalar>(scene, some, {}, hits);
      EXPECT_GT(hits, some.size() / 20);
      expect_what_all_hits_finds<Scalar>(scene, some, {.min_t = Scalar(0.25), .max_t = Scalar(0.5)}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.culling = Culling::front, .mask = 1}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.ignored_instance = id, .ignored_triangle = triangle}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.ignored_instance = {7, 1}, .ignored_triangle = triangle}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.ignored_instance = id}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.instance_mask = 0}, hits);
      expect_what_all_hits_finds<Scalar>(scene, some, {.ignore_start_contact = true, .ignore_end_contact = true}, hits);
    }
  }
}

TEST(OneInstance, AnswersAsItsColliderWhereThatIs) {
  Random random(6);
  ask_instance_in_place<float>(random);
  ask_instance_in_place<double>(random);
}

/// An empty collider is in no tree. So the scene has one instance that can be hit.
TEST(OneInstance, MayHaveAnotherIndex) {
  Random random(3);
  const auto mesh = rough_ground<float>(24, 0.25F, random);
  Scenef scene;
  scene.add(std::make_shared<Colliderf>());
  scene.add(std::make_shared<Colliderf>(mesh.view()));
  scene.commit();
  std::size_t hits = 0;
  expect_answers_of_single_queries(scene, draw_segments(mesh, {}, 100, random), {}, hits);
  EXPECT_GT(hits, 10u);
}

}  // namespace
}  // namespace surehit::test::one_instance_test
