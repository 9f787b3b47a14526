#include "surehit/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <thread>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "executor_answers.hpp"
#include "support/case_count.hpp"
#include "support/floating_point_mode.hpp"
#include "support/scalars.hpp"

namespace surehit::test::executor_test {
namespace {

void forwards(std::size_t count, const Executor::Task& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

void backwards(std::size_t count, const Executor::Task& task) {
  for (std::size_t i = count; i-- > 0;) task(i);
}

/// As many threads for each batch, all in one floating-point mode, that take tasks as they come.
class NewThreads {
 public:
  explicit NewThreads(std::size_t count, const FloatingPointMode& mode = {"to_nearest"}) : count_(count), mode_(mode) {}

  void operator()(std::size_t task_count, const Executor::Task& task) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count_; ++i) {
      threads.emplace_back([&] {
        const FloatingPointModeScope scope(mode_);
        const std::uint64_t before = control_word();
        for (std::size_t index = next++; index < task_count; index = next++) task(index);
        if (control_word() != before) keeps_modes_ = false;
      });
    }
    for (std::thread& thread : threads) thread.join();
    tasks_ += task_count;
  }

  [[nodiscard]] bool keeps_modes() const { return keeps_modes_; }
  [[nodiscard]] std::size_t tasks() const { return tasks_; }

 private:
  std::size_t count_;
  FloatingPointMode mode_;
  std::atomic<bool> keeps_modes_ = true;
  std::size_t tasks_ = 0;
};

/// A temporary lives as long as the call that it is written in.
Executor by(NewThreads&& threads) { return Executor(threads); }

void expect_runs_each_once(Executor executor) {
  for (const std::size_t count : {0U, 1U, 2U, 100U}) {
    std::vector<std::atomic<int>> calls(count + 1);
    executor.run(count, [&](std::size_t index) { ++calls.at(index); });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(calls[i], 1) << i << " of " << count;
    EXPECT_EQ(calls[count], 0);
  }
}

TEST(Executor, of_lambdas_runs_each_index_once) {
  std::size_t runs = 0;
  const auto counting = [&runs](std::size_t count, const Executor::Task& task) {
    ++runs;
    backwards(count, task);
  };
  expect_runs_each_once(counting);
  EXPECT_EQ(runs, 4U);
  expect_runs_each_once([](std::size_t count, const auto& task) { forwards(count, task); });
  int calls_that_change_it = 0;
  expect_runs_each_once([calls_that_change_it](std::size_t count, const Executor::Task& task) mutable {
    ++calls_that_change_it;
    forwards(count, task);
  });
}

TEST(Executor, of_objects_runs_each_index_once) {
  NewThreads threads(3);
  expect_runs_each_once(threads);
  EXPECT_EQ(threads.tasks(), 103U);
  expect_runs_each_once(by(NewThreads(2)));
  const std::function<void(std::size_t, const Executor::Task&)> function = backwards;
  expect_runs_each_once(function);
}

TEST(Executor, of_function_pointers_runs_each_index_once) {
  void (*const pointer)(std::size_t, const Executor::Task&) = forwards;
  expect_runs_each_once(pointer);
  expect_runs_each_once(&backwards);
}

TEST(Executor, copies_refer_to_the_same_callable) {
  std::size_t runs = 0;
  const auto counting = [&runs](std::size_t, const Executor::Task&) { ++runs; };
  const Executor executor = counting;
  Executor copy = executor;
  copy.run(1, [](std::size_t) {});
  copy = Executor(executor);
  copy.run(1, [](std::size_t) {});
  EXPECT_EQ(runs, 2U);
}

TEST(Executor, is_of_nothing_but_what_takes_tasks) {
  EXPECT_TRUE((std::is_convertible_v<NewThreads&, Executor>));
  EXPECT_FALSE((std::is_convertible_v<int, Executor>));
  EXPECT_FALSE((std::is_convertible_v<void (*)(std::size_t), Executor>));
  EXPECT_FALSE((std::is_default_constructible_v<Executor>));
  // It would refer to what is gone.
  EXPECT_FALSE((std::is_convertible_v<NewThreads, Executor>));
  EXPECT_TRUE((std::is_nothrow_constructible_v<Executor, NewThreads&>));
  EXPECT_TRUE((std::is_trivially_copyable_v<Executor>));
}

template <typename Scalar>
class BatchOnExecutor : public testing::Test {
 protected:
  static constexpr std::size_t max_paths = 13'000;

  static const ManyPaths<Scalar>& many() {
    static const ManyPaths<Scalar> paths = ManyPaths<Scalar>::scattered(max_paths);
    return paths;
  }
};
TYPED_TEST_SUITE(BatchOnExecutor, Scalars, ScalarNames);

TYPED_TEST(BatchOnExecutor, of_any_size_answers_as_without) {
  for (const std::size_t count : {0U, 1U, 4095U, 4096U, 4097U, 9000U}) {
    SCOPED_TRACE(count);
    AnswersWithoutExecutor(this->many(), count).expect_same_with(by(NewThreads(3)));
  }
}

TYPED_TEST(BatchOnExecutor, in_any_order_answers_as_without) {
  const AnswersWithoutExecutor expected(this->many(), 9000);
  expected.expect_same_with(&forwards);
  expected.expect_same_with(&backwards);
}

TYPED_TEST(BatchOnExecutor, of_any_threads_answers_as_without) {
  const AnswersWithoutExecutor expected(this->many(), this->max_paths);
  for (const std::size_t count : {1U, 2U, 4U}) expected.expect_same_with(by(NewThreads(count)));
}

TYPED_TEST(BatchOnExecutor, with_options_answers_as_without) {
  for (const auto& options :
       {QueryOptions<TypeParam>{.min_t = TypeParam{0.25}, .max_t = TypeParam{0.75}, .culling = Culling::back},
        QueryOptions<TypeParam>{.ignored_triangle = 7, .ignore_start_contact = true, .ignore_end_contact = true},
        QueryOptions<TypeParam>{.mask = 0}}) {
    AnswersWithoutExecutor(this->many(), 9000, options).expect_same_with(by(NewThreads(2)));
  }
}

TYPED_TEST(BatchOnExecutor, gives_threads_something_to_share) {
  std::size_t tasks = 0;
  const auto counting = [&](std::size_t count, const Executor::Task& task) {
    tasks = count;
    forwards(count, task);
  };
  const auto& many = this->many();
  std::vector<std::uint8_t> blocked(many.segments.size());
  const std::span<const Segment<TypeParam>> segments(many.segments);
  many.collider.any_hits(segments, blocked, {.executor = counting});
  EXPECT_GE(tasks, 4U);
  EXPECT_LE(tasks, 20U);
  tasks = 0;
  many.collider.any_hits(segments.first(1000), blocked, {.executor = counting});
  EXPECT_EQ(tasks, 0U) << "too few paths to share";
}

TYPED_TEST(BatchOnExecutor, of_unequal_lengths_leaves_alone_what_is_beyond_the_shorter) {
  const Hit<TypeParam> untouched{1, 1, 1, 7777, Side::front};
  const auto& many = this->many();
  const std::span<const Line<TypeParam>> lines(many.lines);
  for (const std::size_t count : {4000U, 4096U, 5000U}) {
    std::vector<Hit<TypeParam>> hits(9000, untouched);
    std::vector<std::uint8_t> blocked(9000, 77);
    QueryStatistics statistics;
    many.collider.first_hits(lines.first(count), hits, {.executor = &backwards, .statistics = &statistics});
    many.collider.any_hits(lines.first(count), blocked, {.executor = &backwards, .statistics = &statistics});
    EXPECT_EQ(statistics.paths, 2 * count);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(hits[i] == untouched, i >= count) << i;
      ASSERT_EQ(blocked[i] == 77, i >= count) << i;
    }
    std::fill(hits.begin(), hits.end(), untouched);
    std::fill(blocked.begin(), blocked.end(), std::uint8_t{77});
    many.collider.first_hits(lines, std::span(hits).first(count), {.executor = &backwards});
    many.collider.any_hits(lines, std::span(blocked).first(count), {.executor = &backwards});
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(hits[i] == untouched, i >= count) << i;
      ASSERT_EQ(blocked[i] == 77, i >= count) << i;
    }
  }
}

TYPED_TEST(BatchOnExecutor, adds_to_the_statistics_that_it_is_given) {
  const auto& many = this->many();
  const std::span<const Ray<TypeParam>> rays(many.rays);
  const BatchAnswers<TypeParam> expected(many.collider, rays, QueryOptions<TypeParam>{});
  QueryStatistics statistics = expected.of_first;
  std::vector<Hit<TypeParam>> hits(rays.size());
  many.collider.first_hits(rays, hits, {.executor = by(NewThreads(4)), .statistics = &statistics});
  QueryStatistics twice = expected.of_first;
  twice += expected.of_first;
  EXPECT_GT(twice.candidates, 0U);
  expect_same(statistics, twice);
}

TYPED_TEST(BatchOnExecutor, needs_no_statistics) {
  const auto& many = this->many();
  const std::span<const Segment<TypeParam>> segments(many.segments);
  const BatchAnswers<TypeParam> expected(many.collider, segments, QueryOptions<TypeParam>{});
  std::vector<Hit<TypeParam>> hits(segments.size());
  std::vector<std::uint8_t> blocked(segments.size());
  many.collider.first_hits(segments, hits, {.executor = by(NewThreads(2))});
  many.collider.any_hits(segments, blocked, {.executor = by(NewThreads(2))});
  expect_same<TypeParam>(hits, expected.hits);
  EXPECT_EQ(blocked, expected.blocked);
}

TYPED_TEST(BatchOnExecutor, answers_the_same_in_any_floating_point_mode_of_its_threads) {
  Random random(89);
  const auto mesh = scattered_triangles<TypeParam>(40, TypeParam{0.5}, random);
  const TypeParam tiny = 1000 * std::numeric_limits<TypeParam>::denorm_min();
  for (const TypeParam factor : {TypeParam{1}, tiny}) {
    const ManyPaths<TypeParam> many(placed<TypeParam>(mesh, factor, {0, 0, 0}), 4500);
    const std::span<const Segment<TypeParam>> segments(many.segments);
    const QueryOptions<TypeParam> options;
    const BatchAnswers<TypeParam> expected(many.collider, segments, options);
    for (const FloatingPointMode& mode :
         {FloatingPointMode{"flush", FE_TONEAREST, true}, FloatingPointMode{"upward", FE_UPWARD, false},
          FloatingPointMode{"downward_and_flush", FE_DOWNWARD, true}}) {
      SCOPED_TRACE(mode.name);
      NewThreads threads(2, mode);
      BatchAnswers<TypeParam>(many.collider, segments, threads, options).expect_same_as(expected);
      EXPECT_TRUE(threads.keeps_modes());
    }
  }
}

TYPED_TEST(BatchOnExecutor, never_throws) {
  const Collider<TypeParam>& collider = this->many().collider;
  static_assert(noexcept(collider.first_hits(std::declval<std::span<const Segment<TypeParam>>>(),
                                             std::declval<std::span<Hit<TypeParam>>>(),
                                             std::declval<BatchOptions<TypeParam>>())));
  static_assert(
      noexcept(collider.any_hits(std::declval<std::span<const Line<TypeParam>>>(),
                                 std::declval<std::span<std::uint8_t>>(), std::declval<BatchOptions<TypeParam>>())));
  SUCCEED();
}

template <typename Scalar>
const Grid& grid_of(const Collider<Scalar>& collider) {
  return detail::ColliderState<Scalar>::of(collider).grid;
}

/// Colliders of meshes in more than one part.
template <typename Scalar>
class BuildOnExecutor : public testing::Test {
 protected:
  static void expect_same_bits(const Collider<Scalar>& built, const Collider<Scalar>& expected,
                               const GeneratedMesh<Scalar>& mesh) {
    const auto bits = [](std::span<const CellWord> words) {
      std::vector<std::uint32_t> all;
      for (const CellWord word : words) all.push_back(word.bits());
      return all;
    };
    const Grid& grid = grid_of(built);
    const Grid& expected_grid = grid_of(expected);
    EXPECT_EQ(bits(grid.top()), bits(expected_grid.top()));
    EXPECT_EQ(bits(grid.bricks()), bits(expected_grid.bricks()));
    EXPECT_TRUE(std::ranges::equal(grid.entries(), expected_grid.entries()));
    const auto is_same = [](const CellList& a, const CellList& b) {
      return a.box.bits() == b.box.bits() && a.first_entry == b.first_entry;
    };
    EXPECT_TRUE(std::ranges::equal(grid.lists(), expected_grid.lists(), is_same));
    if (mesh.triangles.empty()) return;  // nothing to aim at
    std::vector<Path<Scalar>> paths;
    PathDrawer<Scalar> drawer(mesh.view(), 97);
    for (std::size_t i = case_count(100); i > 0; --i) paths.push_back(drawer.draw());
    expect_same_answers(built, expected, paths);
  }

  static void expect_same_with(Executor executor, const GeneratedMesh<Scalar>& mesh, const BuildOptions& options = {}) {
    Collider<Scalar> expected(mesh.view(), options);
    BuildOptions on_threads = options;
    on_threads.executor = executor;
    Collider<Scalar> built(mesh.view(), on_threads);
    expect_same_bits(built, expected, mesh);
    GeneratedMesh<Scalar> moved = mesh;
    for (auto& vertex : moved.vertices) vertex[0] += vertex[1] * vertex[2];
    const std::span<const Vector3<Scalar>> vertices(moved.vertices);
    expected.rebuild(vertices);
    for (int i = 0; i < 2; ++i) {
      built.rebuild(vertices, executor);
      expect_same_bits(built, expected, moved);
    }
  }

  Random random_{20240229};
};
TYPED_TEST_SUITE(BuildOnExecutor, Scalars, ScalarNames);

TYPED_TEST(BuildOnExecutor, is_the_same_to_the_bit) {
  for (const std::size_t count : {0U, 1U, 8192U, 8193U, 50'000U}) {
    SCOPED_TRACE(count);
    const auto mesh = scattered_triangles<TypeParam>(count, TypeParam{0.05F}, this->random_);
    this->expect_same_with(&forwards, mesh);
    this->expect_same_with(&backwards, mesh);
    this->expect_same_with(by(NewThreads(3)), mesh);
  }
}

TYPED_TEST(BuildOnExecutor, is_the_same_where_cells_are_divided) {
  const auto mesh = scattered_triangles<TypeParam>(30'000, TypeParam{0.02F}, this->random_);
  this->expect_same_with(by(NewThreads(2)), mesh, {GridOptions{.resolution = {9, 5, 7}, .crowded = 20}, {}});
}

TYPED_TEST(BuildOnExecutor, is_the_same_of_a_smooth_mesh) {
  const auto mesh = smooth_bowl<TypeParam>(100);
  const BuildOptions options{GridOptions{.resolution = {70, 70, 70}}, {}};
  ASSERT_GT(grid_of(Collider<TypeParam>(mesh.view(), options)).lists().size(), 1U << 13);
  this->expect_same_with(&forwards, mesh, options);
  this->expect_same_with(by(NewThreads(3)), mesh, options);
}

/// Those of the first part take more room than a part has, though not more than the mesh may take.
TYPED_TEST(BuildOnExecutor, is_the_same_where_a_part_has_no_room) {
  auto mesh = scattered_triangles<TypeParam>(8192, TypeParam{0.4F}, this->random_);
  const auto small = scattered_triangles<TypeParam>(60'000, TypeParam{0.001F}, this->random_);
  for (std::size_t i = 0; i < small.triangles.size(); ++i) mesh.add(small.view().triangle(i));
  const Collider<TypeParam> collider(mesh.view());
  std::size_t of_first_part = 0;
  for (const std::uint32_t id : grid_of(collider).entries()) of_first_part += id < 8192 ? 1 : 0;
  ASSERT_GT(of_first_part, 8U * 8192U);
  this->expect_same_with(by(NewThreads(2)), mesh);
}

TYPED_TEST(BuildOnExecutor, is_the_same_in_any_floating_point_mode_of_its_threads) {
  const auto mesh = scattered_triangles<TypeParam>(20'000, TypeParam{0.05F}, this->random_);
  const TypeParam tiny = 1'000'000 * std::numeric_limits<TypeParam>::denorm_min();
  for (const TypeParam factor : {TypeParam{1}, tiny}) {
    const auto scaled = placed<TypeParam>(mesh, factor, {0, 0, 0});
    for (const FloatingPointMode& mode :
         {FloatingPointMode{"upward", FE_UPWARD, false}, FloatingPointMode{"downward_and_flush", FE_DOWNWARD, true}}) {
      SCOPED_TRACE(mode.name);
      NewThreads threads(2, mode);
      this->expect_same_with(threads, scaled);
      EXPECT_TRUE(threads.keeps_modes());
      EXPECT_GT(threads.tasks(), 10U);
    }
  }
}

TYPED_TEST(BuildOnExecutor, says_what_is_wrong_with_a_mesh) {
  auto mesh = scattered_triangles<TypeParam>(20'000, TypeParam{0.05F}, this->random_);
  Collider<TypeParam> collider(mesh.view());
  mesh.vertices.back()[0] = std::numeric_limits<TypeParam>::infinity();
  EXPECT_FALSE(collider.try_rebuild(mesh.vertices, by(NewThreads(2))));
  EXPECT_FALSE(collider.try_build(mesh.view(), {.executor = by(NewThreads(2))}));
  EXPECT_THROW(Collider<TypeParam>(mesh.view(), {.executor = by(NewThreads(2))}), InvalidMesh);
}

}  // namespace
}  // namespace surehit::test::executor_test
