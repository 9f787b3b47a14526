#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <thread>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "unit_triangles.hpp"

namespace surehit::test {
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

template <typename Scalar>
class QueryThreads : public testing::Test {};
TYPED_TEST_SUITE(QueryThreads, Scalars, ScalarNames);

TYPED_TEST(QueryThreads, many_on_one_collider_get_the_same_answers) {
  Random random(71);
  GeneratedMesh<TypeParam> mesh = scattered_triangles<TypeParam>(300, TypeParam{0.5}, random);
  std::vector<Segment<TypeParam>> segments;
  for (std::size_t i = case_count(500); i > 0; --i) {
    // Half of the segments lie in planes of triangles of the mesh, where the exact stage is at work.
    const auto [segment, triangle] = draw_pair<TypeParam>(PairFamily::small_integers, random);
    if (random.one_in(2)) mesh.add(triangle);
    segments.push_back(segment);
  }
  const Collider<TypeParam> collider(mesh.view());

  QueryStatistics statistics;
  std::vector<Answers<TypeParam>> expected;
  for (const auto& segment : segments) expected.emplace_back(collider, segment, statistics);

  constexpr std::size_t thread_count = 8;
  std::vector<std::size_t> differences(thread_count, 0);
  std::vector<QueryStatistics> counted(thread_count);
  std::vector<std::thread> threads;
  for (std::size_t id = 0; id < thread_count; ++id) {
    threads.emplace_back([&, id] {
      // Each begins elsewhere, so that they do not ask the same at the same time.
      for (std::size_t i = 0; i < segments.size(); ++i) {
        const std::size_t at = (i + id * segments.size() / thread_count) % segments.size();
        if (!Answers<TypeParam>(collider, segments[at], counted[id]).same_as(expected[at])) ++differences[id];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t id = 0; id < thread_count; ++id) {
    EXPECT_EQ(differences[id], 0u);
    EXPECT_EQ(counted[id].paths, statistics.paths);
    EXPECT_EQ(counted[id].candidates, statistics.candidates);
    EXPECT_EQ(counted[id].exact_decisions, statistics.exact_decisions);
  }
}

}  // namespace
}  // namespace surehit::test
