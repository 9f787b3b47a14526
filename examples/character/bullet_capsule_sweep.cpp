#include "character/bullet_capsule_sweep.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <Eigen/Geometry>
#include <cmath>
#include <surehit/hit.hpp>

namespace surehit::example {
namespace {

btTransform pose_at(const Vector3f& position) {
  return btTransform(btQuaternion::getIdentity(), {position.x(), position.y(), position.z()});
}

class FirstContact : public btCollisionWorld::ConvexResultCallback {
 public:
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    m_closestHitFraction = result.m_hitFraction;
    normal = {result.m_hitNormalLocal.x(), result.m_hitNormalLocal.y(), result.m_hitNormalLocal.z()};
    if (result.m_localShapeInfo) triangle = static_cast<std::uint32_t>(result.m_localShapeInfo->m_triangleIndex);
    return result.m_hitFraction;
  }

  Vector3f normal = Vector3f::Zero();
  std::uint32_t triangle = 0;
};

class BulletCapsuleSweep : public CapsuleSweep {
 public:
  BulletCapsuleSweep(const Mesh<float>& mesh, const BulletOptions& options)
      : mesh_(mesh), skin_(options.skin), capsule_(Body::radius, 2 * Body::half_height) {
    btIndexedMesh indexed;
    indexed.m_numTriangles = static_cast<int>(mesh.triangles.size());
    indexed.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.triangles.data());
    indexed.m_triangleIndexStride = sizeof mesh.triangles[0];
    indexed.m_numVertices = static_cast<int>(mesh.vertices.size());
    indexed.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices.data());
    indexed.m_vertexStride = sizeof mesh.vertices[0];
    arrays_.addIndexedMesh(indexed);
    level_ = std::make_unique<btBvhTriangleMeshShape>(&arrays_, true);
    level_->setMargin(options.margin);
    object_.setCollisionShape(level_.get());
  }

  [[nodiscard]] std::optional<Stop> find_stop(const Vector3f& from, const Vector3f& to,
                                              std::size_t& queries) const override {
    FirstContact contact;
    ++queries;
    // What btCollisionWorld::convexSweepTest does with each object. It changes nothing, so threads may share it.
    btCollisionWorld::objectQuerySingle(&capsule_, pose_at(from), pose_at(to), &object_, level_.get(),
                                        btTransform::getIdentity(), contact, 0);
    if (!contact.hasHit()) return std::nullopt;
    const Vector3f position = from + contact.m_closestHitFraction * (to - from) + skin_ * contact.normal;
    return Stop{position, contact.normal, is_off_face(contact.normal, normal(mesh_.view(), contact.triangle))};
  }

 private:
  const Mesh<float>& mesh_;
  float skin_;
  btCapsuleShapeZ capsule_;
  btTriangleIndexVertexArray arrays_;
  std::unique_ptr<btBvhTriangleMeshShape> level_;
  mutable btCollisionObject object_;  // Bullet's callbacks take it as not constant, and leave it as it is.
};

}  // namespace

std::unique_ptr<const CapsuleSweep> make_bullet_capsule_sweep(const Mesh<float>& mesh, const BulletOptions& options) {
  return std::make_unique<BulletCapsuleSweep>(mesh, options);
}

}  // namespace surehit::example
