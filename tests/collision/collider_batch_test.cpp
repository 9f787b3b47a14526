#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::collider_batch_test {
namespace {

template <typename Scalar>
class ColliderBatch : public testing::Test {
 protected:
  Collider<Scalar> stack{stack_of_triangles<Scalar>(5).view(), BuildOptions{.grid = {.resolution = {2, 2, 3}}}};

  /// Hits and misses in turn, each hit at another triangle.
  static std::vector<Segment<Scalar>> segments(std::size_t count) {
    std::vector<Segment<Scalar>> result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto height = static_cast<Scalar>(i % 5);
      result.push_back(
          through_stack<Scalar>(height + Scalar{0.5}, i % 2 == 0 ? height - Scalar{0.5} : height + Scalar{0.75}));
    }
    return result;
  }

  template <typename AnyPath>
  void expect_same_as_single_calls(std::span<const AnyPath> paths, const QueryOptions<Scalar>& options = {}) {
    std::vector<Hit<Scalar>> hits(paths.size(), Hit<Scalar>{9, 9, 9, 9, Side::back});
    std::vector<std::uint8_t> blocked(paths.size(), 9);
    QueryStatistics first_statistics;
    QueryStatistics any_statistics;
    stack.first_hits(paths, hits, {.options = options, .statistics = &first_statistics});
    stack.any_hits(paths, blocked, {.options = options, .statistics = &any_statistics});
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto single = stack.first_hit(paths[i], options);
      EXPECT_TRUE(same_bits(hits[i], single.value_or(Hit<Scalar>{})));
      EXPECT_EQ(blocked[i], single ? 1 : 0);
    }
    EXPECT_EQ(first_statistics.paths, paths.size());
    EXPECT_EQ(any_statistics.paths, paths.size());
  }
};
TYPED_TEST_SUITE(ColliderBatch, Scalars, ScalarNames);

TYPED_TEST(ColliderBatch, of_any_size_answers_as_single_calls_do) {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 1000u}) {
    this->template expect_same_as_single_calls<Segment<TypeParam>>(this->segments(count));
  }
}

TYPED_TEST(ColliderBatch, of_rays_and_lines) {
  std::vector<Ray<TypeParam>> rays;
  std::vector<Line<TypeParam>> lines;
  for (const auto& segment : this->segments(20)) {
    rays.push_back({segment.start, segment.end - segment.start});
    lines.push_back({segment.end, segment.end - segment.start});
  }
  lines.push_back({{9, 9, 9}, {0, 0, 1}});
  this->template expect_same_as_single_calls<Ray<TypeParam>>(rays);
  this->template expect_same_as_single_calls<Line<TypeParam>>(lines);
}

TYPED_TEST(ColliderBatch, of_paths_from_too_far_away_to_walk_side_by_side) {
  const TypeParam far{0x1p100};
  std::vector<Ray<TypeParam>> rays;
  for (const auto& segment : this->segments(20)) {
    rays.push_back({{segment.start[0], segment.start[1], far}, {0, 0, -1}});
    rays.push_back({segment.start, {0, 0, -1}});
  }
  this->template expect_same_as_single_calls<Ray<TypeParam>>(rays);
  EXPECT_TRUE(this->stack.first_hit(rays[0]));
}

TYPED_TEST(ColliderBatch, with_options) {
  this->template expect_same_as_single_calls<Segment<TypeParam>>(
      this->segments(50), {.max_t = TypeParam{0.5}, .culling = Culling::back, .ignored_triangle = 2});
}

TYPED_TEST(ColliderBatch, miss_has_no_triangle) {
  const std::vector<Segment<TypeParam>> miss = {{{9, 9, 9}, {9, 9, 8}}};
  std::vector<Hit<TypeParam>> hits(1, Hit<TypeParam>{1, 1, 1, 1, Side::front});
  std::vector<std::uint8_t> blocked(1, 7);
  this->stack.first_hits(miss, hits);
  this->stack.any_hits(miss, blocked);
  EXPECT_EQ(hits[0].triangle, no_triangle);
  EXPECT_EQ(blocked[0], 0);
}

TYPED_TEST(ColliderBatch, of_unequal_lengths_leaves_alone_what_is_beyond_the_shorter) {
  const auto segments = this->segments(5);
  const std::span<const Segment<TypeParam>> all(segments);
  const Hit<TypeParam> untouched{1, 1, 1, 77, Side::front};
  std::vector<Hit<TypeParam>> hits(5, untouched);
  std::vector<std::uint8_t> blocked(5, 77);
  this->stack.first_hits(all.first(2), hits);
  this->stack.any_hits(all.first(2), blocked);
  EXPECT_NE(hits[1].triangle, 77u);
  EXPECT_EQ(hits[2], untouched);
  EXPECT_NE(blocked[1], 77);
  EXPECT_EQ(blocked[2], 77);

  std::vector<Hit<TypeParam>> few(3, untouched);
  this->stack.first_hits(all, std::span<Hit<TypeParam>>(few).first(2));
  EXPECT_NE(few[1].triangle, 77u);
  EXPECT_EQ(few[2], untouched);
}

TYPED_TEST(ColliderBatch, never_throws) {
  const Collider<TypeParam>& collider = this->stack;
  static_assert(noexcept(collider.first_hits(std::declval<std::span<const Segment<TypeParam>>>(),
                                             std::declval<std::span<Hit<TypeParam>>>())));
  static_assert(noexcept(
      collider.any_hits(std::declval<std::span<const Ray<TypeParam>>>(), std::declval<std::span<std::uint8_t>>())));
  static_assert(noexcept(collider.first_hit(std::declval<const Path<TypeParam>&>())));
  static_assert(noexcept(collider.any_hit(std::declval<const Path<TypeParam>&>())));
}

}  // namespace
}  // namespace surehit::test::collider_batch_test
