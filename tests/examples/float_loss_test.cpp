#include "mesh_io/float_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::float_loss_test {
namespace {

using example::describe_float_loss;
using example::may_lose_in_float;
using example::Mesh;
using Vertices = std::vector<std::array<double, 3>>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Each three vertices in a row are a triangle unless `triangles` says otherwise.
Mesh<double> mesh_of(const Vertices& vertices, const Triangles& triangles = {}) {
  Mesh<double> mesh;
  mesh.vertices = vertices;
  mesh.triangles = triangles;
  if (!triangles.empty()) return mesh;
  for (std::uint32_t i = 0; i + 2 < vertices.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

Mesh<float> rounded(const Mesh<double>& mesh) {
  Mesh<float> result;
  for (const auto& [x, y, z] : mesh.vertices) {
    result.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  result.triangles = mesh.triangles;
  return result;
}

std::string description_of(const Mesh<double>& mesh) {
  return describe_float_loss(rounded(mesh), mesh).value_or("little is lost");
}

TEST(FloatLoss, describes_what_survey_coordinates_lose) {
  const Mesh<double> mesh =
      mesh_of({{5283911.5, 634250.25, 412.75}, {5283911.7, 634250.25, 412.75}, {5283911.5, 634250.45, 412.75}});
  EXPECT_TRUE(may_lose_in_float(rounded(mesh)));
  EXPECT_EQ(description_of(mesh),
            "float cannot hold its coordinates, double can: x of vertex 1 is 5283911.7 and becomes 5283911.5 in a mesh "
            "that measures 0.2; 1 of 1 triangles change by more than a hundredth of their longest side");
}

TEST(FloatLoss, describes_a_mesh_that_is_small_for_where_it_is) {
  const Mesh<double> mesh = mesh_of({{0, 0, 1000.03}, {8, 0, 1000}, {0, 8, 1000}});
  EXPECT_TRUE(may_lose_in_float(rounded(mesh)));
  EXPECT_EQ(description_of(mesh),
            "float cannot hold its coordinates, double can: z of vertex 0 is 1000.03 and becomes 1000.030029296875 in "
            "a mesh that measures 8");
}

TEST(FloatLoss, describes_one_small_triangle_of_a_large_mesh) {
  const Mesh<double> mesh =
      mesh_of({{0, 0, 0}, {9000, 0, 0}, {0, 9000, 0}, {9000, 0, 0}, {9000.01, 0, 0}, {9000, 0.01, 0}});
  EXPECT_TRUE(may_lose_in_float(rounded(mesh)));
  EXPECT_EQ(description_of(mesh),
            "float cannot hold its coordinates, double can: x of vertex 4 is 9000.01 and becomes 9000.009765625 in a "
            "mesh that measures 9e+03; 1 of 2 triangles change by more than a hundredth of their longest side");
}

TEST(FloatLoss, is_little_in_ordinary_meshes) {
  const Mesh<double> mesh =
      mesh_of({{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.7, 0.9}, {-3.3, 5.1, 1e-9}, {-3.2, 5.1, 0}, {-3.3, 5.2, 0}});
  EXPECT_FALSE(may_lose_in_float(rounded(mesh)));
  EXPECT_EQ(description_of(mesh), "little is lost");
}

TEST(FloatLoss, is_nothing_where_floats_hold_the_coordinates) {
  const Mesh<double> mesh =
      mesh_of({{5283911.5, 634250.25, 412.75}, {5283912, 634250.25, 412.75}, {5283911.5, 634250.75, 412.75}});
  EXPECT_TRUE(may_lose_in_float(rounded(mesh))) << "floats alone cannot tell";
  EXPECT_EQ(description_of(mesh), "little is lost");
}

TEST(FloatLoss, is_only_that_of_vertices_in_triangles) {
  const Vertices vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5283911.7, 634250.3, 412.7}};
  EXPECT_EQ(description_of(mesh_of(vertices, {{0, 1, 2}})), "little is lost");
  EXPECT_EQ(description_of(mesh_of({{0.1, 0.1, 0.1}})), "little is lost") << "there are no triangles";
  EXPECT_FALSE(may_lose_in_float(rounded(mesh_of({{0.1, 0.1, 0.1}}))));
}

TEST(FloatLoss, is_not_that_of_triangles_that_are_points) {
  const Vertices vertices = {{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.7, 0.9}, {0.7, 0.7, 0.7}};
  EXPECT_EQ(description_of(mesh_of(vertices, {{0, 1, 2}, {3, 3, 3}})), "little is lost");
  EXPECT_EQ(description_of(mesh_of(vertices, {{0, 0, 0}})), "little is lost") << "the mesh is a point";
  // A needle is as long as its longest side.
  EXPECT_EQ(description_of(mesh_of(vertices, {{0, 1, 2}, {1, 0, 1}})), "little is lost");
}

TEST(FloatLoss, may_be_where_rounding_lengthens_a_triangle) {
  // Each coordinate of one end goes down by almost half a unit, of the other end up. The mesh is large beside that.
  constexpr double unit_from_here = 1 << 23;
  const double low = unit_from_here + 0.499;
  const double high = unit_from_here + 28.501;
  const Mesh<double> mesh =
      mesh_of({{low, low, low}, {high, high, high}, {low, low, low}, {0, 0, 0}, {1 << 22, 0, 0}, {0, 1 << 22, 0}});
  EXPECT_NE(description_of(mesh), "little is lost");
  EXPECT_TRUE(may_lose_in_float(rounded(mesh)));
}

/// Whoever asks `describe_float_loss` only where floats may lose something misses nothing.
TEST(FloatLoss, may_be_wherever_it_is_described) {
  Random random(1);
  std::size_t described = 0;
  std::size_t certain = 0;
  for (std::size_t i = 0; i < case_count(200000); ++i) {
    // Denormal floats included, and sizes at which the loss is neither much nor little.
    const int offset = static_cast<int>(random.between(-150, 120));
    const int size = random.one_in(4) ? static_cast<int>(random.between(-160, 120))
                                      : offset - static_cast<int>(random.between(0, 24));
    const int triangle_size = size - static_cast<int>(random.between(0, 20));
    Mesh<double> mesh;
    std::array<double, 3> origin;
    for (double& coordinate : origin) coordinate = std::scalbn(random.symmetric<double>(), offset);
    for (std::size_t j = 1 + random.below(3); j > 0; --j) {
      std::array<double, 3> middle;
      for (double& coordinate : middle) coordinate = std::scalbn(random.symmetric<double>(), size);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        mesh.vertices.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double from_middle = std::scalbn(random.symmetric<double>(), triangle_size);
          mesh.vertices.back()[axis] = origin[axis] + middle[axis] + from_middle;
        }
      }
    }
    mesh = mesh_of(mesh.vertices);
    const Mesh<float> floats = rounded(mesh);
    const bool may_lose = may_lose_in_float(floats);
    if (!may_lose) ++certain;
    if (!describe_float_loss(floats, mesh)) continue;
    ++described;
    ASSERT_TRUE(may_lose) << description_of(mesh);
  }
  if (!runs_all_cases()) return;
  EXPECT_GT(described, 10000u);
  EXPECT_GT(certain, 10000u);
}

}  // namespace
}  // namespace surehit::test::float_loss_test
