#include "uneven_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

namespace surehit::benchmark {
namespace {

using Mesh = example::Mesh<float>;
using Index = std::uint32_t;

/// Returns a number in [0, 1) that belongs to a lattice point.
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                     static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
                     static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
  return test::Random(mixed).unit<double>();
}

/// Returns the values of the lattice points, blended smoothly between them.
double noise(const Vector3d& point) {
  std::array<std::int64_t, 3> cell;
  std::array<double, 3> weight;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = point[static_cast<Eigen::Index>(axis)];
    const double floor = std::floor(at);
    cell[axis] = static_cast<std::int64_t>(floor);
    const double s = at - floor;
    weight[axis] = s * s * (3 - 2 * s);
  }
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double product = lattice_value(cell[0] + static_cast<std::int64_t>(corner & 1),
                                   cell[1] + static_cast<std::int64_t>(corner >> 1 & 1),
                                   cell[2] + static_cast<std::int64_t>(corner >> 2));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      product *= (corner >> axis & 1) != 0 ? weight[axis] : 1 - weight[axis];
    }
    sum += product;
  }
  return sum;
}

/// Returns noise with details of half the size and half the height, again and again.
double rough_noise(Vector3d point, int octaves) {
  double sum = 0;
  double height = 0.5;
  for (int i = 0; i < octaves; ++i, height /= 2, point *= 2) sum += height * noise(point);
  return sum;
}

void add_vertex(Mesh& mesh, const Vector3d& point) {
  mesh.vertices.push_back({static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])});
}

/// Adds a surface of `pieces` × `pieces` quads, each of two triangles. `at(s, t)` is a point of it, with s and t in
/// [0, 1].
void add_patch(Mesh& mesh, Index pieces, const std::function<Vector3d(double, double)>& at) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (Index row = 0; row <= pieces; ++row) {
    for (Index column = 0; column <= pieces; ++column) {
      add_vertex(mesh, at(double{static_cast<double>(column)} / pieces, double{static_cast<double>(row)} / pieces));
    }
  }
  for (Index row = 0; row < pieces; ++row) {
    for (Index column = 0; column < pieces; ++column) {
      const Index corner = first + row * (pieces + 1) + column;
      const Index above = corner + pieces + 1;
      mesh.triangles.push_back({corner, corner + 1, above + 1});
      mesh.triangles.push_back({corner, above + 1, above});
    }
  }
}

Index scaled(Index pieces, float detail) {
  return std::max<Index>(2, static_cast<Index>(static_cast<float>(pieces) * detail));
}

/// Adds a bumpy ball of triangles of about the same size: a cube, blown up, with this many pieces along each edge.
void add_ball(Mesh& mesh, const Vector3d& centre, double radius, Index pieces) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? 1 : -1;
    add_patch(mesh, pieces, [&](double s, double t) {
      Vector3d direction;
      direction[axis] = sign;
      direction[(axis + 1) % 3] = sign * (2 * s - 1);
      direction[(axis + 2) % 3] = 2 * t - 1;
      direction.normalize();
      return Vector3d(centre + radius * (0.7 + 0.3 * rough_noise(4 * direction, 3)) * direction);
    });
  }
}

/// Adds one of 70,000 triangles.
void add_blob(Mesh& mesh, const Vector3d& centre, double radius, float detail) {
  add_ball(mesh, centre, radius, scaled(76, detail));
}

void add_box(Mesh& mesh, const Vector3d& centre, double half_edge) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (Index corner = 0; corner < 8; ++corner) {
    const Vector3d side((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    add_vertex(mesh, centre + half_edge * side);
  }
  constexpr std::array<std::array<Index, 4>, 6> faces = {
      {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
  for (const auto& [a, b, c, d] : faces) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}

/// The built-in level, with a ball that is this many times smaller.
NamedMesh stadium(double ratio, float detail) {
  NamedMesh named = level_mesh(detail);
  const double radius = named.diagonal() / ratio / 2;
  const Boxf box = named.box();
  const Vector3d low = box.low.cast<double>();
  Vector3d centre = low + 0.3 * (box.high.cast<double>() - low);
  centre[2] = named.eye[2];
  add_blob(named.mesh, centre, radius, detail);
  return named;
}

/// A ball inside a box of twelve triangles that is 50 times as large.
NamedMesh sky_box(float detail) {
  NamedMesh named;
  add_blob(named.mesh, {0.3, 0.2, -0.4}, 0.5, detail);
  add_box(named.mesh, Vector3d::Zero(), 25);
  named.eye = {3, 2, 1};
  return named;
}

/// Adds a square of terrain from (0, 0) to (size, size).
void add_terrain(Mesh& mesh, Index pieces, double size, double height) {
  add_patch(mesh, pieces, [&](double s, double t) {
    return Vector3d(s * size, t * size, height * rough_noise({8 * s, 8 * t, 0.5}, 6));
  });
}

/// 20,000 triangles, and one more that is this many of their widths away. Paths are those without it.
NamedMesh stray(double distance, float detail) {
  NamedMesh named;
  add_terrain(named.mesh, scaled(100, detail), 1, 0.1);
  named.drawn_in = named.box();
  named.eye = {0.5, 0.5, 0.2};
  const auto first = static_cast<Index>(named.mesh.vertices.size());
  const double size = std::max(0.01, distance * 1e-6);  // So that rounding does not make it a point.
  for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, -1, -1)}) {
    add_vertex(named.mesh, Vector3d::Constant(distance) + size * corner);
  }
  named.mesh.triangles.push_back({first, first + 1, first + 2});
  return named;
}

NamedMesh terrain(float detail) {
  NamedMesh named;
  add_terrain(named.mesh, scaled(708, detail), 1000, 200);
  named.eye = {500, 500, 150};
  return named;
}

/// A landscape of cubes with caves and hollow towers. Cubes have edges of 1, and lie on whole numbers.
class Voxels {
 public:
  explicit Voxels(float detail) : width_(scaled(128, detail)) {}

  [[nodiscard]] NamedMesh mesh() {
    NamedMesh named;
    const auto width = static_cast<std::int64_t>(width_);
    for (std::int64_t z = 0; z < height; ++z) {
      for (std::int64_t y = 0; y < width; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
          if (is_solid(x, y, z)) add_faces(named.mesh, {x, y, z});
        }
      }
    }
    const double middle = static_cast<double>(width_) / 2;
    named.eye = {middle + 0.5, middle + 0.5, 30.5};
    named.cell = 1;
    return named;
  }

 private:
  static constexpr std::int64_t height = 48;
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] bool is_solid(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const auto width = static_cast<std::int64_t>(width_);
    if (x < 0 || y < 0 || x >= width || y >= width || z < 0 || z >= height) return false;
    if (is_tower(x, y, z)) return true;
    const Vector3d at(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    const double ground = 8 + 20 * rough_noise({at[0] / 24, at[1] / 24, 0.5}, 3);
    const bool is_cave = z > 1 && noise(at / 9 + Vector3d::Constant(50)) > 0.68;
    return at[2] < ground && !is_cave;
  }
  /// Each tower is a wall around a square of 6 × 6 cubes, with windows.
  [[nodiscard]] static bool is_tower(std::int64_t x, std::int64_t y, std::int64_t z) {
    const std::int64_t i = x % 32 - 12;
    const std::int64_t j = y % 32 - 12;
    if (i < 0 || j < 0 || i > 7 || j > 7 || z > 40) return false;
    const bool is_wall = i == 0 || j == 0 || i == 7 || j == 7;
    const bool is_window = z % 5 == 3 && (i == 3 || j == 3);
    return is_wall && !is_window;
  }

  void add_faces(Mesh& mesh, const Cell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        Cell beside = cell;
        beside[axis] += upper ? 1 : -1;
        if (is_solid(beside[0], beside[1], beside[2])) continue;
        Cell corner = cell;
        if (upper) ++corner[axis];
        std::size_t u = (axis + 1) % 3;
        std::size_t v = (axis + 2) % 3;
        if (!upper) std::swap(u, v);
        std::array<Index, 4> quad;
        quad[0] = vertex(mesh, corner);
        ++corner[u];
        quad[1] = vertex(mesh, corner);
        ++corner[v];
        quad[2] = vertex(mesh, corner);
        --corner[u];
        quad[3] = vertex(mesh, corner);
        mesh.triangles.push_back({quad[0], quad[1], quad[2]});
        mesh.triangles.push_back({quad[0], quad[2], quad[3]});
      }
    }
  }

  /// Returns the vertex at a corner of the lattice, the same for all faces there.
  Index vertex(Mesh& mesh, const Cell& corner) {
    const std::size_t row = width_ + 1;
    if (numbers_.empty()) numbers_.resize(row * row * (height + 1), none);
    const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(corner[axis]); };
    Index& number = numbers_[(at(2) * row + at(1)) * row + at(0)];
    if (number == none) {
      number = static_cast<Index>(mesh.vertices.size());
      mesh.vertices.push_back(
          {static_cast<float>(corner[0]), static_cast<float>(corner[1]), static_cast<float>(corner[2])});
    }
    return number;
  }

  static constexpr Index none = ~Index{0};
  Index width_;
  std::vector<Index> numbers_;
};

struct UnevenMesh {
  std::string name;
  std::function<NamedMesh(float)> build;
};

std::vector<UnevenMesh> all_meshes() {
  std::vector<UnevenMesh> all;
  for (const int ratio : {10, 100, 1000, 10000}) {
    all.push_back({"stadium_" + std::to_string(ratio), [ratio](float detail) { return stadium(ratio, detail); }});
  }
  all.push_back({"sky_box", sky_box});
  for (const int exponent : {1, 3, 5, 9, 30}) {
    double distance = 1;
    for (int i = 0; i < exponent; ++i) distance *= 10;
    all.push_back(
        {"stray_1e" + std::to_string(exponent), [distance](float detail) { return stray(distance, detail); }});
  }
  all.push_back({"voxels", [](float detail) { return Voxels(detail).mesh(); }});
  all.push_back({"terrain", terrain});
  return all;
}

}  // namespace

example::Mesh<float> bumpy_ball(double radius, std::uint32_t pieces) {
  Mesh mesh;
  add_ball(mesh, Vector3d::Zero(), radius, pieces);
  return mesh;
}

std::vector<std::string> uneven_mesh_names() {
  std::vector<std::string> names;
  for (const UnevenMesh& mesh : all_meshes()) names.push_back(mesh.name);
  return names;
}

NamedMesh uneven_mesh(const std::string& name, float detail) {
  for (const UnevenMesh& mesh : all_meshes()) {
    if (mesh.name != name) continue;
    NamedMesh built = mesh.build(detail);
    built.name = name;
    return built;
  }
  throw std::logic_error("there is no uneven mesh called " + name);
}

}  // namespace surehit::benchmark
