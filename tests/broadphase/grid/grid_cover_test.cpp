#include "grid/grid_cover.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "broadphase/walk/grid_walk.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_cover_test {
namespace {

template <typename Scalar>
class GridCoverTest : public GridWalk<Scalar> {
 protected:
  void place_askew(const GridOptions& options) {
    Random random(31);
    this->build(with_small_copy<Scalar>(grounds_askew<Scalar>(random), {3.3F, 6.2F, -3.1F}), options);
  }

  /// Walks from where the path enters the cover to where it leaves that.
  Walk walk_in_cover(const Path<Scalar>& path, const Range& range) const {
    Walk walk;
    ClippedPath path_in_grid(this->grid_, path, range.first, range.last);
    if (path_in_grid.status != ClippedPath::Status::clipped) return walk;
    const GridCover::Part part = this->grid_.cover().part_of(path_in_grid.start, path_in_grid.inverse_rate,
                                                             path_in_grid.octant, path_in_grid.end);
    if (part.enters > part.leaves) return walk;
    EXPECT_GE(part.enters, 0);
    EXPECT_LE(part.leaves, path_in_grid.end);
    path_in_grid.end = part.leaves;
    for (GridTraversal walked(this->grid_, path_in_grid, part.enters); !walked.at_end(); walked.advance()) {
      walk.visited.push_back(this->expect_on_path(path, range, path_in_grid, walked));
      if (!walked.word().is_empty() && walked.meets_box()) walk.met.push_back(walk.visited.back());
    }
    return walk;
  }

  void expect_found_in_cover(const Path<Scalar>& path) {
    const Range range(path);
    const Walk walk = walk_in_cover(path, range);
    this->met_ += this->expect_listed(path, range, walk);
    visited_ += walk.visited.size();
    visited_in_all_ += this->walk(path, range).visited.size();
  }

  std::size_t visited_ = 0;
  std::size_t visited_in_all_ = 0;
};
TYPED_TEST_SUITE(GridCoverTest, Scalars, ScalarNames);

TYPED_TEST(GridCoverTest, holds_all_that_the_path_meets) {
  for (const GridOptions& options : {GridOptions{.resolution = {11, 9, 13}, .crowded = 0},
                                     GridOptions{.resolution = {5, 6, 4}, .crowded = 4}, GridOptions{}}) {
    this->place_askew(options);
    ASSERT_TRUE(this->grid_.cover().is_useful());
    PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
    for (std::size_t i = case_count(400); i > 0; --i) {
      this->expect_found_in_cover(drawer.draw());
      this->expect_found_in_cover(drawer.any_kind({drawer.point_around_mesh(), drawer.point_around_mesh()}));
      this->expect_found_in_cover(drawer.draw_axis_parallel());
      this->expect_found_in_cover(drawer.draw_from_afar(100));
    }
  }
  EXPECT_GT(this->met_, 0U);
  EXPECT_LT(this->visited_, this->visited_in_all_ * 3 / 4) << "little is left out";
  this->RecordProperty("visited_percent", std::to_string(100 * this->visited_ / this->visited_in_all_));
}

/// In the planes of its boxes, along the walls that made them.
TYPED_TEST(GridCoverTest, holds_walls_in_the_planes_of_its_boxes) {
  const auto cube = lattice_cube<TypeParam>(2);
  this->build(joined(cube, placed<TypeParam>(cube, TypeParam{0.5}, {30, 20, 40})), {.resolution = {8, 8, 8}});
  ASSERT_TRUE(this->grid_.cover().is_useful());
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  for (std::size_t i = case_count(500); i > 0; --i) {
    Vector3<TypeParam> start = drawer.point_on_mesh();
    Vector3<TypeParam> way = drawer.point_on_mesh() - start;
    way[static_cast<Eigen::Index>(drawer.random().below(3))] = 0;
    start -= static_cast<TypeParam>(drawer.random().below(3)) * way;
    this->expect_found_in_cover(drawer.any_kind({start, start + 4 * way}));
  }
  EXPECT_GT(this->met_, 0U);
}

/// Within a padding of the grid, where the cover's outer planes are, past a near plane of the box in the last corner.
TYPED_TEST(GridCoverTest, looks_nowhere_outside_the_grid) {
  const auto cube = placed<TypeParam>(lattice_cube<TypeParam>(2), TypeParam{0.1F}, {0, 0, 0});
  this->build(joined(cube, placed<TypeParam>(cube, TypeParam{1}, {0.8F, 0.8F, 0.8F})), {.resolution = {40, 40, 40}});
  ASSERT_TRUE(this->grid_.cover().is_useful());
  const GridFrame& frame = this->grid_.frame();
  Random random(33);
  std::size_t outside = 0;
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    const std::size_t out = random.below(3);
    const std::size_t along = (out + 1 + random.below(2)) % 3;
    const bool is_mirrored = random.one_in(2);
    // Counted from the corner at which the box is, or from the opposite one.
    const double corner = is_mirrored ? 0 : 40;
    const double inward = is_mirrored ? 1 : -1;
    const double box = corner + inward * (8 - 2.0 * frame.padding(0));
    std::array<double, 3> at = {};
    at.fill(corner + inward * 4);
    at[along] = box + inward * 0.5 * random.unit<double>() * frame.padding(0);
    at[out] = corner - inward * 0.5 * random.unit<double>() * frame.padding(0);
    std::array<double, 3> from = at;
    std::array<double, 3> to = at;
    from[along] += inward * 5;
    to[along] -= inward * 5;
    from[out] += inward * 3 * frame.padding(0);
    to[out] -= inward * 3 * frame.padding(0);
    Segment<TypeParam> segment;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      segment.start[k] = static_cast<TypeParam>(out_of_frame(frame, axis, from[axis]));
      segment.end[k] = static_cast<TypeParam>(out_of_frame(frame, axis, to[axis]));
    }
    const Path<TypeParam> path = segment;
    const ClippedPath in_grid(this->grid_, path, 0, 1);
    if (in_grid.status != ClippedPath::Status::clipped) continue;
    const GridCover::Part part =
        this->grid_.cover().part_of(in_grid.start, in_grid.inverse_rate, in_grid.octant, in_grid.end);
    if (part.enters > part.leaves) continue;
    outside += in_grid.start[out] + part.enters * in_grid.rate[out] >= 40 ? 1 : 0;
    const GridTraversal begun(this->grid_, in_grid, part.enters);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(begun.low()[axis], 40) << hex_text(path);
  }
  EXPECT_GT(outside, 0U) << "none begins there";
  this->RecordProperty("outside", std::to_string(outside));
}

/// To ask a cover takes time, and so does to make one.
TYPED_TEST(GridCoverTest, is_of_use_where_much_is_empty) {
  EXPECT_FALSE(Grid().cover().is_useful());
  EXPECT_FALSE(this->grid_.cover().is_useful());
  this->place_ground(1, {0, 0, 0}, this->nested());
  EXPECT_FALSE(this->grid_.cover().is_useful());
  Random random(32);
  this->build(scattered_triangles<TypeParam>(300, 0.2F, random), {});
  EXPECT_FALSE(this->grid_.cover().is_useful());
  this->place_askew({});
  EXPECT_TRUE(this->grid_.cover().is_useful());
  // The edges of a cube take up little of it, but no few boxes leave much out.
  GeneratedMesh<TypeParam> edges;
  for (int i = 0; i < 64 * 12; ++i) {
    Vector3<TypeParam> point = {0, 0, 0};
    point[i % 3] = static_cast<TypeParam>(i / 12) / 64;
    point[(i + 1) % 3] = static_cast<TypeParam>(i / 3 % 2);
    point[(i + 2) % 3] = static_cast<TypeParam>(i / 6 % 2);
    edges.add({point, point, point});
  }
  this->build(edges, {.resolution = {16, 16, 16}});
  EXPECT_FALSE(this->grid_.cover().is_useful());
  this->build(lattice_cube<TypeParam>(4), {});
  EXPECT_FALSE(this->grid_.cover().is_useful());
}

}  // namespace
}  // namespace surehit::test::grid_cover_test
