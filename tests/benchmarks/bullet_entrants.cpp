#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <array>

#include "entrants.hpp"

namespace surehit::benchmark {
namespace {

btVector3 to_bullet(const Vector3f& point) { return {point.x(), point.y(), point.z()}; }

class FirstHit : public btTriangleRaycastCallback {
 public:
  explicit FirstHit(const Segmentf& segment)
      : btTriangleRaycastCallback(to_bullet(segment.start), to_bullet(segment.end)) {}

  btScalar reportHit(const btVector3&, btScalar fraction, int, int triangle) override {
    hit.t = fraction;
    hit.triangle = static_cast<std::uint32_t>(triangle);
    return fraction;
  }

  Hitf hit;
};

/// Bullet cannot be told to stop; with the fraction at zero the triangles that are left cost it least.
class AnyHit : public btTriangleRaycastCallback {
 public:
  explicit AnyHit(const Segmentf& segment)
      : btTriangleRaycastCallback(to_bullet(segment.start), to_bullet(segment.end)) {}

  btScalar reportHit(const btVector3&, btScalar, int, int) override {
    blocked = true;
    return 0;
  }

  bool blocked = false;
};

class BulletContender : public Contender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    shape_.reset();
    copy(mesh);
    btIndexedMesh indexed;
    indexed.m_numTriangles = static_cast<int>(triangles_.size());
    indexed.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(triangles_.data());
    indexed.m_triangleIndexStride = sizeof triangles_[0];
    indexed.m_numVertices = static_cast<int>(vertices_.size());
    indexed.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
    indexed.m_vertexStride = sizeof vertices_[0];
    arrays_ = std::make_unique<btTriangleIndexVertexArray>();
    arrays_->addIndexedMesh(indexed);
    shape_ = std::make_unique<btBvhTriangleMeshShape>(arrays_.get(), true);
  }

  [[nodiscard]] std::size_t memory_bytes() const override {
    return vertices_.size() * sizeof vertices_[0] + triangles_.size() * sizeof triangles_[0] +
           shape_->getOptimizedBvh()->calculateSerializeBufferSize();
  }

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      FirstHit cast(paths.segments()[i]);
      shape_->performRaycast(&cast, cast.m_from, cast.m_to);
      hits[i] = cast.hit;
    }
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      AnyHit cast(paths.segments()[i]);
      shape_->performRaycast(&cast, cast.m_from, cast.m_to);
      blocked[i] = cast.blocked ? 1 : 0;
    }
  }

 private:
  void copy(const TriangleMeshViewf& mesh) {
    vertices_.resize(mesh.vertex_count());
    for (std::size_t i = 0; i < vertices_.size(); ++i) Vector3f::Map(vertices_[i].data()) = mesh.vertex(i);
    triangles_.resize(mesh.triangle_count());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      triangles_[i] = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
    }
  }

  std::vector<std::array<float, 3>> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;  // Bullet's types keep their own alignment by their operator new
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace

std::vector<Entrant> bullet_entrants() {
  return {{"Bullet", "", "", [] { return std::make_unique<BulletContender>(); }}};
}

}  // namespace surehit::benchmark
