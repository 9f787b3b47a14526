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
#include <variant>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/scene_text.hpp"
#include "support/shape_text.hpp"
#include "support/threads.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::scene_shape_families_test {
namespace {

template <typename Scalar>
using Hits = std::vector<SceneShapeHit<Scalar>>;

/// Returns a size for a shape that makes a step of this length.
template <typename Scalar>
Scalar draw_size(const Vector3<Scalar>& start, Scalar length, Random& random) {
  switch (random.below(6)) {
    case 0:
      return 0;
    case 1:
      return static_cast<Scalar>(random.between(1, 4)) / 2;
    case 2:
      return random.one_in(8) ? std::fabs(random.any_finite<Scalar>()) : length * 2;
    case 3:  // A coordinate, so that the start may be at a distance of exactly the size.
      return std::fabs(start[static_cast<Eigen::Index>(random.below(3))]);
    default:
      return std::ldexp(length * random.unit<Scalar>(), -static_cast<int>(random.below(12)));
  }
}

/// Returns a ball, a box or a capsule with this way.
template <typename Scalar>
SweptShape<Scalar> draw_shape(const Vector3<Scalar>& start, const Vector3<Scalar>& end, Random& random) {
  const Scalar length = (end - start).cwiseAbs().maxCoeff();
  const Scalar size = draw_size(start, length, random);
  switch (random.below(3)) {
    case 0:
      return SweptSphere<Scalar>{start, end, size};
    case 1: {
      Vector3<Scalar> half(size, size, size);
      for (Scalar& x : half) {
        if (random.one_in(2)) x = draw_size(start, length, random);
      }
      return SweptBox<Scalar>{start, end, half};
    }
    default: {
      Vector3<Scalar> half_axis(size, 0, 0);
      for (Scalar& x : half_axis) {
        if (random.one_in(2)) x = size * random.symmetric<Scalar>();
      }
      return SweptCapsule<Scalar>{start, end, half_axis, draw_size(start, length, random)};
    }
  }
}

template <typename Scalar>
bool is_finite(const SweptSphere<Scalar>& sphere) {
  return std::isfinite(sphere.radius);
}
template <typename Scalar>
bool is_finite(const SweptBox<Scalar>& box) {
  return box.half_extents.allFinite();
}
template <typename Scalar>
bool is_finite(const SweptCapsule<Scalar>& capsule) {
  return capsule.half_axis.allFinite() && std::isfinite(capsule.radius);
}

/// Returns shapes on the ways that paths of a scene have. All of their numbers are finite.
template <typename Scalar>
std::vector<SweptShape<Scalar>> draw_shapes(ScenePathDrawer<Scalar>& drawer, std::size_t count, Random& random) {
  std::vector<SweptShape<Scalar>> shapes;
  while (shapes.size() < count) {
    const Path<Scalar> path = drawer.draw();
    const Vector3<Scalar> end =
        path.kind == PathKind::segment ? path.toward : Vector3<Scalar>(path.start + path.toward);
    if (!end.allFinite()) continue;
    const SweptShape<Scalar> shape = draw_shape(path.start, end, random);
    if (std::visit([](const auto& any) { return is_finite(any); }, shape)) shapes.push_back(shape);
  }
  return shapes;
}

template <typename Scalar>
std::string text_of(const SweptShape<Scalar>& shape) {
  return std::visit([](const auto& any) { return hex_text(any); }, shape);
}

template <typename Scalar>
bool is_odd(const SceneShapeHit<Scalar>& hit) {
  return (hit.triangle + hit.instance.index) % 2 == 1;
}

/// Asks a scene about a shape in every way, and compares with all hits.
template <typename Scalar>
std::string difference_from(const Hits<Scalar>& all, const Scene<Scalar>& scene, const SweptShape<Scalar>& shape,
                            const SceneShapeQueryOptions<Scalar>& options) {
  Hits<Scalar> odd;
  std::copy_if(all.begin(), all.end(), std::back_inserter(odd), is_odd<Scalar>);
  const auto first_of = [](const Hits<Scalar>& hits) { return hits.empty() ? SceneShapeHit<Scalar>{} : hits.front(); };
  Hits<Scalar> answered;
  scene.all_hits(shape, answered, is_odd<Scalar>, options);
  if (answered != odd) return "all_hits of the odd ones";
  const auto first = scene.first_hit(shape, options);
  if (first.value_or(SceneShapeHit<Scalar>{}) != first_of(all)) return "first_hit";
  if (scene.first_hit(shape, is_odd<Scalar>, options).value_or(SceneShapeHit<Scalar>{}) != first_of(odd)) {
    return "first_hit of the odd ones";
  }
  if (scene.any_hit(shape, options) == all.empty()) return "any_hit";
  if (scene.any_hit(shape, is_odd<Scalar>, options) == odd.empty()) return "any_hit of the odd ones";
  Hits<Scalar> of_batch(1);
  const auto ask_batch = [&](const auto& one) {
    scene.first_hits(std::span(&one, 1), of_batch, {.options = options, .filter = is_odd<Scalar>});
  };
  std::visit(ask_batch, shape);
  if (of_batch[0] != first_of(odd)) return "first_hits of the odd ones";
  if (!first || first->started_touching) return "";
  const Scalar free = scene.last_free_t(shape, *first);
  SceneShapeQueryOptions<Scalar> until = options;
  until.max_t = free;
  if (scene.any_hit(shape, until)) return "last_free_t is not free";
  until.max_t = std::nextafter(free, Scalar{2});
  if (!scene.any_hit(shape, until)) return "last_free_t is not the last";
  return "";
}

/// Returns options that are hard for a shape and one of its hits.
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

/// Returns a scene. Most have few triangles, because each of them is judged for each shape.
template <typename Scalar>
DrawnScene<Scalar> draw_small_scene(SceneFamily family, Random& random) {
  for (;;) {
    DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
    std::size_t triangles = 0;
    for (const auto& instance : drawn.instances) triangles += drawn.meshes[instance.mesh].triangles.size();
    if (triangles < 60 || random.one_in(16)) return drawn;
  }
}

class SceneShapeFamilies : public testing::TestWithParam<SceneFamily> {};

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
    for (const SweptShape<Scalar>& shape : draw_shapes(drawer, 6, random)) {
      Hits<Scalar> all;
      judged.scene.all_hits(shape, all);
      const auto error = judged.oracle.find_error(shape, {}, all);
      ASSERT_FALSE(error.has_value()) << *error << ", scene " << i << ", " << text_of(shape);
      ASSERT_EQ(difference_from(all, judged.scene, shape, {}), "") << "scene " << i << ", " << text_of(shape);
      ++asked;
      touched += !all.empty();
      if (all.empty() || random.one_in(2)) continue;
      const auto options = draw_shape_options(all[random.below(all.size())], random);
      Hits<Scalar> some;
      judged.scene.all_hits(shape, some, options);
      const auto other = judged.oracle.find_error(shape, options, some);
      ASSERT_FALSE(other.has_value()) << *other << ", scene " << i << ", " << text_of(shape);
      ASSERT_EQ(difference_from(some, judged.scene, shape, options), "") << "scene " << i << ", " << text_of(shape);
    }
  }
  // A family that turned into hits or misses alone would test little.
  if (asked < 40) return;
  EXPECT_GE(10 * touched, asked);
  EXPECT_GE(10 * (asked - touched), asked / 4);
}

TEST_P(SceneShapeFamilies, of_float_scenes) { check<float>(GetParam()); }
TEST_P(SceneShapeFamilies, of_double_scenes) { check<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Families, SceneShapeFamilies, testing::ValuesIn(all_scene_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::scene_shape_families_test
