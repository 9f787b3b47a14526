#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "grid_walk.hpp"
#include "support/pair_families.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_traversal_range_test {
namespace {

/// Only a part of each path counts. This part may become shorter while the path is walked.
template <typename Scalar>
using GridTraversalRange = GridWalk<Scalar>;
TYPED_TEST_SUITE(GridTraversalRange, Scalars, ScalarNames);

TYPED_TEST(GridTraversalRange, finds_all_in_the_range) {
  PathDrawer<TypeParam> drawer(this->mesh_.view(), 7);
  for (std::size_t i = 0; i < case_count(1000); ++i) {
    const Path<TypeParam> path = drawer.draw();
    Range range(path);
    const TypeParam first = drawer.random().template symmetric<TypeParam>();
    range.first = std::max(range.first, double{first});
    range.last = std::min(range.last, double{first + drawer.random().template unit<TypeParam>()});
    this->expect_found(path, range);
  }
  EXPECT_GT(this->met_, 0U);
}

/// The limit is the exact t of a triangle or anything else, and comes at any step.
TYPED_TEST(GridTraversalRange, finds_all_that_is_not_out_of_reach) {
  this->place_ground(1, {0, 0, 0}, {.resolution = {5, 4, 2}, .crowded = 4});
  ASSERT_GT(this->grid_.levels(), 0U);
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
    if (cells.visited.size() < whole.visited.size()) ++shortened_walks;
    this->met_ += this->expect_listed(path, range, cells);
  }
  EXPECT_GT(this->met_, 0U);
  EXPECT_GT(shortened_walks, case_count(3000) / 20);
}

/// A wall just beyond a plane between cells is listed behind it alone: the walk must not end at the plane when the
/// range ends at the wall, nor begin behind it when the range begins there.
TYPED_TEST(GridTraversalRange, finds_walls_just_beside_a_plane_at_the_ends_of_the_range) {
  Random random(7);
  GeneratedMesh<TypeParam> corners;
  for (const TypeParam x : {TypeParam{0}, TypeParam{1}}) corners.add({{x, x, x}, {x, x, x}, {x, x, x}});
  const GridFrame frame = Grid(corners.view(), box_of(corners.view()), this->uniform()).frame();
  for (std::size_t i = 0; i < case_count(1500); ++i) {
    const std::size_t axis = random.below(3);
    const auto k = static_cast<Eigen::Index>(axis);
    const bool beyond = random.one_in(2);
    const double off = frame.padding(axis) * (1.25 + random.unit<double>()) * (beyond ? 1 : -1);
    const auto plane = static_cast<double>(random.between(1, frame.resolution(axis) - 1));
    const auto wall = static_cast<TypeParam>(out_of_frame(frame, axis, plane + off));
    Triangle<TypeParam> triangle{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    triangle.b[(k + 1) % 3] = triangle.c[(k + 2) % 3] = 1;
    triangle.a[k] = triangle.b[k] = triangle.c[k] = wall;
    GeneratedMesh<TypeParam> mesh = corners;
    mesh.add(triangle);
    this->build(std::move(mesh), this->uniform());

    const auto inside = [&] { return Vector3<TypeParam>::NullaryExpr([&] { return random.unit<TypeParam>(); }); };
    Segment<TypeParam> segment{inside() / 2, inside() / 2};
    const TypeParam reach = random.one_in(2) ? 1 : 100;
    segment.start[k] = wall - reach * random.unit<TypeParam>();
    segment.end[k] = wall + reach * random.unit<TypeParam>();
    const bool rises = random.one_in(2);
    if (!rises) std::swap(segment.start, segment.end);
    const Path<TypeParam> path = path_along(segment, static_cast<PathKind>(random.below(3)));
    const auto contact = exact_contact(path, triangle);
    if (!contact) continue;
    Range range(path);
    TypeParam t = nearest<TypeParam>(contact->t);  // the limits of a float path are floats
    if (beyond == rises) {                         // listed in the later cell
      if (t < contact->t) t = std::nextafter(t, std::numeric_limits<TypeParam>::infinity());
      Range shortened = range;
      this->met_ += this->expect_listed(path, shortened, this->walk_shortened(path, shortened, 0, t));
      range.last = t;
    } else {
      if (t > contact->t) t = std::nextafter(t, -std::numeric_limits<TypeParam>::infinity());
      range.first = t;
    }
    this->met_ += this->expect_listed(path, range, this->walk(path, range));
  }
  EXPECT_GT(this->met_, case_count(1500) / 2);
}

TYPED_TEST(GridTraversalRange, shorten_never_lengthens) {
  const Segment<TypeParam> segment = {{-2, 0.1F, 0.3F}, {2, 0.2F, 0.3F}};
  Range range{Path<TypeParam>(segment)};
  range.last = 0.5;
  const auto cells = this->walk(segment, range).visited;
  EXPECT_EQ(this->walk_shortened(segment, range, 0, 0.75).visited, cells);
}

}  // namespace
}  // namespace surehit::test::grid_traversal_range_test
