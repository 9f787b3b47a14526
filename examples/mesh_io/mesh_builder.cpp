#include "mesh_io/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mesh_io/input_error.hpp"
#include "mesh_io/text_lines.hpp"
#include "mesh_io/triangulate.hpp"

namespace surehit::example {

std::uint32_t checked_corner(std::int64_t index, std::uint64_t vertex_count) {
  if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count) {
    throw InputError("vertex index " + std::to_string(index) + " is out of range, there are " +
                     std::to_string(vertex_count) + " vertices");
  }
  if (index > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("a vertex index is beyond 32 bits");
  }
  return static_cast<std::uint32_t>(index);
}

template <typename Scalar>
void MeshBuilder<Scalar>::add_vertex(const std::array<Scalar, 3>& vertex, std::size_t line) {
  if (!std::all_of(vertex.begin(), vertex.end(), [](Scalar coordinate) { return std::isfinite(coordinate); })) {
    non_finite_.push_back({mesh_.vertices.size(), line});
  }
  mesh_.vertices.push_back(vertex);
}

template <typename Scalar>
void MeshBuilder<Scalar>::add_face(const std::vector<std::uint32_t>& corners, std::size_t line) {
  if (corners.size() < 3) {
    throw InputError("a face needs 3 corners or more, not " + std::to_string(corners.size()));
  }
  // Once one waits, all do: triangles are in the order of their faces.
  const bool must_wait =
      !waiting_.empty() || *std::max_element(corners.begin(), corners.end()) >= mesh_.vertices.size();
  if (!must_wait) return cut_face(corners);
  waiting_.push_back({waiting_corners_.size(), line});
  waiting_corners_.insert(waiting_corners_.end(), corners.begin(), corners.end());
}

template <typename Scalar>
Mesh<Scalar> MeshBuilder<Scalar>::finish() {
  cut_waiting_faces();
  replace_non_finite_vertices();
  if (mesh_.triangles.empty()) mesh_.warnings.emplace_back(no_triangles);
  return std::move(mesh_);
}

template <typename Scalar>
void MeshBuilder<Scalar>::cut_face(const std::vector<std::uint32_t>& corners) {
  check_corners_are_finite(corners);
  const std::size_t before = mesh_.triangles.size();
  if (!triangulate(mesh_.vertices, corners, mesh_.triangles)) {
    throw InputError("face " + std::to_string(face_count_) + " of " + std::to_string(corners.size()) +
                     " corners has no valid triangulation: its outline crosses itself");
  }
  count_face(before);
}

/// Notes which face the new triangles are of, from the first time on that this is not a triangle's own id.
template <typename Scalar>
void MeshBuilder<Scalar>::count_face(std::size_t triangles_before) {
  const std::size_t triangles = mesh_.triangles.size();
  if (mesh_.faces.empty() && triangles != triangles_before + 1) {
    mesh_.faces.reserve(triangles);
    mesh_.faces.resize(triangles_before);
    std::iota(mesh_.faces.begin(), mesh_.faces.end(), 0u);
    mesh_.faces.resize(triangles, face_count_);
  } else if (!mesh_.faces.empty()) {
    mesh_.faces.resize(triangles, face_count_);
  }
  ++face_count_;
}

template <typename Scalar>
void MeshBuilder<Scalar>::cut_waiting_faces() {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const std::size_t end = i + 1 < waiting_.size() ? waiting_[i + 1].first_corner : waiting_corners_.size();
    const auto first = waiting_corners_.begin();
    corners.assign(first + static_cast<std::ptrdiff_t>(waiting_[i].first_corner),
                   first + static_cast<std::ptrdiff_t>(end));
    try {
      cut_face(corners);
    } catch (const InputError& error) {
      throw at_line(error, waiting_[i].line);
    }
  }
  waiting_.clear();
}

template <typename Scalar>
void MeshBuilder<Scalar>::check_corners_are_finite(const std::vector<std::uint32_t>& corners) const {
  if (non_finite_.empty()) return;
  for (const std::uint32_t corner : corners) {
    const auto place = std::lower_bound(non_finite_.begin(), non_finite_.end(), corner,
                                        [](const Place& one, std::uint32_t vertex) { return one.vertex < vertex; });
    if (place == non_finite_.end() || place->vertex != corner) continue;
    const auto& vertex = mesh_.vertices[corner];
    const auto* const bad = std::find_if_not(vertex.begin(), vertex.end(), [](Scalar c) { return std::isfinite(c); });
    const std::string of_line = place->line == 0 ? "" : " of line " + std::to_string(place->line);
    throw InputError("face " + std::to_string(face_count_) + " uses vertex " + std::to_string(corner) + of_line +
                     ", of which " + "xyz"[bad - vertex.begin()] + " is " + (std::isnan(*bad) ? "nan" : "infinite"));
  }
}

/// No face uses them, but a collider takes finite vertices alone.
template <typename Scalar>
void MeshBuilder<Scalar>::replace_non_finite_vertices() {
  if (non_finite_.empty()) return;
  const std::array<Scalar, 3> used =
      mesh_.triangles.empty() ? std::array<Scalar, 3>{} : mesh_.vertices[mesh_.triangles.front()[0]];
  for (const Place& place : non_finite_) mesh_.vertices[place.vertex] = used;
  mesh_.warnings.push_back(
      std::to_string(non_finite_.size()) + (non_finite_.size() == 1 ? " vertex is" : " vertices are") +
      " not finite, the first of them vertex " + std::to_string(non_finite_[0].vertex) +
      (non_finite_[0].line == 0 ? "" : " of line " + std::to_string(non_finite_[0].line)) + "; no face uses them");
}

template class MeshBuilder<float>;
template class MeshBuilder<double>;

}  // namespace surehit::example
