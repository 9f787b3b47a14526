#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/random.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// A mesh that owns its arrays.
template <typename Scalar>
struct GeneratedMesh {
  std::vector<Vector3<Scalar>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Three vertices of its own for the triangle.
  void add(const Triangle<Scalar>& triangle);
  /// Lasts until either array changes.
  [[nodiscard]] TriangleMeshView<Scalar> view() const;
};

/// A triangle for each three numbers, with corners in the cube [-1, 1)³ no farther than `size` from its first one.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> scattered_triangles(std::size_t count, Scalar size, Random& random);

/// `count` × `count` squares of two triangles over [-1, 1]², whose corners are at random heights up to `height`.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> rough_ground(std::uint32_t count, Scalar height, Random& random);

/// As many squares of a bowl's wall, steep all over and without an edge or a dent: most lists of a grid have slabs that
/// are much thinner than their boxes.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> smooth_bowl(std::uint32_t count);

/// `count` triangles one behind the other along x, each a thousand times as long as it is wide.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> line_of_needles(std::size_t count, Random& random);

/// `count` points in the square [0, 1]² × {0}, each a triangle, and two of its corners: empty space of every width.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> dust_in_square(std::size_t count, Random& random);

/// The cube [0, size]³ in unit squares of two triangles: closed, with corners on whole numbers.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> lattice_cube(std::uint32_t size);

/// A closed surface of 8 size² triangles around the origin: the lattice of the octahedron |x| + |y| + |z| = size, every
/// vertex drawn out by a random whole factor. Every ray from the origin crosses it once, and all coordinates are whole
/// numbers below 2^24, so that one can aim exactly.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> bumpy_octahedron(std::int32_t size, Random& random);

/// Two pyramids, base to base around the origin, over a square of side 2 size whose rim is cut into unit edges.
/// Vertices 0 and 1, the tips, each join 8 size triangles.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> double_fan(std::int32_t size);

/// Each vertex times `factor`, which rounds, and then `offset` away, which rounds again.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> placed(GeneratedMesh<Scalar> mesh, Scalar factor, const Vector3<Scalar>& offset);

/// Every vertex with the same coordinate on the axis.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> flattened(GeneratedMesh<Scalar> mesh, int axis, Scalar coordinate);

/// The triangles of one and then those of the other.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> joined(GeneratedMesh<Scalar> mesh, const GeneratedMesh<Scalar>& other);

/// Grounds far apart, on the way from one corner of their box to the opposite one. Most of the box is empty.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> grounds_askew(Random& random);

/// Small triangles here and there in [-1, 1]³. In a grid of 40 × 40 × 40 cells, their cover begins next to a plane
/// between cells for a path that `lane_walk_test` names.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> covered_from_a_plane();

/// Joined with a copy of itself a 24th as large, at `offset`: a spot crowded with small triangles.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> with_small_copy(const GeneratedMesh<Scalar>& mesh, const Vector3<Scalar>& offset);

}  // namespace surehit::test
