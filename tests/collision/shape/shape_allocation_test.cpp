#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <vector>

#include "collision/allocations.hpp"
#include "collision/shape/crowded_ground.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::shape_allocation_test {
namespace {

/// Shapes that come to divided cells and to inner grids, alone and in lanes.
template <typename Shape>
class ShapeAllocation : public testing::Test {
 protected:
  using Scalar = ScalarOfShape<Shape>;
  using Hit = ShapeHit<Scalar>;

  static bool is_odd(const Hit& hit) { return hit.triangle % 2 == 1; }

  CrowdedGround<Scalar> ground;
  Collider<Scalar> collider{ground.mesh.view(), CrowdedGround<Scalar>::options()};
  std::vector<Shape> shapes = ground.template shapes<Shape>(60);
};
TYPED_TEST_SUITE(ShapeAllocation, MovingShapes, MovingShapeNames);

TYPED_TEST(ShapeAllocation, counter_counts) {
  // Called as a function, which a compiler may not leave out as it may a new-expression.
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(10)); }), 1U);
}

TYPED_TEST(ShapeAllocation, shapes_come_to_crowded_cells_in_lanes_and_alone) {
  EXPECT_TRUE(this->ground.has_crowded_cells_and_inner_grids(this->collider));
  const auto in_lanes = std::count_if(this->shapes.begin(), this->shapes.end(), [&](const auto& shape) {
    return this->ground.walks_in_a_lane(this->collider, shape);
  });
  EXPECT_EQ(in_lanes, 40);
}

TYPED_TEST(ShapeAllocation, none_in_single_queries) {
  const auto& collider = this->collider;
  std::size_t hits = 0;
  for (const auto& shape : this->shapes) {
    const std::size_t allocations = allocations_of([&] {
      const auto hit = collider.first_hit(shape);
      static_cast<void>(collider.first_hit(shape, this->is_odd));
      static_cast<void>(collider.any_hit(shape));
      static_cast<void>(collider.any_hit(shape, this->is_odd));
      static_cast<void>(collider.overlaps(shape));
      static_cast<void>(collider.overlaps(shape, this->is_odd));
      if (!hit) return;
      ++hits;
      static_cast<void>(collider.last_free_t(shape, *hit));
      static_cast<void>(collider.last_free_point(shape, *hit));
      static_cast<void>(collider.last_free_point(shape, *hit, this->is_odd));
      const auto triangle = collider.triangle(hit->triangle);
      static_cast<void>(intersect(shape, triangle));
      static_cast<void>(contact_point(triangle, *hit));
      static_cast<void>(contact_normal<typename TestFixture::Scalar>(shape, triangle));
    });
    EXPECT_EQ(allocations, 0U);
  }
  EXPECT_GT(hits, this->shapes.size() / 2);
}

TYPED_TEST(ShapeAllocation, none_in_batches) {
  using Scalar = typename TestFixture::Scalar;
  const auto& collider = this->collider;
  std::vector<typename TestFixture::Hit> hits(this->shapes.size());
  std::vector<std::uint8_t> blocked(this->shapes.size());
  const std::vector<ShapeQueryOptions<Scalar>> options(this->shapes.size(), {.max_t = Scalar{0.5F}});
  QueryStatistics statistics;
  EXPECT_EQ(allocations_of([&] {
              collider.first_hits(this->shapes, hits, {.filter = this->is_odd, .statistics = &statistics});
              collider.any_hits(this->shapes, blocked, {.path_options = options});
              collider.first_hits(this->shapes, hits);
              collider.any_hits(this->shapes, blocked);
            }),
            0U);
  EXPECT_GT(std::count(blocked.begin(), blocked.end(), 1), std::ptrdiff_t{30});
}

TYPED_TEST(ShapeAllocation, all_hits_keeps_the_capacity_of_its_vector) {
  std::vector<typename TestFixture::Hit> hits;
  hits.reserve(this->collider.triangle_count());
  const auto* const data = hits.data();
  for (const auto& shape : this->shapes) {
    this->collider.all_hits(shape, hits);
    EXPECT_EQ(hits.data(), data);
  }
}

}  // namespace
}  // namespace surehit::test::shape_allocation_test
