#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/scene_text.hpp"
#include "support/threads.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
using Balls = std::vector<SweptSphere<Scalar>>;
template <typename Scalar>
using Hits = std::vector<SceneShapeHit<Scalar>>;

/// Returns balls on the ways that paths of a scene have. All of their numbers are finite.
template <typename Scalar>
Balls<Scalar> draw_balls(ScenePathDrawer<Scalar>& drawer, std::size_t count, Random& random) {
  Balls<Scalar> balls;
  while (balls.size() < count) {
    const Path<Scalar> path = drawer.draw();
    SweptSphere<Scalar> ball{path.start, path.toward, 0};
    if (path.kind != PathKind::segment) ball.end = path.start + path.toward;
    const Scalar length = (ball.end - ball.start).cwiseAbs().maxCoeff();
    switch (random.below(6)) {
      case 0:
        break;
      case 1:
        ball.radius = static_cast<Scalar>(random.between(1, 4)) / 2;
        break;
      case 2:
        ball.radius = random.one_in(8) ? std::fabs(random.any_finite<Scalar>()) : length * 2;
        break;
      case 3:  // A coordinate, so that the start may be at a distance of exactly the radius.
        ball.radius = std::fabs(ball.start[static_cast<Eigen::Index>(random.below(3))]);
        break;
      default:
        ball.radius = std::ldexp(length * random.unit<Scalar>(), -static_cast<int>(random.below(12)));
    }
    if (ball.end.allFinite() && std::isfinite(ball.radius)) balls.push_back(ball);
  }
  return balls;
}

template <typename Scalar>
std::string text_of(const SweptSphere<Scalar>& ball) {
  return hex_text(Path<Scalar>(Segment<Scalar>{ball.start, ball.end})) + ", radius " +
         hex_text(Vector3<Scalar>(ball.radius, 0, 0));
}

template <typename Scalar>
bool is_odd(const SceneShapeHit<Scalar>& hit) {
  return (hit.triangle + hit.instance.index) % 2 == 1;
}

/// Asks a scene about a ball in every way, and compares with all hits.
template <typename Scalar>
std::string difference_from(const Hits<Scalar>& all, const Scene<Scalar>& scene, const SweptSphere<Scalar>& ball,
                            const SceneShapeQueryOptions<Scalar>& options) {
  Hits<Scalar> odd;
  std::copy_if(all.begin(), all.end(), std::back_inserter(odd), is_odd<Scalar>);
  const auto first_of = [](const Hits<Scalar>& hits) { return hits.empty() ? SceneShapeHit<Scalar>{} : hits.front(); };
  Hits<Scalar> answered;
  scene.all_hits(ball, answered, is_odd<Scalar>, options);
  if (answered != odd) return "all_hits of the odd ones";
  const auto first = scene.first_hit(ball, options);
  if (first.value_or(SceneShapeHit<Scalar>{}) != first_of(all)) return "first_hit";
  if (scene.first_hit(ball, is_odd<Scalar>, options).value_or(SceneShapeHit<Scalar>{}) != first_of(odd)) {
    return "first_hit of the odd ones";
  }
  if (scene.any_hit(ball, options) == all.empty()) return "any_hit";
  if (scene.any_hit(ball, is_odd<Scalar>, options) == odd.empty()) return "any_hit of the odd ones";
  Hits<Scalar> of_batch(1);
  scene.first_hits(std::span(&ball, 1), of_batch, {.options = options, .filter = is_odd<Scalar>});
  if (of_batch[0] != first_of(odd)) return "first_hits of the odd ones";
  if (!first || first->started_touching) return "";
  const Scalar free = scene.last_free_t(ball, *first);
  SceneShapeQueryOptions<Scalar> until = options;
  until.max_t = free;
  if (scene.any_hit(ball, until)) return "last_free_t is not free";
  until.max_t = std::nextafter(free, Scalar{2});
  if (!scene.any_hit(ball, until)) return "last_free_t is not the last";
  return "";
}

/// Returns options that are hard for a ball and one of its hits.
template <typename Scalar>
SceneShapeQueryOptions<Scalar> draw_shape_options(const SceneShapeHit<Scalar>& hit, Random& random) {
  SceneShapeQueryOptions<Scalar> options;
  if (random.one_in(2)) options.max_t = hit.t;
  if (random.one_in(4)) options.max_t = std::nextafter(hit.t, static_cast<Scalar>(random.below(2)));
  if (random.one_in(3)) options.culling = static_cast<Culling>(random.below(3));
  if (random.one_in(3)) options.mask = static_cast<std::uint32_t>(random.below(4));
  if (random.one_in(3)) options.instance_mask = static_cast<std::uint32_t>(random.below(4));
  if (random.one_in(3)) options.ignored_instance = hit.instance;
  if (random.one_in(8)) ++options.ignored_instance.generation;
  if (random.one_in(3)) options.ignored_triangle = hit.triangle;
  options.ignore_start_contact = random.one_in(3);
  return options;
}

/// Returns a scene. Most have few triangles, because each of them is judged for each ball.
template <typename Scalar>
DrawnScene<Scalar> draw_small_scene(SceneFamily family, Random& random) {
  for (;;) {
    DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
    std::size_t triangles = 0;
    for (const auto& instance : drawn.instances) triangles += drawn.meshes[instance.mesh].triangles.size();
    if (triangles < 60 || random.one_in(16)) return drawn;
  }
}

class SceneSpheres : public testing::TestWithParam<SceneFamily> {};

/// The definition is the test: all answers are those of the exact world triangles.
template <typename Scalar>
void check(SceneFamily family) {
  Random random(20261126 + static_cast<std::uint64_t>(family));
  const bool has_long_numbers = family == SceneFamily::all_magnitudes || family == SceneFamily::scaled;
  const std::size_t scenes = case_count(sizeof(Scalar) == 4 && !has_long_numbers ? 20 : 8);
  std::size_t asked = 0;
  std::size_t touched = 0;
  for (std::size_t i = 0; i < scenes; ++i) {
    const DrawnScene<Scalar> drawn = draw_small_scene<Scalar>(family, random);
    const JudgedScene<Scalar> judged(drawn);
    ScenePathDrawer<Scalar> drawer(drawn, judged.oracle, judged.ids, random);
    for (const SweptSphere<Scalar>& ball : draw_balls(drawer, 4, random)) {
      Hits<Scalar> all;
      judged.scene.all_hits(ball, all);
      const auto error = judged.oracle.find_error(ball, {}, all);
      ASSERT_FALSE(error.has_value()) << *error << ", scene " << i << ", " << text_of(ball);
      ASSERT_EQ(difference_from(all, judged.scene, ball, {}), "") << "scene " << i << ", " << text_of(ball);
      ++asked;
      touched += !all.empty();
      if (all.empty() || random.one_in(2)) continue;
      const auto options = draw_shape_options(all[random.below(all.size())], random);
      Hits<Scalar> some;
      judged.scene.all_hits(ball, some, options);
      const auto other = judged.oracle.find_error(ball, options, some);
      ASSERT_FALSE(other.has_value()) << *other << ", scene " << i << ", " << text_of(ball);
      ASSERT_EQ(difference_from(some, judged.scene, ball, options), "") << "scene " << i << ", " << text_of(ball);
    }
  }
  // A family that turned into hits or misses alone would test little.
  if (asked < 40) return;
  EXPECT_GE(10 * touched, asked);
  EXPECT_GE(10 * (asked - touched), asked / 4);
}

TEST_P(SceneSpheres, of_float_scenes) { check<float>(GetParam()); }
TEST_P(SceneSpheres, of_double_scenes) { check<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Families, SceneSpheres, testing::ValuesIn(all_scene_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test
