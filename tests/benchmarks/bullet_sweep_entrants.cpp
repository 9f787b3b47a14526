#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <memory>

#include "bullet_mesh.hpp"
#include "sweep_entrants.hpp"

namespace surehit::benchmark {
namespace {

/// Decides a sweep in a microsecond to a millisecond.
constexpr std::size_t max_sweeps = 2000;
/// Among thousands of objects, it often takes ten milliseconds for one.
constexpr std::size_t max_sweeps_in_worlds = 100;

class FirstTouch : public btCollisionWorld::ConvexResultCallback {
 public:
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    m_closestHitFraction = result.m_hitFraction;
    hit.t = result.m_hitFraction;
    hit.triangle =
        result.m_localShapeInfo == nullptr ? 0 : static_cast<std::uint32_t>(result.m_localShapeInfo->m_triangleIndex);
    return result.m_hitFraction;
  }

  ShapeHitf hit;
};

std::unique_ptr<btConvexShape> shape_of(const SweepBatch& sweeps) {
  const btScalar size = sweeps.size();
  if (sweeps.kind() == ShapeKind::box) return std::make_unique<btBoxShape>(btVector3(size, size, size));
  if (sweeps.kind() == ShapeKind::capsule) return std::make_unique<btCapsuleShapeZ>(size, 2 * size);
  return std::make_unique<btSphereShape>(size);
}

/// Objects that do not move, and what shapes touch among them.
class BulletObjects {
 public:
  BulletObjects() = default;
  ~BulletObjects() { clear(); }
  BulletObjects(const BulletObjects&) = delete;
  BulletObjects& operator=(const BulletObjects&) = delete;

  void clear() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
    objects_.clear();
  }

  void add(btCollisionShape& shape, const btTransform& pose) {
    objects_.push_back(std::make_unique<btCollisionObject>());
    objects_.back()->setCollisionShape(&shape);
    objects_.back()->setWorldTransform(pose);
    // As in Bullet's worlds of bodies, what stands still is not paired with its like.
    world_.addCollisionObject(objects_.back().get(), btBroadphaseProxy::StaticFilter,
                              btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  }

  /// Builds the tree of the objects anew, which was made by adding one at a time.
  void optimize() { broadphase_.optimize(); }

  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) const {
    const std::unique_ptr<btConvexShape> shape = shape_of(sweeps);
    const auto at = [](const Vector3f& place) { return btTransform(btQuaternion::getIdentity(), to_bullet(place)); };
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Segmentf& path = sweeps.paths().segments()[i];
      FirstTouch touch;
      world_.convexSweepTest(shape.get(), at(path.start), at(path.end), touch);
      hits[i] = touch.hit;
    }
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

class BulletSweep : public SweepContender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    objects_.clear();
    mesh_ = std::make_unique<BulletMesh>(mesh);
    objects_.add(mesh_->shape(), btTransform::getIdentity());
  }

  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override { objects_.first(sweeps, hits); }

 private:
  std::unique_ptr<BulletMesh> mesh_;
  BulletObjects objects_;
};

/// An instance that is stretched has a shape of its own over its mesh, which is shared.
class BulletWorldSweep : public WorldSweepContender {
 public:
  void build(const World& world) override {
    objects_.clear();
    stretched_.clear();
    meshes_.clear();
    for (const auto& mesh : world.meshes) meshes_.push_back(std::make_unique<BulletMesh>(mesh.view()));
    for (const auto& [mesh, pose] : world.instances) {
      // All poses here are a stretch along the mesh's axes, and then a turn.
      const Vector3f stretch = pose.linear.colwise().norm();
      const Posef::Matrix3 turn = pose.linear * stretch.cwiseInverse().asDiagonal();
      const btMatrix3x3 basis(turn(0, 0), turn(0, 1), turn(0, 2), turn(1, 0), turn(1, 1), turn(1, 2), turn(2, 0),
                              turn(2, 1), turn(2, 2));
      const btTransform place(basis, to_bullet(pose.translation));
      if (stretch.isOnes(1e-5F)) {
        objects_.add(meshes_[mesh]->shape(), place);
      } else {
        stretched_.push_back(
            std::make_unique<btScaledBvhTriangleMeshShape>(&meshes_[mesh]->shape(), to_bullet(stretch)));
        objects_.add(*stretched_.back(), place);
      }
    }
    objects_.optimize();
  }

  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override { objects_.first(sweeps, hits); }

 private:
  std::vector<std::unique_ptr<BulletMesh>> meshes_;
  std::vector<std::unique_ptr<btScaledBvhTriangleMeshShape>> stretched_;
  BulletObjects objects_;
};

}  // namespace

std::vector<SweepEntrant> bullet_sweep_entrants() {
  return {{"Bullet", "", [] { return std::make_unique<BulletSweep>(); }, max_sweeps}};
}

std::vector<WorldSweepEntrant> bullet_world_sweep_entrants() {
  return {{"Bullet", "", [] { return std::make_unique<BulletWorldSweep>(); }, max_sweeps_in_worlds}};
}

}  // namespace surehit::benchmark
