#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "collider_state.hpp"
#include "collision/in_levels.hpp"
#include "collision/painted_stack.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/shape_families.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

#if defined(SUREHIT_TEST_PROMISES_STACK)

namespace surehit::test::shape_stack_test {
namespace {

template <typename Scalar>
constexpr std::size_t promised_bytes = (sizeof(Scalar) == 4 ? 48 : 256) * 1024;

using FamiliesAndScalars =
    testing::Types<std::pair<SphereFamily, float>, std::pair<SphereFamily, double>, std::pair<BoxFamily, float>,
                   std::pair<BoxFamily, double>, std::pair<CapsuleFamily, float>, std::pair<CapsuleFamily, double>>;

struct FamilyAndScalarNames {
  template <typename FamilyAndScalar>
  static std::string GetName(int) {
    using Family = typename FamilyAndScalar::first_type;
    const std::string shape = std::is_same_v<Family, SphereFamily> ? "sphere"
                              : std::is_same_v<Family, BoxFamily>  ? "box"
                                                                   : "capsule";
    return shape + (sizeof(typename FamilyAndScalar::second_type) == 4 ? "_float" : "_double");
  }
};

template <typename FamilyAndScalar>
class ShapeStack : public testing::Test {};
TYPED_TEST_SUITE(ShapeStack, FamiliesAndScalars, FamilyAndScalarNames);

TYPED_TEST(ShapeStack, of_all_queries_in_all_families) {
  using Family = typename TypeParam::first_type;
  using Scalar = typename TypeParam::second_type;
  PaintedStack stack;
  std::size_t deepest = 0;
  for (const Family family : all_families<Family>) {
    Random random(41 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(10); ++i) {
      const auto [drawn, drawn_triangle] = draw_shape_pair<Scalar>(family, random);
      const auto& shape = drawn;  // Lambdas may not capture bindings.
      const Triangle<Scalar>& triangle = drawn_triangle;
      GeneratedMesh<Scalar> mesh;
      mesh.add(triangle);
      mesh.add({triangle.b, triangle.c, triangle.a});  // A tie.
      const Collider<Scalar> collider(mesh.view());
      std::vector<ShapeHit<Scalar>> hits(1);
      const auto measure = [&](const auto& call) {
        deepest = std::max(deepest, stack.bytes_used_by(call));
        ASSERT_LT(deepest, promised_bytes<Scalar>) << name_of(family) << ", case " << i;
      };
      measure([&] { static_cast<void>(intersect(shape, triangle, {.max_t = Scalar(0.5), .culling = Culling::back})); });
      measure([&] { static_cast<void>(contact_normal<Scalar>(shape, triangle)); });
      measure([&] { static_cast<void>(collider.first_hit(shape)); });
      measure([&] { static_cast<void>(collider.any_hit(shape, {.max_t = Scalar(0.5)})); });
      measure([&] { collider.first_hits(std::span{&shape, 1}, hits); });
      measure([&] { collider.all_hits(shape, hits); });
      if (hits.empty()) continue;
      measure([&] { static_cast<void>(collider.last_free_t(shape, hits.front())); });
      measure([&] { static_cast<void>(collider.last_free_point(shape, hits.front())); });
    }
  }
  testing::Test::RecordProperty("bytes", static_cast<int>(deepest));
  // The longest integers are among the cases.
  EXPECT_GT(deepest, promised_bytes<Scalar> / 4);
}

/// Lanes of a batch come to the deepest inner grid, in which shapes touch what decides with the longest integers.
TYPED_TEST(ShapeStack, of_queries_and_batches_in_inner_grids_in_all_families) {
  using Family = typename TypeParam::first_type;
  using Scalar = typename TypeParam::second_type;
  PaintedStack stack;
  std::size_t deepest = 0;
  std::size_t in_deepest_grid = 0;
  for (const Family family : all_families<Family>) {
    Random random(41 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(3); ++i) {
      const auto [drawn, triangle] = draw_shape_pair<Scalar>(family, random);
      const auto& shape = drawn;  // Lambdas may not capture bindings.
      const auto hit = intersect(shape, triangle);
      if (!hit) continue;
      // A shape is small for the cells around many levels, and walks in a lane. In one level, it may walk alone.
      for (const std::uint32_t levels : {1U, Grid::max_depth}) {
        const auto mesh = in_levels<Scalar>(triangle, contact_point(triangle, *hit), shape.start, levels);
        Collider<Scalar> collider;
        // Numbers may be too large for levels around them.
        if (!collider.try_build(mesh.view(), {.grid = {.resolution = {2, 2, 2}, .crowded = 8}})) continue;
        const Grid& grid = detail::ColliderState<Scalar>::of(collider).grid;
        if (grid.levels() > 0 && grid.inner_frames().size() >= Grid::max_depth) ++in_deepest_grid;
        const std::vector<std::remove_cvref_t<decltype(shape)>> shapes(2, shape);
        std::vector<ShapeHit<Scalar>> hits(shapes.size());
        std::vector<std::uint8_t> blocked(shapes.size());
        const auto measure = [&](const char* query, const auto& call) {
          const std::size_t bytes = stack.bytes_used_by(call);
          deepest = std::max(deepest, bytes);
          EXPECT_LT(bytes, promised_bytes<Scalar>) << query << ", " << name_of(family) << ", case " << i;
        };
        measure("first_hit", [&] { static_cast<void>(collider.first_hit(shape)); });
        measure("any_hit", [&] { static_cast<void>(collider.any_hit(shape, {.max_t = Scalar(0.5)})); });
        measure("overlaps", [&] { static_cast<void>(collider.overlaps(shape)); });
        measure("first_hits", [&] { collider.first_hits(shapes, hits); });
        measure("any_hits", [&] { collider.any_hits(shapes, blocked); });
        measure("all_hits", [&] { collider.all_hits(shape, hits); });
        measure("last_free_point", [&] { static_cast<void>(collider.last_free_point(shape, hits.front())); });
      }
    }
  }
  testing::Test::RecordProperty("bytes", static_cast<int>(deepest));
  EXPECT_GT(in_deepest_grid, 0U);
  // The longest integers are among the cases.
  EXPECT_GT(deepest, promised_bytes<Scalar> / 4);
}

}  // namespace
}  // namespace surehit::test::shape_stack_test

#endif
