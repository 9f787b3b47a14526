#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "collision/in_levels.hpp"
#include "collision/painted_stack.hpp"
#include "collision/unit_triangles.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

#if defined(SUREHIT_TEST_PROMISES_STACK)

namespace surehit::test::query_stack_test {
namespace {

constexpr std::size_t promised_bytes = 24 * 1024;
/// Batches walk many paths at once.
template <typename Scalar>
constexpr std::size_t promised_bytes_of_batches = (std::is_same_v<Scalar, float> ? 48 : 64) * 1024;

template <typename Scalar>
class QueryStack : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;
  static constexpr Scalar tiny = Limits::denorm_min();
  static constexpr Scalar huge = Limits::max();

  struct Case {
    std::string name;
    Path<Scalar> path;
    Triangle<Scalar> triangle;
  };

  /// Every branch of the exact stage, with numbers that are as long as they get: the least and the largest in one pair.
  static std::vector<Case> cases() {
    const Triangle<Scalar> wide{{-huge, -huge, tiny}, {huge, -huge, tiny}, {tiny, huge, tiny}};
    const Triangle<Scalar> tilted{{-huge, -huge, -huge}, {huge, tiny, huge}, {tiny, huge, huge / 3}};
    const Triangle<Scalar> needle{{-huge, -huge, -huge}, {tiny, tiny, tiny}, {huge, huge, huge}};
    const Triangle<Scalar> straight_needle{{-huge, tiny, tiny}, {tiny, tiny, tiny}, {huge, tiny, tiny}};
    const Triangle<Scalar> dot{{tiny, tiny, tiny}, {tiny, tiny, tiny}, {tiny, tiny, tiny}};
    const Vector3<Scalar> middle{tiny, tiny, tiny};
    const Vector3<Scalar> high{huge / 3, huge / 5, huge};
    const Vector3<Scalar> low{-huge / 7, tiny, -huge};
    const Vector3<Scalar> left{-huge, huge / 3, tiny};
    const Vector3<Scalar> right{huge, -huge / 5, tiny};
    return {{"across", Segment<Scalar>{high, low}, wide},
            {"across_tilted", Segment<Scalar>{high, low}, tilted},
            {"across_at_a_corner", Segment<Scalar>{{tiny, huge, huge}, {tiny, huge, -huge}}, wide},
            {"ray_across", Ray<Scalar>{high, {-tiny, -tiny, -huge}}, wide},
            {"line_across", Line<Scalar>{high, {-tiny, -tiny, huge}}, wide},
            {"in_plane", Segment<Scalar>{left, right}, wide},
            {"ray_in_plane", Ray<Scalar>{left, {huge, tiny, 0}}, wide},
            {"line_in_plane", Line<Scalar>{right, {huge, tiny, 0}}, wide},
            {"standing", Segment<Scalar>{middle, middle}, wide},
            {"across_needle", Segment<Scalar>{{tiny, tiny, huge}, {tiny, tiny, -huge}}, straight_needle},
            {"along_needle", Segment<Scalar>{{-huge, tiny, tiny}, {huge, tiny, tiny}}, straight_needle},
            {"along_slanted_needle", Segment<Scalar>{{-huge, -huge, -huge}, {huge, huge, huge}}, needle},
            {"standing_on_needle", Segment<Scalar>{middle, middle}, straight_needle},
            {"across_dot", Segment<Scalar>{{tiny, tiny, huge}, {tiny, tiny, -huge}}, dot},
            {"standing_on_dot", Segment<Scalar>{middle, middle}, dot}};
  }

  static std::vector<QueryOptions<Scalar>> all_options() {
    return {{}, {.min_t = tiny}, {.min_t = -huge, .max_t = huge}, {.min_t = Scalar(0.3), .max_t = Scalar(0.9)}};
  }

  void expect_less_than(std::size_t promised, const std::string& name, const std::function<void()>& call) {
    const std::size_t bytes = stack_.bytes_used_by(call);
    testing::Test::RecordProperty(name, std::to_string(bytes));
    EXPECT_LT(bytes, promised) << name;
  }

  template <typename Call>
  void expect_all_within_promise(Call&& call, std::size_t promised = promised_bytes) {
    for (const Case& one : cases()) {
      GeneratedMesh<Scalar> mesh;
      mesh.add(one.triangle);
      mesh.add({one.triangle.b, one.triangle.c, one.triangle.a});
      const Collider<Scalar> collider(mesh.view());
      std::size_t number = 0;
      for (const QueryOptions<Scalar>& options : all_options()) {
        expect_less_than(promised, one.name + "_" + std::to_string(number++), [&] { call(collider, one, options); });
      }
    }
  }

 private:
  PaintedStack stack_;
};
TYPED_TEST_SUITE(QueryStack, Scalars, ScalarNames);

TYPED_TEST(QueryStack, painted_stack_sees_how_deep_a_call_goes) {
  PaintedStack stack;
  const std::size_t bytes = stack.bytes_used_by([] {
    volatile char block[10'000];
    for (volatile char& byte : block) byte = 1;
  });
  EXPECT_NEAR(static_cast<double>(bytes), 10'000, 1'000);
}

TYPED_TEST(QueryStack, of_intersect) {
  this->expect_all_within_promise([](const auto&, const auto& one, const auto& options) {
    static_cast<void>(intersect(one.path, one.triangle, options));
  });
}

TYPED_TEST(QueryStack, of_first_hit) {
  this->expect_all_within_promise([](const auto& collider, const auto& one, const auto& options) {
    static_cast<void>(collider.first_hit(one.path, options));
  });
}

TYPED_TEST(QueryStack, of_first_hit_with_a_filter) {
  this->expect_all_within_promise([](const auto& collider, const auto& one, const auto& options) {
    static_cast<void>(collider.first_hit(
        one.path, [](const auto& hit) { return hit.triangle > 0; }, options));
  });
}

TYPED_TEST(QueryStack, of_any_hit) {
  this->expect_all_within_promise([](const auto& collider, const auto& one, const auto& options) {
    static_cast<void>(collider.any_hit(one.path, options));
  });
}

TYPED_TEST(QueryStack, of_batches) {
  const auto call = [](const auto& collider, const auto& one, const auto& options) {
    const Segment<TypeParam> segments[] = {{one.path.start, one.path.toward}, {one.path.toward, one.path.start}};
    Hit<TypeParam> hits[2];
    std::uint8_t blocked[2];
    const BatchOptions<TypeParam> batch{.options = options};
    collider.first_hits(segments, hits, batch);
    collider.any_hits(segments, blocked, batch);
  };
  this->expect_all_within_promise(call, promised_bytes_of_batches<TypeParam>);
}

TYPED_TEST(QueryStack, of_last_free_point) {
  this->expect_all_within_promise([](const auto& collider, const auto& one, const auto& options) {
    const Segment<TypeParam> segment{one.path.start, one.path.toward};
    static_cast<void>(collider.last_free_point(segment, Hit<TypeParam>{.t = TypeParam{0.5}, .triangle = 0}, options));
    static_cast<void>(collider.last_free_point(segment, Hit<TypeParam>{.t = 0x1p-60, .triangle = 0}, options));
  });
}

/// Paths walk through all inner grids to what decides with the longest integers for which levels have room around them.
TYPED_TEST(QueryStack, of_queries_and_batches_in_inner_grids) {
  using Scalar = TypeParam;
  std::size_t in_deepest_grid = 0;
  const auto with_room = [](const Vector3<Scalar>& point) -> Vector3<Scalar> {
    return point.unaryExpr([](Scalar x) { return std::fabs(x) > 1 ? x * Scalar{0x1p-60F} : x; });
  };
  for (const auto& one : this->cases()) {
    const Triangle<Scalar> triangle{with_room(one.triangle.a), with_room(one.triangle.b), with_room(one.triangle.c)};
    const Segment<Scalar> segment{with_room(one.path.start), with_room(one.path.toward)};
    const auto hit = intersect(segment, triangle);
    if (!hit) continue;
    const auto mesh = in_levels<Scalar>(triangle, point(segment, *hit), segment.start, Grid::max_depth);
    const Collider<Scalar> collider(mesh.view(), {.grid = {.resolution = {2, 2, 2}, .crowded = 8}});
    const Grid& grid = detail::ColliderState<Scalar>::of(collider).grid;
    if (grid.levels() > 0 && grid.inner_frames().size() >= Grid::max_depth) ++in_deepest_grid;
    const auto measure = [&](const std::string& query, std::size_t promised, const std::function<void()>& call) {
      this->expect_less_than(promised, query + "_" + one.name, call);
    };
    measure("first_hit", promised_bytes, [&] { static_cast<void>(collider.first_hit(segment)); });
    measure("any_hit", promised_bytes, [&] { static_cast<void>(collider.any_hit(segment)); });
    measure("last_free_point", promised_bytes, [&] { static_cast<void>(collider.last_free_point(segment, *hit)); });
    const std::vector<Segment<Scalar>> segments(40, segment);
    std::vector<Hit<Scalar>> hits(segments.size());
    std::vector<std::uint8_t> blocked(segments.size());
    measure("first_hits", promised_bytes_of_batches<Scalar>, [&] { collider.first_hits(segments, hits); });
    measure("any_hits", promised_bytes_of_batches<Scalar>, [&] { collider.any_hits(segments, blocked); });
  }
  EXPECT_GT(in_deepest_grid, 0U);
}

TYPED_TEST(QueryStack, of_point_and_normal) {
  this->expect_all_within_promise([](const auto&, const auto& one, const auto&) {
    const Line<TypeParam> line{one.path.start, one.path.toward};
    static_cast<void>(point(line, Hit<TypeParam>{.t = TestFixture::tiny}));
    static_cast<void>(point(line, Hit<TypeParam>{.t = TypeParam(0.3)}));
    static_cast<void>(point(Segment<TypeParam>{line.origin, line.direction}, Hit<TypeParam>{.t = TypeParam(0.3)}));
    const std::uint32_t corners[] = {0, 1, 2};
    const Vector3<TypeParam> vertices[] = {one.triangle.a, one.triangle.b, one.triangle.c};
    static_cast<void>(normal(TriangleMeshView<TypeParam>(vertices, corners), 0));
  });
}

}  // namespace
}  // namespace surehit::test::query_stack_test

#endif
