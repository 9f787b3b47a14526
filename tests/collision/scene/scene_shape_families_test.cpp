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

template <typename Scalar>
SceneShapeHit<Scalar> first_of(const Hits<Scalar>& hits) {
  return hits.empty() ? SceneShapeHit<Scalar>{} : hits.front();
}

template <typename Scalar>
Hits<Scalar> odd_ones_of(const Hits<Scalar>& hits) {
  Hits<Scalar> odd;
  std::copy_if(hits.begin(), hits.end(), std::back_inserter(odd), is_odd<Scalar>);
  return odd;
}

/// Asks a scene about a shape in every way but batches, and compares with all hits.
template <typename Scalar>
std::string difference_from(const Hits<Scalar>& all, const Scene<Scalar>& scene, const SweptShape<Scalar>& shape,
                            const SceneShapeQueryOptions<Scalar>& options) {
  const Hits<Scalar> odd = odd_ones_of(all);
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
  if (!first || first->started_touching) return "";
  const Scalar free = scene.last_free_t(shape, *first);
  SceneShapeQueryOptions<Scalar> until = options;
  until.max_t = free;
  if (scene.any_hit(shape, until)) return "last_free_t is not free";
  until.max_t = std::nextafter(free, Scalar{2});
  if (!scene.any_hit(shape, until)) return "last_free_t is not the last";
  return "";
}

/// What a scene is asked about a shape, and all of its hits. The oracle has judged these.
template <typename Scalar>
struct JudgedShape {
  SweptShape<Scalar> shape;
  SceneShapeQueryOptions<Scalar> options;
  Hits<Scalar> all;
};

/// Asks a scene in batches about those shapes that are of one kind, and compares with all hits. Each shape is
/// alone in a batch with its options, and has options of its own in a batch of all.
template <typename Shape, typename Scalar>
std::string difference_in_batches(const std::vector<JudgedShape<Scalar>>& judged, const Scene<Scalar>& scene) {
  std::vector<Shape> shapes;
  std::vector<SceneShapeQueryOptions<Scalar>> options;
  std::vector<const Hits<Scalar>*> all;
  for (const JudgedShape<Scalar>& one : judged) {
    if (!std::holds_alternative<Shape>(one.shape)) continue;
    shapes.push_back(std::get<Shape>(one.shape));
    options.push_back(one.options);
    all.push_back(&one.all);
  }
  const auto difference_of = [&](const SceneShapeBatchOptions<Scalar>& asked, std::size_t begin, std::size_t count) {
    // Each answer has to be written, that of a miss too.
    SceneShapeHit<Scalar> stale;
    stale.triangle = 7;
    Hits<Scalar> firsts(count, stale);
    std::vector<std::uint8_t> blocked(count, 7);
    const auto part = std::span(shapes).subspan(begin, count);
    scene.first_hits(part, firsts, asked);
    scene.any_hits(part, blocked, asked);
    for (std::size_t i = 0; i < count; ++i) {
      const Hits<Scalar> expected = asked.filter ? odd_ones_of(*all[begin + i]) : *all[begin + i];
      const std::string of_which = (asked.filter ? " of the odd ones, " : ", ") + hex_text(part[i]);
      if (firsts[i] != first_of(expected)) return "first_hits" + of_which;
      if (blocked[i] != (expected.empty() ? 0 : 1)) return "any_hits" + of_which;
    }
    return std::string();
  };
  for (const bool has_filter : {false, true}) {
    SceneShapeBatchOptions<Scalar> asked;
    if (has_filter) asked.filter = is_odd<Scalar>;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      asked.options = options[i];
      const std::string difference = difference_of(asked, i, 1);
      if (!difference.empty()) return difference;
    }
    // Those of the whole batch may have no say where each shape has its own.
    asked.options = {.instance_mask = 0};
    asked.path_options = options;
    const std::string difference = difference_of(asked, 0, shapes.size());
    if (!difference.empty()) return difference + ", with options of its own";
  }
  return "";
}

/// Does so with the shapes of each kind.
template <typename Scalar>
std::string difference_in_batches(const std::vector<JudgedShape<Scalar>>& judged, const Scene<Scalar>& scene) {
  for (const std::string& difference : {difference_in_batches<SweptSphere<Scalar>>(judged, scene),
                                        difference_in_batches<SweptBox<Scalar>>(judged, scene),
                                        difference_in_batches<SweptCapsule<Scalar>>(judged, scene)}) {
    if (!difference.empty()) return difference;
  }
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
    std::vector<JudgedShape<Scalar>> judged_shapes;
    for (const SweptShape<Scalar>& shape : draw_shapes(drawer, 6, random)) {
      Hits<Scalar> all;
      judged.scene.all_hits(shape, all);
      const auto error = judged.oracle.find_error(shape, {}, all);
      ASSERT_FALSE(error.has_value()) << *error << ", scene " << i << ", " << text_of(shape);
      ASSERT_EQ(difference_from(all, judged.scene, shape, {}), "") << "scene " << i << ", " << text_of(shape);
      judged_shapes.push_back({shape, {}, all});
      ++asked;
      touched += !all.empty();
      if (all.empty() || random.one_in(2)) continue;
      const auto options = draw_shape_options(all[random.below(all.size())], random);
      Hits<Scalar> some;
      judged.scene.all_hits(shape, some, options);
      const auto other = judged.oracle.find_error(shape, options, some);
      ASSERT_FALSE(other.has_value()) << *other << ", scene " << i << ", " << text_of(shape);
      ASSERT_EQ(difference_from(some, judged.scene, shape, options), "") << "scene " << i << ", " << text_of(shape);
      judged_shapes.push_back({shape, options, some});
    }
    ASSERT_EQ(difference_in_batches(judged_shapes, judged.scene), "") << "scene " << i;
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
