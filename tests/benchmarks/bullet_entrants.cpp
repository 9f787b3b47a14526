#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <memory>

#include "bullet_mesh.hpp"
#include "entrants.hpp"

namespace surehit::benchmark {
namespace {

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

/// Bullet has no rays. A segment that is three times as long as the way to a ray's target goes past the mesh.
Segmentf cast_along(const PathBatch& paths, std::size_t index) {
  Segmentf segment = paths.segments()[index];
  if (paths.are_rays()) segment.end += 2 * (segment.end - segment.start);
  return segment;
}

class BulletContender : public Contender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    mesh_.reset();
    mesh_ = std::make_unique<BulletMesh>(mesh);
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return mesh_->memory_bytes(); }

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      FirstHit cast(cast_along(paths, i));
      mesh_->shape().performRaycast(&cast, cast.m_from, cast.m_to);
      hits[i] = cast.hit;
    }
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      AnyHit cast(cast_along(paths, i));
      mesh_->shape().performRaycast(&cast, cast.m_from, cast.m_to);
      blocked[i] = cast.blocked ? 1 : 0;
    }
  }

 private:
  std::unique_ptr<BulletMesh> mesh_;
};

}  // namespace

std::vector<Entrant> bullet_entrants() {
  return {{"Bullet", "", "", [] { return std::make_unique<BulletContender>(); }}};
}

}  // namespace surehit::benchmark
