#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surehit/attributes.hpp"
#include "surehit/instance.hpp"
#include "surehit/pose.hpp"
#include "surehit/scene_queries.hpp"
#include "surehit/triangle.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
class Scene;

/// What a scene had committed when `Scene::snapshot` was called. It answers all queries of a scene.
///
/// It stays the same while the scene is changed, committed, moved or destroyed in another thread. So queries go on
/// while the next commit is made. Copies cost nothing, and have the same state. Different ones may be copied and given
/// up in different threads.
///
/// It shares the colliders with the scene, and does not copy them. No query of a snapshot may run while one of its
/// colliders is rebuilt or gets other masks. After a rebuild, no query of an older snapshot may run at all, because it
/// does not see the new mesh as a commit does. Two colliders in turn let queries go on while a mesh deforms.
template <FloatOrDouble Scalar>
class SUREHIT_API SceneSnapshot : public SceneQueries<Scalar> {
 public:
  /// Makes a snapshot of an empty scene.
  SceneSnapshot() noexcept = default;

  /// Returns the number of committed instances.
  [[nodiscard]] std::size_t instance_count() const noexcept;
  /// Returns true if the id is that of a committed instance.
  [[nodiscard]] bool contains(InstanceId id) const noexcept;
  /// Returns the ids of all committed instances, in order. May throw std::bad_alloc.
  [[nodiscard]] std::vector<InstanceId> instances() const;
  /// Returns the committed pose. The reference is valid until this snapshot is destroyed or assigned.
  ///
  /// Throws an InvalidInstance if the id is not that of a committed instance, here and below. A library without
  /// exceptions ends the program.
  [[nodiscard]] const Pose<Scalar>& pose(InstanceId id) const SUREHIT_LIFETIMEBOUND;
  /// Returns the committed motion. The reference is valid as long as that of the pose.
  [[nodiscard]] const Vector3<Scalar>& motion(InstanceId id) const SUREHIT_LIFETIMEBOUND;
  /// Returns the committed mask.
  [[nodiscard]] std::uint32_t mask(InstanceId id) const;
  /// Returns `InstanceOptions::user_data`.
  [[nodiscard]] std::uint64_t user_data(InstanceId id) const;
  /// Returns the number of triangles of the instance's collider.
  [[nodiscard]] std::size_t triangle_count(InstanceId id) const;
  /// Returns the corners of a placed triangle, see `Scene::triangle`. It is placed by the committed pose.
  [[nodiscard]] Triangle<Scalar> triangle(InstanceId id, std::uint32_t triangle) const;
  /// Returns the unit normal of a placed triangle, see `Scene::normal`.
  [[nodiscard]] Vector3<Scalar> normal(InstanceId id, std::uint32_t triangle) const;

 private:
  friend class Scene<Scalar>;
  explicit SceneSnapshot(const detail::CommittedShare<Scalar>& committed) noexcept : SceneQueries<Scalar>(committed) {}
};

extern template class SUREHIT_API SceneSnapshot<float>;
extern template class SUREHIT_API SceneSnapshot<double>;

using SceneSnapshotf = SceneSnapshot<float>;   ///< A snapshot of a scene in float.
using SceneSnapshotd = SceneSnapshot<double>;  ///< A snapshot of a scene in double.

}  // namespace surehit
