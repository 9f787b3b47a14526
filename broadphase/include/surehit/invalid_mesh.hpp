#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "surehit/attributes.hpp"

namespace surehit {

/// Why a mesh or its masks cannot be used, and the first element that is invalid. `what()` says the same in one line.
///
/// `Collider::try_build` and its like return it. Constructors and `Collider::rebuild` throw it, where exceptions are
/// on.
class SUREHIT_API InvalidMesh : public std::runtime_error {
 public:
  /// What is invalid, and what `element` then means.
  enum class Reason : std::uint8_t {
    too_many_triangles,         ///< There are more than 2^32 - 2 triangles. `element` is the number of triangles.
    index_out_of_range,         ///< A corner's index is not below the number of vertices. `element` is the triangle.
    non_finite_vertex,          ///< A coordinate is NaN or infinite. `element` is the vertex.
    masks_do_not_match,         ///< There must be one mask a triangle, or none. `element` is the number of masks.
    vertices_do_not_match,      ///< A rebuild needs as many vertices as before. `element` is the number given.
    missing_array,              ///< The pointer to vertices or triangles is null. `element` is their number.
    incomplete_vertex,          ///< The last vertex lacks coordinates. `element` is this vertex.
    incomplete_triangle,        ///< The last triangle lacks indices. `element` is this triangle.
    vertex_stride_too_small,    ///< Vertices overlap. `element` is the stride in bytes.
    triangle_stride_too_small,  ///< Triangles overlap. `element` is the stride in bytes.
  };

  /// Sets both members. `what()` returns the message. May throw std::bad_alloc.
  InvalidMesh(Reason reason_given, std::size_t element_at_fault, const std::string& message)
      : std::runtime_error(message), reason(reason_given), element(element_at_fault) {}

  Reason reason;        ///< What is invalid.
  std::size_t element;  ///< The first invalid element, or a number. `Reason` says which.
};

}  // namespace surehit
