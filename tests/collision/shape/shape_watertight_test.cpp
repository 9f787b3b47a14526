#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"
#include "support/shape_text.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::shape_watertight_test {
namespace {

/// Closed surfaces around the origin, which no ray from there crosses twice. A shape from inside to outside must touch
/// them before its centre is through.
template <typename Scalar>
class ShapeWatertight : public testing::Test {
 protected:
  using Point = Vector3<Scalar>;

  /// One path through each vertex and one through each edge, exactly. Half of them begin at the origin. The others
  /// begin near it, and their ends are rounded.
  std::vector<Segment<Scalar>> paths_through(const GeneratedMesh<Scalar>& mesh, Scalar inner_radius) {
    std::vector<Segment<Scalar>> paths;
    const auto add = [&](const Point& outside) {
      if (random_.one_in(2)) {
        paths.push_back({Point::Zero(), outside});
        return;
      }
      Point inside;
      for (Scalar& x : inside) x = inner_radius / 4 * random_.symmetric<Scalar>();
      const Point aim = outside / static_cast<Scalar>(random_.between(2, 64));
      paths.push_back({inside, inside + (aim - inside) * 256});
    };
    const auto weight = [&] { return static_cast<Scalar>(random_.between(2, 64)); };
    for (const Point& vertex : mesh.vertices) add(vertex * weight());
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& triangle : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(triangle[i], triangle[(i + 1) % 3]));
    }
    for (const auto& [from, to] : edges) add(mesh.vertices[from] * weight() + mesh.vertices[to] * weight());
    return paths;
  }

  template <typename Shape>
  void expect_blocked(const Collider<Scalar>& collider, const std::vector<Shape>& shapes,
                      const std::vector<Hit<Scalar>>& of_centres) {
    std::vector<ShapeHit<Scalar>> hits(shapes.size());
    collider.first_hits(shapes, hits);
    std::size_t through = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const bool is_blocked =
          hits[i].triangle != no_triangle && !hits[i].started_touching && hits[i].t <= of_centres[i].t;
      if (!is_blocked && ++through == 1) {
        ADD_FAILURE() << "first one through: " << hex_text(shapes[i]) << ", " << hex_text(hits[i]);
      }
    }
    EXPECT_EQ(through, 0U) << "of " << shapes.size();
    shapes_ += shapes.size();
  }

  void scan(const GeneratedMesh<Scalar>& mesh, Scalar inner_radius) {
    const Collider<Scalar> collider(mesh.view());
    const std::vector<Segment<Scalar>> paths = paths_through(mesh, inner_radius);
    std::vector<Hit<Scalar>> of_centres(paths.size());
    collider.first_hits(paths, of_centres);
    for (const Scalar size : {inner_radius / 16, inner_radius / 65536}) {
      std::vector<SweptSphere<Scalar>> balls;
      std::vector<SweptBox<Scalar>> boxes;
      std::vector<SweptCapsule<Scalar>> capsules;
      for (const auto& [start, end] : paths) {
        balls.push_back({start, end, size});
        boxes.push_back({start, end, {size, size / 2, size / 4}});
        capsules.push_back({start, end, {size, 0, size / 2}, size / 4});
      }
      expect_blocked(collider, balls, of_centres);
      expect_blocked(collider, boxes, of_centres);
      expect_blocked(collider, capsules, of_centres);
    }
  }

  Random random_{20261127};
  std::size_t shapes_ = 0;
};
TYPED_TEST_SUITE(ShapeWatertight, Scalars, ScalarNames);

TYPED_TEST(ShapeWatertight, every_vertex_and_edge_of_a_bumpy_octahedron) {
  // 8 size² triangles have 12 size² edges and 4 size² + 2 vertices.
  const auto mesh = bumpy_octahedron<TypeParam>(12, this->random_);
  for (std::size_t i = case_count(4); i > 0; --i) this->scan(mesh, 10'000);
  EXPECT_EQ(this->shapes_, case_count(4) * 6 * (16 * 144 + 2));
}

TYPED_TEST(ShapeWatertight, every_vertex_and_edge_of_dense_fans) {
  const auto mesh = double_fan<TypeParam>(20);
  this->scan(mesh, 10);
  EXPECT_GT(this->shapes_, 6U * 4 * 160);
}

}  // namespace
}  // namespace surehit::test::shape_watertight_test
