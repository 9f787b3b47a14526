#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::watertight_test {
namespace {

/// A closed surface around the origin, which no ray from there crosses twice: a path from inside to outside must meet
/// it, whatever is rounded on the way to the path's ends.
template <typename Scalar>
class Watertight : public testing::Test {
 protected:
  using Point = Vector3<Scalar>;

  /// Weighs a triangle's corners: one corner, two for an edge, or all three, by small whole numbers, so that on the
  /// lattice the sum is exact. Seen from the origin it lies exactly behind the corner, the edge or the triangle, and
  /// outside.
  Point weighed(const GeneratedMesh<Scalar>& mesh, std::size_t corners) {
    const auto& triangle = mesh.triangles[random_.below(mesh.triangles.size())];
    Point sum = mesh.vertices[triangle[0]] * static_cast<Scalar>(random_.between(2, 64));
    for (std::size_t i = 1; i < corners; ++i) {
      sum += mesh.vertices[triangle[i]] * static_cast<Scalar>(random_.between(1, 64));
    }
    return sum;
  }

  void expect_blocked(const Collider<Scalar>& collider, const Segment<Scalar>& segment) {
    ++paths_;
    if (collider.first_hit(segment) && collider.any_hit(segment)) return;
    ++misses_;
    if (misses_ == 1) ADD_FAILURE() << "first miss: " << hex_text(Path<Scalar>(segment));
  }

  /// From the origin exactly through corners, edges and triangles, and from points near it as exactly as a Scalar goes.
  void scan(const GeneratedMesh<Scalar>& mesh, Scalar inner_radius, std::size_t paths) {
    const Collider<Scalar> collider(mesh.view());
    for (std::size_t i = 0; i < case_count(paths); ++i) {
      const Point outside = weighed(mesh, 1 + i % 3);
      if (i % 2 == 0) {
        expect_blocked(collider, {Point::Zero(), outside});
      } else {
        Point inside;
        for (Scalar& x : inside) x = inner_radius * random_.symmetric<Scalar>();
        const Point aim = outside / static_cast<Scalar>(random_.between(1, 64));
        expect_blocked(collider, {inside, inside + (aim - inside) * 256});
      }
    }
    EXPECT_EQ(paths_, case_count(paths));
    EXPECT_EQ(misses_, 0U);
  }

  Random random_{20240229};
  std::size_t paths_ = 0;
  std::size_t misses_ = 0;
};
TYPED_TEST_SUITE(Watertight, Scalars, ScalarNames);

TYPED_TEST(Watertight, a_million_segments_through_closed_mesh) {
  const auto mesh = bumpy_octahedron<TypeParam>(50, this->random_);
  ASSERT_EQ(mesh.triangles.size(), 20'000U);
  this->scan(mesh, 10'000, 1'000'000);
}

TYPED_TEST(Watertight, dense_fans) {
  const auto mesh = double_fan<TypeParam>(500);
  ASSERT_EQ(mesh.triangles.size(), 8'000U);
  this->scan(mesh, 100, 2'500);
}

/// Exactly at the tips, where thousands of edges meet, and past them by an ulp or a few.
TYPED_TEST(Watertight, tips_of_dense_fans) {
  const auto mesh = double_fan<TypeParam>(500);
  const Collider<TypeParam> collider(mesh.view());
  const std::size_t paths = case_count(1000);
  for (std::size_t i = 0; i < paths; ++i) {
    Vector3<TypeParam> end = 2 * mesh.vertices[i % 2];
    for (auto& x : end)
      x += static_cast<TypeParam>(this->random_.between(-2, 2)) * std::numeric_limits<TypeParam>::epsilon();
    this->expect_blocked(collider, {{0, 0, 0}, end});
  }
  EXPECT_EQ(this->paths_, paths);
  EXPECT_EQ(this->misses_, 0U);
}

/// From the origin, twice a vertex is twice as far as the surface.
TYPED_TEST(Watertight, exact_aims_meet_the_surface_where_it_is) {
  const auto mesh = bumpy_octahedron<TypeParam>(20, this->random_);
  const Collider<TypeParam> collider(mesh.view());
  for (const auto& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle;
    for (const Vector3<TypeParam>& outside :
         std::array<Vector3<TypeParam>, 2>{2 * mesh.vertices[a], mesh.vertices[a] + mesh.vertices[b]}) {
      const auto hit = collider.first_hit(Segment<TypeParam>{{0, 0, 0}, outside});
      ASSERT_TRUE(hit.has_value()) << hex_text(outside);
      EXPECT_EQ(hit->t, TypeParam{0.5}) << hex_text(outside);
    }
  }
}

}  // namespace
}  // namespace surehit::test::watertight_test
