#include "surehit/triangle_mesh_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "support/scalars.hpp"

namespace surehit::test::triangle_mesh_view_test {
namespace {

using Reason = InvalidMesh::Reason;

template <typename Scalar>
class TriangleMeshViewTest : public testing::Test {
 protected:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  static constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

  TriangleMeshView<Scalar> view() const { return {vertices, triangles}; }

  std::vector<Vector3<Scalar>> vertices = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {2, 1, 3}};
};
TYPED_TEST_SUITE(TriangleMeshViewTest, Scalars, ScalarNames);

TYPED_TEST(TriangleMeshViewTest, by_default_is_empty_and_valid) {
  const TriangleMeshView<TypeParam> view;
  EXPECT_EQ(view.vertex_count(), 0U);
  EXPECT_EQ(view.triangle_count(), 0U);
  EXPECT_FALSE(find_invalid(view).has_value());
}

TYPED_TEST(TriangleMeshViewTest, reads_dense_arrays) {
  const auto view = this->view();
  EXPECT_EQ(view.vertex_count(), 4U);
  EXPECT_EQ(view.triangle_count(), 2U);
  EXPECT_EQ(view.vertex(3), this->vertices[3]);
  EXPECT_EQ(view.corner(1, 2), 3U);
  const Triangle<TypeParam> triangle = view.triangle(1);
  EXPECT_EQ(triangle.a, this->vertices[2]);
  EXPECT_EQ(triangle.b, this->vertices[1]);
  EXPECT_EQ(triangle.c, this->vertices[3]);
  EXPECT_FALSE(find_invalid(view).has_value());
}

TYPED_TEST(TriangleMeshViewTest, reads_interleaved_arrays_in_place) {
  struct Corner {
    std::array<TypeParam, 3> position;
    std::array<TypeParam, 2> texture;
  };
  struct Face {
    std::uint32_t material;
    std::array<std::uint32_t, 3> corners;
  };
  const std::vector<Corner> corners = {{{1, 2, 3}, {}}, {{4, 5, 6}, {}}, {{7, 8, 9}, {}}};
  const std::vector<Face> faces = {{9, {0, 1, 2}}, {9, {2, 0, 1}}};
  const TriangleMeshView<TypeParam> view(
      VertexView<TypeParam>::strided(corners.front().position.data(), corners.size(), sizeof(Corner)),
      TriangleIndexView::strided(faces.front().corners.data(), faces.size(), sizeof(Face)));
  EXPECT_EQ(view.triangle(1).a, (Vector3<TypeParam>{7, 8, 9}));
  EXPECT_EQ(view.triangle(1).c, (Vector3<TypeParam>{4, 5, 6}));
  EXPECT_FALSE(find_invalid(view).has_value());
}

TYPED_TEST(TriangleMeshViewTest, reads_eigen_matrices_maps_and_blocks) {
  Eigen::Matrix<TypeParam, 3, Eigen::Dynamic> vertices(3, 4);
  vertices << 0, 3, 6, 9, 1, 4, 7, 10, 2, 5, 8, 11;
  Eigen::Matrix<std::int32_t, 3, Eigen::Dynamic> triangles(3, 2);
  triangles << 0, 2, 1, 1, 2, 3;
  const TriangleMeshView<TypeParam> of_matrices(vertices, triangles);
  EXPECT_EQ(of_matrices.triangle(1).c, this->vertices[3]);

  using Strided = Eigen::Map<const Eigen::Matrix<TypeParam, 3, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;
  const Strided every_second(vertices.data(), 3, 2, Eigen::OuterStride<>(6));
  const TriangleMeshView<TypeParam> of_map(every_second, triangles);
  EXPECT_EQ(of_map.vertex_count(), 2U);
  EXPECT_EQ(of_map.vertex(1), this->vertices[2]);

  const TriangleMeshView<TypeParam> of_blocks(vertices.rightCols(3), triangles.rightCols(1));
  EXPECT_EQ(of_blocks.triangle_count(), 1U);
  EXPECT_EQ(of_blocks.vertex(0), this->vertices[1]);
  EXPECT_EQ(of_blocks.corner(0, 0), 2U);
}

TYPED_TEST(TriangleMeshViewTest, reads_sixteen_bit_indices) {
  const std::vector<std::array<std::uint16_t, 3>> triangles = {{0, 1, 2}, {2, 1, 3}};
  const TriangleMeshView<TypeParam> dense(this->vertices, triangles);
  EXPECT_EQ(dense.triangle(1).a, this->vertices[2]);
  EXPECT_EQ(dense.triangle(1).b, this->vertices[1]);
  EXPECT_EQ(dense.triangle(1).c, this->vertices[3]);
  EXPECT_FALSE(find_invalid(dense).has_value());

  struct Face {
    std::uint16_t material;
    std::array<std::uint16_t, 3> corners;
  };
  const std::vector<Face> faces = {{9, {0, 1, 2}}, {9, {3, 2, 4}}};
  const TriangleMeshView<TypeParam> strided(
      this->vertices, TriangleIndexView::strided(faces.front().corners.data(), faces.size(), sizeof(Face)));
  EXPECT_EQ(strided.corner(1, 0), 3U);
  const auto invalid = find_invalid(strided);
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->element, 1U);

  Eigen::Matrix<std::uint16_t, 3, Eigen::Dynamic> columns(3, 2);
  columns << 0, 65535, 1, 1, 2, 3;
  const Eigen::Matrix<TypeParam, 3, Eigen::Dynamic> vertices = Eigen::Matrix<TypeParam, 3, 4>::Zero();
  const TriangleMeshView<TypeParam> of_columns(vertices, columns.rightCols(1));
  EXPECT_EQ(of_columns.corner(0, 0), 65535U);
  EXPECT_EQ(of_columns.corner(0, 2), 3U);
}

TYPED_TEST(TriangleMeshViewTest, names_the_first_triangle_with_an_index_out_of_range) {
  this->triangles = {{0, 1, 2}, {0, 1, 4}, {9, 9, 9}};
  const auto invalid = find_invalid(this->view());
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->reason, Reason::index_out_of_range);
  EXPECT_EQ(invalid->element, 1U);
  EXPECT_STREQ(invalid->what(), "triangle 1: corner c is vertex 4, but the mesh has 4 vertices");
}

TYPED_TEST(TriangleMeshViewTest, checks_every_corner_and_the_last_triangle) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    this->triangles = {{0, 1, 2}, {2, 1, 3}};
    this->triangles[1][corner] = 4;
    const auto invalid = find_invalid(this->view());
    ASSERT_TRUE(invalid.has_value()) << corner;
    EXPECT_EQ(invalid->element, 1U);
    EXPECT_NE(std::string(invalid->what()).find(std::string("corner ") + "abc"[corner]), std::string::npos);
  }
}

TYPED_TEST(TriangleMeshViewTest, takes_negative_indices_as_out_of_range) {
  const Eigen::Matrix<TypeParam, 3, 3> vertices = Eigen::Matrix<TypeParam, 3, 3>::Identity();
  const Eigen::Vector3i triangle(0, -1, 2);
  const auto invalid = find_invalid(TriangleMeshView<TypeParam>(vertices, triangle));
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->reason, Reason::index_out_of_range);
}

TYPED_TEST(TriangleMeshViewTest, names_the_first_non_finite_vertex_used_or_not) {
  for (const TypeParam bad : {this->infinity, -this->infinity, this->nan}) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      auto vertices = this->vertices;
      this->triangles = {{0, 1, 2}};
      vertices[3][axis] = bad;
      const TriangleMeshView<TypeParam> view(vertices, this->triangles);
      const auto invalid = find_invalid(view);
      ASSERT_TRUE(invalid.has_value()) << bad << " on axis " << axis;
      EXPECT_EQ(invalid->reason, Reason::non_finite_vertex);
      EXPECT_EQ(invalid->element, 3U);
      const std::string start = std::string("vertex 3: ") + "xyz"[axis] + " is ";
      EXPECT_EQ(std::string(invalid->what()).substr(0, start.size()), start);
    }
  }
}

TYPED_TEST(TriangleMeshViewTest, takes_the_largest_and_the_least_numbers) {
  this->vertices[0] = {std::numeric_limits<TypeParam>::max(), std::numeric_limits<TypeParam>::lowest(),
                       std::numeric_limits<TypeParam>::denorm_min()};
  EXPECT_FALSE(find_invalid(this->view()).has_value());
}

TYPED_TEST(TriangleMeshViewTest, names_indices_before_vertices) {
  this->vertices[0][0] = this->nan;
  this->triangles[1][0] = 7;
  EXPECT_EQ(find_invalid(this->view())->reason, Reason::index_out_of_range);
}

/// Their count is checked before any is read.
TYPED_TEST(TriangleMeshViewTest, refuses_more_triangles_than_ids) {
  const TriangleMeshView<TypeParam> view(this->vertices,
                                         TriangleIndexView::strided(this->triangles.front().data(), no_triangle, 0));
  const auto invalid = find_invalid(view);
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->reason, Reason::too_many_triangles);
  EXPECT_EQ(invalid->element, no_triangle);
  EXPECT_STREQ(invalid->what(), "mesh has 4294967295 triangles, more than the 4294967294 that 32-bit ids allow");
}

}  // namespace
}  // namespace surehit::test::triangle_mesh_view_test
