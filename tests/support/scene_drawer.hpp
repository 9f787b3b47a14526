#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "support/random.hpp"
#include "support/scene_oracle.hpp"
#include "surehit/collider.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/instance.hpp"
#include "surehit/path.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {

/// How the instances of a drawn scene are placed.
enum class SceneFamily : std::uint8_t {
  identity,          ///< All are where their meshes are.
  translations,      ///< Half of the scenes lie on whole numbers.
  integer_matrices,  ///< Meshes and translations are whole numbers too, so ties abound.
  rotations,
  mirrored,
  sheared,
  scaled,           ///< By 2^-60 to 2^60, each by its own power.
  nearly_singular,  ///< The determinant is tiny.
  pieces,           ///< Copies of a piece of ground, side by side, that touch exactly.
  mixed,            ///< Each instance is of another family.
  all_magnitudes,   ///< Entries are up to the ends of their range. Coordinates are any finite numbers.
};

inline constexpr std::array all_scene_families = {
    SceneFamily::identity, SceneFamily::translations, SceneFamily::integer_matrices, SceneFamily::rotations,
    SceneFamily::mirrored, SceneFamily::sheared,      SceneFamily::scaled,           SceneFamily::nearly_singular,
    SceneFamily::pieces,   SceneFamily::mixed,        SceneFamily::all_magnitudes,
};

[[nodiscard]] std::string name_of(SceneFamily family);
inline void PrintTo(SceneFamily family, std::ostream* out) { *out << name_of(family); }

/// A mesh of a drawn scene. If it is one of floats, all of its numbers are floats.
struct DrawnMesh {
  bool is_float = true;
  std::vector<Vector3<double>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> masks;  ///< One for each triangle, or none.
  std::vector<Path<double>> paths;   ///< Paths that are hard for the mesh where it is.
  GridOptions grid = {};             ///< How a collider of the mesh divides its box.

  [[nodiscard]] TriangleMeshView<double> view() const { return {vertices, triangles}; }
};

/// Returns a piece of ground over the square [0, side]², with random heights in [-1, 1). Opposite rims have the same
/// heights, so copies side by side touch exactly.
[[nodiscard]] DrawnMesh ground_piece(std::uint32_t side, bool is_float, Random& random);

/// Returns such a piece with two squares a side, and a prop of 72 triangles that is 256 times smaller. All vertices are
/// whole numbers. The prop has an inner grid, in the piece's own cells or in their bricks.
[[nodiscard]] DrawnMesh ground_with_prop(bool is_float, Random& random);

/// Returns a collider of the mesh.
template <typename MeshScalar>
[[nodiscard]] std::shared_ptr<Collider<MeshScalar>> collider_of(const DrawnMesh& mesh);

/// Returns the nearest finite point of Scalars.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> rounded(const Vector3<double>& point) {
  constexpr double largest = double{std::numeric_limits<Scalar>::max()};
  return point.cwiseMax(-largest).cwiseMin(largest).template cast<Scalar>();
}

template <typename Scalar>
struct DrawnScene {
  struct Instance {
    std::size_t mesh;
    Placement<Scalar> placement;
  };

  std::vector<DrawnMesh> meshes;
  std::vector<Instance> instances;
};

/// Returns a matrix of eighths, with few digits and an exact determinant that is not 0. So its products with small
/// whole numbers are exact.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 3> matrix_of_eighths(Random& random);

/// Returns the next scene of a family. In double, half of the meshes are of floats. Call it in the default
/// floating-point environment.
template <typename Scalar>
[[nodiscard]] DrawnScene<Scalar> draw_scene(SceneFamily family, Random& random);

/// Returns a finite pose of a family, with an exact determinant that is not 0. For `pieces` and `mixed`, it is one of
/// the others.
template <typename Scalar>
[[nodiscard]] Pose<Scalar> draw_pose(SceneFamily family, Random& random);

/// A drawn scene, and its judge.
template <typename Scalar>
struct JudgedScene {
  /// Adds all instances, and commits them.
  explicit JudgedScene(const DrawnScene<Scalar>& drawn);

  Scene<Scalar> scene;
  SceneOracle<Scalar> oracle;
  std::vector<InstanceId> ids;  ///< One for each drawn instance.
};

}  // namespace surehit::test
