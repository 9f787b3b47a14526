#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace surehit {

/// Why a mesh cannot be built, and the first element that is at fault.
/// Thrown where exceptions are on, returned by `try_build` everywhere; `what()` is the same in one readable line.
class InvalidMesh : public std::runtime_error {
 public:
  enum class Reason : std::uint8_t {
    too_many_triangles,     ///< more than an id can tell apart; `element` is how many
    index_out_of_range,     ///< `element` is the triangle
    non_finite_vertex,      ///< `element` is the vertex
    masks_do_not_match,     ///< one mask a triangle, or none; `element` is how many masks
    vertices_do_not_match,  ///< a rebuild takes as many vertices as the mesh has; `element` is how many were given
  };

  InvalidMesh(Reason reason_given, std::size_t element_at_fault, const std::string& message)
      : std::runtime_error(message), reason(reason_given), element(element_at_fault) {}

  Reason reason;
  std::size_t element;
};

}  // namespace surehit
