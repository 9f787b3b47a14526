#include "world_paths.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace surehit::benchmark {
namespace {

using test::Random;

/// Draws points on the surfaces of all instances, each part as often as its area says. A pose that stretches counts by
/// the mean of its squared stretches.
class PlacedSurfaces {
 public:
  explicit PlacedSurfaces(const World& world) : world_(world) {
    std::vector<double> areas;
    for (const auto& mesh : world.meshes) {
      surfaces_.emplace_back(mesh.view(), [](const Trianglef&) { return true; });
      double area = 0;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Trianglef triangle = mesh.view().triangle(i);
        const Vector3d a = triangle.a.cast<double>();
        area += (triangle.b.cast<double>() - a).cross(triangle.c.cast<double>() - a).norm();
      }
      areas.push_back(area);
    }
    double area = 0;
    for (const auto& [mesh, pose] : world.instances) {
      area += areas[mesh] * pose.linear.cast<double>().squaredNorm() / 3;
      area_up_to_.push_back(area);
    }
  }

  /// Draws a point of an instance.
  [[nodiscard]] Vector3d draw_of(const PlacedMesh& instance, Random& random) const {
    return placed(instance.pose, surfaces_[instance.mesh].draw(random));
  }

  [[nodiscard]] Vector3d draw(Random& random) const {
    const double area = random.unit<double>() * area_up_to_.back();
    const auto place = std::upper_bound(area_up_to_.begin(), area_up_to_.end(), area);
    return draw_of(world_.instances[static_cast<std::size_t>(place - area_up_to_.begin())], random);
  }

 private:
  const World& world_;
  std::vector<SurfacePoints> surfaces_;
  std::vector<double> area_up_to_;  ///< of the instances up to each one, itself included
};

class WorldPathDrawer {
 public:
  WorldPathDrawer(PathSet set, const World& world)
      : set_(set), world_(world), box_(world.box()), diagonal_((box_.high - box_.low).norm()), surfaces_(world) {
    for (const auto& mesh : world.meshes) mesh_boxes_.push_back(box_of(mesh.view()));
  }

  [[nodiscard]] Segmentf draw(Random& random) const {
    const auto rounded = [](const Vector3d& start, const Vector3d& end) {
      return Segmentf{start.cast<float>(), end.cast<float>()};
    };
    switch (set_) {
      case PathSet::short_paths: {
        const Vector3d start = draw_in_box(1, random);
        return rounded(start, start + 0.01 * diagonal_ * draw_direction(random));
      }
      case PathSet::near_paths: {
        const Vector3d touched = surfaces_.draw(random);
        const Vector3d start = touched + 0.005 * diagonal_ * draw_in_unit_ball(random);
        return rounded(start, start + 0.01 * diagonal_ * draw_direction(random));
      }
      case PathSet::detail_paths: {
        const PlacedMesh& instance = world_.instances[random.below(world_.instances.size())];
        const Boxd box = placed(instance.pose, mesh_boxes_[instance.mesh]);
        const double length = (box.high - box.low).norm();
        const Vector3d touched = surfaces_.draw_of(instance, random);
        const Vector3d start = touched + 0.5 * length * draw_in_unit_ball(random);
        return rounded(start, start + length * draw_direction(random));
      }
      case PathSet::long_paths: {
        const Vector3d start = draw_in_box(1.2, random);
        return rounded(start, draw_in_box(1.2, random));
      }
      case PathSet::sight_paths:
        return rounded(world_.eye, surfaces_.draw(random) + NamedMesh::target_height * diagonal_ * Vector3d::UnitZ());
      default:
        throw std::logic_error("no such paths are drawn in worlds");
    }
  }

 private:
  [[nodiscard]] Vector3d draw_in_box(double inflation, Random& random) const {
    const Vector3d from_centre = draw_in_unit_cube(random) - Vector3d::Constant(0.5);
    return (box_.low + box_.high) / 2 + inflation * from_centre.cwiseProduct(box_.high - box_.low);
  }

  PathSet set_;
  const World& world_;
  Boxd box_;
  double diagonal_;
  std::vector<Boxf> mesh_boxes_;
  PlacedSurfaces surfaces_;
};

}  // namespace

std::vector<PathSet> path_sets_of(const World& world) {
  std::vector<PathSet> sets = {PathSet::short_paths, PathSet::near_paths, PathSet::long_paths, PathSet::sight_paths};
  if (world.has_details) sets.insert(sets.begin() + 2, PathSet::detail_paths);
  return sets;
}

PathBatch draw_world_paths(PathSet set, const World& world, std::size_t count, std::uint64_t seed) {
  const WorldPathDrawer drawer(set, world);
  Random random(seed);
  std::vector<Segmentf> segments;
  do {
    segments.push_back(drawer.draw(random));
  } while (segments.size() < count || segments.size() % PathBatch::octet_size != 0);
  return PathBatch(std::move(segments));
}

PathBatch in_frame_of(const Posef& pose, const PathBatch& paths) {
  const Eigen::Matrix3d inverse = pose.linear.cast<double>().inverse();
  const auto seen = [&](const Vector3f& point) {
    return Vector3f((inverse * (point.cast<double>() - pose.translation.cast<double>())).cast<float>());
  };
  std::vector<Segmentf> segments;
  for (const Segmentf& path : paths.segments()) segments.push_back({seen(path.start), seen(path.end)});
  return PathBatch(std::move(segments));
}

}  // namespace surehit::benchmark
