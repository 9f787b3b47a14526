#include "render/corner_normals.hpp"

#include <Eigen/Geometry>
#include <surehit/hit.hpp>

namespace surehit::example {
namespace {

constexpr float cosine_of_edge = 0.766f;

/// The triangles at each vertex, side by side.
struct Fans {
  explicit Fans(const Mesh<float>& mesh) : begins(mesh.vertices.size() + 1), triangles(3 * mesh.triangles.size()) {
    for (const auto& corners : mesh.triangles) {
      for (const std::uint32_t vertex : corners) ++begins[vertex + 1];
    }
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    std::vector<std::size_t> next = begins;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i]) triangles[next[vertex]++] = i;
    }
  }

  std::vector<std::size_t> begins;
  std::vector<std::uint32_t> triangles;
};

/// Twice the area of a triangle.
float twice_area(const Trianglef& triangle) { return (triangle.b - triangle.a).cross(triangle.c - triangle.a).norm(); }

}  // namespace

std::vector<std::array<Vector3f, 3>> corner_normals(const Mesh<float>& mesh) {
  const Fans fans(mesh);
  const TriangleMeshViewf view = mesh.view();
  std::vector<Vector3f> flat;
  std::vector<float> areas;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    flat.push_back(normal(view, static_cast<std::uint32_t>(i)));
    areas.push_back(twice_area(view.triangle(i)));
  }
  std::vector<std::array<Vector3f, 3>> normals;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<Vector3f, 3> of_corners;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[i][corner];
      Vector3f sum = Vector3f::Zero();
      for (std::size_t at = fans.begins[vertex]; at < fans.begins[vertex + 1]; ++at) {
        const std::uint32_t other = fans.triangles[at];
        if (flat[i].dot(flat[other]) >= cosine_of_edge) sum += areas[other] * flat[other];
      }
      const float length = sum.norm();
      of_corners[corner] = length > 0 ? Vector3f(sum / length) : flat[i];
    }
    normals.push_back(of_corners);
  }
  return normals;
}

}  // namespace surehit::example
