#pragma once

#include <limits>

#include "surehit/attributes.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// An axis-parallel box, both ends included. The one made by default holds nothing.
template <FloatOrDouble Scalar>
struct Box {
  Vector3<Scalar> low = Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::infinity());
  Vector3<Scalar> high = Vector3<Scalar>::Constant(-std::numeric_limits<Scalar>::infinity());

  [[nodiscard]] bool is_empty() const { return !(low.array() <= high.array()).all(); }

  void extend(const Vector3<Scalar>& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }

  [[nodiscard]] bool contains(const Vector3<Scalar>& point) const {
    return (low.array() <= point.array()).all() && (point.array() <= high.array()).all();
  }
};

/// The least box around all triangles of a valid mesh; vertices that no triangle uses do not count.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh);

extern template SUREHIT_API Box<float> box_of(const TriangleMeshView<float>&);
extern template SUREHIT_API Box<double> box_of(const TriangleMeshView<double>&);

using Boxf = Box<float>;
using Boxd = Box<double>;

}  // namespace surehit
