#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "collision/shape/shape_comparison.hpp"
#include "support/case_count.hpp"
#include "support/floating_point_mode.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/small_meshes.hpp"
#include "support/sphere_families.hpp"
#include "support/sphere_oracle.hpp"
#include "support/threads.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"

namespace surehit::test::collider_spheres_test {
namespace {

constexpr auto by_judge = [](const auto& sphere, const auto& x, const auto& y) { return comes_before(sphere, x, y); };

template <typename Scalar>
class ColliderSpheres : public testing::Test {
 protected:
  static void compare(const TriangleMeshView<Scalar>& mesh, const std::vector<SweptSphere<Scalar>>& spheres,
                      const std::string& what) {
    compare_with_brute_force(mesh, spheres, by_judge, what);
  }

  /// Balls that begin in or beside the box of a mesh. Their steps are from a thousandth of the box to twice its size.
  static std::vector<SweptSphere<Scalar>> draw_spheres(const Box<Scalar>& box, std::size_t count, Random& random) {
    std::vector<SweptSphere<Scalar>> spheres;
    const Vector3<Scalar> extent = box.high - box.low;
    const Scalar size = extent.maxCoeff();
    for (std::size_t i = 0; i < count; ++i) {
      const auto draw = [&] { return random.symmetric<Scalar>(); };
      const Vector3<Scalar> start =
          box.low + extent / 2 + extent.cwiseProduct(Vector3<Scalar>(draw(), draw(), draw())) * Scalar(0.7);
      const Scalar reach = std::ldexp(size, -static_cast<int>(random.below(11)) + 1);
      const Vector3<Scalar> end = start + Vector3<Scalar>(draw(), draw(), draw()) * reach;
      spheres.push_back({start, end, std::ldexp(size * random.unit<Scalar>(), -static_cast<int>(random.below(14)))});
    }
    return spheres;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ColliderSpheres, Scalars);

TYPED_TEST(ColliderSpheres, FindWhatBruteForceFindsInSmallMeshes) {
  using Scalar = TypeParam;
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    Random random(3 + kind);
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 6 : 2); ++i) {
      const SmallMesh<Scalar> mesh = draw_small_mesh<Scalar>(kind, random);
      std::vector<SweptSphere<Scalar>> spheres;
      for (const Path<Scalar>& path : mesh.paths) {
        if (path.kind != PathKind::segment) continue;
        const Scalar length = (path.toward - path.start).cwiseAbs().maxCoeff();
        const Scalar radius = length < Scalar(1e10) ? length * random.unit<Scalar>() / 4 : Scalar{1};
        spheres.push_back({path.start, path.toward, random.one_in(8) ? Scalar{0} : radius});
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), spheres, name_of_small_mesh(kind)));
    }
  }
}

TYPED_TEST(ColliderSpheres, FindWhatBruteForceFindsInAllFamilies) {
  using Scalar = TypeParam;
  for (const SphereFamily family : all_sphere_families) {
    Random random(31 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 8 : 2); ++i) {
      // Each triangle has a ball of its own, so a ball comes close to one triangle at least.
      GeneratedMesh<Scalar> mesh;
      std::vector<SweptSphere<Scalar>> spheres;
      for (std::size_t k = 0; k < 40; ++k) {
        const auto [sphere, triangle] = draw_sphere_pair<Scalar>(family, random);
        mesh.add(triangle);
        spheres.push_back(sphere);
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), spheres, name_of(family)));
    }
  }
}

TYPED_TEST(ColliderSpheres, FindWhatBruteForceFindsInMeshesThatAreHardForGrids) {
  using Scalar = TypeParam;
  Random random(5);
  const auto compare = [&](const GeneratedMesh<Scalar>& mesh, const std::string& what) {
    const Box<Scalar> box = Collider<Scalar>(mesh.view()).box();
    const auto spheres = this->draw_spheres(box, case_count(30), random);
    this->compare(mesh.view(), spheres, what);
  };
  ASSERT_NO_FATAL_FAILURE(compare(scattered_triangles<Scalar>(900, Scalar(0.1), random), "scattered"));
  ASSERT_NO_FATAL_FAILURE(compare(rough_ground<Scalar>(20, Scalar(0.2), random), "ground"));
  ASSERT_NO_FATAL_FAILURE(compare(smooth_bowl<Scalar>(20), "bowl"));
  ASSERT_NO_FATAL_FAILURE(compare(line_of_needles<Scalar>(300, random), "needles"));
  ASSERT_NO_FATAL_FAILURE(compare(dust_in_square<Scalar>(300, random), "dust"));
  ASSERT_NO_FATAL_FAILURE(compare(lattice_cube<Scalar>(8), "cube"));
  ASSERT_NO_FATAL_FAILURE(compare(grounds_askew<Scalar>(random), "askew"));
  // An inner grid, and one that is far smaller than the ball.
  const auto ground = rough_ground<Scalar>(20, Scalar(0.2), random);
  ASSERT_NO_FATAL_FAILURE(compare(with_small_copy(ground, Vector3<Scalar>(Scalar(0.3), 0, Scalar(0.1))), "copy"));
  const auto prop = placed(rough_ground<Scalar>(30, Scalar(0.2), random), Scalar(1e-4), Vector3<Scalar>(0, 0, 0));
  ASSERT_NO_FATAL_FAILURE(compare(joined(ground, prop), "prop"));
  const auto far = placed(rough_ground<Scalar>(10, Scalar(0.2), random), Scalar(1), Vector3<Scalar>(1000, -3000, 50));
  ASSERT_NO_FATAL_FAILURE(compare(far, "far"));
}

TYPED_TEST(ColliderSpheres, FindWhatIsBehindEmptySpace) {
  using Scalar = TypeParam;
  Random random(6);
  for (std::size_t i = 0; i < case_count(4); ++i) {
    // Tiny triangles far from each other in a fine grid, so the walk leaps over many cells. Balls are wider than a
    // cell.
    const auto mesh = scattered_triangles<Scalar>(100, Scalar(0.001), random);
    const Collider<Scalar> collider(mesh.view(), {.grid = {.resolution = {24, 24, 24}}});
    const auto draw = [&] {
      return Vector3<Scalar>(random.symmetric<Scalar>(), random.symmetric<Scalar>(), random.symmetric<Scalar>());
    };
    for (std::size_t k = 0; k < 600; ++k) {
      const SweptSphere<Scalar> sphere{draw(), draw(), Scalar(0.15) * random.unit<Scalar>()};
      const auto expected = brute_force(mesh.view(), sphere, by_judge);
      const ShapeHit<Scalar> first = expected.empty() ? ShapeHit<Scalar>{} : expected.front();
      ASSERT_TRUE(collider.first_hit(sphere).value_or(ShapeHit<Scalar>{}) == first);
      ASSERT_EQ(collider.any_hit(sphere), !expected.empty());
      const SweptSphere<Scalar> at_rest{sphere.start, sphere.start, sphere.radius};
      ASSERT_EQ(collider.overlaps(at_rest), !brute_force(mesh.view(), at_rest, by_judge).empty());
    }
  }
}

// The empty cube around the first cell that a shape at rest meets ends below the triangle.
TYPED_TEST(ColliderSpheres, FindWhatIsAboveEmptySpaceAtRest) {
  using Scalar = TypeParam;
  GeneratedMesh<Scalar> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.add({{16, 16, 16}, {15, 16, 16}, {16, 15, 16}});
  mesh.add({{9, 9, 13}, {10, 9, 13}, {9, 10, 13}});
  const Collider<Scalar> collider(mesh.view(), {.grid = {.resolution = {4, 4, 4}}});
  const Vector3<Scalar> below(Scalar(9.25), Scalar(9.25), Scalar(11.875));
  EXPECT_TRUE(collider.overlaps(SweptSphere<Scalar>{below, below, Scalar(1.25)}));
  EXPECT_FALSE(collider.overlaps(SweptSphere<Scalar>{below, below, 1}));
  const Vector3<Scalar> low(Scalar(9.25), Scalar(9.25), 8);
  EXPECT_TRUE(collider.overlaps(SweptBox<Scalar>{low, low, {Scalar(0.125), Scalar(0.125), 6}}));
  EXPECT_TRUE(collider.overlaps(SweptCapsule<Scalar>{low, low, {0, 0, 5}, Scalar(0.125)}));
}

TYPED_TEST(ColliderSpheres, FindAllThatIsThereFromAfarAndWithAnySize) {
  using Scalar = TypeParam;
  Random random(9);
  const auto mesh = rough_ground<Scalar>(5, Scalar(0.2), random);
  const Scalar largest = std::sqrt(std::numeric_limits<Scalar>::max());
  std::vector<SweptSphere<Scalar>> spheres;
  for (const Scalar far : {Scalar(1e3), Scalar(1e12), largest}) {
    spheres.push_back({{far, 0, 1}, {-far, 0, -1}, Scalar(0.1)});
    spheres.push_back({{far, far, far}, {0, 0, 0}, 0});
    spheres.push_back({{0, 0, far}, {0, 0, far / 2}, far / 2});
    spheres.push_back({{far, 0, 0}, {0, far, 0}, far});
  }
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), spheres, "ground"));
}

// The lists of a smooth mesh have slabs, far thinner than these balls, whose centres stay outside of them.
// One over such a step is not a number of the lanes, or the step itself is not.
TYPED_TEST(ColliderSpheres, FindContactsInStepsThatNearlyVanishOrOverflow) {
  using Scalar = TypeParam;
  const auto expect_hit = [](const Triangle<Scalar>& triangle, const SweptSphere<Scalar>& sphere) {
    GeneratedMesh<Scalar> mesh;
    mesh.add(triangle);
    const auto expected = intersect(sphere, triangle);
    ASSERT_TRUE(expected.has_value());
    EXPECT_EQ(Collider<Scalar>(mesh.view()).first_hit(sphere), expected);
  };
  const Triangle<Scalar> wall = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Scalar tiny = std::numeric_limits<Scalar>::min() / 8;
  expect_hit(wall, {{tiny, Scalar(0.25), Scalar(0.25)}, {-tiny, Scalar(0.5), Scalar(0.25)}, 0});
  expect_hit(wall, {{tiny, Scalar(0.25), Scalar(0.25)}, {-tiny, Scalar(0.25), Scalar(0.25)}, 0});
  const Scalar large = std::numeric_limits<Scalar>::max();
  const Triangle<Scalar> floor = {
      {-large / 1000, -large / 1000, 0}, {large / 1000, -large / 1000, 0}, {0, large / 1000, 0}};
  expect_hit(floor, {{large * Scalar(-0.75), large / 8, large / 10000},
                     {large * Scalar(0.75), large / -8, large / 10000},
                     large / 100});
}

TYPED_TEST(ColliderSpheres, TouchASmoothMeshFromOutsideOfItsSlabs) {
  using Scalar = TypeParam;
  const GeneratedMesh<Scalar> mesh = smooth_bowl<Scalar>(60);
  const TriangleMeshView<Scalar> view = mesh.view();
  const Collider<Scalar> collider(view);
  Random random(23);
  for (std::size_t i = 0; i < case_count(400); ++i) {
    const auto id = static_cast<std::uint32_t>(random.below(view.triangle_count()));
    const Triangle<Scalar> triangle = view.triangle(id);
    const Vector3<Scalar> inside = (triangle.a + triangle.b + triangle.c) / 3;
    const Vector3<Scalar> normal = surehit::normal(triangle) * (random.one_in(2) ? 1 : -1);
    const Scalar radius = (triangle.b - triangle.a).norm() * (1 + 4 * random.unit<Scalar>());
    const SweptSphere<Scalar> sphere = {inside + 2 * radius * normal, inside + radius * normal * Scalar(0.9), radius};
    ASSERT_TRUE(intersect(sphere, triangle).has_value());
    ASSERT_TRUE(collider.any_hit(sphere)) << "ball " << i;
    std::vector<ShapeHit<Scalar>> hits;
    collider.all_hits(sphere, hits);
    const bool has_it = std::any_of(hits.begin(), hits.end(), [&](const auto& hit) { return hit.triangle == id; });
    ASSERT_TRUE(has_it) << "ball " << i;
  }
}

TYPED_TEST(ColliderSpheres, FindTrianglesThatAreMuchSmallerThanTheBall) {
  using Scalar = TypeParam;
  // Squares of such sizes underflow one after the other. The judge takes long for the numbers of doubles.
  const int step = sizeof(Scalar) == 4 || runs_all_cases() ? 5 : 25;
  for (int exponent = std::numeric_limits<Scalar>::min_exponent; exponent < 0; exponent += step) {
    const Scalar size = std::ldexp(Scalar{1}, exponent);
    GeneratedMesh<Scalar> mesh;
    mesh.add({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    mesh.add({{0, 0, size}, {size, 0, 0}, {0, size, -size}});
    const Scalar half = Scalar(0.5);
    const std::vector<SweptSphere<Scalar>> spheres = {{{size / 4, -half, 0}, {size / 4, -half, 0}, 1},
                                                      {{Scalar(0.25), -2, 0}, {Scalar(0.25), -half, 0}, 1},
                                                      {{2, 2, 2}, {-2, -2, -2}, half}};
    ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), spheres, "2^" + std::to_string(exponent)));
  }
}

TYPED_TEST(ColliderSpheres, LetNothingThroughVerticesAndEdgesOfAClosedMesh) {
  using Scalar = TypeParam;
  Random random(17);
  const auto mesh = bumpy_octahedron<Scalar>(8, random);
  const Collider<Scalar> collider(mesh.view());
  const Scalar size = collider.box().high.maxCoeff();
  std::vector<SweptSphere<Scalar>> spheres;
  for (std::size_t i = 0; i < case_count(4000); ++i) {
    const auto& corners = mesh.triangles[random.below(mesh.triangles.size())];
    const Vector3<Scalar>& a = mesh.vertices[corners[0]];
    const Vector3<Scalar>& b = mesh.vertices[corners[1]];
    const Vector3<Scalar> aim = random.one_in(2) ? a : Vector3<Scalar>((a + b) / 2);
    spheres.push_back({{0, 0, 0}, aim * 4, std::ldexp(size, -static_cast<int>(random.between(3, 60)))});
  }
  std::vector<std::uint8_t> blocked(spheres.size());
  collider.any_hits(spheres, blocked);
  EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 0), 0);
}

TYPED_TEST(ColliderSpheres, KeepMasksFiltersAndOptions) {
  using Scalar = TypeParam;
  Random random(21);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  std::vector<std::uint32_t> masks(mesh.triangles.size());
  for (auto& mask : masks) mask = static_cast<std::uint32_t>(random.below(4));
  const Collider<Scalar> collider(mesh.view(), {.masks = masks});
  const auto spheres = this->draw_spheres(collider.box(), case_count(300), random);
  std::vector<ShapeQueryOptions<Scalar>> options(spheres.size());
  for (auto& one : options) {
    one.max_t = random.unit<Scalar>() * 2;
    one.culling = static_cast<Culling>(random.below(3));
    one.mask = static_cast<std::uint32_t>(1 + random.below(3));
    one.ignored_triangle = static_cast<std::uint32_t>(random.below(masks.size()));
    one.ignore_start_contact = random.one_in(2);
  }
  const auto is_even = [](const ShapeHit<Scalar>& hit) { return hit.triangle % 2 == 0; };
  std::vector<ShapeHit<Scalar>> firsts(spheres.size());
  collider.first_hits(spheres, firsts, {.path_options = options, .filter = is_even});
  std::vector<ShapeHit<Scalar>> all;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    auto expected = brute_force(mesh.view(), spheres[i], by_judge, options[i]);
    std::erase_if(expected, [&](const auto& hit) { return (masks[hit.triangle] & options[i].mask) == 0; });
    collider.all_hits(spheres[i], all, options[i]);
    ASSERT_EQ(all, expected) << i;
    ASSERT_EQ(collider.any_hit(spheres[i], options[i]), !expected.empty()) << i;
    std::erase_if(expected, [&](const auto& hit) { return !is_even(hit); });
    collider.all_hits(spheres[i], all, is_even, options[i]);
    ASSERT_EQ(all, expected) << i;
    ASSERT_EQ(collider.any_hit(spheres[i], is_even, options[i]), !expected.empty()) << i;
    const auto first = expected.empty() ? ShapeHit<Scalar>{} : expected.front();
    ASSERT_EQ(collider.first_hit(spheres[i], is_even, options[i]).value_or(ShapeHit<Scalar>{}), first) << i;
    ASSERT_EQ(firsts[i], first) << i;
    hits += !expected.empty();
  }
  EXPECT_GE(hits, case_count(30) / 2);
}

TYPED_TEST(ColliderSpheres, OverlapAtTheStartWhateverTheRestOfTheStepIs) {
  using Scalar = TypeParam;
  GeneratedMesh<Scalar> mesh;
  mesh.add({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  mesh.add({{0, 0, 9}, {4, 0, 9}, {0, 4, 9}});
  const Collider<Scalar> collider(mesh.view());
  const Vector3<Scalar> beyond = {1, 1, std::numeric_limits<Scalar>::infinity()};
  EXPECT_TRUE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 2}, beyond, 2}, {.ignore_start_contact = true}));
  EXPECT_TRUE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 2}, beyond, 2}, {.max_t = -1}));
  for (const Culling culling : {Culling::back, Culling::front}) {
    EXPECT_TRUE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 2}, beyond, 2}, {.culling = culling}));
    EXPECT_FALSE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 3}, {1, 1, 9}, 2}, {.culling = culling}));
  }
  EXPECT_FALSE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 3}, {1, 1, 9}, 2}, {.max_t = 1}));
  EXPECT_FALSE(collider.overlaps(SweptSphere<Scalar>{{1, 1, 2}, {1, 1, 2}, 2}, {.ignored_triangle = 0}));
  const SweptSphere<Scalar> leaves = {{1, 1, 2}, {1, 1, 9}, 2};  // and comes to the other one
  EXPECT_TRUE(collider.overlaps(leaves, [](const ShapeHit<Scalar>& hit) { return hit.triangle == 0; }));
  EXPECT_FALSE(collider.overlaps(leaves, [](const ShapeHit<Scalar>& hit) { return hit.triangle == 1; }));
  EXPECT_TRUE(collider.overlaps(leaves, [](const ShapeHit<Scalar>& hit) { return hit.started_touching; },
                                {.ignore_start_contact = true}));
}

TYPED_TEST(ColliderSpheres, FindTheLastFreeT) {
  using Scalar = TypeParam;
  Random random(23);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  const Collider<Scalar> collider(mesh.view());
  std::size_t rounded_down = 0;
  for (const auto& sphere : this->draw_spheres(collider.box(), case_count(1500), random)) {
    const auto hit = collider.first_hit(sphere);
    if (!hit) continue;
    const Scalar free = collider.last_free_t(sphere, *hit);
    if (hit->started_touching) {
      ASSERT_EQ(free, 0);
      continue;
    }
    rounded_down += free == hit->t;
    ASSERT_FALSE(collider.any_hit(sphere, {.max_t = free}));
    ASSERT_TRUE(collider.any_hit(sphere, {.max_t = std::nextafter(free, Scalar{2})}));
  }
  EXPECT_GE(rounded_down, case_count(40));
}

TYPED_TEST(ColliderSpheres, FindTheLastFreeTWithFlushToZero) {
  using Scalar = TypeParam;
  const Scalar far = std::numeric_limits<Scalar>::max() / 2;
  GeneratedMesh<Scalar> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Collider<Scalar> collider(mesh.view());
  const SweptSphere<Scalar> sphere{
      {Scalar(0.25), Scalar(0.25), 1 + Scalar(0x1p-20)}, {Scalar(0.25), Scalar(0.25), -far}, 1};
  const ShapeHit<Scalar> hit = collider.first_hit(sphere).value();
  ASSERT_LT(hit.t, std::numeric_limits<Scalar>::min());
  const Scalar free = collider.last_free_t(sphere, hit);
  EXPECT_GT(free, 0);
  Scalar flushed = 0;
  {
    const FloatingPointModeScope mode({"flush to zero", FE_TONEAREST, true});
    flushed = collider.last_free_t(sphere, hit);
  }
  EXPECT_EQ(flushed, free);
}

TYPED_TEST(ColliderSpheres, AnswerABatchInTasksOfAnExecutor) {
  using Scalar = TypeParam;
  Random random(25);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  const Collider<Scalar> collider(mesh.view());
  const auto spheres = this->draw_spheres(collider.box(), 1500, random);
  std::vector<ShapeHit<Scalar>> alone(spheres.size());
  std::vector<ShapeHit<Scalar>> together(spheres.size());
  QueryStatistics statistics;
  collider.first_hits(spheres, alone);
  const Threads threads(3);
  collider.first_hits(spheres, together, {.executor = Executor(threads), .statistics = &statistics});
  EXPECT_EQ(alone, together);
  EXPECT_EQ(statistics.paths, spheres.size());
  // The batch ends with the shorter of balls and hits.
  std::vector<ShapeHit<Scalar>> few(7);
  collider.first_hits(std::span(spheres).first(3), few);
  EXPECT_EQ(few[2], alone[2]);
  EXPECT_EQ(few[3], ShapeHit<Scalar>{});
}

// More of them than there are lanes come near nothing, before one that hits, and in other batches after it.
TYPED_TEST(ColliderSpheres, AnswerTheLastOfABatchThatMostlyMisses) {
  using Scalar = TypeParam;
  GeneratedMesh<Scalar> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.add({{0, 0, -4}, {1, 0, -4}, {0, 1, -4}});  // So cells are wider than the balls.
  const Collider<Scalar> collider(mesh.view());
  const Scalar radius = Scalar(0.0625);
  const SweptSphere<Scalar> passing{{-1, 0, 2}, {1, 1, 2}, radius};
  const SweptSphere<Scalar> hitting{{Scalar(0.25), Scalar(0.25), 1}, {Scalar(0.25), Scalar(0.25), -1}, radius};
  const SweptSphere<Scalar> invalid{{0, 0, 0}, {0, 0, 0}, -1};
  for (const std::size_t index : {0U, 1U, 15U, 16U, 17U, 40U, 99U}) {
    std::vector<SweptSphere<Scalar>> spheres(100, passing);
    spheres[50] = invalid;
    spheres[index] = hitting;
    std::vector<ShapeHit<Scalar>> hits(spheres.size());
    std::vector<std::uint8_t> blocked(spheres.size(), 2);
    QueryStatistics statistics;
    collider.first_hits(spheres, hits, {.statistics = &statistics});
    collider.any_hits(spheres, blocked);
    EXPECT_EQ(statistics.paths, spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      ASSERT_EQ(hits[i].triangle, i == index ? 0 : no_triangle) << i;
      ASSERT_EQ(blocked[i], i == index ? 1 : 0) << i;
    }
    EXPECT_EQ(hits[index].t, (1 - radius) / 2);
  }
}

TYPED_TEST(ColliderSpheres, VisitFewCells) {
  using Scalar = TypeParam;
  Random random(27);
  const auto mesh = rough_ground<Scalar>(100, Scalar(0.05), random);
  const Collider<Scalar> collider(mesh.view());
  QueryStatistics point;
  QueryStatistics small;
  QueryStatistics large;
  for (std::size_t i = 0; i < 200; ++i) {
    const Scalar x = random.symmetric<Scalar>() / 2;
    const Scalar y = random.symmetric<Scalar>() / 2;
    const SweptSphere<Scalar> step{{x, y, Scalar(0.5)}, {x + Scalar(0.02), y, Scalar(-0.5)}, Scalar(0.0005)};
    static_cast<void>(collider.first_hit(SweptSphere<Scalar>{step.start, step.end, 0}, {}, &point));
    static_cast<void>(collider.first_hit(step, {}, &small));
    static_cast<void>(collider.first_hit(SweptSphere<Scalar>{step.start, step.end, Scalar(0.3)}, {}, &large));
  }
  EXPECT_LT(small.cells, 3 * point.cells);
  EXPECT_LT(small.candidates, 3 * point.candidates);
  EXPECT_LT(large.candidates, 200 * mesh.triangles.size() / 4);
  EXPECT_LT(large.cells, 200 * mesh.triangles.size() / 30);
  EXPECT_LT(large.undecided, 200 * mesh.triangles.size() / 80);
}

// A fuzzer found the first one: one over the step on an axis is infinite.
TYPED_TEST(ColliderSpheres, HitWithADenormalStepOnAnAxis) {
  using Scalar = TypeParam;
  const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();
  for (const Scalar height : {33 * tiny, -33 * tiny, tiny}) {
    for (const Scalar radius : {Scalar{0}, tiny}) {
      GeneratedMesh<Scalar> mesh;
      mesh.add({{0, 0, -2}, {0, 0, -2}, {0, 0, -2}});
      const Collider<Scalar> collider(mesh.view());
      const SweptSphere<Scalar> down{{0, height, 4}, {0, 0, -2}, radius};
      const SweptSphere<Scalar> up{down.end, down.start, radius};
      EXPECT_EQ(collider.first_hit(down), intersect(down, collider.triangle(0)));
      EXPECT_TRUE(collider.any_hit(down));
      EXPECT_TRUE(collider.any_hit(up));
    }
  }
}

TYPED_TEST(ColliderSpheres, MissAColliderWithoutTriangles) {
  using Scalar = TypeParam;
  const Collider<Scalar> collider;
  EXPECT_FALSE(collider.first_hit(SweptSphere<Scalar>{{0, 0, 0}, {1, 1, 1}, 5}));
  EXPECT_FALSE(collider.any_hit(SweptSphere<Scalar>{{0, 0, 0}, {1, 1, 1}, 5}));
}

}  // namespace
}  // namespace surehit::test::collider_spheres_test
