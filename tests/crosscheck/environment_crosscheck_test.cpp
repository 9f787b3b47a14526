#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pair_cases.hpp"
#include "support/floating_point_mode.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/shape_families.hpp"
#include "support/shape_text.hpp"
#include "support/small_meshes.hpp"
#include "surehit/box.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::environment_crosscheck_test {
namespace {

constexpr std::array modes = {
    FloatingPointMode{"flush_to_zero", FE_TONEAREST, true},
    FloatingPointMode{"upward", FE_UPWARD, false},
    FloatingPointMode{"downward", FE_DOWNWARD, false},
    FloatingPointMode{"toward_zero_and_flush", FE_TOWARDZERO, true},
};

/// Whether this machine has the mode at all.
bool is_in_force(const FloatingPointMode& mode) {
  volatile double denormal = std::numeric_limits<double>::min();
  const FloatingPointModeScope scope(mode);
  denormal = denormal / 2;
  return std::fegetround() == mode.rounding && (denormal == 0) == mode.flushes_denormals;
}

class FloatingPointModes : public testing::TestWithParam<FloatingPointMode> {
 protected:
  void SetUp() override {
    if (!is_in_force(GetParam())) GTEST_SKIP() << "this machine has no mode " << GetParam().name;
  }
};

/// What a call answers in a mode, and whether it left the mode as it found it.
template <typename Call>
auto answer_in(const FloatingPointMode& mode, bool& mode_is_kept, const Call& call) {
  const FloatingPointModeScope scope(mode);
  const std::uint64_t before = control_word();
  auto answer = call();
  mode_is_kept = control_word() == before;
  return answer;
}

template <typename Scalar>
bool same_answer(const std::optional<Hit<Scalar>>& left, const std::optional<Hit<Scalar>>& right) {
  return left.has_value() == right.has_value() && (!left || same_bits(*left, *right));
}

template <typename Scalar>
bool same_answer(std::span<const Hit<Scalar>> left, std::span<const Hit<Scalar>> right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                    [](const Hit<Scalar>& a, const Hit<Scalar>& b) { return same_bits(a, b); });
}

template <typename Scalar>
void expect_same_in(const FloatingPointMode& mode, const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                    const QueryOptions<Scalar>& options) {
  const auto call = [&] { return intersect(path, triangle, options); };
  bool mode_is_kept = false;
  const std::optional<Hit<Scalar>> expected = call();
  const std::optional<Hit<Scalar>> answer = answer_in(mode, mode_is_kept, call);
  EXPECT_TRUE(mode_is_kept) << hex_text(path) << '\n' << hex_text(triangle) << '\n' << hex_text(options);
  EXPECT_TRUE(same_answer(answer, expected))
      << hex_text(path) << '\n'
      << hex_text(triangle) << '\n'
      << hex_text(options) << "\nexpected: " << (expected ? hex_text(*expected) : "a miss")
      << "\nanswered: " << (answer ? hex_text(*answer) : "a miss");
}

/// A twelfth of the pairs: each is answered twice, in three modes.
template <typename Scalar>
void check_pairs(const FloatingPointMode& mode) {
  for (const PairFamily family : all_pair_families) {
    SCOPED_TRACE(name_of(family));
    std::size_t number = 0;
    const auto visit = [&](const auto&... pair) {
      if (number++ % 12 == 0) expect_same_in<Scalar>(mode, pair...);
    };
    visit_segments<Scalar>(family, visit);
    visit_rays_and_lines<Scalar>(family, visit);
    visit_options<Scalar>(family, visit);
  }
}

TEST_P(FloatingPointModes, do_not_change_what_float_pairs_answer) { check_pairs<float>(GetParam()); }
TEST_P(FloatingPointModes, do_not_change_what_double_pairs_answer) { check_pairs<double>(GetParam()); }

/// All that is told of a moving shape and a triangle.
template <typename Scalar>
struct ShapePairAnswer {
  std::optional<ShapeHit<Scalar>> hit;
  Vector3<Scalar> point{0, 0, 0};
  Vector3<Scalar> normal{0, 0, 0};

  /// No answer is a NaN.
  friend bool operator==(const ShapePairAnswer&, const ShapePairAnswer&) = default;
};

template <typename Scalar, typename Family>
void check_shape_pairs(const FloatingPointMode& mode) {
  for (const Family family : all_families<Family>) {
    Random random(4 + static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(sizeof(Scalar) == 4 ? 100 : 10); i > 0; --i) {
      const auto [drawn, drawn_triangle] = draw_shape_pair<Scalar>(family, random);
      const auto& shape = drawn;  // Lambdas may not capture bindings.
      const Triangle<Scalar>& triangle = drawn_triangle;
      ShapeQueryOptions<Scalar> options;
      if (i % 4 == 0) options = {.max_t = random.unit<Scalar>(), .culling = Culling::back};
      const auto call = [&] {
        ShapePairAnswer<Scalar> answer{intersect(shape, triangle, options)};
        if (answer.hit) answer.point = contact_point(triangle, *answer.hit);
        if (answer.hit) answer.normal = contact_normal<Scalar>(shape, triangle);
        return answer;
      };
      bool mode_is_kept = false;
      const ShapePairAnswer<Scalar> expected = call();
      const ShapePairAnswer<Scalar> answer = answer_in(mode, mode_is_kept, call);
      EXPECT_TRUE(mode_is_kept) << name_of(family);
      EXPECT_TRUE(answer == expected) << name_of(family) << ": " << hex_text(shape) << '\n' << hex_text(triangle);
    }
  }
}

template <typename Scalar>
void check_shape_pairs_of_all_kinds(const FloatingPointMode& mode) {
  check_shape_pairs<Scalar, SphereFamily>(mode);
  check_shape_pairs<Scalar, BoxFamily>(mode);
  check_shape_pairs<Scalar, CapsuleFamily>(mode);
}

TEST_P(FloatingPointModes, do_not_change_what_float_shapes_and_triangles_answer) {
  check_shape_pairs_of_all_kinds<float>(GetParam());
}
TEST_P(FloatingPointModes, do_not_change_what_double_shapes_and_triangles_answer) {
  check_shape_pairs_of_all_kinds<double>(GetParam());
}

/// All that a collider answers about the paths of its mesh.
template <typename Scalar>
struct ColliderAnswers {
  std::vector<Hit<Scalar>> hits;
  std::vector<Vector3<Scalar>> free_points;
  std::vector<std::uint8_t> blocked;
};

template <typename Scalar>
ColliderAnswers<Scalar> ask(const SmallMesh<Scalar>& mesh) {
  ColliderAnswers<Scalar> answers;
  const Collider<Scalar> collider(mesh.view());
  std::vector<Segment<Scalar>> segments;
  for (const Path<Scalar>& path : mesh.paths) {
    const auto first = collider.first_hit(path);
    if (first) answers.hits.push_back(*first);
    answers.blocked.push_back(collider.any_hit(path));
    std::vector<Hit<Scalar>> all;
    collider.all_hits(path, all);
    answers.hits.insert(answers.hits.end(), all.begin(), all.end());
    if (path.kind != PathKind::segment) continue;
    segments.push_back({path.start, path.toward});
    if (first) answers.free_points.push_back(collider.last_free_point(segments.back(), *first));
  }
  std::vector<Hit<Scalar>> batch(segments.size());
  collider.first_hits(segments, batch);
  answers.hits.insert(answers.hits.end(), batch.begin(), batch.end());
  std::vector<std::uint8_t> blocked(segments.size());
  collider.any_hits(segments, blocked);
  answers.blocked.insert(answers.blocked.end(), blocked.begin(), blocked.end());
  return answers;
}

template <typename Scalar>
void check_colliders(const FloatingPointMode& mode) {
  Random random(4);
  for (std::size_t i = case_count(300); i > 0; --i) {
    const auto mesh = draw_small_mesh<Scalar>(i % small_mesh_kind_count, random);
    const auto call = [&] { return ask(mesh); };
    bool mode_is_kept = false;
    const ColliderAnswers<Scalar> expected = call();
    const ColliderAnswers<Scalar> answers = answer_in(mode, mode_is_kept, call);
    EXPECT_TRUE(mode_is_kept);
    EXPECT_TRUE(same_answer<Scalar>(answers.hits, expected.hits));
    EXPECT_EQ(answers.blocked, expected.blocked);
    EXPECT_EQ(answers.free_points, expected.free_points);
  }
}

TEST_P(FloatingPointModes, do_not_change_what_float_colliders_answer) { check_colliders<float>(GetParam()); }
TEST_P(FloatingPointModes, do_not_change_what_double_colliders_answer) { check_colliders<double>(GetParam()); }

/// The box of a mesh, and its collider as it is saved.
template <typename Scalar>
struct Saved {
  Box<Scalar> box;
  std::vector<std::byte> bytes;
};

/// Corners whose differences are denormal, and zeros of both signs.
template <typename Scalar>
void check_saved_denormals(const FloatingPointMode& mode) {
  const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();
  const std::vector<Vector3<Scalar>> corners = {
      {2 * tiny, Scalar{-0.0}, 7 * tiny}, {tiny, Scalar{-0.0}, 9 * tiny}, {3 * tiny, Scalar{0}, 8 * tiny}};
  const std::vector<int> triangle = {0, 1, 2};
  const TriangleMeshView<Scalar> mesh(corners, triangle);
  const Collider<Scalar> collider(mesh);
  const auto call = [&] {
    Saved<Scalar> saved{box_of(mesh), {}};
    EXPECT_TRUE(collider.save([&](std::span<const std::byte> part) {
      saved.bytes.insert(saved.bytes.end(), part.begin(), part.end());
      return true;
    }));
    return saved;
  };
  bool mode_is_kept = false;
  const Saved<Scalar> expected = call();
  const Saved<Scalar> saved = answer_in(mode, mode_is_kept, call);
  EXPECT_TRUE(mode_is_kept);
  EXPECT_EQ(saved.box.low[0], tiny);
  EXPECT_EQ(saved.box.low[2], 7 * tiny);
  EXPECT_EQ(saved.box.high[0], 3 * tiny);
  EXPECT_EQ(saved.box.high[2], 9 * tiny);
  EXPECT_EQ(saved.bytes, expected.bytes);
  Collider<Scalar> loaded;
  EXPECT_TRUE(loaded.try_load(saved.bytes));
}

TEST_P(FloatingPointModes, do_not_change_what_is_saved_of_floats) { check_saved_denormals<float>(GetParam()); }
TEST_P(FloatingPointModes, do_not_change_what_is_saved_of_doubles) { check_saved_denormals<double>(GetParam()); }

/// All that a collider answers about moving shapes, single and in a batch.
template <typename Scalar>
struct ColliderShapeAnswers {
  std::vector<ShapeHit<Scalar>> hits;
  std::vector<Scalar> free_ts;
  std::vector<Vector3<Scalar>> free_points;
  std::vector<std::uint8_t> blocked;

  friend bool operator==(const ColliderShapeAnswers&, const ColliderShapeAnswers&) = default;
};

template <typename Shape, typename Scalar>
void ask(const Collider<Scalar>& collider, const std::vector<Shape>& shapes, ColliderShapeAnswers<Scalar>& answers) {
  std::vector<ShapeHit<Scalar>> hits;
  for (const Shape& shape : shapes) {
    answers.blocked.push_back(collider.any_hit(shape));
    answers.blocked.push_back(collider.overlaps(shape));
    collider.all_hits(shape, hits);
    answers.hits.insert(answers.hits.end(), hits.begin(), hits.end());
    const auto first = collider.first_hit(shape);
    if (!first) continue;
    answers.hits.push_back(*first);
    answers.free_ts.push_back(collider.last_free_t(shape, *first));
    answers.free_points.push_back(collider.last_free_point(shape, *first));
  }
  hits.resize(shapes.size());
  collider.first_hits(shapes, hits);
  answers.hits.insert(answers.hits.end(), hits.begin(), hits.end());
  std::vector<std::uint8_t> blocked(shapes.size());
  collider.any_hits(shapes, blocked);
  answers.blocked.insert(answers.blocked.end(), blocked.begin(), blocked.end());
}

/// Each triangle has a shape of its own. Crowded cells are divided.
template <typename Scalar, typename Family>
void check_shapes_of_colliders(const FloatingPointMode& mode) {
  for (const Family family : all_families<Family>) {
    Random random(5 + static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(sizeof(Scalar) == 4 ? 3 : 1); i > 0; --i) {
      const auto [first_shape, first_triangle] = draw_shape_pair<Scalar>(family, random);
      std::vector shapes(1, first_shape);
      GeneratedMesh<Scalar> mesh;
      mesh.add(first_triangle);
      while (shapes.size() < (sizeof(Scalar) == 4 ? 16 : 5)) {
        const auto [shape, triangle] = draw_shape_pair<Scalar>(family, random);
        shapes.push_back(shape);
        mesh.add(triangle);
      }
      const auto call = [&] {
        ColliderShapeAnswers<Scalar> answers;
        ask(Collider<Scalar>(mesh.view(), {.grid = {.resolution = {2, 2, 2}, .crowded = 2}}), shapes, answers);
        return answers;
      };
      bool mode_is_kept = false;
      const ColliderShapeAnswers<Scalar> expected = call();
      const ColliderShapeAnswers<Scalar> answers = answer_in(mode, mode_is_kept, call);
      EXPECT_TRUE(mode_is_kept) << name_of(family);
      EXPECT_TRUE(answers == expected) << name_of(family);
    }
  }
}

template <typename Scalar>
void check_shapes_of_all_kinds(const FloatingPointMode& mode) {
  check_shapes_of_colliders<Scalar, SphereFamily>(mode);
  check_shapes_of_colliders<Scalar, BoxFamily>(mode);
  check_shapes_of_colliders<Scalar, CapsuleFamily>(mode);
}

TEST_P(FloatingPointModes, do_not_change_what_float_colliders_answer_about_shapes) {
  check_shapes_of_all_kinds<float>(GetParam());
}
TEST_P(FloatingPointModes, do_not_change_what_double_colliders_answer_about_shapes) {
  check_shapes_of_all_kinds<double>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, FloatingPointModes, testing::ValuesIn(modes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace surehit::test::environment_crosscheck_test
