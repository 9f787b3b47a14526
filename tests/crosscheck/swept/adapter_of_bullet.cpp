// Answers cases with Bullet: `swept_adapter_of_bullet <cases >answers`. An adapter of another engine looks like this.

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "swept_input.hpp"

namespace {

btVector3 vector(const std::array<double, 3>& x) {
  return {static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]), static_cast<btScalar>(x[2])};
}

class FirstTouch : public btCollisionWorld::ConvexResultCallback {
 public:
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    m_closestHitFraction = result.m_hitFraction;
    touches = true;
    return result.m_hitFraction;
  }

  bool touches = false;
};

/// Bullet's capsules are along an axis, so they have to be turned.
std::unique_ptr<btConvexShape> shape_of(const swept::Input& input, btQuaternion& turn) {
  const auto size = [&](std::size_t i) { return static_cast<btScalar>(input.size[i]); };
  if (input.shape == "sphere") return std::make_unique<btSphereShape>(size(0));
  const btVector3 first(size(0), size(1), size(2));
  if (input.shape == "box") return std::make_unique<btBoxShape>(first);
  if (first.isZero()) return std::make_unique<btSphereShape>(size(3));
  turn = shortestArcQuat(btVector3(0, 1, 0), first.normalized());
  return std::make_unique<btCapsuleShape>(size(3), 2 * first.length());
}

/// Bullet would round the numbers of such a case, and then answer another one.
void refuse_doubles(const swept::Input& input) {
  if (input.scalar == "float" || sizeof(btScalar) == sizeof(double)) return;
  std::fputs("Bullet computes in float here, and cannot answer cases of doubles\n", stderr);
  std::exit(1);
}

std::string ask(const swept::Input& input) {
  refuse_doubles(input);
  btTriangleMesh triangles;
  triangles.addTriangle(vector(input.corners[0]), vector(input.corners[1]), vector(input.corners[2]));
  btBvhTriangleMeshShape mesh(&triangles, true);
  btCollisionObject object;
  object.setCollisionShape(&mesh);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  world.addCollisionObject(&object);

  btQuaternion turn = btQuaternion::getIdentity();
  const std::unique_ptr<btConvexShape> shape = shape_of(input, turn);
  const auto at = [&](const std::array<double, 3>& place) { return btTransform(turn, vector(place)); };
  FirstTouch touch;
  world.convexSweepTest(shape.get(), at(input.start), at(input.end), touch);
  world.removeCollisionObject(&object);
  if (!touch.touches) return "miss";
  char text[64];
  std::snprintf(text, sizeof text, "hit %a", static_cast<double>(touch.m_closestHitFraction));
  return text;
}

}  // namespace

int main() { return swept::answer_all(ask); }
