#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <memory>

#include "bullet_mesh.hpp"
#include "sweep_entrants.hpp"

namespace surehit::benchmark {
namespace {

/// Decides a sweep in a microsecond to a millisecond.
constexpr std::size_t max_sweeps = 2000;

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

/// A world that has one mesh, which does not move.
class BulletSweep : public SweepContender {
 public:
  ~BulletSweep() override { clear(); }

  void build(const TriangleMeshViewf& mesh) override {
    clear();
    mesh_ = std::make_unique<BulletMesh>(mesh);
    object_.setCollisionShape(&mesh_->shape());
    world_.addCollisionObject(&object_);
  }

  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
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
  void clear() {
    if (mesh_ != nullptr) world_.removeCollisionObject(&object_);
    mesh_.reset();
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btCollisionObject object_;
  std::unique_ptr<BulletMesh> mesh_;
};

}  // namespace

std::vector<SweepEntrant> bullet_sweep_entrants() {
  return {{"Bullet", "", [] { return std::make_unique<BulletSweep>(); }, max_sweeps}};
}

}  // namespace surehit::benchmark
