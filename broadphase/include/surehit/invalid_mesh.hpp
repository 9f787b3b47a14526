#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "surehit/attributes.hpp"

namespace surehit {

/// Why a mesh cannot be built, and the first element that is at fault.
/// Constructors throw it where exceptions are on; `try_build` returns it everywhere. `what()` says the same in one
/// line.
class SUREHIT_API InvalidMesh : public std::runtime_error {
 public:
  enum class Reason : std::uint8_t {
    too_many_triangles,         ///< more than an id can tell apart; `element` is how many
    index_out_of_range,         ///< `element` is the triangle
    non_finite_vertex,          ///< `element` is the vertex
    masks_do_not_match,         ///< one mask a triangle, or none; `element` is how many masks
    vertices_do_not_match,      ///< a rebuild takes as many vertices as the mesh has; `element` is how many were given
    missing_array,              ///< a null pointer to vertices or triangles; `element` is how many there should be
    incomplete_vertex,          ///< numbers that are no multiple of three; `element` is the vertex that lacks some
    incomplete_triangle,        ///< indices that are no multiple of three; `element` is the triangle that lacks some
    vertex_stride_too_small,    ///< vertices that overlap; `element` is the stride in bytes
    triangle_stride_too_small,  ///< triangles that overlap; `element` is the stride in bytes
  };

  InvalidMesh(Reason reason_given, std::size_t element_at_fault, const std::string& message)
      : std::runtime_error(message), reason(reason_given), element(element_at_fault) {}

  Reason reason;
  std::size_t element;
};

}  // namespace surehit
