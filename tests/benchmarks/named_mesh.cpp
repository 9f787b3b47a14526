#include "named_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <surehit/collider.hpp>
#include <utility>

#include "level/level.hpp"
#include "mesh_io/read_mesh.hpp"

namespace surehit::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr double eye_height = 0.03;  // of the diagonal

Vector3d choose_eye(const NamedMesh& named) {
  constexpr int eyes = 64;
  constexpr int targets = 256;
  const Colliderf collider(named.mesh.view());
  const SurfacePoints floor = named.floor();
  const double diagonal = named.diagonal();
  test::Random random(1);
  Vector3d best = Vector3d::Zero();
  int min_distance = targets;
  for (int i = 0; i < eyes; ++i) {
    const Vector3d eye = floor.draw(random) + named.upward(eye_height * diagonal);
    int seen = 0;
    for (int j = 0; j < targets; ++j) {
      const Vector3d target = floor.draw(random) + named.upward(NamedMesh::target_height * diagonal);
      seen += collider.any_hit(Segmentf{eye.cast<float>(), target.cast<float>()}) ? 0 : 1;
    }
    const int distance = std::abs(seen - targets / 2);
    if (distance < min_distance) {
      min_distance = distance;
      best = eye;
    }
  }
  return best;
}

bool is_mesh_file(const fs::path& path) {
  constexpr std::array endings = {".obj", ".ply", ".stl", ".off"};
  return std::find(endings.begin(), endings.end(), path.extension()) != endings.end();
}

}  // namespace

bool NamedMesh::draws_at(const Trianglef& triangle) const {
  return !drawn_in ||
         ((triangle.a.array() >= drawn_in->low.array()).all() && (triangle.a.array() <= drawn_in->high.array()).all());
}

double NamedMesh::diagonal() const {
  const Boxf around = box();
  return (around.high.cast<double>() - around.low.cast<double>()).norm();
}

SurfacePoints NamedMesh::floor() const {
  const auto looks_up = [axis = up](const Trianglef& triangle) {
    const Vector3d a = triangle.a.cast<double>();
    const Vector3d normal = (triangle.b.cast<double>() - a).cross(triangle.c.cast<double>() - a);
    return normal[axis] > 0.7 * normal.norm();
  };
  return {mesh.view(), looks_up};
}

Vector3d NamedMesh::upward(double length) const { return length * Vector3d::Unit(up); }

NamedMesh level_mesh(float detail) {
  example::Level level = example::build_level({detail});
  const Vector3d eye = Vector3f(level.eye[0], level.eye[1], level.eye[2]).cast<double>();
  return {.name = "level", .mesh = std::move(level.mesh), .up = 2, .eye = eye};
}

std::vector<NamedMesh> meshes_in(const std::string& folder, const std::vector<std::string>& z_up,
                                 const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    const bool is_named = names.empty() || std::find(names.begin(), names.end(), path.stem()) != names.end();
    if (is_named && is_mesh_file(path)) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  std::vector<NamedMesh> meshes;
  for (const fs::path& file : files) {
    const int up = std::find(z_up.begin(), z_up.end(), file.stem()) != z_up.end() ? 2 : 1;
    NamedMesh& named = meshes.emplace_back(
        NamedMesh{.name = file.stem().string(), .mesh = example::read_mesh<float>(file.string()), .up = up});
    named.eye = choose_eye(named);
  }
  return meshes;
}

}  // namespace surehit::benchmark
