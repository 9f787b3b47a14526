#include "support/small_meshes.hpp"

#include "support/pair_families.hpp"

namespace surehit::test {
namespace {

constexpr std::size_t family_count = all_pair_families.size();
static_assert(small_mesh_kind_count == family_count + 2);

PathKind random_kind(Random& random) { return static_cast<PathKind>(random.below(3)); }

template <typename Scalar>
Vector3<Scalar> lattice_point(Random& random, std::int64_t low, std::int64_t high) {
  Vector3<Scalar> point;
  for (Scalar& coordinate : point.reshaped()) coordinate = static_cast<Scalar>(random.between(low, high));
  return point;
}

/// Triangles of a family. Some share their corners with those before.
template <typename Scalar>
SmallMesh<Scalar> of_family(PairFamily family, Random& random) {
  SmallMesh<Scalar> mesh;
  for (std::uint64_t i = 1 + random.below(64); i > 0; --i) {
    const Pair<Scalar> pair = draw_pair<Scalar>(family, random);
    std::array<std::uint32_t, 3> triangle;
    const std::array corners = {pair.triangle.a, pair.triangle.b, pair.triangle.c};
    const bool is_joined = !mesh.vertices.empty() && random.one_in(2);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (is_joined && corner < 2) {
        triangle[corner] = static_cast<std::uint32_t>(random.below(mesh.vertices.size()));
      } else {
        triangle[corner] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(corners[corner]);
      }
    }
    mesh.triangles.push_back(triangle);
    if (mesh.paths.size() < 16) mesh.paths.push_back(path_along(pair.segment, random_kind(random)));
  }
  return mesh;
}

/// Any three points of a small lattice, so triangles cross, coincide, and lie in one plane or on one line.
template <typename Scalar>
SmallMesh<Scalar> lattice_soup(Random& random) {
  SmallMesh<Scalar> mesh;
  const std::int64_t reach = random.between(1, 4);
  for (std::uint64_t i = 3 + random.below(20); i > 0; --i) {
    mesh.vertices.push_back(lattice_point<Scalar>(random, -reach, reach));
  }
  for (std::uint64_t i = 1 + random.below(64); i > 0; --i) {
    std::array<std::uint32_t, 3> triangle;
    for (std::uint32_t& corner : triangle) corner = static_cast<std::uint32_t>(random.below(mesh.vertices.size()));
    mesh.triangles.push_back(triangle);
  }
  for (int i = 0; i < 16; ++i) {
    const Vector3<Scalar> start = lattice_point<Scalar>(random, -reach - 1, reach + 1);
    const Vector3<Scalar> end = lattice_point<Scalar>(random, -reach - 1, reach + 1);
    mesh.paths.push_back(path_along(Segment<Scalar>{start, end}, random_kind(random)));
  }
  return mesh;
}

/// A surface over a square of lattice points: paths go down through its corners and edges, and along it.
template <typename Scalar>
SmallMesh<Scalar> height_field(Random& random) {
  SmallMesh<Scalar> mesh;
  const auto side = static_cast<std::uint32_t>(random.between(1, 5));
  const std::int64_t roughness = random.between(0, 2);
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      mesh.vertices.emplace_back(static_cast<Scalar>(2 * x), static_cast<Scalar>(2 * y),
                                 static_cast<Scalar>(random.between(-roughness, roughness)));
    }
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t corner = y * (side + 1) + x;
      mesh.triangles.push_back({corner, corner + 1, corner + side + 1});
      mesh.triangles.push_back({corner + 1, corner + side + 2, corner + side + 1});
    }
  }
  const std::int64_t reach = 2 * std::int64_t{side};
  for (int i = 0; i < 16; ++i) {
    Vector3<Scalar> start = lattice_point<Scalar>(random, 0, reach);
    const Vector3<Scalar> end = lattice_point<Scalar>(random, -1, reach + 1);
    if (random.one_in(2)) start = {end[0], end[1], -start[2]};
    mesh.paths.push_back(path_along(Segment<Scalar>{start, end}, random_kind(random)));
  }
  return mesh;
}

}  // namespace

std::string name_of_small_mesh(std::size_t kind) {
  if (kind < family_count) return name_of(all_pair_families[kind]);
  return kind == family_count ? "lattice_soup" : "height_field";
}

template <typename Scalar>
SmallMesh<Scalar> draw_small_mesh(std::size_t kind, Random& random) {
  if (kind < family_count) return of_family<Scalar>(all_pair_families[kind], random);
  return kind == family_count ? lattice_soup<Scalar>(random) : height_field<Scalar>(random);
}

template SmallMesh<float> draw_small_mesh(std::size_t, Random&);
template SmallMesh<double> draw_small_mesh(std::size_t, Random&);

}  // namespace surehit::test
