#include "walk/swept_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "grid/list_cells.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "surehit/box.hpp"

namespace surehit::test::swept_lanes_test {
namespace {

using Point = std::array<double, 3>;

/// A moving box, and a triangle that it touches at some point before `end`, where one is known.
struct Touch {
  Point start, end, half;
  std::uint32_t triangle;
  float last_t;
};

/// What the walk of one box came to.
struct Visited {
  bool is_apart = false;
  std::set<std::uint32_t> triangles;  ///< Those of all lists, and of all that lies below bricks.
  std::vector<std::size_t> cells;     ///< The words that were visited.
};

/// Lets small boxes walk in lanes to points of triangles that they touch at known times (W6, W7).
class SweptLanesTest : public testing::Test {
 protected:
  static Point number(const Vector3<float>& point) { return {point[0], point[1], point[2]}; }

  /// Draws boxes of at most `reach` that touch points of the mesh with a face, an edge or their inside.
  static std::vector<Touch> draw(const GeneratedMesh<float>& mesh, double reach, Random& random) {
    const TriangleMeshView<float> view = mesh.view();
    const Box<float> box = box_of(view);
    const double size = (box.high - box.low).maxCoeff();
    std::vector<Touch> touches;
    for (std::size_t i = 0; i < case_count(3000); ++i) {
      Touch touch;
      touch.triangle = static_cast<std::uint32_t>(random.below(view.triangle_count()));
      const Triangle<float> triangle = view.triangle(touch.triangle);
      const Point point = number(random.one_in(3) ? triangle.a : random.one_in(2) ? triangle.b : triangle.c);
      const double t = random.one_in(8) ? 0 : random.one_in(8) ? 1 : random.unit<double>();
      const double length = std::ldexp(size, 1 - static_cast<int>(random.below(12)));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        touch.half[axis] = reach * random.unit<double>();
        const double side = random.one_in(3) ? -1 : random.one_in(2) ? 1 : random.symmetric<double>();
        const double way = random.one_in(6) ? 0 : length * random.symmetric<double>();
        touch.start[axis] = point[axis] + side * touch.half[axis] - t * way;
        touch.end[axis] = touch.start[axis] + way;
        // What the sums above have rounded.
        touch.half[axis] += (size + std::fabs(point[axis])) * 0x1p-48;
      }
      touch.last_t = SweptLanes::beyond(t);
      touches.push_back(touch);
    }
    return touches;
  }

  /// More steps than any walk makes: it crosses the planes of each axis, and few of them again.
  static std::size_t max_steps(const Grid& grid) {
    const auto& cells = grid.frame().cells;
    return 2 * (std::size_t{cells[0]} + cells[1] + cells[2]) + 8;
  }

  static void add(const Grid& grid, CellWord word, Visited& visited) {
    for (const std::uint32_t id : grid.triangles(word)) visited.triangles.insert(id);
  }
  static void add_all(const Grid& grid, const GridFrame& frame, std::size_t first, std::size_t last, Visited& visited) {
    detail::visit_list_cells(grid, frame, first, last, [&](const detail::ListCell& cell) {
      add(grid, cell.word, visited);
      if (!cell.word.has_inner_grid()) return;
      const GridFrame& inner = grid.inner_frame(cell.word);
      add_all(grid, inner, 0, std::size_t{inner.cells[0]} * inner.cells[1] * inner.cells[2], visited);
    });
  }

  static std::vector<Visited> walk(const Grid& grid, const std::vector<Touch>& touches) {
    std::vector<Visited> all(touches.size());
    SweptLanes lanes(grid, nullptr);
    SweptLanes::Entering entering = {};
    SweptLanes::Arrivals arrivals;
    for (std::size_t first = 0; first < touches.size(); first += SweptLanes::count) {
      const std::size_t count = std::min(SweptLanes::count, touches.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Touch& touch = touches[first + lane];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          entering.start[axis][lane] = touch.start[axis];
          entering.end[axis][lane] = touch.end[axis];
          entering.half_extents[axis][lane] = touch.half[axis];
        }
        lanes.end[lane] = touch.last_t;
      }
      std::uint32_t apart = 0;
      std::uint32_t walking = lanes.enter(entering, (1U << count) - 1, apart);
      for (std::size_t lane = 0; lane < count; ++lane) all[first + lane].is_apart = (apart >> lane & 1) != 0;
      for (std::size_t steps = 0; walking != 0; ++steps) {
        if (steps == max_steps(grid)) {
          ADD_FAILURE() << "The walk does not end.";
          return all;
        }
        lanes.step(walking, arrivals);
        for (std::size_t k = 0; k < SweptLanes::max_cells; ++k) {
          for (std::size_t lane = 0; lane < count; ++lane) {
            Visited& visited = all[first + lane];
            const CellWord word(arrivals.words[k][lane]);
            if ((arrivals.lists[k] >> lane & 1) != 0) {
              add(grid, word, visited);
              visited.cells.push_back(word.list());
            }
            if ((arrivals.bricks[k] >> lane & 1) == 0) continue;
            const auto cell = lanes.cell(arrivals, k, lane);
            const GridFrame& frame = grid.frame();
            const std::size_t top = cell[0] + frame.cells[0] * (cell[1] + std::size_t{frame.cells[1]} * cell[2]);
            EXPECT_EQ(grid.all_top()[frame.first_top + top].bits(), word.bits());
            add_all(grid, frame, top, top + 1, visited);
          }
        }
        walking &= ~arrivals.ended;
      }
    }
    return all;
  }

  void check(const GeneratedMesh<float>& mesh, const GridOptions& options, const std::string& what) {
    const Grid grid(mesh.view(), box_of(mesh.view()), options);
    const GridFrame& frame = grid.frame();
    const double finest =
        frame.division / *std::max_element(frame.scale.begin(), frame.scale.end()) / frame.unit[0] / frame.unit[1];
    const std::vector<Touch> touches = draw(mesh, finest * 0.44, random_);
    const std::vector<Visited> all = walk(grid, touches);
    std::size_t apart = 0;
    std::size_t visited = 0;
    std::size_t twice = 0;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (all[i].is_apart) {
        ++apart;
        continue;
      }
      ASSERT_TRUE(all[i].triangles.contains(touches[i].triangle)) << what << ", box " << i;
      std::vector<std::size_t> cells = all[i].cells;
      std::sort(cells.begin(), cells.end());
      visited += cells.size();
      twice += static_cast<std::size_t>(cells.end() - std::unique(cells.begin(), cells.end()));
    }
    EXPECT_LE(twice, visited / 500) << what;
    EXPECT_LT(apart, touches.size() * 3 / 4) << what;
  }

  /// Draws small triangles in a cube of cells, and small boxes that go along its diagonals or those of its sides.
  void check_diagonals(std::uint32_t resolution) {
    GeneratedMesh<float> mesh;
    const auto add = [&](const Vector3<float>& at) {
      const Vector3<float> inward = (at.array() < 0.5F).select(Vector3<float>::Constant(1e-4F), -1e-4F);
      mesh.add({at, at + inward[0] * Vector3<float>::UnitX(), at + inward[1] * Vector3<float>::UnitY()});
    };
    add({0, 0, 0});
    add({1, 1, 1});
    for (std::uint64_t count = random_.below(3000); count != 0; --count) {
      add({random_.unit<float>(), random_.unit<float>(), random_.unit<float>()});
    }
    const Grid grid(mesh.view(), box_of(mesh.view()), {.resolution = {resolution, resolution, resolution}});
    std::vector<Touch> boxes(case_count(2000));
    for (Touch& box : boxes) {
      const double start = 1.2 * random_.unit<double>() - 0.1;
      const double way = random_.unit<double>();
      const double half = random_.one_in(5) ? 0 : 0.4 * random_.unit<double>() / resolution;
      const std::uint64_t other_axis = random_.below(6);  // None from 3 on.
      const double other_start = random_.one_in(2) ? start : random_.unit<double>();
      const double other_way = random_.symmetric<double>();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_other = axis == other_axis;
        box.start[axis] = is_other ? other_start : start;
        box.end[axis] = box.start[axis] + (is_other ? other_way : way);
        box.half[axis] = half;
        if (!random_.one_in(3)) continue;
        box.start[axis] = 1 - box.start[axis];
        box.end[axis] = 1 - box.end[axis];
      }
      box.last_t = SweptLanes::beyond(1);
    }
    walk(grid, boxes);
  }

  Random random_ = Random(101);
};

TEST_F(SweptLanesTest, come_to_each_cell_with_a_touched_point) {
  ASSERT_NO_FATAL_FAILURE(
      check(scattered_triangles<float>(100, 0.001F, random_), {.resolution = {24, 24, 24}}, "dust"));
  ASSERT_NO_FATAL_FAILURE(check(scattered_triangles<float>(900, 0.1F, random_), {}, "scattered"));
  ASSERT_NO_FATAL_FAILURE(check(rough_ground<float>(20, 0.2F, random_), {}, "ground"));
  ASSERT_NO_FATAL_FAILURE(check(lattice_cube<float>(8), {}, "cube"));
  ASSERT_NO_FATAL_FAILURE(check(line_of_needles<float>(300, random_), {}, "needles"));
  const auto ground = rough_ground<float>(20, 0.2F, random_);
  ASSERT_NO_FATAL_FAILURE(check(with_small_copy(ground, Vector3<float>(0.3F, 0, 0.1F)), {}, "copy"));
  const auto far = placed(rough_ground<float>(10, 0.2F, random_), 1.0F, Vector3<float>(1000, -3000, 50));
  ASSERT_NO_FATAL_FAILURE(check(far, {}, "far"));
}

// Positions are rounded down to before planes that two or three axes cross at the same t (W7).
TEST_F(SweptLanesTest, end_where_axes_cross_planes_together) {
  for (std::uint32_t resolution = 2; resolution < 62; resolution += 3) {
    check_diagonals(resolution);
    ASSERT_FALSE(HasFailure()) << "resolution " << resolution;
  }
}

}  // namespace
}  // namespace surehit::test::swept_lanes_test
