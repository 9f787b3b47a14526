#include "path_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "named_mesh.hpp"
#include "uneven_meshes.hpp"

namespace surehit::test::path_set_test {
namespace {

using benchmark::all_path_sets;
using benchmark::draw_paths;
using benchmark::name_of;
using benchmark::NamedMesh;
using benchmark::PathBatch;
using benchmark::PathSet;

class PathSetTest : public testing::Test {
 protected:
  static constexpr std::size_t count = 2000;

  [[nodiscard]] PathBatch draw(PathSet set) const { return draw_paths(set, level_, count); }
  /// Returns the share of a set's paths that meet the mesh.
  [[nodiscard]] double share_of_hits(PathSet set) const {
    const Colliderf collider(level_.mesh.view());
    const PathBatch paths = draw(set);
    std::vector<std::uint8_t> blocked(paths.size());
    paths.visit([&](const auto& all) { collider.any_hits(all, blocked); });
    return static_cast<double>(std::count(blocked.begin(), blocked.end(), 1)) / static_cast<double>(paths.size());
  }

  /// A square of two triangles in a slanted plane, and twenty tiny triangles on one of its corners.
  [[nodiscard]] static NamedMesh slanted_square() {
    NamedMesh named;
    named.mesh.vertices = {{0, 0, 1}, {8, 0, 3}, {8, 8, 7}, {0, 8, 5}, {0.01F, 0, 1}, {0, 0.01F, 1}};
    named.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (int i = 0; i < 20; ++i) named.mesh.triangles.push_back({0, 4, 5});
    return named;
  }
  using Point = std::array<float, 3>;
  [[nodiscard]] static Point point_of(const Vector3f& point) { return {point[0], point[1], point[2]}; }

  const NamedMesh level_ = benchmark::level_mesh(0.05F);
  const double diagonal_ = level_.diagonal();
  const Vector3d centre_ = (level_.box().low.cast<double>() + level_.box().high.cast<double>()) / 2;
};

TEST_F(PathSetTest, has_a_name_of_its_own) {
  std::set<std::string> names;
  for (const PathSet set : all_path_sets) names.insert(name_of(set));
  EXPECT_EQ(names.size(), all_path_sets.size());
}

TEST_F(PathSetTest, has_rays_only_where_it_says_so) {
  for (const PathSet set : all_path_sets) EXPECT_EQ(draw(set).are_rays(), set == PathSet::far_rays) << name_of(set);
  const std::vector<PathSet> sets(all_path_sets.begin(), all_path_sets.end());
  const std::vector<PathSet> with_segments = benchmark::sets_of_segments(sets);
  EXPECT_EQ(with_segments.size(), sets.size() - 1);
  for (const PathSet set : with_segments) EXPECT_FALSE(draw(set).are_rays()) << name_of(set);
}

TEST_F(PathSetTest, draws_the_same_paths_for_the_same_seed) {
  for (const PathSet set : all_path_sets) {
    const PathBatch paths = draw(set);
    const PathBatch again = draw(set);
    const PathBatch others = draw_paths(set, level_, count, 2);
    const auto is_same = [](const Segmentf& x, const Segmentf& y) { return x.start == y.start && x.end == y.end; };
    EXPECT_TRUE(std::ranges::equal(paths.segments(), again.segments(), is_same)) << name_of(set);
    EXPECT_FALSE(std::ranges::equal(paths.segments(), others.segments(), is_same)) << name_of(set);
  }
}

TEST_F(PathSetTest, has_short_paths_of_one_length) {
  for (const PathSet set : {PathSet::short_paths, PathSet::near_paths, PathSet::detail_paths}) {
    const PathBatch paths = draw(set);
    for (const Segmentf& path : paths.segments()) {
      EXPECT_NEAR((path.end - path.start).cast<double>().norm(), 0.01 * diagonal_, 1e-5 * diagonal_) << name_of(set);
    }
  }
}

TEST_F(PathSetTest, begins_far_away_and_is_aimed_at_the_mesh_half_of_the_time) {
  for (const PathSet set : {PathSet::far_paths, PathSet::far_rays}) {
    const PathBatch paths = draw(set);
    for (const Segmentf& path : paths.segments()) {
      const double distance = (path.start.cast<double>() - centre_).norm() / diagonal_;
      EXPECT_GE(distance, 9.99) << name_of(set);
      EXPECT_LE(distance, 1000.1) << name_of(set);
    }
    // A path that is aimed may end in front of the first triangle, or leave through the open side of a hall.
    EXPECT_GT(share_of_hits(set), 0.3) << name_of(set);
    EXPECT_LT(share_of_hits(set), 0.55) << name_of(set);
  }
}

TEST_F(PathSetTest, meets_what_it_is_aimed_at) {
  for (const PathSet set : {PathSet::edge_paths, PathSet::edge_end_paths}) {
    EXPECT_GT(share_of_hits(set), 0.9) << name_of(set);
  }
}

/// All triangles count alike in detail paths. In near ones, those of the square have nearly all of the area.
TEST_F(PathSetTest, has_detail_where_triangles_are_small) {
  const NamedMesh square = slanted_square();
  const auto share_at_corner = [&](PathSet set) {
    const PathBatch paths = draw_paths(set, square, count);
    const auto at_corner = std::ranges::count_if(paths.segments(), [&](const Segmentf& path) {
      return (path.start - Vector3f(0, 0, 1)).norm() < 0.02 * square.diagonal();
    });
    return static_cast<double>(at_corner) / static_cast<double>(paths.size());
  };
  EXPECT_NEAR(share_at_corner(PathSet::detail_paths), 20. / 22, 0.03);
  EXPECT_LT(share_at_corner(PathSet::near_paths), 0.01);
}

TEST_F(PathSetTest, ends_on_vertices_and_in_the_middle_of_edges) {
  std::set<Point> vertices;
  std::set<Point> middles;
  for (std::size_t i = 0; i < level_.mesh.view().triangle_count(); ++i) {
    const Trianglef triangle = level_.mesh.view().triangle(i);
    const std::array<Vector3d, 3> corners = {triangle.a.cast<double>(), triangle.b.cast<double>(),
                                             triangle.c.cast<double>()};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      vertices.insert(point_of(corners[corner].cast<float>()));
      middles.insert(point_of(((corners[corner] + corners[(corner + 1) % 3]) / 2).cast<float>()));
    }
  }
  std::size_t on_vertices = 0;
  std::size_t on_edges = 0;
  const PathBatch paths = draw(PathSet::edge_end_paths);
  for (const Segmentf& path : paths.segments()) {
    on_vertices += vertices.count(point_of(path.end));
    on_edges += middles.count(point_of(path.end));
  }
  EXPECT_GE(on_vertices + on_edges, paths.size());
  EXPECT_GT(on_vertices, paths.size() / 3);
  EXPECT_GT(on_edges, paths.size() / 3);
}

TEST_F(PathSetTest, lies_in_planes_and_along_edges_and_nearly_so) {
  NamedMesh square = slanted_square();
  square.mesh.triangles.resize(2);
  const double tilt = 1e-6 * square.diagonal();
  // z = 1 + x / 4 + y / 2
  const auto height = [](const Vector3f& point) {
    return std::abs(double{point[2]} - 1 - double{point[0]} / 4 - double{point[1]} / 2);
  };
  const std::set<Point> corners = {{0, 0, 1}, {8, 0, 3}, {8, 8, 7}};
  std::size_t edges = 0;
  std::size_t to_a_vertex = 0;
  std::size_t off_at_start = 0;
  std::size_t off_at_end = 0;
  const PathBatch paths = draw_paths(PathSet::in_plane_paths, square, count);
  for (const Segmentf& path : paths.segments()) {
    const bool ends_at_corner = corners.contains(point_of(path.end));
    const bool is_edge = ends_at_corner && corners.contains(point_of(path.start));
    edges += is_edge;
    to_a_vertex += ends_at_corner && !is_edge;
    EXPECT_LE(height(path.start), 3 * tilt);
    EXPECT_LE(height(path.end), 3 * tilt);
    off_at_start += height(path.start) > tilt / 16;
    off_at_end += height(path.end) > tilt / 16;
  }
  const auto quarter = static_cast<double>(paths.size()) / 4;
  EXPECT_NEAR(static_cast<double>(edges), quarter, 0.15 * quarter);
  EXPECT_NEAR(static_cast<double>(to_a_vertex), quarter, 0.15 * quarter);
  // A tenth of the points of a ball are so near to its middle plane.
  EXPECT_NEAR(static_cast<double>(off_at_start), 0.9 * quarter, 0.15 * quarter);
  EXPECT_NEAR(static_cast<double>(off_at_end), 0.9 * quarter, 0.15 * quarter);
}

TEST_F(PathSetTest, goes_from_centre_to_centre_of_cells) {
  const NamedMesh voxels = benchmark::uneven_mesh("voxels", 0.2F);
  ASSERT_EQ(voxels.cell, 1);
  float longest = 0;
  const auto is_centre = [](float x) { return x - std::floor(x) == 0.5F; };
  const PathBatch paths = draw_paths(PathSet::cell_paths, voxels, count);
  for (const Segmentf& path : paths.segments()) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(is_centre(path.start[axis]) && is_centre(path.end[axis]));
      longest = std::max(longest, std::abs(path.end[axis] - path.start[axis]));
    }
  }
  EXPECT_EQ(longest, 12);
  // Other meshes have cells whose edges are powers of two.
  const double cell = std::exp2(std::round(std::log2(diagonal_ / 200)));
  const PathBatch others = draw(PathSet::cell_paths);
  for (const Segmentf& path : others.segments()) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(is_centre(static_cast<float>(double{path.start[axis]} / cell)));
  }
}

}  // namespace
}  // namespace surehit::test::path_set_test
