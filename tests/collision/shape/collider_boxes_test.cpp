#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "collision/shape/shape_comparison.hpp"
#include "support/box_families.hpp"
#include "support/box_oracle.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::collider_boxes_test {
namespace {

constexpr auto by_judge = [](const auto& box, const auto& x, const auto& y) { return comes_before(box, x, y); };

template <typename Scalar>
class ColliderBoxes : public testing::Test {
 protected:
  static void compare(const TriangleMeshView<Scalar>& mesh, const std::vector<SweptBox<Scalar>>& boxes,
                      const std::string& what) {
    compare_with_brute_force(mesh, boxes, by_judge, what);
  }

  /// Boxes that begin in or beside the box of a mesh. Their steps are from a thousandth of it to twice its size.
  static std::vector<SweptBox<Scalar>> draw_boxes(const Box<Scalar>& around, std::size_t count, Random& random) {
    std::vector<SweptBox<Scalar>> boxes;
    const Vector3<Scalar> extent = around.high - around.low;
    const Scalar size = extent.maxCoeff();
    const auto vector = [&]() -> Vector3<Scalar> {
      const Scalar x = random.symmetric<Scalar>();
      const Scalar y = random.symmetric<Scalar>();
      return {x, y, random.symmetric<Scalar>()};
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3<Scalar> start = around.low + extent / 2 + extent.cwiseProduct(vector()) * Scalar(0.7);
      const Scalar reach = std::ldexp(size, -static_cast<int>(random.below(11)) + 1);
      const Vector3<Scalar> end = start + vector() * reach;
      Vector3<Scalar> half = vector().cwiseAbs() * std::ldexp(size, -static_cast<int>(random.below(14)));
      if (random.one_in(8)) half[static_cast<Eigen::Index>(random.below(3))] = 0;
      boxes.push_back({start, end, half});
    }
    return boxes;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ColliderBoxes, Scalars);

TYPED_TEST(ColliderBoxes, FindWhatBruteForceFindsInSmallMeshes) {
  using Scalar = TypeParam;
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    Random random(3 + kind);
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 6 : 2); ++i) {
      const SmallMesh<Scalar> mesh = draw_small_mesh<Scalar>(kind, random);
      std::vector<SweptBox<Scalar>> boxes;
      for (const Path<Scalar>& path : mesh.paths) {
        if (path.kind != PathKind::segment) continue;
        const Scalar length = (path.toward - path.start).cwiseAbs().maxCoeff();
        const auto extent = [&] { return length < Scalar(1e10) ? length * random.unit<Scalar>() / 4 : Scalar{1}; };
        const Scalar x = random.one_in(8) ? Scalar{0} : extent();
        const Scalar y = random.one_in(8) ? Scalar{0} : extent();
        boxes.push_back({path.start, path.toward, {x, y, extent()}});
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, name_of_small_mesh(kind)));
    }
  }
}

TYPED_TEST(ColliderBoxes, FindWhatBruteForceFindsInAllFamilies) {
  using Scalar = TypeParam;
  for (const BoxFamily family : all_box_families) {
    Random random(31 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 5 : 1); ++i) {
      // Each triangle has a box of its own, so a box comes close to one triangle at least.
      GeneratedMesh<Scalar> mesh;
      std::vector<SweptBox<Scalar>> boxes;
      for (std::size_t k = 0; k < 40; ++k) {
        const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
        mesh.add(triangle);
        boxes.push_back(box);
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, name_of(family)));
    }
  }
}

TYPED_TEST(ColliderBoxes, FindWhatBruteForceFindsInMeshesThatAreHardForGrids) {
  using Scalar = TypeParam;
  Random random(5);
  const auto compare = [&](const GeneratedMesh<Scalar>& mesh, const std::string& what) {
    const Box<Scalar> around = Collider<Scalar>(mesh.view()).box();
    this->compare(mesh.view(), this->draw_boxes(around, case_count(30), random), what);
  };
  ASSERT_NO_FATAL_FAILURE(compare(scattered_triangles<Scalar>(900, Scalar(0.1), random), "scattered"));
  ASSERT_NO_FATAL_FAILURE(compare(rough_ground<Scalar>(20, Scalar(0.2), random), "ground"));
  ASSERT_NO_FATAL_FAILURE(compare(line_of_needles<Scalar>(300, random), "needles"));
  ASSERT_NO_FATAL_FAILURE(compare(lattice_cube<Scalar>(8), "cube"));
  const auto ground = rough_ground<Scalar>(20, Scalar(0.2), random);
  const auto prop = placed(rough_ground<Scalar>(30, Scalar(0.2), random), Scalar(1e-4), Vector3<Scalar>(0, 0, 0));
  ASSERT_NO_FATAL_FAILURE(compare(joined(ground, prop), "prop"));
  const auto far = placed(rough_ground<Scalar>(10, Scalar(0.2), random), Scalar(1), Vector3<Scalar>(1000, -3000, 50));
  ASSERT_NO_FATAL_FAILURE(compare(far, "far"));
}

/// So fine a grid that a box of half its width has more cells on an edge than a cube of empty cells can have.
constexpr GridOptions fine_grid = {.resolution = {48, 48, 48}};

// Tiny triangles far from each other, so that boxes of all extents come through empty space first.
TYPED_TEST(ColliderBoxes, FindWhatIsBehindEmptySpaceWithAnyExtents) {
  using Scalar = TypeParam;
  Random random(11);
  for (std::size_t i = 0; i < case_count(10); ++i) {
    const auto mesh = scattered_triangles<Scalar>(60, Scalar(0.001), random);
    std::vector<SweptBox<Scalar>> boxes;
    while (boxes.size() < 200) {
      const auto vector = [&]() -> Vector3<Scalar> {
        const Scalar x = random.symmetric<Scalar>();
        const Scalar y = random.symmetric<Scalar>();
        return {x, y, random.symmetric<Scalar>()};
      };
      Vector3<Scalar> half = vector().cwiseAbs();
      for (Scalar& x : half) x = std::ldexp(x, -static_cast<int>(random.below(6)));
      const Vector3<Scalar> start = 2 * vector();
      // Now and then it stays on an axis.
      Vector3<Scalar> step = 3 * vector();
      for (Scalar& x : step) x = random.one_in(4) ? 0 : x;
      boxes.push_back({start, start + step, half});
    }
    ASSERT_NO_FATAL_FAILURE(compare_with_brute_force(mesh.view(), boxes, by_judge, "scattered", fine_grid));
  }
}

/// Returns how many cells a box with half the width of the grid comes to on some step. Only the ends of the grid have
/// triangles.
template <typename Scalar>
std::uint64_t cells_on_step(const Vector3<Scalar>& step) {
  GeneratedMesh<Scalar> mesh;
  for (const Scalar far : {Scalar{-24}, Scalar{24}}) {
    const Scalar near = far * Scalar(0.99);
    mesh.add({{far, far, far}, {near, far, far}, {far, near, far}});
  }
  const Collider<Scalar> collider(mesh.view(), {.grid = fine_grid});
  QueryStatistics statistics;
  const Vector3<Scalar> half(12, 12, 12);
  EXPECT_FALSE(collider.any_hit(SweptBox<Scalar>{-step / 2, step / 2, half}, {}, &statistics));
  return statistics.cells;
}

// Row by row, and slab by slab, these boxes would come to thousands of cells.
TYPED_TEST(ColliderBoxes, LeapOverEmptyCellsThoughTheyAreWiderThanTheLeaps) {
  using Scalar = TypeParam;
  const Vector3<Scalar> along(0, 0, 20);
  const Vector3<Scalar> askew(3, -2, 20);
  const Vector3<Scalar> diagonal(-20, 20, 20);
  const Vector3<Scalar> no_step(0, 0, 0);
  EXPECT_LT(cells_on_step<Scalar>(along), 40U);
  EXPECT_LT(cells_on_step<Scalar>(askew), 40U);
  EXPECT_LT(cells_on_step<Scalar>(diagonal), 100U);
  EXPECT_LT(cells_on_step<Scalar>(no_step), 20U);
}

TYPED_TEST(ColliderBoxes, FindAllThatIsThereFromAfarAndWithAnySize) {
  using Scalar = TypeParam;
  Random random(9);
  const auto mesh = rough_ground<Scalar>(5, Scalar(0.2), random);
  std::vector<SweptBox<Scalar>> boxes;
  for (const Scalar far : {Scalar(1e3), Scalar(1e12), std::sqrt(std::numeric_limits<Scalar>::max())}) {
    boxes.push_back({{far, 0, 1}, {-far, 0, -1}, {1, Scalar(0.1), 0}});
    boxes.push_back({{far, far, far}, {0, 0, 0}, {0, 0, 0}});
    boxes.push_back({{0, 0, far}, {0, 0, far / 2}, {1, 1, far / 2}});
    boxes.push_back({{far, 0, 0}, {0, far, 0}, {far, far, 1}});
  }
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, "ground"));
}

TYPED_TEST(ColliderBoxes, FindTrianglesThatAreMuchSmallerThanTheBox) {
  using Scalar = TypeParam;
  // Products of such sizes underflow one after the other.
  for (int exponent = std::numeric_limits<Scalar>::min_exponent; exponent < 0; exponent += 5) {
    const Scalar size = std::ldexp(Scalar{1}, exponent);
    GeneratedMesh<Scalar> mesh;
    mesh.add({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    mesh.add({{0, 0, size}, {size, 0, 0}, {0, size, -size}});
    const Scalar half = Scalar(0.5);
    const std::vector<SweptBox<Scalar>> boxes = {{{size / 4, -half, 0}, {size / 4, -half, 0}, {1, half, 1}},
                                                 {{Scalar(0.25), -2, 0}, {Scalar(0.25), -half, 0}, {1, half, 1}},
                                                 {{2, 2, 2}, {-2, -2, -2}, {half, half, half}}};
    ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, "2^" + std::to_string(exponent)));
  }
}

TYPED_TEST(ColliderBoxes, LetNothingThroughVerticesAndEdgesOfAClosedMesh) {
  using Scalar = TypeParam;
  Random random(17);
  const auto mesh = bumpy_octahedron<Scalar>(8, random);
  const Collider<Scalar> collider(mesh.view());
  const Scalar size = collider.box().high.maxCoeff();
  std::vector<SweptBox<Scalar>> boxes;
  for (std::size_t i = 0; i < case_count(4000); ++i) {
    const auto& corners = mesh.triangles[random.below(mesh.triangles.size())];
    const Vector3<Scalar>& a = mesh.vertices[corners[0]];
    const Vector3<Scalar>& b = mesh.vertices[corners[1]];
    const Vector3<Scalar> aim = random.one_in(2) ? a : Vector3<Scalar>((a + b) / 2);
    const auto extent = [&] { return std::ldexp(size, -static_cast<int>(random.between(3, 60))); };
    const Scalar x = extent();
    const Scalar y = extent();
    boxes.push_back({{0, 0, 0}, aim * 4, {x, y, extent()}});
  }
  std::vector<std::uint8_t> blocked(boxes.size());
  collider.any_hits(boxes, blocked);
  EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 0), 0);
}

TYPED_TEST(ColliderBoxes, KeepOptions) {
  using Scalar = TypeParam;
  Random random(21);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  const Collider<Scalar> collider(mesh.view());
  const auto boxes = this->draw_boxes(collider.box(), case_count(300), random);
  std::vector<ShapeHit<Scalar>> all;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ShapeQueryOptions<Scalar> options;
    options.max_t = random.unit<Scalar>() * 2;
    options.culling = static_cast<Culling>(random.below(3));
    options.ignore_start_contact = random.one_in(2);
    const auto expected = brute_force<SweptBox<Scalar>, Scalar>(mesh.view(), boxes[i], by_judge, options);
    collider.all_hits(boxes[i], all, options);
    ASSERT_EQ(all, expected) << i;
    ASSERT_EQ(collider.any_hit(boxes[i], options), !expected.empty()) << i;
    const auto first = expected.empty() ? ShapeHit<Scalar>{} : expected.front();
    ASSERT_EQ(collider.first_hit(boxes[i], options).value_or(ShapeHit<Scalar>{}), first) << i;
    hits += !expected.empty();
  }
  EXPECT_GE(hits, case_count(30));
}

TYPED_TEST(ColliderBoxes, FindTheLastFreeT) {
  using Scalar = TypeParam;
  Random random(23);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  const Collider<Scalar> collider(mesh.view());
  std::size_t rounded_down = 0;
  for (const auto& box : this->draw_boxes(collider.box(), case_count(1500), random)) {
    const auto hit = collider.first_hit(box);
    if (!hit) continue;
    const Scalar free = collider.last_free_t(box, *hit);
    if (hit->started_touching) {
      ASSERT_EQ(free, 0);
      continue;
    }
    rounded_down += free == hit->t;
    ASSERT_FALSE(collider.any_hit(box, {.max_t = free}));
    ASSERT_TRUE(collider.any_hit(box, {.max_t = std::nextafter(free, Scalar{2})}));
  }
  EXPECT_GE(rounded_down, case_count(40));
}

/// A floor of squares with sides of 1 at z = 0, each of two triangles. The centre is a vertex.
template <typename Scalar>
GeneratedMesh<Scalar> flat_floor(int half_count) {
  GeneratedMesh<Scalar> mesh;
  for (int x = -half_count; x < half_count; ++x) {
    for (int y = -half_count; y < half_count; ++y) {
      const Vector3<Scalar> corner = {static_cast<Scalar>(x), static_cast<Scalar>(y), 0};
      const auto at = [&](Scalar dx, Scalar dy) -> Vector3<Scalar> { return corner + Vector3<Scalar>(dx, dy, 0); };
      mesh.add({at(0, 0), at(1, 0), at(1, 1)});
      mesh.add({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh;
}

TYPED_TEST(ColliderBoxes, LandOnTheLowestIdOfAFlatFloorWithoutIntegers) {
  using Scalar = TypeParam;
  Random random(29);
  const auto mesh = flat_floor<Scalar>(4);
  const Collider<Scalar> collider(mesh.view());
  QueryStatistics statistics;
  std::vector<SweptBox<Scalar>> boxes;
  for (std::size_t i = 0; i < 200; ++i) {
    const Scalar x = random.symmetric<Scalar>();
    const Scalar y = random.symmetric<Scalar>();
    const SweptBox<Scalar> box{{x, y, 3}, {x, y + Scalar(0.5), -1}, {Scalar(1.25), Scalar(0.75), 1}};
    const auto hit = collider.first_hit(box, {}, &statistics);
    ASSERT_TRUE(hit);
    boxes.push_back(box);
  }
  EXPECT_EQ(statistics.exact_decisions, 0U);
  EXPECT_EQ(statistics.exact_orders, 0U);
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, "floor"));
}

TYPED_TEST(ColliderBoxes, LandOnTheHigherOfTwoFloorsThatAreAlmostOne) {
  using Scalar = TypeParam;
  GeneratedMesh<Scalar> mesh;
  for (const Scalar height : {Scalar{0}, Scalar(0x1p-70), Scalar(0x1p-80)}) {
    mesh.add({{-9, -9, height}, {9, -9, height}, {0, 9, height}});
    mesh.add({{-9, 9, height / 2}, {9, 9, height / 2}, {0, -9, height}});
  }
  const Collider<Scalar> collider(mesh.view());
  const SweptBox<Scalar> box{{0, 0, 3}, {0, 0, -3}, {1, 1, 1}};
  EXPECT_EQ(collider.first_hit(box)->triangle, 2U);
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), {box}, "floors"));
}

TYPED_TEST(ColliderBoxes, SlideOverAFlatFloorAtItsHeight) {
  using Scalar = TypeParam;
  const auto mesh = flat_floor<Scalar>(3);
  std::vector<SweptBox<Scalar>> boxes;
  for (const Scalar height : {std::nextafter(Scalar{1}, Scalar{2}), Scalar{1}, std::nextafter(Scalar{1}, Scalar{0})}) {
    boxes.push_back({{-9, Scalar(0.5), height}, {9, Scalar(0.5), height}, {1, 1, 1}});
    boxes.push_back({{Scalar(0.3), Scalar(0.4), height}, {2, 2, height}, {1, 1, 1}});
    boxes.push_back({{-9, -9, height}, {9, 9, height}, {Scalar(0.5), Scalar(0.5), 1}});
  }
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), boxes, "floor"));
  const Collider<Scalar> collider(mesh.view());
  EXPECT_FALSE(collider.any_hit(boxes[0]));
  EXPECT_EQ(collider.first_hit(boxes[3])->t, static_cast<Scalar>(5.0 / 18));
  EXPECT_TRUE(collider.overlaps(boxes[4]));
}

}  // namespace
}  // namespace surehit::test::collider_boxes_test
