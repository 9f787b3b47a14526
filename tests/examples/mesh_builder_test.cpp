#include "mesh_io/mesh_builder.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "error_of.hpp"
#include "support/scalars.hpp"

namespace surehit::test::mesh_builder_test {
namespace {

using example::checked_corner;
using example::Mesh;
using Faces = std::vector<std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Warnings = std::vector<std::string>;

template <typename Scalar>
class MeshBuilder : public testing::Test {
 protected:
  static constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

  /// The corners of a square, of a roof over it and of a smaller square inside, in lines 1 to 9.
  void add_vertices() {
    const std::vector<std::array<Scalar, 3>> vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 6, 0},
                                                         {1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}};
    for (const auto& vertex : vertices) builder_.add_vertex(vertex, builder_.vertex_count() + 1);
  }

  std::string error_at_the_end() {
    return error_of([this] { return builder_.finish(); });
  }

  std::string error_of_face(const std::vector<std::uint32_t>& corners, std::size_t line = 0) {
    return error_of([&] { return builder_.add_face(corners, line), 0; });
  }

  example::MeshBuilder<Scalar> builder_;
};

TYPED_TEST_SUITE(MeshBuilder, Scalars, ScalarNames);

TYPED_TEST(MeshBuilder, notes_no_faces_where_each_is_a_triangle) {
  this->add_vertices();
  this->builder_.add_face({0, 1, 2});
  this->builder_.add_face({7, 6, 5});
  EXPECT_EQ(this->builder_.face_count(), 2u);
  EXPECT_EQ(this->builder_.vertex_count(), 9u);
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {7, 6, 5}}));
  EXPECT_EQ(mesh.vertices.size(), 9u);
  EXPECT_TRUE(mesh.faces.empty());
  EXPECT_EQ(mesh.face_of(1), 1u);
  EXPECT_EQ(mesh.face_count(), 2u);
  EXPECT_TRUE(mesh.warnings.empty());
}

TYPED_TEST(MeshBuilder, notes_the_face_of_each_triangle) {
  this->add_vertices();
  this->builder_.add_face({0, 1, 2});
  this->builder_.add_face({1, 2, 3});
  this->builder_.add_face({0, 1, 2, 3});
  this->builder_.add_face({5, 6, 7});
  this->builder_.add_face({0, 1, 2, 4, 3});
  EXPECT_EQ(this->builder_.face_count(), 5u);
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.triangles,
            (Triangles{{0, 1, 2}, {1, 2, 3}, {0, 1, 2}, {0, 2, 3}, {5, 6, 7}, {0, 1, 2}, {0, 2, 4}, {0, 4, 3}}));
  EXPECT_EQ(mesh.faces, (Faces{0, 1, 2, 2, 3, 4, 4, 4}));
  EXPECT_EQ(mesh.face_of(3), 2u);
  EXPECT_EQ(mesh.face_count(), 5u);
}

TYPED_TEST(MeshBuilder, notes_that_the_first_face_is_a_polygon) {
  this->add_vertices();
  this->builder_.add_face({0, 1, 2, 3});
  this->builder_.add_face({5, 6, 7});
  EXPECT_EQ(this->builder_.finish().faces, (Faces{0, 0, 1}));
}

TYPED_TEST(MeshBuilder, cuts_concave_faces) {
  this->add_vertices();
  // A wall, its window, and a bridge between both.
  this->builder_.add_face({0, 1, 2, 3, 0, 5, 8, 7, 6, 5});
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.faces, Faces(8, 0));
  TypeParam doubled_area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& [from, to, third] = std::array{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    doubled_area += (to[0] - from[0]) * (third[1] - from[1]) - (to[1] - from[1]) * (third[0] - from[0]);
  }
  EXPECT_EQ(doubled_area, 2 * (4 * 4 - 2 * 2));
}

TYPED_TEST(MeshBuilder, keeps_the_order_of_faces_that_come_before_their_vertices) {
  this->builder_.add_vertex({0, 0, 0});
  this->builder_.add_vertex({4, 0, 0});
  this->builder_.add_vertex({4, 4, 0});
  this->builder_.add_face({0, 1, 2});
  this->builder_.add_face({2, 1, 3, 4});
  this->builder_.add_face({2, 0, 1});
  EXPECT_EQ(this->builder_.face_count(), 1u) << "the others wait";
  this->builder_.add_vertex({8, 0, 0});
  this->builder_.add_vertex({8, 4, 0});
  this->builder_.add_face({1, 2, 0});
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {2, 0, 1}, {1, 2, 0}}));
  EXPECT_EQ(mesh.faces, (Faces{0, 1, 1, 2, 3}));
}

TYPED_TEST(MeshBuilder, needs_three_corners) {
  this->add_vertices();
  EXPECT_EQ(this->error_of_face({4, 5}), "a face needs 3 corners or more, not 2");
  EXPECT_EQ(this->error_of_face({}), "a face needs 3 corners or more, not 0");
  EXPECT_EQ(this->error_of_face({99}), "a face needs 3 corners or more, not 1");
  EXPECT_TRUE(this->builder_.finish().triangles.empty());
}

TYPED_TEST(MeshBuilder, refuses_faces_that_cross_themselves) {
  this->add_vertices();
  this->builder_.add_face({0, 1, 2, 3});
  EXPECT_EQ(this->error_of_face({0, 2, 1, 3}, 12),
            "face 1 of 4 corners has no valid triangulation: its outline crosses itself");
}

TYPED_TEST(MeshBuilder, names_the_line_of_a_face_that_waited) {
  this->builder_.add_face({0, 1, 2, 3}, 3);
  this->builder_.add_face({0, 2, 1, 3}, 4);
  this->add_vertices();
  EXPECT_EQ(this->error_at_the_end(),
            "line 4: face 1 of 4 corners has no valid triangulation: its outline crosses itself");
}

TYPED_TEST(MeshBuilder, names_no_line_where_there_is_none) {
  this->builder_.add_face({0, 2, 1, 3});
  this->add_vertices();
  EXPECT_EQ(this->error_at_the_end(), "face 0 of 4 corners has no valid triangulation: its outline crosses itself");
}

TYPED_TEST(MeshBuilder, refuses_a_vertex_that_is_not_finite) {
  this->builder_.add_vertex({this->nan, 0, 0}, 5);
  this->add_vertices();
  this->builder_.add_vertex({0, this->infinity, this->nan}, 21);
  this->builder_.add_vertex({0, 0, -this->infinity});
  this->builder_.add_face({1, 2, 3});
  EXPECT_EQ(this->error_of_face({1, 2, 0}), "face 1 uses vertex 0 of line 5, of which x is nan");
  EXPECT_EQ(this->error_of_face({1, 10, 3, 0}), "face 1 uses vertex 10 of line 21, of which y is infinite");
  EXPECT_EQ(this->error_of_face({1, 2, 3, 11}, 7), "face 1 uses vertex 11, of which z is infinite");
}

TYPED_TEST(MeshBuilder, refuses_it_in_a_face_that_waited_as_well) {
  this->builder_.add_face({0, 1, 2}, 2);
  this->builder_.add_face({0, 1, 9}, 3);
  this->add_vertices();
  this->builder_.add_vertex({0, this->nan, 0}, 13);
  EXPECT_EQ(this->error_at_the_end(), "line 3: face 1 uses vertex 9 of line 13, of which y is nan");
}

TYPED_TEST(MeshBuilder, replaces_vertices_that_are_not_finite_and_not_used) {
  this->builder_.add_vertex({this->nan, 1, 1}, 4);
  this->add_vertices();
  this->builder_.add_vertex({1, 1, this->infinity}, 20);
  this->builder_.add_face({3, 4, 5});
  const Mesh<TypeParam> mesh = this->builder_.finish();
  ASSERT_EQ(mesh.vertices.size(), 11u);
  const std::array<TypeParam, 3> used = {4, 4, 0};
  EXPECT_EQ(mesh.vertices[3], used);
  EXPECT_EQ(mesh.vertices[0], used);
  EXPECT_EQ(mesh.vertices[10], used);
  EXPECT_EQ(mesh.warnings,
            Warnings{"2 vertices are not finite, the first of them vertex 0 of line 4; no face uses them"});
}

TYPED_TEST(MeshBuilder, replaces_them_in_a_mesh_without_triangles) {
  this->builder_.add_vertex({1, 1, 1});
  this->builder_.add_vertex({1, this->nan, 1});
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.vertices[1], (std::array<TypeParam, 3>{0, 0, 0}));
  EXPECT_EQ(mesh.warnings,
            (Warnings{"1 vertex is not finite, the first of them vertex 1; no face uses them", example::no_triangles}));
}

TYPED_TEST(MeshBuilder, warns_of_a_mesh_of_nothing) {
  const Mesh<TypeParam> mesh = this->builder_.finish();
  EXPECT_EQ(mesh.warnings, Warnings{"the mesh has no triangles, so nothing is ever hit"});
  EXPECT_EQ(mesh.face_count(), 0u);
}

TEST(CheckedCorner, checks_an_index_against_the_vertices) {
  EXPECT_EQ(checked_corner(7, 8), 7u);
  EXPECT_EQ(checked_corner(0xffffffff, std::uint64_t{1} << 33), 0xffffffffu);
  EXPECT_EQ(error_of([] { return checked_corner(8, 8); }), "vertex index 8 is out of range, there are 8 vertices");
  EXPECT_EQ(error_of([] { return checked_corner(-1, 8); }), "vertex index -1 is out of range, there are 8 vertices");
  EXPECT_EQ(error_of([] { return checked_corner(0x100000000, std::uint64_t{1} << 33); }),
            "a vertex index is beyond 32 bits");
}

}  // namespace
}  // namespace surehit::test::mesh_builder_test
