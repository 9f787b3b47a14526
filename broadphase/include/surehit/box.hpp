#pragma once

#include <limits>

#include "surehit/attributes.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// A box with edges along the axes, in the mesh's unit of length. It contains its surface. A default box is empty.
template <FloatOrDouble Scalar>
struct Box {
  /// The minimum coordinate on each axis.
  Vector3<Scalar> low = Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::infinity());
  /// The maximum coordinate on each axis.
  Vector3<Scalar> high = Vector3<Scalar>::Constant(-std::numeric_limits<Scalar>::infinity());

  /// Returns true if the box contains no point. A box with a NaN is empty.
  [[nodiscard]] bool is_empty() const { return !(low.array() <= high.array()).all(); }

  /// Grows the box until it contains the point, which must not have a NaN.
  void extend(const Vector3<Scalar>& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }

  /// Returns true if the point is inside the box or on its surface.
  [[nodiscard]] bool contains(const Vector3<Scalar>& point) const {
    return (low.array() <= point.array()).all() && (point.array() <= high.array()).all();
  }
};

/// Returns the smallest box around all triangles of a mesh. It ignores vertices that no triangle uses. The box of a
/// mesh without triangles is empty.
///
/// The mesh must be valid, see `find_invalid`. Takes linear time and allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh);

extern template SUREHIT_API Box<float> box_of(const TriangleMeshView<float>&);
extern template SUREHIT_API Box<double> box_of(const TriangleMeshView<double>&);

using Boxf = Box<float>;   ///< A box in float.
using Boxd = Box<double>;  ///< A box in double.

}  // namespace surehit
