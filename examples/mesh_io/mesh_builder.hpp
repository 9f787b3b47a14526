#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Checks an index that counts from 0 against the vertices there are. Throws InputError.
[[nodiscard]] std::uint32_t checked_corner(std::int64_t index, std::uint64_t vertex_count);

/// Makes a mesh of the vertices and faces that a reader finds, in any order.
///
/// Faces of more than three corners are triangulated. A vertex may have coordinates that are not finite as long as no
/// face uses it. `line` is where the file has the element; 0 where it has no lines.
template <typename Scalar>
class MeshBuilder {
 public:
  void add_vertex(const std::array<Scalar, 3>& vertex, std::size_t line = 0);

  /// Throws InputError for less than 3 corners, for a corner that is not finite and where there is no triangulation.
  /// What depends on vertices that are still to come is checked by `finish`.
  void add_face(const std::vector<std::uint32_t>& corners, std::size_t line = 0);

  [[nodiscard]] std::size_t vertex_count() const { return mesh_.vertices.size(); }
  [[nodiscard]] std::size_t face_count() const { return face_count_; }

  /// The mesh. All corners must have got their vertices. Throws InputError, which names the line.
  [[nodiscard]] Mesh<Scalar> finish();

 private:
  struct Place {
    std::size_t vertex;
    std::size_t line;
  };
  struct Waiting {
    std::size_t first_corner;
    std::size_t line;
  };

  void cut_face(const std::vector<std::uint32_t>& corners);
  void count_face(std::size_t triangles_before);
  void cut_waiting_faces();
  void check_corners_are_finite(const std::vector<std::uint32_t>& corners) const;
  void replace_non_finite_vertices();

  Mesh<Scalar> mesh_;
  std::uint32_t face_count_ = 0;  ///< of the faces that are cut
  std::vector<Place> non_finite_;
  std::vector<Waiting> waiting_;  ///< the faces from the first one on that came before a vertex of its
  std::vector<std::uint32_t> waiting_corners_;
};

}  // namespace surehit::example
