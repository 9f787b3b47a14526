#include "surehit/box.hpp"

#include <algorithm>

#include "build/vertex_lanes.hpp"
#include "support/floating_point_environment.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
Box<Scalar> box_of(const TriangleMeshView<Scalar>& mesh) {
  const FloatingPointEnvironment environment;
  // Each corner has a box of its own, so that no minimum or maximum waits for another.
  using Point = typename detail::VertexLanes<Scalar>::Point;
  const Box<Scalar> none;
  Point low[3];
  Point high[3];
  for (std::size_t corner = 0; corner < 3; ++corner) {
    low[corner] = Point{} + none.low[0];
    high[corner] = Point{} + none.high[0];
  }
  const detail::VertexLanes<Scalar> vertices(mesh);
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    Point corners[3];
    vertices.load_corners(i, corners);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      low[corner] = detail::lesser(corners[corner], low[corner]);
      high[corner] = detail::greater(corners[corner], high[corner]);
    }
  }
  Box<Scalar> box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    box.low[k] = std::min({low[0][axis], low[1][axis], low[2][axis]});
    box.high[k] = std::max({high[0][axis], high[1][axis], high[2][axis]});
  }
  return box;
}

template Box<float> box_of(const TriangleMeshView<float>&);
template Box<double> box_of(const TriangleMeshView<double>&);

}  // namespace surehit
