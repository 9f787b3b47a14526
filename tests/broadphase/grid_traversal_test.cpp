#include "surehit/grid_traversal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/exact_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"

namespace surehit::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Parameters that count: those of the path's kind, where nothing else is said.
struct Range {
  template <typename Scalar>
  explicit Range(const Path<Scalar>& path)
      : first(path.has_start() ? 0 : -infinity), last(path.has_end() ? 1 : infinity) {}

  double first;
  double last;
};

template <typename Scalar>
class GridTraversalTest : public testing::Test {
 protected:
  explicit GridTraversalTest(GeneratedMesh<Scalar> mesh) : mesh_(std::move(mesh)) {}
  GridTraversalTest() : GridTraversalTest(GeneratedMesh<Scalar>()) { place_ground(1, {0, 0, 0}); }

  void place_ground(Scalar factor, const Vector3<Scalar>& offset,
                    const GridOptions& options = {.resolution = {9, 8, 5}}) {
    Random random(20240229);
    mesh_ = placed<Scalar>(rough_ground<Scalar>(6, 0.7F, random), factor, offset);
    grid_ = Grid(mesh_.view(), box_of(mesh_.view()), options);
  }

  /// Walks all the way, and checks each cell against the exact path: the walk goes where the path goes, and nowhere
  /// else.
  std::vector<std::size_t> walk(const Path<Scalar>& path, Range range) {
    GridTraversal traversal(grid_, path, range.first, range.last);
    EXPECT_FALSE(traversal.is_unclipped()) << hex_text(path);
    std::vector<std::size_t> cells;
    for (; !traversal.at_end(); traversal.advance()) {
      cells.push_back(traversal.cell());
      expect_on_path(path, range, traversal.cell());
      if (cells.size() > most_cells()) break;
    }
    expect_connected(path, cells);
    return cells;
  }

  /// The same, where the path is made shorter on the way.
  std::vector<std::size_t> walk_shortened(const Path<Scalar>& path, Range& range, std::size_t steps, double t) {
    GridTraversal traversal(grid_, path, range.first, range.last);
    std::vector<std::size_t> cells;
    for (; !traversal.at_end(); traversal.advance()) {
      cells.push_back(traversal.cell());
      expect_on_path(path, range, traversal.cell());
      if (cells.size() != steps + 1) continue;
      traversal.shorten(t);
      range.last = std::min(range.last, t);
    }
    expect_connected(path, cells);
    return cells;
  }

  void expect_on_path(const Path<Scalar>& path, const Range& range, std::size_t cell) const {
    ASSERT_LT(cell, grid_.cell_count());
    EXPECT_TRUE(meets_cell(grid_.frame(), path, range.first, range.last, cell, GridFrame::padding))
        << hex_text(path) << " is not in cell " << cell;
  }

  /// From a cell the walk goes to one that shares a face, and never back.
  void expect_connected(const Path<Scalar>& path, const std::vector<std::size_t>& cells) const {
    EXPECT_LE(cells.size(), most_cells()) << hex_text(path);
    const auto& [x, y, z] = grid_.resolution();
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const std::size_t step = cells[i] > cells[i - 1] ? cells[i] - cells[i - 1] : cells[i - 1] - cells[i];
      EXPECT_TRUE(step == 1 || step == x || step == std::size_t{x} * y) << hex_text(path);
    }
  }

  [[nodiscard]] std::size_t most_cells() const {
    const auto& [x, y, z] = grid_.resolution();
    return std::size_t{x} + y + z - 2;
  }

  /// Every triangle that the path exactly meets in the range is listed in one of the cells. Returns how many it meets.
  std::size_t expect_listed(const Path<Scalar>& path, const Range& range, const std::vector<std::size_t>& cells) const {
    std::set<std::uint32_t> listed;
    for (const std::size_t cell : cells) listed.insert(grid_.triangles(cell).begin(), grid_.triangles(cell).end());
    std::size_t met = 0;
    for (std::uint32_t id = 0; id < mesh_.triangles.size(); ++id) {
      const auto contact = exact_contact(path, mesh_.view().triangle(id));
      if (!contact) continue;
      if (std::isfinite(range.first) && contact->t < range.first) continue;
      if (std::isfinite(range.last) && contact->t > range.last) continue;
      ++met;
      EXPECT_TRUE(listed.contains(id)) << hex_text(path) << " from " << range.first << " to " << range.last
                                       << " loses triangle " << id;
    }
    return met;
  }

  void expect_found(const Path<Scalar>& path) {
    const Range range(path);
    met_ += expect_listed(path, range, walk(path, range));
  }

  /// Paths of every kind, long and short.
  void scan(std::size_t paths) {
    PathDrawer<Scalar> drawer(mesh_.view(), 7);
    for (std::size_t i = 0; i < case_count(paths); ++i) expect_found(drawer.draw());
    EXPECT_GT(met_, 0U);
  }

  GeneratedMesh<Scalar> mesh_;
  Grid grid_;
  std::size_t met_ = 0;
};
TYPED_TEST_SUITE(GridTraversalTest, Scalars, ScalarNames);

TYPED_TEST(GridTraversalTest, EmptyGridHasNoWalk) {
  const Grid grid;
  const Line<TypeParam> line = {{0, 0, 0}, {1, 0, 0}};
  const GridTraversal traversal(grid, Path<TypeParam>(line), -infinity, infinity);
  EXPECT_TRUE(traversal.at_end());
  EXPECT_FALSE(traversal.is_unclipped());
}

TYPED_TEST(GridTraversalTest, FindsAllThatThePathMeets) { this->scan(2000); }

TYPED_TEST(GridTraversalTest, FindsAllInMeshesOfEverySize) {
  using Limits = std::numeric_limits<TypeParam>;
  this->place_ground(Limits::max() / 2, {0, 0, 0});
  this->scan(300);
  this->place_ground(64 * Limits::denorm_min(), {0, 0, 0});
  this->scan(300);
  this->place_ground(1000, {1e7F, 1e7F, -1e7F});
  this->scan(300);
}

TYPED_TEST(GridTraversalTest, FindsAllFromFarAway) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  for (const TypeParam distance : {5.F, 100.F, 1e6F, 1e9F, 1e12F, 1e15F, 0x1p58F}) {
    for (std::size_t i = 0; i < case_count(300); ++i) this->expect_found(drawer.draw_from_afar(distance));
  }
  EXPECT_GT(this->met_, 0U);
}

/// Where a far path stands near the mesh must be worked out in more than a double.
TYPED_TEST(GridTraversalTest, FindsAllThroughTheOriginFromFarAway) {
  this->mesh_ = placed<TypeParam>(lattice_cube<TypeParam>(4), TypeParam{0.25}, {-0.5F, -0.5F, -0.5F});
  this->grid_ = Grid(this->mesh_.view(), box_of(this->mesh_.view()), {.resolution = {9, 8, 5}});
  Random random(7);
  for (const int exponent : {24, 40, 50, 58, 60}) {
    for (std::size_t i = 0; i < 40; ++i) {
      const std::size_t met_before = this->met_;
      const Segment<TypeParam> segment = far_through_origin<TypeParam>(exponent, random);
      this->expect_found(segment);
      ASSERT_GE(this->met_, met_before + 2) << hex_text(Path<TypeParam>(segment));
      this->expect_found(Ray<TypeParam>{segment.start, segment.end});
    }
  }
}

TYPED_TEST(GridTraversalTest, FindsAllAlongTheAxes) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  for (std::size_t i = 0; i < case_count(2000); ++i) this->expect_found(drawer.draw_axis_parallel());
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, FindsAllInTheRange) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  for (std::size_t i = 0; i < case_count(1000); ++i) {
    const Path<TypeParam> path = drawer.draw();
    Range range(path);
    range.first = std::max(range.first, drawer.random().template symmetric<double>());
    range.last = std::min(range.last, range.first + drawer.random().template unit<double>());
    this->met_ += this->expect_listed(path, range, this->walk(path, range));
  }
  EXPECT_GT(this->met_, 0U);
}

/// The limit is the exact t of a triangle or anything else, and comes at any step.
TYPED_TEST(GridTraversalTest, FindsAllThatIsNotOutOfReach) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  std::size_t shortened_walks = 0;
  for (std::size_t i = 0; i < case_count(3000); ++i) {
    const Path<TypeParam> path = drawer.random().one_in(2) ? drawer.draw() : drawer.draw_from_afar(1e9F);
    Range range(path);
    double limit = drawer.random().template unit<double>();
    const auto contact =
        exact_contact(path, this->mesh_.view().triangle(drawer.random().below(this->mesh_.triangles.size())));
    if (contact) {
      limit = nearest<double>(contact->t);
      if (limit < contact->t) limit = std::nextafter(limit, infinity);
    }
    const auto whole = this->walk(path, range);
    const auto cells = this->walk_shortened(path, range, drawer.random().below(4), limit);
    if (cells.size() < whole.size()) ++shortened_walks;
    this->met_ += this->expect_listed(path, range, cells);
  }
  EXPECT_GT(this->met_, 0U);
  EXPECT_GT(shortened_walks, case_count(3000) / 20);
}

TYPED_TEST(GridTraversalTest, ShortenNeverLengthens) {
  const Segment<TypeParam> segment = {{-2, 0.1F, 0.3F}, {2, 0.2F, 0.3F}};
  Range range{Path<TypeParam>(segment)};
  range.last = 0.5;
  const auto cells = this->walk(segment, range);
  EXPECT_EQ(this->walk_shortened(segment, range, 0, 0.75), cells);
}

TYPED_TEST(GridTraversalTest, FindsAllOnCellPlanes) {
  this->mesh_ = lattice_cube<TypeParam>(4);
  this->grid_ = Grid(this->mesh_.view(), box_of(this->mesh_.view()), {.resolution = {8, 8, 8}});
  const GridFrame& frame = this->grid_.frame();
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  const auto on_planes = [&] {
    Vector3<TypeParam> point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto plane = static_cast<std::uint32_t>(drawer.random().below(frame.resolution[axis] + 1));
      const double place = frame.plane(axis, plane) + frame.origin[axis];
      point[static_cast<Eigen::Index>(axis)] = static_cast<TypeParam>(std::ldexp(place, -frame.exponent));
    }
    return point;
  };
  for (std::size_t i = 0; i < case_count(1000); ++i) this->expect_found(drawer.any_kind({on_planes(), on_planes()}));
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, FindsAllWithDirectionsOfEverySize) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  using Limits = std::numeric_limits<TypeParam>;
  for (std::size_t i = 0; i < case_count(500); ++i) {
    const Vector3<TypeParam> start = drawer.point_around_mesh();
    const Vector3<TypeParam> direction = drawer.point_on_mesh() - start;
    for (const TypeParam size : {Limits::max() / 4, TypeParam{1}, Limits::min(), 256 * Limits::denorm_min()}) {
      this->expect_found(Ray<TypeParam>{start, direction * size});
      this->expect_found(Line<TypeParam>{start, direction * size});
    }
  }
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(GridTraversalTest, PointHasOneCellInsideAndNoneOutside) {
  for (const Path<TypeParam>& path : {Path<TypeParam>(Segment<TypeParam>{{0, 0, 0.3F}, {0, 0, 0.3F}}),
                                      Path<TypeParam>(Ray<TypeParam>{{0, 0, 0.3F}, {0, 0, 0}}),
                                      Path<TypeParam>(Line<TypeParam>{{0, 0, 0.3F}, {0, 0, 0}})}) {
    EXPECT_EQ(this->walk(path, Range(path)).size(), 1U);
    Path<TypeParam> far = path;
    far.start[0] = 1e9F;
    if (far.has_end()) far.toward[0] = 1e9F;
    EXPECT_TRUE(this->walk(far, Range(far)).empty());
  }
}

TYPED_TEST(GridTraversalTest, WalksThroughEveryCellOfARow) {
  const Segment<TypeParam> along_x = {{-2, 0.01F, 0.3F}, {2, 0.01F, 0.3F}};
  const Segment<TypeParam> along_z = {{0.01F, 0.01F, 2}, {0.01F, 0.01F, -2}};
  EXPECT_EQ(this->walk(along_x, Range{Path<TypeParam>(along_x)}).size(), 9U);
  EXPECT_EQ(this->walk(along_z, Range{Path<TypeParam>(along_z)}).size(), 5U);
}

TYPED_TEST(GridTraversalTest, IsUnclippedOnlyWhereItCannotBePlaced) {
  const auto at = [&](TypeParam distance) {
    return GridTraversal(this->grid_, Path<TypeParam>(Segment<TypeParam>{{distance, 0, 0}, {-distance, 0, 0}}), 0, 1);
  };
  EXPECT_FALSE(at(0x1p59F).is_unclipped());
  EXPECT_TRUE(at(0x1p63F).is_unclipped());
  EXPECT_TRUE(at(std::numeric_limits<TypeParam>::max()).is_unclipped());
  EXPECT_TRUE(at(0x1p63F).at_end());
}

TYPED_TEST(GridTraversalTest, StartsNearAndEndsAnywhere) {
  constexpr TypeParam largest = std::numeric_limits<TypeParam>::max();
  for (const TypeParam far : {TypeParam{0x1p63F}, largest / 4, largest}) {
    this->expect_found(Segment<TypeParam>{{0, 0, 1}, {far / 3, far / 5, -far}});
    this->expect_found(Segment<TypeParam>{{0.1F, 0, 1}, {0.1F, 0, -far}});
  }
  EXPECT_GE(this->met_, 6U);
}

}  // namespace
}  // namespace surehit::test
