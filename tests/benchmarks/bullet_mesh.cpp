#include "bullet_mesh.hpp"

#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>

namespace surehit::benchmark {

BulletMesh::BulletMesh(const TriangleMeshViewf& mesh)
    : vertices_(mesh.vertex_count()),
      triangles_(mesh.triangle_count()),
      arrays_(std::make_unique<btTriangleIndexVertexArray>()) {
  for (std::size_t i = 0; i < vertices_.size(); ++i) Vector3f::Map(vertices_[i].data()) = mesh.vertex(i);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    triangles_[i] = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
  }
  btIndexedMesh indexed;
  indexed.m_numTriangles = static_cast<int>(triangles_.size());
  indexed.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(triangles_.data());
  indexed.m_triangleIndexStride = sizeof triangles_[0];
  indexed.m_numVertices = static_cast<int>(vertices_.size());
  indexed.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
  indexed.m_vertexStride = sizeof vertices_[0];
  arrays_->addIndexedMesh(indexed);
  shape_ = std::make_unique<btBvhTriangleMeshShape>(arrays_.get(), true);
}

std::size_t BulletMesh::memory_bytes() const {
  return vertices_.size() * sizeof vertices_[0] + triangles_.size() * sizeof triangles_[0] +
         shape_->getOptimizedBvh()->calculateSerializeBufferSize();
}

}  // namespace surehit::benchmark
