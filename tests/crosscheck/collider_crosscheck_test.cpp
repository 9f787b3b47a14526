#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "collider_judge.hpp"
#include "collider_state.hpp"
#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::collider_crosscheck_test {
namespace {

/// Built at several resolutions, for none may change an answer.
template <typename Scalar>
std::vector<Collider<Scalar>> colliders_of(const SmallMesh<Scalar>& mesh, const std::vector<std::uint32_t>& masks) {
  std::vector<Collider<Scalar>> colliders;
  for (const std::array<std::uint32_t, 3> resolution : {std::array<std::uint32_t, 3>{0, 0, 0}, {1, 1, 1}, {13, 2, 7}}) {
    BuildOptions options;
    options.grid.resolution = resolution;
    options.masks = masks;
    colliders.emplace_back(mesh.view(), options);
  }
  return colliders;
}

template <typename Scalar>
QueryOptions<Scalar> draw_query(Random& random, const ExactMeshOracle<Scalar>& oracle, const Path<Scalar>& path) {
  const std::vector<Hit<Scalar>> hits = oracle.all_hits(path, {});
  if (hits.empty() || random.one_in(3)) return {};
  const Hit<Scalar>& hit = hits[random.below(hits.size())];
  QueryOptions<Scalar> options = draw_options(random, hit.t);
  if (random.one_in(3)) options.ignored_triangle = hit.triangle;
  if (random.one_in(2)) options.mask = static_cast<std::uint32_t>(random.below(4));
  return options;
}

class ColliderCrosscheck : public testing::TestWithParam<std::size_t> {};

template <typename Scalar>
void check(std::size_t kind) {
  Random random(5);
  for (std::size_t i = case_count(150); i > 0; --i) {
    const SmallMesh<Scalar> mesh = draw_small_mesh<Scalar>(kind, random);
    std::vector<std::uint32_t> masks;
    if (random.one_in(2)) {
      for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        masks.push_back(static_cast<std::uint32_t>(random.below(4)));
      }
    }
    const ExactMeshOracle<Scalar> oracle(mesh.view(), masks);
    const std::vector<Collider<Scalar>> colliders = colliders_of(mesh, masks);
    for (const Path<Scalar>& path : mesh.paths) {
      const QueryOptions<Scalar> options = draw_query(random, oracle, path);
      const Collider<Scalar>& collider = colliders[random.below(colliders.size())];
      ASSERT_EQ(collider_difference(collider, oracle, path, options), "") << "mesh " << i;
    }
  }
}

TEST_P(ColliderCrosscheck, of_float_meshes) { check<float>(GetParam()); }
TEST_P(ColliderCrosscheck, of_double_meshes) { check<double>(GetParam()); }

/// Paths through a prop and the level around it, which has an inner grid for the prop.
template <typename Scalar>
void check_prop(Scalar ratio) {
  Random random(6);
  const GeneratedMesh<Scalar> level = rough_ground<Scalar>(4, Scalar{0.3F}, random);
  const GeneratedMesh<Scalar> prop = placed<Scalar>(scattered_triangles<Scalar>(100, Scalar{0.4F}, random), 1 / ratio,
                                                    {Scalar{0.31F}, Scalar{0.27F}, 0});
  const GeneratedMesh<Scalar> mesh = joined(level, prop);
  const ExactMeshOracle<Scalar> oracle(mesh.view(), {});
  const Collider<Scalar> collider(mesh.view(), {.grid = {.crowded = 20}});
  ASSERT_FALSE(detail::ColliderState<Scalar>::of(collider).grid.inner_frames().empty());
  PathDrawer<Scalar> of_mesh(mesh.view(), 1);
  PathDrawer<Scalar> of_prop(prop.view(), 2);
  for (std::size_t i = case_count(600); i > 0; --i) {
    const Path<Scalar> path = random.one_in(4)   ? of_mesh.draw()
                              : random.one_in(4) ? of_prop.draw_axis_parallel()
                                                 : of_prop.draw();
    const QueryOptions<Scalar> options = draw_query(random, oracle, path);
    ASSERT_EQ(collider_difference(collider, oracle, path, options), "") << "path " << i;
  }
}

TEST(PropCrosscheck, of_floats) {
  for (const float ratio : {1e3F, 1e6F}) check_prop<float>(ratio);
}
TEST(PropCrosscheck, of_doubles) {
  for (const double ratio : {1e3, 1e12}) check_prop<double>(ratio);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ColliderCrosscheck, testing::Range(std::size_t{0}, small_mesh_kind_count),
                         [](const auto& test) { return name_of_small_mesh(test.param); });

}  // namespace
}  // namespace surehit::test::collider_crosscheck_test
