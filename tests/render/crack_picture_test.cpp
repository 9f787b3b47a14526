#include "render/crack_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "mesh_io/input_error.hpp"
#include "render/plain_intersect.hpp"
#include "render/shapes.hpp"

namespace surehit::example::crack_picture_test {
namespace {

bool is_hole(const Colour& colour) { return colour.red == 1 && colour.green < 0.2f && colour.blue < 0.2f; }

TEST(CrackPicture, has_holes_of_plain_floats_alone) {
  for (const int divisions : {2, 3, 4}) {
    const Mesh<float> mesh = tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, divisions).mesh;
    const CrackView view = find_crack_view(mesh, std::nullopt, 96);
    const Cracks cracks = draw_cracks(mesh, view, 2);
    EXPECT_EQ(cracks.rays, std::size_t{96 * 96});
    EXPECT_GT(cracks.holes_of_plain, 0u) << divisions;
    EXPECT_LT(cracks.holes_of_plain, cracks.rays / 10) << "most of its answers are right";
    EXPECT_EQ(cracks.holes_of_surehit, 0u) << divisions;
    std::size_t left = 0;
    std::size_t right = 0;
    for (int y = 0; y < cracks.picture.height(); ++y) {
      for (int x = 0; x < cracks.picture.width(); ++x) {
        (2 * x < cracks.picture.width() ? left : right) += is_hole(cracks.picture.at(x, y));
      }
    }
    EXPECT_EQ(left, cracks.holes_of_plain);
    EXPECT_EQ(right, 0u);
  }
}

TEST(CrackPicture, shows_the_vertex_in_the_middle) {
  const Mesh<float> mesh = tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, 3).mesh;
  const CrackView view = find_crack_view(mesh, std::nullopt, 64);
  const auto& [x, y, z] = mesh.vertices[view.vertex];
  EXPECT_EQ(view.camera.target, Vector3f(x, y, z));
  EXPECT_EQ(find_crack_view(mesh, view.vertex, 64).vertex, view.vertex);
}

TEST(CrackPicture, finds_a_vertex_below_many_others) {
  // A wall of tall spikes whose tops are no vertices that face upwards, and a sphere below.
  Mesh<float> mesh = tessellated_sphere({0, 0, 0}, 1, 2).mesh;
  for (int i = 0; i < 200; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const float x = 5 + static_cast<float>(i);
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 9}, {x, 1, 9}, {x, 0, 5}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_LT(mesh.vertices[find_crack_view(mesh, std::nullopt, 64).vertex][2], 1.1f);
}

TEST(CrackPicture, looks_from_below_a_ceiling) {
  Mesh<float> mesh = tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, 3).mesh;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const float ceiling = 1.8f;
  mesh.vertices.insert(mesh.vertices.end(), {{-99, -99, ceiling}, {99, -99, ceiling}, {0, 99, ceiling}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const CrackView view = find_crack_view(mesh, std::nullopt, 96);
  EXPECT_LT(view.camera.eye.z(), ceiling);
  EXPECT_EQ(draw_cracks(mesh, view, 2).holes_of_surehit, 0u);
}

TEST(CrackPicture, leaves_out_vertices_at_which_the_mesh_touches_itself) {
  Mesh<float> mesh = tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, 3).mesh;
  const std::uint32_t vertex = find_crack_view(mesh, std::nullopt, 96).vertex;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto [x, y, z] = mesh.vertices[vertex];
  mesh.vertices.insert(mesh.vertices.end(), {{x - 1, y - 1, z}, {x, y + 1, z}, {x + 1, y - 1, z}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  EXPECT_NE(find_crack_view(mesh, std::nullopt, 96).vertex, vertex);
}

TEST(CrackPicture, takes_vertices_at_one_place_for_one) {
  const Mesh<float> joined = tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, 3).mesh;
  Mesh<float> mesh;
  for (const auto& triangle : joined.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t corner : triangle) mesh.vertices.push_back(joined.vertices[corner]);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const CrackView view = find_crack_view(mesh, std::nullopt, 96);
  EXPECT_EQ(mesh.vertices[view.vertex], joined.vertices[find_crack_view(joined, std::nullopt, 96).vertex]);
  EXPECT_EQ(draw_cracks(mesh, view, 2).holes_of_surehit, 0u);
}

void expect_error(const Mesh<float>& mesh, std::optional<std::uint32_t> vertex, const std::string& error) {
  try {
    static_cast<void>(find_crack_view(mesh, vertex, 64));
    ADD_FAILURE() << "expected: " << error;
  } catch (const InputError& caught) {
    EXPECT_EQ(caught.what(), error);
  }
}

TEST(CrackPicture, says_why_there_is_no_view) {
  const Mesh<float> sphere = tessellated_sphere({0, 0, 0}, 1, 2).mesh;
  const auto bottom = static_cast<std::uint32_t>(
      std::ranges::min_element(sphere.vertices, {}, [](const auto& vertex) { return vertex[2]; }) -
      sphere.vertices.begin());
  expect_error(sphere, bottom,
               "--vertex: the triangles at vertex " + std::to_string(bottom) + " do not all face upwards");
  expect_error(sphere, 1'000'000, "--vertex: there is no vertex 1000000, the mesh has 162");
  Mesh<float> one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  const std::string need =
      "no vertex can be shown: it needs triangles all around it that face upwards and that are seen from above. Of ";
  expect_error(one, 0, "--vertex: the triangles at vertex 0 do not lie all around it");
  expect_error(one, std::nullopt, need + "3 vertices, 0 have triangles all around them, 0 of these face upwards");
  expect_error({}, std::nullopt, need + "0 vertices, 0 have triangles all around them, 0 of these face upwards");
  // A tetrahedron that stands on its tip, and then one under a lid that lies on it.
  Mesh<float> tetrahedron;
  tetrahedron.vertices = {{0, 0, -2}, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  expect_error(tetrahedron, std::nullopt,
               need + "4 vertices, 4 have triangles all around them, 0 of these face upwards: --up may be wrong");
  tetrahedron.vertices[0][2] = 1;
  for (auto& triangle : tetrahedron.triangles) std::swap(triangle[0], triangle[1]);
  tetrahedron.vertices.insert(tetrahedron.vertices.end(), {{-9, -9, 1.0625f}, {9, -9, 1.0625f}, {0, 9, 1.0625f}});
  tetrahedron.triangles.push_back({4, 5, 6});
  expect_error(
      tetrahedron, std::nullopt,
      need + "7 vertices, 4 have triangles all around them, 1 of these face upwards, and all of them are hidden");
}

TEST(CrackPicture, plain_floats_are_right_where_nothing_is_close) {
  const Trianglef triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto hit = plain_intersect({{1, 2, 3}, {0, 0, -2}}, triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 1.5f);
  EXPECT_EQ(hit->u, 0.25f);
  EXPECT_EQ(hit->v, 0.5f);
  EXPECT_TRUE(hit->is_front);
  EXPECT_FALSE(plain_intersect({{1, 2, -3}, {0, 0, 2}}, triangle)->is_front);
  EXPECT_FALSE(plain_intersect({{1, 2, 3}, {0, 0, 2}}, triangle)) << "behind the origin";
  EXPECT_FALSE(plain_intersect({{3, 2, 3}, {0, 0, -2}}, triangle)) << "beside it";
  EXPECT_FALSE(plain_intersect({{1, 2, 3}, {1, 0, 0}}, triangle)) << "parallel";
}

}  // namespace
}  // namespace surehit::example::crack_picture_test
