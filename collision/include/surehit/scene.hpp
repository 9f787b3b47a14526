#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surehit/attributes.hpp"
#include "surehit/byte_sink.hpp"
#include "surehit/collider.hpp"
#include "surehit/executor.hpp"
#include "surehit/instance.hpp"
#include "surehit/load_result.hpp"
#include "surehit/pose.hpp"
#include "surehit/scene_queries.hpp"
#include "surehit/scene_snapshot.hpp"
#include "surehit/triangle.hpp"

namespace surehit {

namespace detail {
/// A type of which nothing can be made.
struct NoCollider {
  NoCollider() = delete;
};
/// What a scene holds behind its pointer.
template <FloatOrDouble Scalar>
struct SceneState;
/// Deletes it where its type is complete.
template <FloatOrDouble Scalar>
struct SUREHIT_API DeleteSceneState {
  /// Deletes the state, or does nothing if it is null.
  void operator()(SceneState<Scalar>* state) const noexcept;
};
}  // namespace detail

/// Many meshes, placed and moving, that are asked as one.
///
/// A scene holds instances. An instance is a collider with a pose, and it is the exact image of its mesh: no corner is
/// rounded. So answers are those of exact real arithmetic on the numbers of the path, the pose, the motion and the
/// mesh. t, u and v are rounded once. Among hits with equal exact t, the lowest instance id comes first, and then the
/// lowest triangle id. A scene of doubles takes colliders of float and of double.
///
/// `add`, `remove` and the setters take effect with the next `commit`. Until then, queries answer as before. A commit
/// looks at no triangle. The masks of a collider's triangles are the collider's, and take effect at once.
///
/// Queries are const and may run in many threads at the same time, and while one thread adds, removes and sets. They
/// are those of `SceneQueries`. The other const functions, except `snapshot`, tell what was set last. So none of them
/// may run while the scene changes or commits. No query of the scene may run while it commits, loads, or is assigned,
/// or while one of its colliders changes. A query of a `snapshot` may run while the scene commits.
///
/// A collider is shared by the instances that have it, and by its maker. It may be rebuilt. Then no query may run until
/// a commit has succeeded, which sees the new mesh.
template <FloatOrDouble Scalar>
class SUREHIT_API Scene : public SceneQueries<Scalar> {
 public:
  /// A shared collider of the scene's own Scalar.
  using ColliderPointer = std::shared_ptr<const Collider<Scalar>>;
  /// A shared collider of floats, for a scene of doubles. In a scene of floats, nothing is of this type.
  using FloatColliderPointer =
      std::conditional_t<std::same_as<Scalar, double>, std::shared_ptr<const Collider<float>>, detail::NoCollider>;

  /// Makes a scene without instances. Every query misses. Allocates nothing.
  Scene() noexcept = default;
  /// Frees all memory, and gives up its share of the colliders. No query of the scene may run. Snapshots stay.
  ~Scene() = default;
  /// Takes over the other scene's instances, in constant time. The other scene is then empty.
  Scene(Scene&&) noexcept = default;
  /// Frees what this scene has, and takes over the other one's instances. The other scene is then empty.
  Scene& operator=(Scene&&) noexcept = default;

  /// Adds an instance. Fails if the collider is null, if the pose is invalid (see `Pose`), or if there are too many
  /// instances. May throw std::bad_alloc. After any failure, the scene is as before.
  InstanceResult try_add(ColliderPointer collider, const Pose<Scalar>& pose = {}, const InstanceOptions& options = {});
  /// Does the same for a mesh of floats in a scene of doubles.
  InstanceResult try_add(FloatColliderPointer collider, const Pose<Scalar>& pose = {},
                         const InstanceOptions& options = {});

  /// Removes an instance. Fails for a stale id. A failure may throw std::bad_alloc, here and below.
  InstanceResult try_remove(InstanceId id);
  /// Gives an instance another collider. Its id, pose, motion, mask and user data stay. Fails for a stale id, or if the
  /// collider is null. Ask about the triangles of earlier hits before this, because they are those of the other mesh.
  InstanceResult try_set_collider(InstanceId id, ColliderPointer collider);
  /// Does the same for a mesh of floats in a scene of doubles.
  InstanceResult try_set_collider(InstanceId id, FloatColliderPointer collider);
  /// Sets the pose of an instance. Fails for a stale id, or for an invalid pose. Does not end its motion.
  InstanceResult try_set_pose(InstanceId id, const Pose<Scalar>& pose);
  /// Sets the motion of an instance. At parameter t, the instance is at its pose plus t times the motion. This is for
  /// segments and moving shapes, whose t is then a time in a step. Rays and lines see the instance at its pose.
  ///
  /// The motion stays until it is set again. Zero ends it. Fails for a stale id, or if the motion is not finite.
  InstanceResult try_set_motion(InstanceId id, const Vector3<Scalar>& motion);
  /// Sets the mask of an instance. Fails for a stale id.
  InstanceResult try_set_mask(InstanceId id, std::uint32_t mask);

#if defined(__cpp_exceptions)
  /// Adds an instance as `try_add` does. Throws the InvalidInstance that it would return.
  InstanceId add(ColliderPointer collider, const Pose<Scalar>& pose = {}, const InstanceOptions& options = {}) {
    return id_of(try_add(std::move(collider), pose, options));
  }
  /// Does the same for a mesh of floats in a scene of doubles.
  InstanceId add(FloatColliderPointer collider, const Pose<Scalar>& pose = {}, const InstanceOptions& options = {}) {
    return id_of(try_add(std::move(collider), pose, options));
  }
  /// Removes an instance as `try_remove` does. Throws the InvalidInstance that it would return.
  void remove(InstanceId id) { id_of(try_remove(id)); }
  /// Sets a collider as `try_set_collider` does. Throws the InvalidInstance that it would return.
  void set_collider(InstanceId id, ColliderPointer collider) { id_of(try_set_collider(id, std::move(collider))); }
  /// Does the same for a mesh of floats in a scene of doubles.
  void set_collider(InstanceId id, FloatColliderPointer collider) { id_of(try_set_collider(id, std::move(collider))); }
  /// Sets a pose as `try_set_pose` does. Throws the InvalidInstance that it would return.
  void set_pose(InstanceId id, const Pose<Scalar>& pose) { id_of(try_set_pose(id, pose)); }
  /// Sets a motion as `try_set_motion` does. Throws the InvalidInstance that it would return.
  void set_motion(InstanceId id, const Vector3<Scalar>& motion) { id_of(try_set_motion(id, motion)); }
  /// Sets a mask as `try_set_mask` does. Throws the InvalidInstance that it would return.
  void set_mask(InstanceId id, std::uint32_t mask) { id_of(try_set_mask(id, mask)); }
#endif

  /// Lets all changes since the last commit take effect. No query may run at the same time, and no collider of the
  /// scene may change. The executor's threads compute what the poses that have changed need. The tree is made on the
  /// calling thread. The result is the same. May throw std::bad_alloc. Then the committed state is as before.
  ///
  /// Takes time linear in the changes, and hardly any for the other instances. It looks at all of them if dozens come
  /// or go, or if the box of the scene grows. It sorts them anew after half of them have come, gone or appeared
  /// elsewhere, or once moved ones have made queries slow. `snapshot` says what a commit costs beside a snapshot.
  void commit(const std::optional<Executor>& executor = {});

  /// Returns the committed state as it is now. It stays the same while the scene changes and commits.
  ///
  /// Takes constant time and allocates nothing. It may run at the same time as queries, but not while the scene
  /// commits. The first commit beside a snapshot copies all instances. Later ones use the memory of a state that no
  /// snapshot has any more, and bring it up to date. A commit frees the other states that no snapshot has.
  [[nodiscard]] SceneSnapshot<Scalar> snapshot() const noexcept { return SceneSnapshot<Scalar>(this->committed_); }

  /// Writes the scene to a sink, as it was set last: each collider once, and the instances. `collision/FORMAT.md`
  /// describes each byte.
  ///
  /// The bytes are the same on every platform. Returns false if the sink did not take all of them. May throw
  /// std::bad_alloc, and throws what the sink throws.
  [[nodiscard]] bool save(const ByteSink& sink) const;
  /// Becomes the scene that was saved in these bytes, and is committed. The colliders are new ones.
  ///
  /// Ids stay valid: an instance has the id that it had in the saved scene. The id of an instance that was removed
  /// there is stale here too. New instances get the same ids in both scenes.
  ///
  /// The bytes may come from anyone, see `Collider::try_load`. May throw std::bad_alloc. After any failure, the scene
  /// is as before.
  LoadResult try_load(std::span<const std::byte> bytes, const LoadOptions& options = {});
#if defined(__cpp_exceptions)
  /// Returns the scene that was saved in these bytes, as `try_load` reads it. Throws the InvalidFile that it would
  /// return.
  [[nodiscard]] static Scene load(std::span<const std::byte> bytes, const LoadOptions& options = {}) {
    Scene scene;
    if (const LoadResult loaded = scene.try_load(bytes, options); !loaded) throw loaded.error();
    return scene;
  }
#endif

  /// Returns the number of instances, with those that are not yet committed.
  [[nodiscard]] std::size_t instance_count() const noexcept;
  /// Returns true if the id is that of an instance.
  [[nodiscard]] bool contains(InstanceId id) const noexcept;
  /// Returns the ids of all instances, in order. May throw std::bad_alloc.
  [[nodiscard]] std::vector<InstanceId> instances() const;
  /// Returns the pose that was set last. The id is that of an instance, here and below, or of one that was removed
  /// since the last commit: a hit may have it. The reference is valid until an instance is added.
  ///
  /// Throws an InvalidInstance if the id is stale, here and below. A library without exceptions ends the program.
  [[nodiscard]] const Pose<Scalar>& pose(InstanceId id) const;
  /// Returns the motion that was set last. It is zero if none was set. The reference is valid as that of the pose.
  [[nodiscard]] const Vector3<Scalar>& motion(InstanceId id) const;
  /// Returns the mask that was set last.
  [[nodiscard]] std::uint32_t mask(InstanceId id) const;
  /// Returns `InstanceOptions::user_data`.
  [[nodiscard]] std::uint64_t user_data(InstanceId id) const;
  /// Returns the number of triangles of the instance's collider.
  [[nodiscard]] std::size_t triangle_count(InstanceId id) const;

  /// Returns the memory that the scene has allocated, without its colliders, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  /// Returns the corners of a placed triangle at t = 0, as the pose that was set last places it. Each coordinate is the
  /// exact one, rounded once to nearest. `triangle` must be below `triangle_count(id)`. A shape that touches the exact
  /// image may miss the rounded one, so ask the scene for the `contact_point` and the `contact_normal` of a hit.
  [[nodiscard]] Triangle<Scalar> triangle(InstanceId id, std::uint32_t triangle) const;
  /// Returns the unit normal of a placed triangle, as `surehit::normal` returns that of a triangle: within 2 ulp(1).
  /// It is that of the exact image, before any corner is rounded.
  [[nodiscard]] Vector3<Scalar> normal(InstanceId id, std::uint32_t triangle) const;

 private:
#if defined(__cpp_exceptions)
  /// Returns the id of a success, or throws the error.
  static InstanceId id_of(const InstanceResult& result) {
    if (!result) throw result.error();
    return result.id();
  }
#endif
  /// Adds an instance of that one of the two colliders that is not null.
  InstanceResult add_instance(ColliderPointer collider, std::shared_ptr<const Collider<float>> float_collider,
                              const Pose<Scalar>& pose, const InstanceOptions& options);
  /// Gives an instance that one of the two colliders that is not null.
  InstanceResult set_either_collider(InstanceId id, ColliderPointer collider,
                                     std::shared_ptr<const Collider<float>> float_collider);
  /// Returns the state, or that of an empty scene.
  [[nodiscard]] const detail::SceneState<Scalar>& state() const noexcept;

  using StatePointer = std::unique_ptr<detail::SceneState<Scalar>, detail::DeleteSceneState<Scalar>>;
  StatePointer state_;  ///< Null before the first instance is added, and after a move from this scene.
};

extern template class SUREHIT_API Scene<float>;
extern template class SUREHIT_API Scene<double>;

using Scenef = Scene<float>;   ///< A scene in float.
using Scened = Scene<double>;  ///< A scene in double.

}  // namespace surehit
