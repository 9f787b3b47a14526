#include "surehit/box.hpp"

#include <array>

namespace surehit {

template <typename Scalar>
Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh) {
  // As many as vectors hold, and a box for each corner, so that none waits for another.
  using Point = Eigen::Array<Scalar, 4, 1>;
  const Box<Scalar> none;
  std::array<Point, 3> low;
  std::array<Point, 3> high;
  low.fill(Point::Constant(none.low[0]));
  high.fill(Point::Constant(none.high[0]));
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3<Scalar> vertex = mesh.vertex(mesh.corner(i, corner));
      const Point point(vertex[0], vertex[1], vertex[2], vertex[2]);
      low[corner] = low[corner].min(point);
      high[corner] = high[corner].max(point);
    }
  }
  return {.low = low[0].min(low[1]).min(low[2]).template head<3>(),
          .high = high[0].max(high[1]).max(high[2]).template head<3>()};
}

template Box<float> box_of(const TriangleMeshView<float>&);
template Box<double> box_of(const TriangleMeshView<double>&);

}  // namespace surehit
