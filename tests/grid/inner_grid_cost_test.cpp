#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::inner_grid_cost_test {
namespace {

/// The ways in which a path is asked.
constexpr std::array ways = {"first_hit", "any_hit", "first_hits", "any_hits"};
/// The work of all paths, one for each way.
using Costs = std::array<QueryStatistics, ways.size()>;

/// What paths cost in meshes of small and large triangles. Work is counted, so a busy machine does not matter.
template <typename Scalar>
class InnerGridCost : public testing::Test {
 protected:
  /// Paths of each kind.
  struct Paths {
    std::vector<Segment<Scalar>> segments;
    std::vector<Ray<Scalar>> rays;
    std::vector<Line<Scalar>> lines;
  };

  GeneratedMesh<Scalar> ground(std::uint32_t count) { return rough_ground<Scalar>(count, Scalar{0.3F}, random_); }

  /// Draws paths as if the mesh were all that there is.
  static Paths draw(const GeneratedMesh<Scalar>& mesh) {
    PathDrawer<Scalar> drawer(mesh.view(), 1);
    Paths paths;
    constexpr std::size_t min_paths = 200;  // The costs of fewer are far from those of many.
    for (std::size_t i = std::max(min_paths, case_count(2000)); i > 0; --i) {
      const Path<Scalar> path = drawer.draw();
      if (path.kind == PathKind::segment) paths.segments.push_back({path.start, path.toward});
      if (path.kind == PathKind::ray) paths.rays.push_back({path.start, path.toward});
      if (path.kind == PathKind::line) paths.lines.push_back({path.start, path.toward});
    }
    return paths;
  }

  static Costs costs(const GeneratedMesh<Scalar>& mesh, const Paths& paths) {
    const Collider<Scalar> collider(mesh.view());
    Costs costs = {};
    const auto ask = [&](const auto& some) {
      for (const auto& path : some) {
        static_cast<void>(collider.first_hit(path, {}, &costs[0]));
        static_cast<void>(collider.any_hit(path, {}, &costs[1]));
      }
      std::vector<Hit<Scalar>> hits(some.size());
      std::vector<std::uint8_t> blocked(some.size());
      collider.first_hits(some, hits, {.statistics = &costs[2]});
      collider.any_hits(some, blocked, {.statistics = &costs[3]});
    };
    ask(paths.segments);
    ask(paths.rays);
    ask(paths.lines);
    return costs;
  }

  /// Expects at most `factor` times the work in a part, what the rest costs alone, and a cell on the way to the part.
  static void expect_little_more(const Costs& whole, const Costs& part, const Costs& rest, double factor) {
    for (std::size_t way = 0; way < ways.size(); ++way) {
      SCOPED_TRACE(ways[way]);
      const auto as_double = [](std::uint64_t count) { return static_cast<double>(count); };
      // In an even mesh, a single path for any hit looks into many cells at once, and finds a later hit earlier.
      const QueryStatistics& in_order = part[way == 1 ? 3 : way];
      EXPECT_GT(in_order.candidates, 0U);
      EXPECT_LE(as_double(whole[way].candidates),
                factor * as_double(in_order.candidates) + as_double(rest[way].candidates));
      EXPECT_LE(as_double(whole[way].cells),
                factor * as_double(part[way].cells) + as_double(rest[way].cells) + as_double(whole[way].paths));
    }
  }

  /// Asks about paths that are drawn about the prop.
  static void expect_sum(const GeneratedMesh<Scalar>& level, const GeneratedMesh<Scalar>& prop, double factor) {
    const Paths paths = draw(prop);
    expect_little_more(costs(joined(level, prop), paths), costs(prop, paths), costs(level, paths), factor);
  }
  static GeneratedMesh<Scalar> in_level(const GeneratedMesh<Scalar>& prop, double ratio) {
    return placed<Scalar>(prop, static_cast<Scalar>(1 / ratio), {Scalar{0.31F}, Scalar{0.27F}, Scalar{0.5F}});
  }

  Random random_{77};
};
TYPED_TEST_SUITE(InnerGridCost, Scalars, ScalarNames);

TYPED_TEST(InnerGridCost, of_a_field_hardly_grows_with_a_stray_triangle) {
  const auto field = this->ground(60);
  const auto paths = this->draw(field);
  const Costs alone = this->costs(field, paths);
  for (const double distance : {10., 1e3, 1e5, 1e9, 1e30}) {
    SCOPED_TRACE(distance);
    const auto far = static_cast<TypeParam>(distance);
    auto mesh = field;
    mesh.add({{far, far, far}, {far * TypeParam{1.5F}, far, far}, {far, far * TypeParam{1.5F}, far}});
    this->expect_little_more(this->costs(mesh, paths), alone, {}, 1.5);
  }
}

/// A teapot in a stadium. Paths are drawn about the teapot.
TYPED_TEST(InnerGridCost, of_a_prop_hardly_grows_with_a_level_around_it) {
  const auto level = this->ground(50);
  const auto prop = this->ground(50);
  for (const double ratio : {6., 10., 20., 50., 100., 1e3, 1e4}) {
    SCOPED_TRACE(ratio);
    // Cells of the level that are not crowded may list several times as many triangles as those of the prop alone.
    this->expect_sum(level, this->in_level(prop, ratio), ratio == 6 ? 5.5 : ratio < 50 ? 2 : 1.5);
  }
  for (const double ratio : {1e9, 1e30}) {
    SCOPED_TRACE(ratio);
    this->expect_sum(placed<TypeParam>(level, static_cast<TypeParam>(ratio), {0, 0, 0}), prop, 1.5);
  }
}

TYPED_TEST(InnerGridCost, of_a_prop_of_70000_triangles_hardly_grows_with_a_level_around_it) {
  const auto level = this->ground(10);
  const auto prop = this->ground(187);
  for (const double ratio : {10., 30., 100., 1e3, 1e4}) {
    SCOPED_TRACE(ratio);
    // Cells of the level that are not crowded list more triangles than those of the prop alone.
    this->expect_sum(level, this->in_level(prop, ratio), ratio == 10 ? 2.2 : ratio == 30 ? 1.8 : 1.5);
  }
}

}  // namespace
}  // namespace surehit::test::inner_grid_cost_test
