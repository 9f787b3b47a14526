#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <surehit/triangle.hpp>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// What is known of a way of a body.
struct Clearance {
  bool is_touching = false;  ///< True if the body touches a triangle on its way.
  bool is_certain = true;    ///< False if only exact arithmetic can tell, and there is none.
  double depth = 0;          ///< How much nearer than its radius the core came to a triangle, in metres, about.
};

/// Tells whether a body that goes straight touches a mesh, and knows nothing of the library's queries.
///
/// Doubles decide whatever bounds of their errors allow. Rational numbers decide the rest, if GMP is there. Triangles
/// are found by the squares of the plan that they are over.
class ClearanceCheck {
 public:
  explicit ClearanceCheck(const Mesh<float>& mesh);

  /// The way may have length zero. The positions must be finite.
  [[nodiscard]] Clearance check(const Vector3f& from, const Vector3f& to) const;

 private:
  /// A range of squares on an axis.
  struct Range {
    std::size_t first, last;
  };
  struct Box {
    Vector3f low, high;
  };

  [[nodiscard]] Range squares(int axis, float low, float high) const;

  std::vector<Trianglef> triangles_;
  std::vector<Box> boxes_;
  Box box_;
  std::array<std::size_t, 2> counts_ = {};
  std::vector<std::vector<std::uint32_t>> squares_;
};

}  // namespace surehit::example
