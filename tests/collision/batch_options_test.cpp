#include "surehit/batch_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "executor_answers.hpp"
#include "same_answers.hpp"
#include "support/pair_families.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::batch_options_test {
namespace {

/// Batches in which each path is asked something of its own, beside single calls that ask the same.
template <typename Scalar>
class BatchOptionsTest : public testing::Test {
 protected:
  static constexpr std::size_t count = 2500;

  BatchOptionsTest() : many_(ManyPaths<Scalar>::scattered(count)) {
    Random random(89);
    std::vector<std::uint32_t> masks(many_.collider.triangle_count());
    for (auto& mask : masks) mask = static_cast<std::uint32_t>(random.below(4));
    EXPECT_TRUE(many_.collider.try_set_masks(masks));
    for (std::size_t i = 0; i < count; ++i) {
      QueryOptions<Scalar> options;
      if (const auto hit = many_.collider.first_hit(many_.segments[i])) {
        options = draw_options(random, hit->t);
        if (random.one_in(2)) options.ignored_triangle = hit->triangle;
      }
      if (random.one_in(2)) options.mask = static_cast<std::uint32_t>(random.below(4));
      if (random.one_in(50)) options.max_t = std::numeric_limits<Scalar>::quiet_NaN();
      if (random.one_in(50)) options.min_t = 2;
      own_options_.push_back(options);
    }
  }

  /// `single(i)` answers path i alone. Returns how many paths hit.
  template <typename Single>
  std::size_t expect_same(const PathSpan<Scalar>& paths, const BatchOptions<Scalar>& options, const Single& single) {
    std::vector<Hit<Scalar>> hits(paths.size());
    std::vector<std::uint8_t> blocked(paths.size());
    many_.collider.first_hits(paths, hits, options);
    many_.collider.any_hits(paths, blocked, options);
    std::size_t found = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const Hit<Scalar> expected = single(i).value_or(Hit<Scalar>{});
      EXPECT_TRUE(same_bits(hits[i], expected)) << i;
      EXPECT_EQ(blocked[i] != 0, expected.triangle != no_triangle) << i;
      found += blocked[i];
    }
    return found;
  }

  template <typename AnyPath>
  void expect_own_options(const std::vector<AnyPath>& paths, const std::optional<Executor>& executor = {}) {
    const std::size_t found =
        expect_same(paths, {.path_options = own_options_, .executor = executor},
                    [&](std::size_t i) { return many_.collider.first_hit(paths[i], own_options_[i]); });
    EXPECT_GT(found, paths.size() / 20);
    EXPECT_LT(found, paths.size());
  }

  ManyPaths<Scalar> many_;
  std::vector<QueryOptions<Scalar>> own_options_;
};
TYPED_TEST_SUITE(BatchOptionsTest, Scalars, ScalarNames);

TYPED_TEST(BatchOptionsTest, ask_each_path_by_its_own) {
  this->expect_own_options(this->many_.segments);
  this->expect_own_options(this->many_.rays);
  this->expect_own_options(this->many_.lines);
}

TYPED_TEST(BatchOptionsTest, ask_each_path_by_its_own_on_an_executor) {
  const auto backwards = [](std::size_t count, const Executor::Task& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  const std::vector<Segment<TypeParam>> once = this->many_.segments;
  for (int i = 0; i < 2; ++i) {  // beyond one task
    this->many_.segments.insert(this->many_.segments.end(), once.begin(), once.end());
    this->own_options_.insert(this->own_options_.end(), this->own_options_.begin(),
                              this->own_options_.begin() + this->count);
  }
  this->expect_own_options(this->many_.segments, backwards);
}

TYPED_TEST(BatchOptionsTest, are_as_many_as_the_shortest) {
  const Hit<TypeParam> untouched{1, 1, 1, 7777, Side::front};
  std::vector<Hit<TypeParam>> hits(this->count, untouched);
  std::vector<std::uint8_t> blocked(this->count, 77);
  const auto few = std::span(this->own_options_).first(100);
  this->many_.collider.first_hits(this->many_.segments, hits, {.path_options = few});
  this->many_.collider.any_hits(this->many_.segments, blocked, {.path_options = few});
  for (std::size_t i = 0; i < this->count; ++i) {
    EXPECT_EQ(hits[i] == untouched, i >= 100) << i;
    EXPECT_EQ(blocked[i] == 77, i >= 100) << i;
  }
}

TYPED_TEST(BatchOptionsTest, filter_by_the_index_of_the_path) {
  const auto accepts = [](std::size_t path, const Hit<TypeParam>& hit) { return (path + hit.triangle) % 3 != 0; };
  const auto& segments = this->many_.segments;
  std::vector<Segment<TypeParam>> many;
  for (int i = 0; i < 4; ++i) many.insert(many.end(), segments.begin(), segments.end());
  const auto single = [&](std::size_t i) {
    return this->many_.collider.first_hit(many[i], [&](const Hit<TypeParam>& hit) { return accepts(i, hit); });
  };
  EXPECT_GT(this->expect_same(many, {.filter = accepts}, single), 0U);
  const auto forwards = [](std::size_t count, const Executor::Task& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
  EXPECT_GT(this->expect_same(many, {.filter = accepts, .executor = forwards}, single), 0U);
}

TYPED_TEST(BatchOptionsTest, filter_by_the_hit_alone) {
  const auto is_even = [](const Hit<TypeParam>& hit) { return hit.triangle % 2 == 0; };
  const auto& rays = this->many_.rays;
  EXPECT_GT(
      this->expect_same(rays, {.options = {.mask = 1}, .filter = is_even},
                        [&](std::size_t i) { return this->many_.collider.first_hit(rays[i], is_even, {.mask = 1}); }),
      0U);
}

TYPED_TEST(BatchOptionsTest, read_paths_where_they_lie) {
  struct Particle {
    std::uint32_t id;
    TypeParam position[3];
    TypeParam mass;
    TypeParam next[3];
  };
  const auto& segments = this->many_.segments;
  std::vector<Particle> particles(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    std::copy_n(segments[i].start.data(), 3, particles[i].position);
    std::copy_n(segments[i].end.data(), 3, particles[i].next);
  }
  const auto at = [&](const TypeParam* first) {
    return VertexView<TypeParam>::strided(first, particles.size(), sizeof(Particle));
  };
  const auto starts = at(particles[0].position);
  const auto ends = at(particles[0].next);
  const auto& collider = this->many_.collider;
  EXPECT_GT(this->expect_same(PathSpan<TypeParam>::segments(starts, ends), {},
                              [&](std::size_t i) { return collider.first_hit(segments[i]); }),
            0U);
  EXPECT_GT(this->expect_same(
                PathSpan<TypeParam>::rays(starts, ends), {.path_options = this->own_options_},
                [&](std::size_t i) {
                  return collider.first_hit(Ray<TypeParam>{segments[i].start, segments[i].end}, this->own_options_[i]);
                }),
            0U);
  EXPECT_GT(this->expect_same(PathSpan<TypeParam>::lines(starts, ends), {},
                              [&](std::size_t i) {
                                return collider.first_hit(Line<TypeParam>{segments[i].start, segments[i].end});
                              }),
            0U);
  // Without masks, the kernel decides most hits, and the batch rounds them.
  EXPECT_TRUE(this->many_.collider.try_set_masks({}));
  EXPECT_GT(this->expect_same(PathSpan<TypeParam>::segments(starts, ends), {},
                              [&](std::size_t i) { return collider.first_hit(segments[i]); }),
            0U);
}

/// As single queries do.
TYPED_TEST(BatchOptionsTest, statistics_count_the_paths_of_a_collider_without_triangles) {
  const Collider<TypeParam> nothing;
  const auto& segments = this->many_.segments;
  std::vector<Hit<TypeParam>> hits(segments.size());
  std::vector<std::uint8_t> blocked(segments.size(), 1);
  QueryStatistics statistics;
  nothing.first_hits(segments, hits, {.statistics = &statistics});
  nothing.any_hits(segments, blocked, {.statistics = &statistics});
  EXPECT_EQ(statistics.paths, 2 * segments.size());
  EXPECT_EQ(statistics.candidates, 0U);
  EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 1), 0);
}

}  // namespace
}  // namespace surehit::test::batch_options_test
