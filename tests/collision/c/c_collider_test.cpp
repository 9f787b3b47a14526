#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "c_functions.hpp"
#include "c_values.hpp"
#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/small_meshes.hpp"
#include "support/threads.hpp"
#include "surehit/collider.hpp"
#include "surehit/hit.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::c_collider_test {
namespace {

/// Runs tasks on three threads. It shows that an executor of C gets its user pointer.
void run_on_threads(void* user, std::size_t count, surehit_task task, void* work) {
  ++*static_cast<std::size_t*>(user);
  const auto executor = Executor(Threads(3));
  executor.run(count, [&](std::size_t i) { task(work, i); });
}

/// The same collider in C and in C++, which are asked the same.
template <typename Scalar>
class CCollider : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;

  void build(const SmallMesh<Scalar>& mesh, const std::vector<std::uint32_t>& masks) {
    static_assert(sizeof(Vector3<Scalar>) == 3 * sizeof(Scalar));
    const Scalar* const vertices = mesh.vertices.empty() ? nullptr : mesh.vertices[0].data();
    const typename C::Mesh given = {vertices, mesh.vertices.size(), 0, mesh.triangles.data(), mesh.triangles.size(), 0,
                                    4};
    surehit_build_options options = {};
    options.size = sizeof options;
    options.masks = masks.empty() ? nullptr : masks.data();
    options.mask_count = masks.size();
    typename C::ColliderHandle* handle = nullptr;
    ASSERT_EQ(C::create(&given, &options, &handle), SUREHIT_OK) << surehit_last_error();
    c.reset(handle);
    cpp = Collider<Scalar>(mesh.view(), {.masks = masks});
  }

  /// A filter that gets what decides from its user pointer.
  static std::int32_t accept(void* user, std::size_t path, const typename C::Hit* hit) {
    return (hit->triangle + path) % *static_cast<const std::uint32_t*>(user) != 0 ? SUREHIT_ACCEPT : SUREHIT_REJECT;
  }

  void expect_same(const Path<Scalar>& path, const QueryOptions<Scalar>& options, std::uint32_t* modulus) {
    const auto filter = [&](const Hit<Scalar>& hit) { return modulus == nullptr || hit.triangle % *modulus != 0; };
    const auto given_path = in_c(path);
    const auto given_options = in_c(options);
    const typename C::Filter given_filter = {accept, modulus};
    const auto* const c_filter = modulus != nullptr ? &given_filter : nullptr;

    QueryStatistics work;
    surehit_statistics c_work = {};
    c_work.size = sizeof c_work;
    typename C::Hit c_hit;
    ASSERT_EQ(C::first_hit(c.get(), &given_path, &given_options, c_filter, &c_work, &c_hit), SUREHIT_OK);
    const Hit<Scalar> hit = cpp.first_hit(path, filter, options, &work).value_or(Hit<Scalar>{});
    EXPECT_TRUE(same_bits(in_cpp(c_hit), hit)) << hex_text(path);
    if (modulus != nullptr) expect_same_work(c_work, work);

    std::uint8_t blocked = 2;
    ASSERT_EQ(C::any_hit(c.get(), &given_path, &given_options, c_filter, nullptr, &blocked), SUREHIT_OK);
    EXPECT_EQ(blocked, hit.triangle != no_triangle ? 1 : 0);

    std::vector<Hit<Scalar>> hits;
    cpp.all_hits(path, hits, filter, options);
    std::array<typename C::Hit, 70> c_hits;
    std::size_t count = 0;
    ASSERT_EQ(
        C::all_hits(c.get(), &given_path, &given_options, c_filter, nullptr, c_hits.data(), c_hits.size(), &count),
        SUREHIT_OK);
    ASSERT_EQ(count, hits.size());
    for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(same_bits(in_cpp(c_hits[i]), hits[i])) << hex_text(path);
    if (hit.triangle == no_triangle) return;

    Scalar max_t = 0;
    ASSERT_EQ(C::max_t_keeping(c.get(), &given_path, &c_hit, &max_t), SUREHIT_OK);
    EXPECT_TRUE(same_bits(max_t, cpp.max_t_keeping(path, hit)));
    if (path.kind != PathKind::segment) return;
    typename C::Vector point;
    ASSERT_EQ(C::last_free_point(c.get(), &given_path, &c_hit, &given_options, c_filter, &point), SUREHIT_OK);
    const Vector3<Scalar> free = cpp.last_free_point({path.start, path.toward}, hit, filter, options);
    for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_TRUE(same_bits(in_cpp(point)[axis], free[axis]));
  }

  static void expect_same_work(const surehit_statistics& c_work, const QueryStatistics& work) {
    EXPECT_EQ(c_work.paths, work.paths);
    EXPECT_EQ(c_work.cells, work.cells);
    EXPECT_EQ(c_work.candidates, work.candidates);
    EXPECT_EQ(c_work.undecided, work.undecided);
    EXPECT_EQ(c_work.exact_decisions, work.exact_decisions);
    EXPECT_EQ(c_work.exact_orders, work.exact_orders);
    EXPECT_EQ(c_work.exact_roundings, work.exact_roundings);
    EXPECT_EQ(c_work.instances, work.instances);
    EXPECT_EQ(c_work.unclipped, work.unclipped);
  }

  struct Destroy {
    void operator()(typename C::ColliderHandle* handle) const { EXPECT_EQ(C::destroy(handle), SUREHIT_OK); }
  };
  std::unique_ptr<typename C::ColliderHandle, Destroy> c;
  Collider<Scalar> cpp;
};
TYPED_TEST_SUITE(CCollider, Scalars, ScalarNames);

TYPED_TEST(CCollider, single_queries_have_the_bits_of_cpp) {
  Random random(20261126);
  std::size_t hits = 0;
  for (std::size_t i = case_count(40 * small_mesh_kind_count); i > 0; --i) {
    const auto mesh = draw_small_mesh<TypeParam>(i % small_mesh_kind_count, random);
    std::vector<std::uint32_t> masks;
    while (i % 2 == 0 && masks.size() < mesh.triangles.size())
      masks.push_back(static_cast<std::uint32_t>(random.below(4)));
    ASSERT_NO_FATAL_FAILURE(this->build(mesh, masks));
    for (std::size_t j = 0; j < std::min<std::size_t>(mesh.paths.size(), 6); ++j) {
      const auto& path = mesh.paths[j];
      const auto hit = this->cpp.first_hit(path);
      hits += hit ? 1 : 0;
      QueryOptions<TypeParam> options = draw_options(random, hit ? hit->t : TypeParam{0.5});
      options.mask = static_cast<std::uint32_t>(random.below(4));
      if (hit && random.one_in(2)) options.ignored_triangle = hit->triangle;
      std::uint32_t modulus = 2;
      ASSERT_NO_FATAL_FAILURE(this->expect_same(path, {}, nullptr));
      ASSERT_NO_FATAL_FAILURE(this->expect_same(path, options, j % 2 == 0 ? nullptr : &modulus));
    }
  }
  EXPECT_GT(hits, 0U);
}

TYPED_TEST(CCollider, batches_have_the_bits_of_single_queries) {
  using Scalar = TypeParam;
  using C = CFunctions<Scalar>;
  Random random(5);
  for (std::size_t kind = 0; kind < small_mesh_kind_count; kind += 4) {
    const auto mesh = draw_small_mesh<Scalar>(kind, random);
    ASSERT_NO_FATAL_FAILURE(this->build(mesh, {}));
    // More than one task of an executor. Starts and ends lie in structs of their own.
    constexpr std::size_t count = 5000;
    struct Agent {
      Scalar health;
      typename C::Vector start;
      typename C::Vector toward;
    };
    std::vector<Agent> agents;
    std::vector<Scalar> packed;
    std::vector<typename C::Options> own;
    const PathKind path_kind = mesh.paths[0].kind;
    while (agents.size() < count) {
      const auto& path = mesh.paths[random.below(mesh.paths.size())];
      agents.push_back({0, in_c(path.start), in_c(path.toward)});
      packed.insert(packed.end(),
                    {path.start[0], path.start[1], path.start[2], path.toward[0], path.toward[1], path.toward[2]});
      own.push_back(in_c(draw_options(random, Scalar{0.5})));
    }
    const auto c_kind = static_cast<std::uint32_t>(path_kind);
    const typename C::Paths strided = {&agents[0].start.x, &agents[0].toward.x, count,
                                       sizeof(Agent),      sizeof(Agent),       c_kind};
    const typename C::Paths side_by_side = {packed.data(), nullptr, count, 0, 0, c_kind};
    std::uint32_t modulus = 3;
    std::size_t runs = 0;
    const typename C::Filter filter = {this->accept, &modulus};
    const surehit_executor executor = {run_on_threads, &runs};
    surehit_statistics work = {};
    work.size = sizeof work;
    typename C::BatchOptions options = {sizeof options, nullptr, own.data(), &filter, &executor, &work};

    std::vector<typename C::Hit> hits(count);
    std::vector<typename C::Hit> packed_hits(count);
    std::vector<std::uint8_t> blocked(count, 2);
    ASSERT_EQ(C::first_hits(this->c.get(), &strided, &options, hits.data()), SUREHIT_OK) << surehit_last_error();
    ASSERT_EQ(C::any_hits(this->c.get(), &side_by_side, &options, blocked.data()), SUREHIT_OK);
    EXPECT_EQ(runs, 2U);
    EXPECT_EQ(work.paths, 2 * count);
    options = {sizeof options, &own[0], nullptr, nullptr, nullptr, nullptr};
    ASSERT_EQ(C::first_hits(this->c.get(), &side_by_side, &options, packed_hits.data()), SUREHIT_OK);
    for (std::size_t i = 0; i < count; ++i) {
      const typename C::Path path = {agents[i].start, agents[i].toward, c_kind};
      // A single query is path 0 for its filter, so the filter is asked for what it says about path i.
      std::array<typename C::Hit, 70> all;
      std::size_t found = 0;
      ASSERT_EQ(C::all_hits(this->c.get(), &path, &own[i], nullptr, nullptr, all.data(), all.size(), &found),
                SUREHIT_OK);
      Hit<Scalar> expected;
      for (std::size_t j = found; j-- > 0;) {
        if (this->accept(&modulus, i, &all[j]) == SUREHIT_ACCEPT) expected = in_cpp(all[j]);
      }
      ASSERT_TRUE(same_bits(in_cpp(hits[i]), expected)) << name_of_small_mesh(kind) << ", path " << i;
      ASSERT_EQ(blocked[i], expected.triangle != no_triangle ? 1 : 0);
      typename C::Hit single;
      ASSERT_EQ(C::first_hit(this->c.get(), &path, &own[0], nullptr, nullptr, &single), SUREHIT_OK);
      ASSERT_TRUE(same_bits(in_cpp(packed_hits[i]), in_cpp(single))) << name_of_small_mesh(kind) << ", path " << i;
    }
  }
}

TYPED_TEST(CCollider, tells_what_cpp_tells) {
  using C = CFunctions<TypeParam>;
  Random random(11);
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    const auto mesh = draw_small_mesh<TypeParam>(kind, random);
    ASSERT_NO_FATAL_FAILURE(this->build(mesh, {}));
    std::size_t number = 0;
    ASSERT_EQ(C::triangle_count(this->c.get(), &number), SUREHIT_OK);
    ASSERT_EQ(number, this->cpp.triangle_count());
    for (std::uint32_t id = 0; id < number; ++id) {
      typename C::Triangle corners;
      typename C::Vector normal;
      typename C::Vector normal_of_corners;
      ASSERT_EQ(C::triangle(this->c.get(), id, &corners), SUREHIT_OK);
      ASSERT_EQ(C::normal(this->c.get(), id, &normal), SUREHIT_OK);
      ASSERT_EQ(C::normal_of_triangle(&corners, &normal_of_corners), SUREHIT_OK);
      EXPECT_EQ(in_cpp(corners.b), this->cpp.triangle(id).b);
      EXPECT_EQ(in_cpp(normal), this->cpp.normal(id));
      EXPECT_EQ(in_cpp(normal_of_corners), this->cpp.normal(id));
    }
    typename C::Box box;
    ASSERT_EQ(C::box(this->c.get(), &box), SUREHIT_OK);
    EXPECT_EQ(in_cpp(box.low), this->cpp.box().low);
    EXPECT_EQ(in_cpp(box.high), this->cpp.box().high);
    surehit_grid_summary grid = {};
    grid.size = sizeof grid;
    ASSERT_EQ(C::grid_summary(this->c.get(), &grid), SUREHIT_OK);
    const GridSummary expected = this->cpp.grid_summary();
    EXPECT_EQ(grid.cells, expected.cells);
    EXPECT_EQ(grid.entries, expected.entries);
    EXPECT_EQ(grid.memory_bytes, expected.memory_bytes);
    EXPECT_EQ((std::array{grid.resolution_x, grid.resolution_y, grid.resolution_z}), expected.resolution);
    EXPECT_EQ(grid.levels, expected.levels);
    ASSERT_EQ(C::memory_bytes(this->c.get(), &number), SUREHIT_OK);
    EXPECT_EQ(number, this->cpp.memory_bytes());
  }
}

TYPED_TEST(CCollider, pairs_have_the_bits_of_cpp) {
  using C = CFunctions<TypeParam>;
  Random random(12);
  for (std::size_t i = case_count(2000); i > 0; --i) {
    const auto mesh = draw_small_mesh<TypeParam>(i % small_mesh_kind_count, random);
    const Path<TypeParam>& path = mesh.paths[0];
    const Triangle<TypeParam> triangle = mesh.view().triangle(0);
    const auto expected = intersect(path, triangle).value_or(Hit<TypeParam>{});
    const auto c_path = in_c(path);
    const auto c_triangle = in_c(triangle);
    typename C::Hit hit;
    ASSERT_EQ(C::intersect(&c_triangle, &c_path, nullptr, &hit), SUREHIT_OK);
    EXPECT_TRUE(same_bits(in_cpp(hit), expected));
    typename C::Vector point;
    TypeParam distance = 0;
    TypeParam max_t = 0;
    ASSERT_EQ(C::point(&c_path, &hit, &point), SUREHIT_OK);
    ASSERT_EQ(C::distance(&c_path, &hit, &distance), SUREHIT_OK);
    ASSERT_EQ(C::max_t_keeping_of_triangle(&c_triangle, &c_path, &hit, &max_t), SUREHIT_OK);
    EXPECT_EQ(in_cpp(point), surehit::point(path, expected));
    EXPECT_TRUE(same_bits(distance, surehit::distance(path, expected)));
    EXPECT_TRUE(same_bits(max_t, max_t_keeping(path, triangle, expected)));
  }
}

TYPED_TEST(CCollider, grid_options_are_those_of_cpp) {
  using C = CFunctions<TypeParam>;
  Random random(13);
  const auto mesh = draw_small_mesh<TypeParam>(1, random);
  ASSERT_NO_FATAL_FAILURE(this->build(mesh, {}));
  const typename C::Mesh given = {
      mesh.vertices[0].data(), mesh.vertices.size(), 0, mesh.triangles.data(), mesh.triangles.size(), 0, 4};
  const auto expect_same_grid = [&](const surehit_build_options& options, const GridOptions& grid) {
    ASSERT_EQ(C::rebuild(this->c.get(), &given, &options), SUREHIT_OK);
    this->cpp.rebuild(mesh.view(), {.grid = grid});
    surehit_grid_summary summary = {};
    summary.size = sizeof summary;
    ASSERT_EQ(C::grid_summary(this->c.get(), &summary), SUREHIT_OK);
    EXPECT_EQ(summary.cells, this->cpp.grid_summary().cells);
    EXPECT_EQ(summary.entries, this->cpp.grid_summary().entries);
    EXPECT_EQ(summary.levels, this->cpp.grid_summary().levels);
  };
  surehit_build_options options = {};
  options.size = sizeof options;
  expect_same_grid(options, {});
  options.cells_per_triangle = 20;
  expect_same_grid(options, {.cells_per_triangle = 20});
  options.resolution_x = 2;
  options.resolution_y = 3;
  options.resolution_z = 4;
  expect_same_grid(options, {.resolution = {2, 3, 4}});
  options.crowded = 1;
  expect_same_grid(options, {.resolution = {2, 3, 4}, .crowded = 1});
  options.crowded = UINT32_MAX;
  expect_same_grid(options, {.resolution = {2, 3, 4}, .crowded = 0});
}

}  // namespace
}  // namespace surehit::test::c_collider_test
