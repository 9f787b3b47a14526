#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "surehit/collider.hpp"
#include "surehit/scene.hpp"
#include "surehit/scene_queries.hpp"
#include "surehit/scene_snapshot.hpp"

namespace surehit::c {

/// What a handle stands for.
enum class HandleKind : std::uint32_t {
  closed,
  collider_of_floats,
  collider_of_doubles,
  scene_of_floats,
  scene_of_doubles,
  snapshot_of_floats,
  snapshot_of_doubles
};

/// The kind of handles of an object.
template <typename Object>
inline constexpr HandleKind kind_of = HandleKind::closed;
template <>
inline constexpr HandleKind kind_of<Collider<float>> = HandleKind::collider_of_floats;
template <>
inline constexpr HandleKind kind_of<Collider<double>> = HandleKind::collider_of_doubles;
template <>
inline constexpr HandleKind kind_of<Scene<float>> = HandleKind::scene_of_floats;
template <>
inline constexpr HandleKind kind_of<Scene<double>> = HandleKind::scene_of_doubles;
template <>
inline constexpr HandleKind kind_of<SceneSnapshot<float>> = HandleKind::snapshot_of_floats;
template <>
inline constexpr HandleKind kind_of<SceneSnapshot<double>> = HandleKind::snapshot_of_doubles;

/// What a handle of the C interface points to. Its memory never goes back to the system, so that a handle can be told
/// from one that was closed. A closed one is used again, but only after many others.
class Handle {
 public:
  /// Returns a new handle of an object. May throw std::bad_alloc.
  template <typename Object>
  [[nodiscard]] static Handle* open(std::shared_ptr<Object> object) {
    return open(kind_of<Object>, std::move(object));
  }
  /// Gives up the object.
  void close() noexcept;

  /// Returns the object, or null if the handle is closed or of another kind.
  template <typename Object>
  [[nodiscard]] Object* get() const noexcept {
    return is_of<Object>() ? static_cast<Object*>(object_.get()) : nullptr;
  }
  /// Returns a share of the object. The handle must be of this kind.
  template <typename Object>
  [[nodiscard]] std::shared_ptr<Object> share() const noexcept {
    return std::static_pointer_cast<Object>(object_);
  }

 private:
  template <typename Object>
  [[nodiscard]] bool is_of() const noexcept {
    static_assert(kind_of<Object> != HandleKind::closed);
    return kind_.load(std::memory_order_relaxed) == kind_of<Object>;
  }
  [[nodiscard]] static Handle* open(HandleKind kind, std::shared_ptr<void> object);
  /// Returns a scene or a snapshot, or null if the handle is of neither.
  template <typename Scalar>
  [[nodiscard]] SceneQueries<Scalar>* queries() const noexcept {
    if (Scene<Scalar>* const scene = get<Scene<Scalar>>()) return scene;
    return get<SceneSnapshot<Scalar>>();
  }

  friend class ClosedHandles;

  std::atomic<HandleKind> kind_ = HandleKind::closed;
  std::shared_ptr<void> object_;
  Handle* next_closed_ = nullptr;  ///< The handle that was closed after this one.
};

// Scenes and snapshots have handles of one type in C, because they answer the same queries.
template <>
[[nodiscard]] inline SceneQueries<float>* Handle::get() const noexcept {
  return queries<float>();
}
template <>
[[nodiscard]] inline SceneQueries<double>* Handle::get() const noexcept {
  return queries<double>();
}

}  // namespace surehit::c
