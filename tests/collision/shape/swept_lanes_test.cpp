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

namespace surehit::test {
namespace {

using Point = std::array<double, 3>;

/// A moving box, and a triangle that it touches at some point before `end`.
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
      while (walking != 0) {
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

}  // namespace
}  // namespace surehit::test
