#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <span>
#include <vector>

#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "unit_triangles.hpp"

namespace {

std::size_t allocation_count = 0;

}  // namespace

// Not inlined, or GCC sees memory of malloc given to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++allocation_count;
  if (void* block = std::malloc(bytes == 0 ? 1 : bytes)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace surehit::test::query_allocation_test {
namespace {

template <typename Call>
std::size_t allocations_of(Call&& call) {
  const std::size_t before = allocation_count;
  call();
  return allocation_count - before;
}

template <typename Scalar>
class QueryAllocation : public testing::Test {
 protected:
  Collider<Scalar> collider{stack_of_triangles<Scalar>(100).view()};
  Segment<Scalar> across = through_stack<Scalar>(Scalar{-0.5}, 200);
  /// In the plane of triangle 3, where all is decided, ordered and rounded exactly.
  Segment<Scalar> in_plane{{-1, Scalar{0.25}, 3}, {2, Scalar{0.125}, 3}};
};
TYPED_TEST_SUITE(QueryAllocation, Scalars, ScalarNames);

TYPED_TEST(QueryAllocation, counter_counts) {
  // Called as a function, which a compiler may not leave out as it may a new-expression.
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(10)); }), 1u);
}

TYPED_TEST(QueryAllocation, none_in_single_queries) {
  for (const auto& segment : {this->across, this->in_plane}) {
    const Path<TypeParam> path = segment;
    const auto odd = [](const Hit<TypeParam>& hit) { return hit.triangle % 2 == 1; };
    const std::size_t allocations = allocations_of([&] {
      const auto hit = this->collider.first_hit(path);
      ASSERT_TRUE(hit);
      static_cast<void>(this->collider.any_hit(path));
      static_cast<void>(this->collider.first_hit(path, odd));
      static_cast<void>(this->collider.any_hit(path, odd));
      static_cast<void>(this->collider.last_free_point(segment, *hit));
      static_cast<void>(point(segment, *hit));
      static_cast<void>(intersect(path, this->collider.triangle(hit->triangle)));
    });
    EXPECT_EQ(allocations, 0u);
  }
}

TYPED_TEST(QueryAllocation, none_in_batches) {
  const std::vector<Segment<TypeParam>> segments(64, this->in_plane);
  std::vector<Hit<TypeParam>> hits(segments.size());
  std::vector<std::uint8_t> blocked(segments.size());
  EXPECT_EQ(allocations_of([&] {
              this->collider.first_hits(segments, hits);
              this->collider.any_hits(segments, blocked);
            }),
            0u);
  EXPECT_EQ(hits.back().triangle, 3u);
}

TYPED_TEST(QueryAllocation, all_hits_keeps_the_capacity_of_its_vector) {
  std::vector<Hit<TypeParam>> hits;
  hits.reserve(1000);
  const Hit<TypeParam>* const data = hits.data();
  this->collider.all_hits(this->across, hits);
  EXPECT_EQ(hits.size(), 100u);
  EXPECT_EQ(hits.data(), data);
}

}  // namespace
}  // namespace surehit::test::query_allocation_test
