#include "grid/main_grid.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "grid/grid.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/neighbour.hpp"
#include "support/pair_text.hpp"
#include "support/random.hpp"
#include "walk/main_grid_path.hpp"

namespace surehit::test::main_grid_test {
namespace {

using OtherBox = MainGrid::OtherBox;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The sides of a box of `MainGrid`, counted in finest cells.
ExactBox exact_box(const GridFrame& frame, const OtherBox& box) {
  const Vector3<float> low(box.low[0], box.low[1], box.low[2]);
  const Vector3<float> high(box.high[0], box.high[1], box.high[2]);
  return {in_frame(frame, low), in_frame(frame, high)};
}

bool contains(const ExactBox& box, const ExactPoint& point) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (point[axis] < box.low[axis] || point[axis] > box.high[axis]) return false;
  }
  return true;
}

/// A mesh with a main part and up to four large triangles, and its grid. The mesh may be many widths away from the
/// origin, where floats are coarse.
struct Uneven {
  explicit Uneven(Random& random) {
    const float size = std::ldexp(1.0F, static_cast<int>(random.between(-30, 30)));
    const float distance = random.one_in(2) ? 0 : std::ldexp(size, static_cast<int>(random.between(4, 12)));
    const auto vector = [&](float length) -> Vector3<float> {
      return Vector3<float>::NullaryExpr([&] { return length * random.symmetric<float>(); });
    };
    const Vector3<float> place = vector(distance);
    mesh = placed<float>(rough_ground<float>(20, 0.3F, random), size / 64, place + vector(size));
    for (std::uint64_t i = 1 + random.below(3); i > 0; --i) {
      const Vector3<float> corner = place + vector(size);
      const float edge = random.one_in(2) ? size : size / 8;
      mesh.add({corner, corner + vector(edge), corner + vector(edge)});
    }
    grid = Grid(mesh.view(), box_of(mesh.view()), {});
  }

  GeneratedMesh<float> mesh;
  Grid grid;
};

/// L18: a path that meets a triangle of another list, in the cell of the list, is in a box of the main grid there.
TEST(MainGrid, HasBoxesAroundAllThatIsNotInIt) {
  Random random(20261127);
  std::size_t with_main_grid = 0;
  const std::size_t cases = case_count(2000);
  for (std::size_t i = 0; i < cases; ++i) {
    const Uneven uneven(random);
    const Grid& grid = uneven.grid;
    if (!grid.main_grid().exists()) continue;
    ++with_main_grid;
    std::vector<ExactBox> boxes;
    for (const OtherBox& box : grid.main_grid().boxes()) boxes.push_back(exact_box(grid.frame(), box));
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (leaf.word.is_empty()) continue;
      const bool has_main = leaf.word.has_inner_grid() && &grid.inner_frame(leaf.word) == &grid.main_frame();
      std::vector<std::uint32_t> others = triangles_in(grid, leaf.word);
      if (has_main) others.assign(grid.triangles(leaf.word).begin(), grid.triangles(leaf.word).end());
      for (const std::uint32_t id : others) {
        const ExactPolygon part = part_in(leaf.box(), in_frame(grid.frame(), uneven.mesh.view().triangle(id)));
        const bool is_in_one = std::any_of(boxes.begin(), boxes.end(), [&](const ExactBox& box) {
          return std::all_of(part.begin(), part.end(), [&](const ExactPoint& point) { return contains(box, point); });
        });
        EXPECT_TRUE(is_in_one) << "triangle " << id << " of mesh " << i;
      }
    }
  }
  EXPECT_GE(with_main_grid, cases / 4);
}

/// A ray and the part of it that counts.
struct RangedRay {
  Path<float> path;
  float first;
  float last;

  [[nodiscard]] bool meets(const OtherBox& box) const {
    mpq_class enters(double{first});
    std::optional<mpq_class> leaves;
    if (last < infinity) leaves = double{last};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const mpq_class start(double{path.start[k]});
      const mpq_class way(double{path.toward[k]});
      const mpq_class low(double{box.low[axis]});
      const mpq_class high(double{box.high[axis]});
      if (way == 0) {
        if (start < low || start > high) return false;
        continue;
      }
      mpq_class near = (low - start) / way;
      mpq_class far = (high - start) / way;
      if (near > far) std::swap(near, far);
      enters = std::max(enters, near);
      leaves = leaves ? std::min(*leaves, far) : far;
    }
    return !leaves || enters <= *leaves;
  }
};

/// Draws a ray that touches a corner of a box exactly, or comes as near to it as floats can tell. Its range may begin
/// or end there.
RangedRay draw_ray_to_corner(const OtherBox& box, Random& random) {
  Vector3<float> start;
  Vector3<float> way;
  const auto steps = static_cast<float>(random.between(1, 64));
  const bool is_exact = random.one_in(2);
  const float size = std::ldexp(1.0F, static_cast<int>(random.between(0, is_exact ? 6 : 20)));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const float corner = random.one_in(2) ? box.low[axis] : box.high[axis];
    const float ulp = neighbour(std::fabs(corner), 1) - std::fabs(corner);
    way[k] = ulp * size * static_cast<float>(random.between(-1000, 1000));
    start[k] = corner - steps * way[k];
    if (is_exact) continue;
    way[k] *= 1 + std::ldexp(random.symmetric<float>(), -static_cast<int>(random.between(5, 26)));
  }
  RangedRay ray = {Ray<float>{start, way}, 0, infinity};
  if (random.one_in(4)) (random.one_in(2) ? ray.first : ray.last) = steps;
  return ray;
}

/// L17 for a single path: no box is missed that is met.
TEST(MainGrid, IsEnoughOnlyForPathsThatMissAllOthers) {
  Random random(5);
  std::size_t meeting = 0;
  std::size_t missing = 0;
  const std::size_t rays = case_count(6000);
  std::optional<Uneven> uneven;
  for (std::size_t i = 0; i < rays; ++i) {
    if (i % 60 == 0) uneven.emplace(random);
    while (!uneven->grid.main_grid().exists()) uneven.emplace(random);
    const MainGrid& main = uneven->grid.main_grid();
    const std::span<const OtherBox> boxes = main.boxes();
    const RangedRay ray = draw_ray_to_corner(boxes[random.below(boxes.size())], random);
    const bool meets_any = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) { return ray.meets(box); });
    const bool misses = detail::misses_others(main, ray.path, ray.first, ray.last);
    EXPECT_FALSE(meets_any && misses) << hex_text(ray.path);
    meeting += meets_any ? 1 : 0;
    missing += misses ? 1 : 0;
  }
  EXPECT_GT(meeting, rays / 4);
  EXPECT_GT(missing, rays / 10);
}

}  // namespace
}  // namespace surehit::test::main_grid_test
