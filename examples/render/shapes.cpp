#include "render/shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

namespace surehit::example {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Halves edges, each of them once, so that neighbours share the new vertex.
class EdgeHalver {
 public:
  explicit EdgeHalver(std::vector<Vector3f>& points) : points_(points) {}

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points_.size()));
    if (is_new) {
      const Vector3f sum = points_[a] + points_[b];
      points_.emplace_back(sum / sum.norm());
    }
    return entry->second;
  }

 private:
  std::vector<Vector3f>& points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

/// The twelve vertices of an icosahedron in the unit sphere.
std::vector<Vector3f> icosahedron() {
  const float golden = (1 + std::sqrt(5.0f)) / 2;
  std::vector<Vector3f> points;
  for (const float one : {-1.0f, 1.0f}) {
    for (const float far : {-golden, golden}) {
      points.emplace_back(0, one, far);
      points.emplace_back(one, far, 0);
      points.emplace_back(far, 0, one);
    }
  }
  return points;
}

/// Its faces: all triples of vertices at the same, smallest distance, counterclockwise from outside.
std::vector<Corners> faces_of(const std::vector<Vector3f>& points) {
  const auto are_neighbours = [&](std::uint32_t a, std::uint32_t b) { return (points[a] - points[b]).norm() < 2.5f; };
  std::vector<Corners> faces;
  for (std::uint32_t a = 0; a < points.size(); ++a) {
    for (std::uint32_t b = a + 1; b < points.size(); ++b) {
      for (std::uint32_t c = b + 1; c < points.size(); ++c) {
        if (!are_neighbours(a, b) || !are_neighbours(b, c) || !are_neighbours(c, a)) continue;
        const bool is_outward = points[a].dot(points[b].cross(points[c])) > 0;
        faces.push_back(is_outward ? Corners{a, b, c} : Corners{a, c, b});
      }
    }
  }
  return faces;
}

}  // namespace

Model tessellated_sphere(const Vector3f& centre, float radius, int divisions) {
  std::vector<Vector3f> points = icosahedron();
  std::vector<Corners> triangles = faces_of(points);
  for (Vector3f& point : points) point /= point.norm();
  for (int i = 0; i < divisions; ++i) {
    EdgeHalver halver(points);
    std::vector<Corners> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = halver.middle(a, b);
      const std::uint32_t bc = halver.middle(b, c);
      const std::uint32_t ca = halver.middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  Model sphere;
  for (const Vector3f& point : points) {
    const Vector3f vertex = centre + radius * point;
    sphere.mesh.vertices.push_back({vertex.x(), vertex.y(), vertex.z()});
  }
  for (const auto& [a, b, c] : triangles) sphere.normals.push_back({points[a], points[b], points[c]});
  sphere.mesh.triangles = std::move(triangles);
  sphere.texture_coordinates.resize(sphere.normals.size());
  for (auto& corners : sphere.texture_coordinates) corners.fill(Eigen::Vector2f::Zero());
  set_material(sphere, {});
  return sphere;
}

Model chess_board(const Vector3f& centre, float width, int squares) {
  Model board;
  const auto count = static_cast<std::uint32_t>(squares);
  for (std::uint32_t row = 0; row <= count; ++row) {
    for (std::uint32_t column = 0; column <= count; ++column) {
      const auto place = [&](std::uint32_t i) {
        return width * (static_cast<float>(i) / static_cast<float>(count) - 0.5f);
      };
      board.mesh.vertices.push_back({centre.x() + place(column), centre.y() + place(row), centre.z()});
    }
  }
  const auto add_triangle = [&](const Corners& corners) {
    board.mesh.triangles.push_back(corners);
    board.normals.push_back({Vector3f::UnitZ(), Vector3f::UnitZ(), Vector3f::UnitZ()});
    std::array<Eigen::Vector2f, 3> places;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t column = corners[i] % (count + 1);
      const std::uint32_t row = corners[i] / (count + 1);
      places[i] = {static_cast<float>(column), static_cast<float>(row)};
    }
    board.texture_coordinates.push_back(places);
  };
  for (std::uint32_t row = 0; row < count; ++row) {
    for (std::uint32_t column = 0; column < count; ++column) {
      const std::uint32_t a = row * (count + 1) + column;
      add_triangle({a, a + 1, a + count + 2});
      add_triangle({a, a + count + 2, a + count + 1});
    }
  }
  set_material(board, {});
  return board;
}

}  // namespace surehit::example
