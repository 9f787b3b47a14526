#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_comparison.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"

namespace surehit::test::far_path_comparison_test {
namespace {

/// Paths of floats that begin far from a mesh, or far from a prop in it. They answer as asking every triangle does.
class FarPathComparison : public testing::Test {
 protected:
  /// Draws a path that begins 2 to 2^20 widths away. It ends on the mesh, in its box, or as far beyond.
  static Path<float> draw(PathDrawer<float>& drawer) {
    Random& random = drawer.random();
    const Vector3<float> target = random.one_in(2) ? drawer.point_on_mesh() : drawer.point_around_mesh();
    Vector3<float> way = drawer.point_around_mesh() - target;
    if (random.one_in(4)) way[static_cast<Eigen::Index>(random.below(3))] = 0;
    way *= std::exp2(1 + static_cast<float>(random.below(20)) * random.unit<float>());
    const Vector3<float> start = target + way;
    return drawer.any_kind({start, random.one_in(2) ? target : Vector3<float>(target - way)});
  }

  void compare(const GeneratedMesh<float>& mesh, const GeneratedMesh<float>& aimed_at,
               const std::vector<GridOptions>& grids, std::size_t paths) {
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      SCOPED_TRACE(name_of_instruction_set(target));
      GridComparison<float> comparison(mesh.view(), {}, grids);
      PathDrawer<float> drawer(aimed_at.view(), 12);
      std::vector<Segment<float>> segments;
      std::vector<Line<float>> lines;
      std::vector<QueryOptions<float>> options;
      for (std::size_t i = case_count(paths); i > 0; --i) {
        const Path<float> path = draw(drawer);
        const auto hits = comparison.expect_same(path);
        // Limits that may be exactly those of a hit.
        const float t = hits.empty() ? drawer.random().unit<float>() : hits.front().t;
        options.push_back(draw_options(drawer.random(), t));
        comparison.expect_same(path, options.back());
        segments.push_back({path.start, path.has_end() ? path.toward : path.start + path.toward});
        lines.push_back({path.start, path.has_end() ? Vector3<float>(path.toward - path.start) : path.toward});
      }
      // Among them are paths that begin near the mesh.
      for (std::size_t i = 0; i < segments.size(); i += 3) {
        segments[i] = {drawer.point_around_mesh(), drawer.point_on_mesh()};
        lines[i] = {segments[i].start, segments[i].end - segments[i].start};
      }
      for (const Collider<float>& collider : comparison.colliders()) {
        expect_batch<float, Segment<float>>(collider, segments);
        expect_batch<float, Segment<float>>(collider, segments, options);
        expect_batch<float, Line<float>>(collider, lines);
        expect_batch<float, Line<float>>(collider, lines, options);
      }
      EXPECT_GT(comparison.hit_count(), case_count(paths) / 8);
    }
  }

  Random random_{81};
};

TEST_F(FarPathComparison, of_meshes_at_the_origin_and_far_from_it) {
  for (const float offset : {0.0F, 3000.0F}) {
    const auto mesh = placed<float>(rough_ground<float>(9, 0.4F, random_), 2, {offset, -offset, offset});
    compare(mesh, mesh, {{.crowded = 0}, {.resolution = {3, 2, 4}, .crowded = 3}}, 150);
  }
}

/// Faces on whole numbers lie on planes between cells, and on the mesh's box.
TEST_F(FarPathComparison, of_cubes) {
  const auto mesh = lattice_cube<float>(4);
  compare(mesh, mesh, {{}, {.resolution = {16, 16, 16}, .crowded = 0}}, 150);
}

TEST_F(FarPathComparison, of_props_in_levels) {
  for (const float ratio : {10.0F, 1e3F, 1e6F}) {
    SCOPED_TRACE(ratio);
    const auto level = placed<float>(rough_ground<float>(6, 0.3F, random_), 1, {0, 0, 0});
    const auto prop = placed<float>(scattered_triangles<float>(150, 0.4F, random_), 1 / ratio, {0.31F, 0.27F, 0.02F});
    compare(joined(level, prop), prop, {{.crowded = 30}, {.resolution = {2, 3, 1}, .crowded = 12}}, 100);
  }
}

/// Floats for t cannot tell the hits apart, but the order is that of exact t. Some hits are on edges, so that only the
/// narrowphase decides them.
TEST_F(FarPathComparison, of_stacks_whose_hits_have_one_rounded_t) {
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    for (std::size_t i = case_count(300); i > 0; --i) {
      GeneratedMesh<float> mesh;
      mesh.add({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}});  // The box is as high as it is wide.
      mesh.add({{-1, -1, 1}, {-1, -1, 0}, {-1, 1, 1}});
      const float step = std::ldexp(1.0F, -static_cast<int>(random_.between(4, 12)));
      for (std::size_t triangles = 40; triangles > 0; --triangles) {
        const float height = step * static_cast<float>(random_.between(-8, 8));
        const float behind = random_.one_in(3) ? 0 : -1;
        mesh.add({{-1, behind, height}, {1, behind, height}, {0, 1, height}});
      }
      GridComparison<float> comparison(mesh.view(), {}, {{.resolution = {1, 1, 1}, .crowded = 0}, {}});
      const float far = std::ldexp(1.0F, static_cast<int>(random_.between(8, 18)));
      comparison.expect_same(Segment<float>{{0, 0, far}, {0, 0, -far}});
      comparison.expect_same(Segment<float>{{0, 0, far}, {0, 0, -1}});
      comparison.expect_same(Ray<float>{{0, 0, -far}, {0, 0, 3}});
      const std::vector<Segment<float>> twice(12, Segment<float>{{0, 0, far}, {0, 0, i % 2 == 0 ? -far : -1}});
      for (const Collider<float>& collider : comparison.colliders()) expect_batch(collider, twice);
    }
  }
}

/// Paths that are clipped to the level, but are too far away to be clipped to the prop.
TEST_F(FarPathComparison, of_props_in_levels_of_almost_any_size) {
  const auto prop = placed<float>(scattered_triangles<float>(150, 0.4F, random_), 1, {0, 0, 0});
  for (const float ratio : {1e10F, 1e20F, 1e25F}) {
    SCOPED_TRACE(ratio);
    const auto mesh = joined(placed<float>(rough_ground<float>(6, 0.3F, random_), ratio, {0, 0, 0}), prop);
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      GridComparison<float> comparison(mesh.view(), {}, {{.crowded = 30}});
      for (std::size_t i = case_count(60); i > 0; --i) {
        const Vector3<float> way =
            Vector3<float>{random_.symmetric<float>(), random_.symmetric<float>(), 1} * ratio * 40;
        comparison.expect_same(Segment<float>{way, -way});
        comparison.expect_same(Ray<float>{way, -way});
        comparison.expect_same(Segment<float>{way, {random_.unit<float>(), random_.unit<float>(), 0}});
      }
      EXPECT_GT(comparison.hit_count(), 0U);
    }
  }
}

/// The way from the start of a path to the mesh is no float, in a slow direction.
TEST_F(FarPathComparison, of_ways_that_overflow) {
  constexpr float far = 0x1.cp127F;
  GeneratedMesh<float> stray = placed<float>(scattered_triangles<float>(1000, 0.05F, random_), 1, {11, 11, 11});
  stray.add({{far, -1, -1}, {far, 1, -1}, {far, 0, 1}});
  GeneratedMesh<float> wall;
  for (int i = -5; i < 5; ++i) {
    const auto y = static_cast<float>(10 * i);
    for (int k = -5; k < 5; ++k) {
      const auto z = static_cast<float>(10 * k);
      wall.add({{far, y, z}, {far, y + 10, z}, {far, y, z + 10}});
    }
  }
  const Ray<float> slow{{-far, -0x1p49F, 0}, {0x1.cp99F, 0x1p20F, 0}};
  const Line<float> back{{-far, 0, 0}, {-0x1.cp99F, 0, 0}};
  for (const GeneratedMesh<float>* mesh : {&stray, &wall}) {
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      GridComparison<float> comparison(mesh->view(), {}, {{}});
      comparison.expect_same(slow);
      comparison.expect_same(back);
      comparison.expect_same(slow, QueryOptions<float>{.max_t = 0x1p30F});
      EXPECT_GE(comparison.hit_count(), 2U);
      for (const Collider<float>& collider : comparison.colliders()) {
        expect_batch(collider, std::vector<Ray<float>>(24, slow));
        expect_batch(collider, std::vector<Line<float>>(24, back));
      }
    }
  }
}

}  // namespace
}  // namespace surehit::test::far_path_comparison_test
