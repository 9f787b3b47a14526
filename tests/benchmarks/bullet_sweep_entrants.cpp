#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
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
    const btSphereShape ball(sweeps.size());
    const auto at = [](const Vector3f& place) { return btTransform(btQuaternion::getIdentity(), to_bullet(place)); };
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Segmentf& path = sweeps.paths().segments()[i];
      FirstTouch touch;
      world_.convexSweepTest(&ball, at(path.start), at(path.end), touch);
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
