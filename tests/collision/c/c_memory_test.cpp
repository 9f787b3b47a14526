#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../allocations.hpp"
#include "c_functions.hpp"
#include "support/scalars.hpp"

namespace surehit::test::c_memory_test {
namespace {

void run_in_turn(void* /*user*/, std::size_t count, surehit_task task, void* work) {
  for (std::size_t i = 0; i < count; ++i) task(work, i);
}

/// A square of two triangles.
template <typename Scalar>
class CMemory : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;

  [[nodiscard]] surehit_status create(typename C::ColliderHandle** handle) const {
    return C::create(&mesh, nullptr, handle);
  }
  void expect_hit(const typename C::ColliderHandle* collider) const {
    typename C::Hit hit = {};
    EXPECT_EQ(C::first_hit(collider, &path, nullptr, nullptr, nullptr, &hit), SUREHIT_OK);
    EXPECT_EQ(hit.triangle, 0U);
  }

  /// Calls `attempt()` with memory for 0, 1, 2 allocations, and so on, until it succeeds. Returns how often it failed.
  template <typename Attempt>
  static std::size_t failures_of(const Attempt& attempt) {
    for (std::size_t failures = 0;; ++failures) {
      surehit_status status = SUREHIT_OK;
      {
        const ScarceMemory memory(failures);
        status = attempt();
      }
      if (status == SUREHIT_OK) return failures;
      EXPECT_EQ(status, SUREHIT_OUT_OF_MEMORY) << surehit_last_error();
      if (status != SUREHIT_OUT_OF_MEMORY) return failures;
    }
  }

  std::array<Scalar, 12> vertices = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
  std::array<std::uint32_t, 6> triangles = {0, 1, 2, 0, 2, 3};
  typename C::Mesh mesh = {vertices.data(), 4, 0, triangles.data(), 2, 0, 4};
  typename C::Path path = {{3, 1, 1}, {3, 1, -1}, SUREHIT_SEGMENT};
};
TYPED_TEST_SUITE(CMemory, Scalars, ScalarNames);

TYPED_TEST(CMemory, that_runs_out_while_a_collider_is_made_makes_none) {
  using C = CFunctions<TypeParam>;
  typename C::ColliderHandle* collider = nullptr;
  EXPECT_GE(this->failures_of([&] {
    collider = nullptr;
    const surehit_status status = this->create(&collider);
    EXPECT_EQ(collider == nullptr, status != SUREHIT_OK);
    return status;
  }),
            3U);
  this->expect_hit(collider);
  typename C::ColliderHandle* copy = nullptr;
  EXPECT_GE(this->failures_of([&] { return C::copy(collider, &copy); }), 3U);
  this->expect_hit(copy);
  EXPECT_EQ(C::destroy(copy), SUREHIT_OK);
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
}

TYPED_TEST(CMemory, that_runs_out_in_a_change_changes_nothing) {
  using C = CFunctions<TypeParam>;
  typename C::ColliderHandle* collider = nullptr;
  ASSERT_EQ(this->create(&collider), SUREHIT_OK);
  const auto expect_kept = [&](surehit_status status) {
    this->expect_hit(collider);
    return status;
  };
  EXPECT_GE(this->failures_of([&] { return expect_kept(C::build(collider, &this->mesh, nullptr)); }), 1U);
  EXPECT_GE(this->failures_of([&] { return expect_kept(C::rebuild(collider, &this->mesh, nullptr)); }), 1U);
  EXPECT_GE(this->failures_of([&] { return expect_kept(C::set_mask(collider, 1, 1)); }), 1U);
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
}

TYPED_TEST(CMemory, that_runs_out_in_a_scene_changes_nothing) {
  using C = CFunctions<TypeParam>;
  typename C::ColliderHandle* collider = nullptr;
  typename C::SceneHandle* scene = nullptr;
  ASSERT_EQ(this->create(&collider), SUREHIT_OK);
  EXPECT_GE(this->failures_of([&] { return C::create_scene(&scene); }), 1U);
  surehit_instance_id id = {};
  std::size_t count = 7;
  EXPECT_GE(this->failures_of([&] { return C::add(scene, collider, nullptr, 1, 0, &id); }), 1U);
  EXPECT_GE(this->failures_of([&] { return C::commit(scene, nullptr); }), 1U);
  EXPECT_GE(this->failures_of([&] { return C::instances(scene, nullptr, 0, &count); }), 1U);
  EXPECT_EQ(count, 1U);
  typename C::SceneHit hit = {};
  EXPECT_EQ(C::scene_first_hit(scene, &this->path, nullptr, nullptr, nullptr, &hit), SUREHIT_OK);
  EXPECT_EQ(hit.triangle, 0U);
  EXPECT_EQ(C::destroy_scene(scene), SUREHIT_OK);
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
}

TYPED_TEST(CMemory, is_needed_by_no_query_but_all_hits) {
  using C = CFunctions<TypeParam>;
  typename C::ColliderHandle* collider = nullptr;
  ASSERT_EQ(this->create(&collider), SUREHIT_OK);
  const std::size_t path_count = 10'000;
  std::vector<TypeParam> numbers;
  for (std::size_t i = 0; i < path_count; ++i) numbers.insert(numbers.end(), {3, 1, 1, 3, 1, -1});
  const typename C::Paths paths = {numbers.data(), nullptr, path_count, 0, 0, SUREHIT_SEGMENT};
  std::vector<typename C::Hit> hits(path_count);
  typename C::Hit hit = {};
  EXPECT_EQ(allocations_of([&] {
              (void)C::first_hit(collider, &this->path, nullptr, nullptr, nullptr, &hit);
              (void)C::first_hits(collider, &paths, nullptr, hits.data());
            }),
            0U);
  std::size_t count = 0;
  EXPECT_GE(this->failures_of(
                [&] { return C::all_hits(collider, &this->path, nullptr, nullptr, nullptr, nullptr, 0, &count); }),
            1U);
  EXPECT_EQ(count, 1U);

  // Without memory to note which tasks are done, the calling thread does them all.
  const surehit_executor executor = {run_in_turn, nullptr};
  const typename C::BatchOptions options = {sizeof options, nullptr, nullptr, nullptr, &executor, nullptr};
  EXPECT_EQ(this->failures_of([&] { return C::first_hits(collider, &paths, &options, hits.data()); }), 0U);
  EXPECT_EQ(hits[path_count - 1].triangle, 0U);
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
}

}  // namespace
}  // namespace surehit::test::c_memory_test
