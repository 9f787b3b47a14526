#include "surehit/box.hpp"

namespace surehit {

template <typename Scalar>
Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh) {
  Box<Scalar> box;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) box.extend(mesh.vertex(mesh.corner(i, corner)));
  }
  return box;
}

template Box<float> box_of(const TriangleMeshView<float>&);
template Box<double> box_of(const TriangleMeshView<double>&);

}  // namespace surehit
