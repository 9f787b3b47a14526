#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "exact_world_answers.hpp"

namespace surehit::benchmark {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

ExactPoint to_exact(const Vector3f& point) { return {double{point.x()}, double{point.y()}, double{point.z()}}; }

/// Returns the corner of the exact image: M v + m, without a rounding.
ExactPoint exactly_placed(const Posef& pose, const Vector3f& corner) {
  std::array<ExactKernel::FT, 3> image;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    ExactKernel::FT& coordinate = image[static_cast<std::size_t>(axis)];
    coordinate = double{pose.translation[axis]};
    for (Eigen::Index i = 0; i < 3; ++i) {
      // The product of two floats is exact in double.
      coordinate += ExactKernel::FT(double{pose.linear(axis, i)} * double{corner[i]});
    }
  }
  return {image[0], image[1], image[2]};
}

/// A segment in double, which leaves out boxes that it is certainly apart from.
class RoughPath {
 public:
  explicit RoughPath(const Segmentf& path)
      : centre_((path.start.cast<double>() + path.end.cast<double>()) / 2),
        half_((path.end.cast<double>() - path.start.cast<double>()) / 2) {}

  /// Looks for an axis along which they are apart: those of the box, and their cross products with the path. All of
  /// this is off by some ulps in double, so boxes grow by far more than that.
  [[nodiscard]] bool may_meet(const Boxd& box) const {
    const Vector3d low = box.low - centre_;
    const Vector3d high = box.high - centre_;
    double size = 0;
    for (const Vector3d& vector : {low, high, centre_, half_}) size = std::max(size, vector.cwiseAbs().maxCoeff());
    const Vector3d middle = (low + high) / 2;
    const Vector3d reach = (high - low) / 2 + Vector3d::Constant(1e-9 * size);
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (std::abs(middle[i]) > reach[i] + std::abs(half_[i])) return false;
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index j = (i + 1) % 3;
      const Eigen::Index k = (i + 2) % 3;
      const double apart = std::abs(half_[j] * middle[k] - half_[k] * middle[j]);
      if (apart > std::abs(half_[j]) * reach[k] + std::abs(half_[k]) * reach[j]) return false;
    }
    return true;
  }

 private:
  Vector3d centre_;
  Vector3d half_;
};

/// Asks CGAL's exact kernel about each placed triangle near a path.
class ExactWorld {
 public:
  explicit ExactWorld(const World& world) : world_(world) {
    std::vector<Boxf> boxes;
    for (const auto& mesh : world.meshes) boxes.push_back(box_of(mesh.view()));
    for (const auto& [mesh, pose] : world.instances) boxes_.push_back(placed(pose, boxes[mesh]));
  }

  [[nodiscard]] bool meets(const Segmentf& path) const {
    const RoughPath rough(path);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (rough.may_meet(boxes_[i]) && meets(path, rough, world_.instances[i])) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool meets(const Segmentf& path, const RoughPath& rough, const PlacedMesh& instance) const {
    const auto& mesh = world_.meshes[instance.mesh];
    std::vector<Vector3d> vertices;
    for (const auto& vertex : mesh.vertices) {
      vertices.push_back(placed(instance.pose, Vector3f::Map(vertex.data()).cast<double>()));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Boxd box;
      for (const std::uint32_t corner : mesh.triangles[i]) box.extend(vertices[corner]);
      if (rough.may_meet(box) && exactly_meets(path, mesh.view().triangle(i), instance.pose)) return true;
    }
    return false;
  }

  static bool exactly_meets(const Segmentf& path, const Trianglef& triangle, const Posef& pose) {
    const ExactPoint a = exactly_placed(pose, triangle.a);
    const ExactPoint b = exactly_placed(pose, triangle.b);
    const ExactPoint c = exactly_placed(pose, triangle.c);
    const auto path_meets = [&](const auto& shape) {
      const ExactPoint start = to_exact(path.start);
      const ExactPoint end = to_exact(path.end);
      return start == end ? CGAL::do_intersect(start, shape)
                          : CGAL::do_intersect(ExactKernel::Segment_3(start, end), shape);
    };
    // CGAL wants triangles that are not degenerate, and segments that are not points.
    if (!CGAL::collinear(a, b, c)) return path_meets(ExactKernel::Triangle_3(a, b, c));
    const auto [least, greatest] = std::minmax({a, b, c});
    return least == greatest ? path_meets(least) : path_meets(ExactKernel::Segment_3(least, greatest));
  }

  const World& world_;
  std::vector<Boxd> boxes_;
};

}  // namespace

std::vector<std::uint8_t> exact_world_answers(const World& world, std::span<const Segmentf> paths) {
  constexpr std::size_t max_judged = 4000;
  const ExactWorld exact(world);
  std::vector<std::uint8_t> answers;
  for (const Segmentf& path : paths.first(std::min(paths.size(), max_judged))) {
    answers.push_back(exact.meets(path) ? 1 : 0);
  }
  return answers;
}

}  // namespace surehit::benchmark
