#include "build/vertex_lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "support/scalars.hpp"

namespace surehit::test::vertex_lanes_test {
namespace {

/// Vertex i has the coordinates 10 i, 10 i + 1 and 10 i + 2, and others lie behind the last one.
template <typename Scalar>
class VertexLanesTest : public testing::Test {
 protected:
  static constexpr std::size_t count = 5;
  static constexpr Scalar beyond = -1;
  using Lanes = detail::VertexLanes<Scalar>;

  static std::vector<Scalar> numbers(std::size_t stride) {
    std::vector<Scalar> numbers(count * stride + 4, beyond);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) numbers[i * stride + axis] = static_cast<Scalar>(10 * i + axis);
    }
    return numbers;
  }

  static void expect_vertex(const typename Lanes::Point& point, std::size_t vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(point[axis], static_cast<Scalar>(10 * vertex + axis)) << vertex << ' ' << axis;
    }
    EXPECT_NE(point[3], beyond) << vertex;
  }

  static void expect_vertices(const TriangleMeshView<Scalar>& mesh) {
    const Lanes lanes(mesh);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      typename Lanes::Point point;
      lanes.load(i, point);
      expect_vertex(point, i);
    }
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      typename Lanes::Point corners[3];
      lanes.load_corners(i, corners);
      for (std::size_t corner = 0; corner < 3; ++corner) expect_vertex(corners[corner], mesh.corner(i, corner));
    }
  }

  static TriangleMeshView<Scalar> mesh_of(const std::vector<Scalar>& numbers, std::size_t stride) {
    return mesh_at(numbers.data(), stride * sizeof(Scalar));
  }
  static TriangleMeshView<Scalar> mesh_at(const Scalar* vertices, std::size_t stride_in_bytes) {
    static constexpr std::array<std::uint32_t, 12> triangles = {0, 1, 2, 4, 0, 1, 2, 4, 3, 3, 2, 4};
    return {VertexView<Scalar>::strided(vertices, count, stride_in_bytes), triangles};
  }
};
TYPED_TEST_SUITE(VertexLanesTest, Scalars, ScalarNames);

TYPED_TEST(VertexLanesTest, hold_vertices_that_lie_side_by_side) {
  const auto numbers = this->numbers(3);
  this->expect_vertices(this->mesh_of(numbers, 3));
}

TYPED_TEST(VertexLanesTest, hold_vertices_that_lie_apart) {
  for (const std::size_t stride : {4U, 7U}) {
    const auto numbers = this->numbers(stride);
    this->expect_vertices(this->mesh_of(numbers, stride));
  }
}

TYPED_TEST(VertexLanesTest, hold_vertices_that_are_not_aligned) {
  for (const std::size_t gap : {0U, 1U}) {
    const std::size_t stride = 3 * sizeof(TypeParam) + gap;
    const auto numbers = this->numbers(3);
    std::vector<std::byte> bytes(1 + this->count * stride + sizeof(typename TestFixture::Lanes::Point));
    for (std::size_t i = 0; i < this->count; ++i) {
      std::memcpy(&bytes[1 + i * stride], &numbers[3 * i], 3 * sizeof(TypeParam));
    }
    this->expect_vertices(this->mesh_at(reinterpret_cast<const TypeParam*>(&bytes[1]), stride));
  }
}

TYPED_TEST(VertexLanesTest, hold_a_vertex_alone) {
  const auto numbers = this->numbers(3);
  this->expect_vertices({VertexView<TypeParam>::strided(numbers.data(), 1, 0), {}});
}

TYPED_TEST(VertexLanesTest, load_nothing_of_a_mesh_without_vertices) {
  const TriangleMeshView<TypeParam> none;
  this->expect_vertices(none);
}

}  // namespace
}  // namespace surehit::test::vertex_lanes_test
