#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <memory>

#include "sweep_entrants.hpp"

namespace surehit::benchmark {
namespace {

/// Decides a sweep in a microsecond to a millisecond.
constexpr std::size_t max_sweeps = 2000;

std::unique_ptr<fcl::CollisionGeometryd> shape_of(const SweepBatch& sweeps) {
  const double size = sweeps.size();
  if (sweeps.kind() == ShapeKind::box) return std::make_unique<fcl::Boxd>(2 * size, 2 * size, 2 * size);
  if (sweeps.kind() == ShapeKind::capsule) return std::make_unique<fcl::Capsuled>(size, 2 * size);
  return std::make_unique<fcl::Sphered>(size);
}

class FclSweep : public SweepContender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    model_ = std::make_unique<Model>();
    std::vector<fcl::Vector3d> vertices;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) vertices.push_back(mesh.vertex(i).cast<double>());
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      triangles.emplace_back(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
    }
    model_->beginModel();
    model_->addSubModel(vertices, triangles);
    model_->endModel();
  }

  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    const std::unique_ptr<fcl::CollisionGeometryd> shape = shape_of(sweeps);
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    const auto at = [&](const Vector3f& place) {
      fcl::Transform3d transform = rest;
      transform.translation() = place.cast<double>();
      return transform;
    };
    // The defaults try ten places along the way. Its conservative advancement finds no contact of a ball with a mesh.
    const fcl::ContinuousCollisionRequestd request;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Segmentf& path = sweeps.paths().segments()[i];
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide<double>(model_.get(), rest, rest, shape.get(), at(path.start), at(path.end), request,
                                     result);
      hits[i] = {};
      if (!result.is_collide) continue;
      hits[i].t = static_cast<float>(result.time_of_contact);
      hits[i].triangle = 0;  // FCL does not say which.
    }
  }

 private:
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  std::unique_ptr<Model> model_;
};

}  // namespace

std::vector<SweepEntrant> fcl_sweep_entrants() {
  return {{"FCL", "", [] { return std::make_unique<FclSweep>(); }, max_sweeps}};
}

}  // namespace surehit::benchmark
