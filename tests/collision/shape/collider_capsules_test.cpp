#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "collision/shape/shape_comparison.hpp"
#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::collider_capsules_test {
namespace {

template <typename Scalar>
class ColliderCapsules : public testing::Test {
 protected:
  /// Asks a collider of the mesh about capsules in every way, and compares with brute force.
  static void compare(const TriangleMeshView<Scalar>& mesh, const std::vector<SweptCapsule<Scalar>>& capsules,
                      const std::string& what) {
    compare_with_brute_force(
        mesh, capsules, [](const auto& capsule, const auto& x, const auto& y) { return comes_before(capsule, x, y); },
        what);
  }

  /// Capsules that begin in or beside the box of a mesh. Their steps, axes and radii are of many sizes.
  static std::vector<SweptCapsule<Scalar>> draw_capsules(const Box<Scalar>& box, std::size_t count, Random& random) {
    std::vector<SweptCapsule<Scalar>> capsules;
    const Vector3<Scalar> extent = box.high - box.low;
    const Scalar size = extent.maxCoeff();
    const auto vector = [&]() -> Vector3<Scalar> {
      const Scalar x = random.symmetric<Scalar>();
      const Scalar y = random.symmetric<Scalar>();
      return {x, y, random.symmetric<Scalar>()};
    };
    const auto length = [&](std::uint64_t steps) {
      return std::ldexp(size, 1 - static_cast<int>(random.below(steps)));
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3<Scalar> start = box.low + extent / 2 + extent.cwiseProduct(vector()) * Scalar(0.7);
      const Vector3<Scalar> end = start + vector() * length(11);
      Vector3<Scalar> axis = vector() * length(14) / 4;
      if (random.one_in(3)) axis[0] = axis[1] = 0;
      const Scalar radius = random.unit<Scalar>() * length(14) / 8;
      capsules.push_back({start, end, axis, random.one_in(8) ? Scalar{0} : radius});
    }
    return capsules;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ColliderCapsules, Scalars);

TYPED_TEST(ColliderCapsules, FindWhatBruteForceFindsInSmallMeshes) {
  using Scalar = TypeParam;
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    Random random(3 + kind);
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 4 : 1); ++i) {
      const SmallMesh<Scalar> mesh = draw_small_mesh<Scalar>(kind, random);
      std::vector<SweptCapsule<Scalar>> capsules;
      for (const Path<Scalar>& path : mesh.paths) {
        if (path.kind != PathKind::segment) continue;
        const Scalar length = (path.toward - path.start).cwiseAbs().maxCoeff();
        const Scalar size = length < Scalar(1e10) ? length / 4 : Scalar{1};
        const Scalar radius = random.one_in(8) ? Scalar{0} : size * random.unit<Scalar>();
        Vector3<Scalar> axis(random.symmetric<Scalar>(), 0, 0);
        if (random.one_in(2)) axis[1] = random.symmetric<Scalar>();
        if (random.one_in(2)) axis[2] = random.symmetric<Scalar>();
        capsules.push_back({path.start, path.toward, axis * size, radius});
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), capsules, name_of_small_mesh(kind)));
    }
  }
}

TYPED_TEST(ColliderCapsules, FindWhatBruteForceFindsInAllFamilies) {
  using Scalar = TypeParam;
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(31 + static_cast<std::uint64_t>(family));
    const bool is_long = family == CapsuleFamily::mixed_magnitudes && sizeof(Scalar) == 8;
    for (std::size_t i = 0; i < case_count(sizeof(Scalar) == 4 ? 2 : 1); ++i) {
      // Each triangle has a capsule of its own, so a capsule comes close to one triangle at least.
      GeneratedMesh<Scalar> mesh;
      std::vector<SweptCapsule<Scalar>> capsules;
      for (std::size_t k = 0; k < (is_long ? 6 : 30); ++k) {
        const auto [capsule, triangle] = draw_capsule_pair<Scalar>(family, random);
        mesh.add(triangle);
        capsules.push_back(capsule);
      }
      ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), capsules, name_of(family)));
    }
  }
}

TYPED_TEST(ColliderCapsules, FindWhatBruteForceFindsInMeshesThatAreHardForGrids) {
  using Scalar = TypeParam;
  Random random(5);
  const auto compare = [&](const GeneratedMesh<Scalar>& mesh, const std::string& what) {
    const Box<Scalar> box = Collider<Scalar>(mesh.view()).box();
    this->compare(mesh.view(), this->draw_capsules(box, case_count(20), random), what);
  };
  ASSERT_NO_FATAL_FAILURE(compare(scattered_triangles<Scalar>(600, Scalar(0.1), random), "scattered"));
  ASSERT_NO_FATAL_FAILURE(compare(rough_ground<Scalar>(16, Scalar(0.2), random), "ground"));
  ASSERT_NO_FATAL_FAILURE(compare(line_of_needles<Scalar>(200, random), "needles"));
  ASSERT_NO_FATAL_FAILURE(compare(dust_in_square<Scalar>(200, random), "dust"));
  ASSERT_NO_FATAL_FAILURE(compare(lattice_cube<Scalar>(6), "cube"));
  // An inner grid, and one that is far smaller than the capsule.
  const auto ground = rough_ground<Scalar>(16, Scalar(0.2), random);
  ASSERT_NO_FATAL_FAILURE(compare(with_small_copy(ground, Vector3<Scalar>(Scalar(0.3), 0, Scalar(0.1))), "copy"));
}

TYPED_TEST(ColliderCapsules, FindAllThatIsThereFromAfarAndWithAnySize) {
  using Scalar = TypeParam;
  Random random(9);
  const auto mesh = rough_ground<Scalar>(5, Scalar(0.2), random);
  const Scalar largest = std::numeric_limits<Scalar>::max();
  std::vector<SweptCapsule<Scalar>> capsules;
  for (const Scalar far : {Scalar(1e3), Scalar(1e12), std::sqrt(largest), largest}) {
    capsules.push_back({{far, 0, 1}, {-far, 0, -1}, {0, 0, far}, Scalar(0.1)});
    capsules.push_back({{0, 0, far / 2}, {0, 0, 0}, {far, far / 2, 0}, 0});
    capsules.push_back({{0, 0, far}, {0, 0, far / 2}, {0, far, far}, far});
    capsules.push_back({{far, 0, 0}, {0, far, 0}, {1, -far, 0}, far});
  }
  ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), capsules, "ground"));
}

TYPED_TEST(ColliderCapsules, FindTrianglesThatAreMuchSmallerThanTheCapsule) {
  using Scalar = TypeParam;
  // Squares of such sizes underflow one after the other.
  for (int exponent = std::numeric_limits<Scalar>::min_exponent; exponent < 0; exponent += 11) {
    const Scalar size = std::ldexp(Scalar{1}, exponent);
    GeneratedMesh<Scalar> mesh;
    mesh.add({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    mesh.add({{0, 0, size}, {size, 0, 0}, {0, size, -size}});
    const Scalar half = Scalar(0.5);
    const std::vector<SweptCapsule<Scalar>> capsules = {{{size / 4, -half, 0}, {size / 4, -half, 0}, {0, 0, 2}, 1},
                                                        {{half, -2, 0}, {half, -half, 0}, {half, 0, size}, half},
                                                        {{2, 2, 2}, {-2, -2, -2}, {0, size, 0}, half}};
    ASSERT_NO_FATAL_FAILURE(this->compare(mesh.view(), capsules, "2^" + std::to_string(exponent)));
  }
}

TYPED_TEST(ColliderCapsules, LetNothingThroughVerticesAndEdgesOfAClosedMesh) {
  using Scalar = TypeParam;
  Random random(17);
  const auto mesh = bumpy_octahedron<Scalar>(8, random);
  const Collider<Scalar> collider(mesh.view());
  const Scalar size = collider.box().high.maxCoeff();
  const auto tiny = [&] { return std::ldexp(size, -static_cast<int>(random.between(3, 60))); };
  std::vector<SweptCapsule<Scalar>> capsules;
  for (std::size_t i = 0; i < case_count(2000); ++i) {
    const auto& corners = mesh.triangles[random.below(mesh.triangles.size())];
    const Vector3<Scalar>& a = mesh.vertices[corners[0]];
    const Vector3<Scalar>& b = mesh.vertices[corners[1]];
    const Vector3<Scalar> aim = random.one_in(2) ? a : Vector3<Scalar>((a + b) / 2);
    const Vector3<Scalar> axis = random.one_in(2) ? Vector3<Scalar>(aim * tiny()) : Vector3<Scalar>((b - a) * tiny());
    capsules.push_back({{0, 0, 0}, aim * 4, axis, random.one_in(2) ? Scalar{0} : tiny()});
  }
  std::vector<std::uint8_t> blocked(capsules.size());
  collider.any_hits(capsules, blocked);
  EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 0), 0);
}

TYPED_TEST(ColliderCapsules, FindTheLastFreeT) {
  using Scalar = TypeParam;
  Random random(23);
  const auto mesh = rough_ground<Scalar>(12, Scalar(0.2), random);
  const Collider<Scalar> collider(mesh.view());
  std::size_t hits = 0;
  for (const auto& capsule : this->draw_capsules(collider.box(), case_count(1000), random)) {
    const auto hit = collider.first_hit(capsule);
    if (!hit) continue;
    const Scalar free = collider.last_free_t(capsule, *hit);
    if (hit->started_touching) {
      ASSERT_EQ(free, 0);
      continue;
    }
    ++hits;
    ASSERT_FALSE(collider.any_hit(capsule, {.max_t = free}));
    ASSERT_TRUE(collider.any_hit(capsule, {.max_t = std::nextafter(free, Scalar{2})}));
  }
  EXPECT_GE(hits, case_count(60));
}

}  // namespace
}  // namespace surehit::test::collider_capsules_test
