#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <surehit/pose.hpp>
#include <vector>

namespace surehit::example {

/// What a line of a scene file says: which mesh, and where it is.
template <typename Scalar>
struct PlacedMesh {
  std::size_t line = 0;   ///< The number of the line, from 1.
  std::string mesh_path;  ///< The mesh file, as seen from where the program runs.
  Pose<Scalar> pose = {};
  Vector3<Scalar> motion = Vector3<Scalar>::Zero();
  std::uint32_t mask = ~std::uint32_t{0};
};

/// Reads a scene file, or standard input if the path is `-`. Each line places one mesh:
///
///     MESH  m00 m01 m02 m0  m10 m11 m12 m1  m20 m21 m22 m2  [motion X Y Z] [mask BITS]
///
/// A corner v of the mesh is at M v + m. The path of a mesh is relative to the folder of the scene file. A path with
/// white space, a comma or a quotation mark in it stands in quotation marks, which are doubled inside. Numbers are
/// separated as in `read_number_table`. Lines that begin with # and blank lines are skipped.
///
/// Reads no mesh. Throws InputError, which names the file and the line. It does not judge poses: a scene does.
template <typename Scalar>
[[nodiscard]] std::vector<PlacedMesh<Scalar>> read_scene(const std::string& path);

}  // namespace surehit::example
