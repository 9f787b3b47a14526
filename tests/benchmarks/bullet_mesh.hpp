#pragma once

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

namespace surehit::benchmark {

[[nodiscard]] inline btVector3 to_bullet(const Vector3f& point) { return {point.x(), point.y(), point.z()}; }

/// A mesh as Bullet has it.
class BulletMesh {
 public:
  /// Copies the mesh, and builds its tree.
  explicit BulletMesh(const TriangleMeshViewf& mesh);

  [[nodiscard]] btBvhTriangleMeshShape& shape() const { return *shape_; }
  /// Returns the bytes of the copy and of the tree.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::vector<std::array<float, 3>> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;  // Bullet's types keep their own alignment by their operator new
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace surehit::benchmark
