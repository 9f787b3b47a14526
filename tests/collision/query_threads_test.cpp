#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "same_answers.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::query_threads_test {
namespace {

/// All that a thread can ask about one segment.
template <typename Scalar>
struct Answers {
  std::optional<Hit<Scalar>> first;
  std::optional<Hit<Scalar>> filtered;
  std::vector<Hit<Scalar>> all;
  Vector3<Scalar> free{0, 0, 0};
  bool any = false;

  Answers(const Collider<Scalar>& collider, const Segment<Scalar>& segment, QueryStatistics& statistics) {
    first = collider.first_hit(segment, {}, &statistics);
    filtered = collider.first_hit(
        segment, [](const Hit<Scalar>& hit) { return hit.triangle % 3 == 0; }, {}, &statistics);
    collider.all_hits(segment, all, {}, &statistics);
    any = collider.any_hit(segment, {}, &statistics);
    if (first) free = collider.last_free_point(segment, *first);
  }

  [[nodiscard]] bool same_as(const Answers& other) const {
    const auto same = [](const auto& x, const auto& y) {
      return x.has_value() == y.has_value() && (!x || same_bits(*x, *y));
    };
    if (!same(first, other.first) || !same(filtered, other.filtered) || any != other.any) return false;
    if (all.size() != other.all.size() || free != other.free) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!same_bits(all[i], other.all[i])) return false;
    }
    return true;
  }
};

/// One collider, asked by eight threads at once. Elsewhere such rays get lost, or answers come out at random:
/// https://github.com/AndresTraks/BulletSharpPInvoke/issues/63,
/// https://github.com/GPUOpen-LibrariesAndSDKs/RadeonRays_SDK/issues/96
template <typename Scalar>
class QueryThreads : public testing::Test {
 protected:
  static constexpr std::size_t thread_count = 8;

  QueryThreads() {
    Random random(71);
    GeneratedMesh<Scalar> mesh = scattered_triangles<Scalar>(300, Scalar{0.5}, random);
    for (std::size_t i = case_count(500); i > 0; --i) {
      // Half of the segments lie in planes of triangles of the mesh, where the exact stage is at work.
      const auto [segment, triangle] = draw_pair<Scalar>(PairFamily::small_integers, random);
      if (random.one_in(2)) mesh.add(triangle);
      segments.push_back(segment);
    }
    collider = Collider<Scalar>(mesh.view());
  }

  /// Calls work(id) in each thread, and returns when all have ended.
  template <typename Work>
  static void run_threads(const Work& work) {
    std::vector<std::thread> threads;
    for (std::size_t id = 0; id < thread_count; ++id) threads.emplace_back(work, id);
    for (std::thread& thread : threads) thread.join();
  }

  /// Where a thread begins, so that they do not ask the same at the same time.
  [[nodiscard]] std::size_t first_of(std::size_t id) const { return id * segments.size() / thread_count; }

  std::vector<Segment<Scalar>> segments;
  Collider<Scalar> collider;
};
TYPED_TEST_SUITE(QueryThreads, Scalars, ScalarNames);

TYPED_TEST(QueryThreads, many_on_one_collider_get_the_same_answers) {
  QueryStatistics statistics;
  std::vector<Answers<TypeParam>> expected;
  for (const auto& segment : this->segments) expected.emplace_back(this->collider, segment, statistics);

  std::vector<std::size_t> differences(this->thread_count, 0);
  std::vector<QueryStatistics> counted(this->thread_count);
  this->run_threads([&](std::size_t id) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::size_t at = (i + this->first_of(id)) % expected.size();
      const Answers<TypeParam> answers(this->collider, this->segments[at], counted[id]);
      if (!answers.same_as(expected[at])) ++differences[id];
    }
  });
  for (std::size_t id = 0; id < this->thread_count; ++id) {
    EXPECT_EQ(differences[id], 0u);
    expect_same(counted[id], statistics);
  }
}

TYPED_TEST(QueryThreads, many_with_batches_on_one_collider_get_the_same_answers) {
  using Hits = std::vector<Hit<TypeParam>>;
  Hits expected_hits;
  std::vector<std::uint8_t> expected_blocked;
  for (const auto& segment : this->segments) {
    expected_hits.push_back(this->collider.first_hit(segment).value_or(Hit<TypeParam>{}));
    expected_blocked.push_back(this->collider.any_hit(segment) ? 1 : 0);
  }

  std::vector<Hits> hits(this->thread_count, Hits(expected_hits.size()));
  std::vector<std::vector<std::uint8_t>> blocked(this->thread_count,
                                                 std::vector<std::uint8_t>(expected_blocked.size()));
  this->run_threads([&](std::size_t id) {
    const std::span<const Segment<TypeParam>> segments(this->segments);
    const std::size_t middle = this->first_of(id);
    // The later part first, so that every thread's batches are others.
    for (const auto& [begin, count] :
         {std::pair{middle, segments.size() - middle}, std::pair{std::size_t{0}, middle}}) {
      this->collider.first_hits(segments.subspan(begin, count), std::span(hits[id]).subspan(begin, count));
      this->collider.any_hits(segments.subspan(begin, count), std::span(blocked[id]).subspan(begin, count));
    }
  });
  for (std::size_t id = 0; id < this->thread_count; ++id) {
    expect_same<TypeParam>(hits[id], expected_hits);
    EXPECT_EQ(blocked[id], expected_blocked);
  }
}

}  // namespace
}  // namespace surehit::test::query_threads_test
