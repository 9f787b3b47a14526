#include "surehit/box.hpp"

#include <algorithm>

namespace surehit {

template <typename Scalar>
Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh) {
  Box<Scalar> box;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3<Scalar> vertex = mesh.vertex(mesh.corner(i, corner));
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], vertex[axis]);
        box.high[axis] = std::max(box.high[axis], vertex[axis]);
      }
    }
  }
  return box;
}

template Box<float> box_of(const TriangleMeshView<float>&);
template Box<double> box_of(const TriangleMeshView<double>&);

}  // namespace surehit
