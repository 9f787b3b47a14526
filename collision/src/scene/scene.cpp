#include "surehit/scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "file/scene_file.hpp"
#include "scene/committed_scene.hpp"
#include "scene/instance_triangle.hpp"
#include "scene/invalid_pose.hpp"
#include "scene/scene_state.hpp"
#include "scene/stale_id.hpp"
#include "support/floating_point_environment.hpp"
#include "support/in_parts.hpp"
#include "support/never_destroyed.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

template <typename Scalar>
using SceneStateOf = detail::SceneState<Scalar>;

InvalidInstance no_collider() {
  return {InvalidInstance::Reason::no_collider, 0, "the pointer to the collider is null"};
}

}  // namespace

template <FloatOrDouble Scalar>
void detail::DeleteSceneState<Scalar>::operator()(SceneStateOf<Scalar>* state) const noexcept {
  delete state;
}

template <FloatOrDouble Scalar>
const SceneStateOf<Scalar>& Scene<Scalar>::state() const noexcept {
  return state_ ? *state_ : detail::never_destroyed<SceneStateOf<Scalar>>();
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::add_instance(ColliderPointer collider,
                                           std::shared_ptr<const Collider<float>> float_collider,
                                           const Pose<Scalar>& pose, const InstanceOptions& options) {
  const FloatingPointEnvironment environment;
  if (!collider && !float_collider) return no_collider();
  if (std::optional<InvalidInstance> invalid = detail::find_invalid(pose)) return *std::move(invalid);
  // The pose may be that of an instance of this scene, which moves when the scene grows.
  const detail::Placement<Scalar> placement = {pose};
  if (!state_) state_ = StatePointer(new SceneStateOf<Scalar>);
  auto& pending = state_->pending;
  if (state_->unused.empty()) {
    // An index is below the bit of the tree that marks an instance.
    constexpr std::size_t max_instances = detail::InstanceTree::instance_bit - 1;
    if (pending.size() >= max_instances) {
      return InvalidInstance(InvalidInstance::Reason::too_many_instances, pending.size(),
                             std::to_string(pending.size()) + " instances are the maximum");
    }
    const std::size_t room = std::max<std::size_t>(8, 2 * pending.size());
    if (pending.size() == pending.capacity()) pending.reserve(room);
    // Later changes and removals need no memory.
    state_->changed.reserve(pending.capacity());
    state_->unused.reserve(pending.capacity());
    state_->unused.push_back(static_cast<std::uint32_t>(pending.size()));
    pending.emplace_back();
  }
  const std::uint32_t index = state_->unused.back();
  state_->unused.pop_back();
  detail::PendingInstance<Scalar>& instance = pending[index];
  instance.set_collider(std::move(collider), std::move(float_collider));
  instance.placement = placement;
  instance.options = options;
  instance.is_there = true;
  state_->note_change(index);
  ++state_->count;
  return InstanceId{index, instance.generation};
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_add(ColliderPointer collider, const Pose<Scalar>& pose,
                                      const InstanceOptions& options) {
  return add_instance(std::move(collider), nullptr, pose, options);
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_add(FloatColliderPointer collider, const Pose<Scalar>& pose,
                                      const InstanceOptions& options) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return add_instance(nullptr, std::move(collider), pose, options);
  } else {
    return add_instance(nullptr, nullptr, pose, options);  // No one can call it.
  }
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_remove(InstanceId id) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return detail::stale_id(id);
  // The collider stays until the commit, because queries may still use it. So does the index.
  instance->is_there = false;
  ++instance->generation;
  state_->note_change(id.index);
  --state_->count;
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::set_either_collider(InstanceId id, ColliderPointer collider,
                                                  std::shared_ptr<const Collider<float>> float_collider) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return detail::stale_id(id);
  if (!collider && !float_collider) return no_collider();
  // Queries use the other one until the commit, which has a share of it.
  instance->set_collider(std::move(collider), std::move(float_collider));
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_collider(InstanceId id, ColliderPointer collider) {
  return set_either_collider(id, std::move(collider), nullptr);
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_collider(InstanceId id, FloatColliderPointer collider) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return set_either_collider(id, nullptr, std::move(collider));
  } else {
    return set_either_collider(id, nullptr, nullptr);  // No one can call it.
  }
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_pose(InstanceId id, const Pose<Scalar>& pose) {
  const FloatingPointEnvironment environment;
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return detail::stale_id(id);
  if (std::optional<InvalidInstance> invalid = detail::find_invalid(pose)) return *std::move(invalid);
  instance->placement.pose = pose;
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_motion(InstanceId id, const Vector3<Scalar>& motion) {
  const FloatingPointEnvironment environment;
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return detail::stale_id(id);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isfinite(motion[static_cast<Eigen::Index>(axis)])) continue;
    return InvalidInstance(InvalidInstance::Reason::non_finite_motion, axis,
                           "motion[" + std::to_string(axis) + "] is not finite");
  }
  instance->placement.motion = motion;
  instance->placement.moves = motion != Vector3<Scalar>::Zero();
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_mask(InstanceId id, std::uint32_t mask) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return detail::stale_id(id);
  instance->options.mask = mask;
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::commit(const std::optional<Executor>& executor) {
  const FloatingPointEnvironment environment;
  if (!state_) return;
  // The first commit makes it, because queries may run while instances are added.
  if (this->committed_.get() == nullptr) {
    this->committed_ = detail::CommittedShare<Scalar>(new detail::CommittedScene<Scalar>);
  }
  state_->commit(this->committed_, detail::address_of(executor));
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::save(const ByteSink& sink) const {
  return detail::save(state(), sink);
}

template <FloatOrDouble Scalar>
LoadResult Scene<Scalar>::try_load(std::span<const std::byte> bytes, const LoadOptions& options) {
  const FloatingPointEnvironment environment;
  StatePointer loaded(new SceneStateOf<Scalar>);
  detail::CommittedShare<Scalar> committed(new detail::CommittedScene<Scalar>);
  if (std::optional<InvalidFile> invalid = detail::load(bytes, options, *loaded, committed)) return *std::move(invalid);
  state_ = std::move(loaded);
  this->committed_ = std::move(committed);
  return {};
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::instance_count() const noexcept {
  return state().count;
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::contains(InstanceId id) const noexcept {
  return state().find(id) != nullptr;
}

template <FloatOrDouble Scalar>
std::vector<InstanceId> Scene<Scalar>::instances() const {
  std::vector<InstanceId> ids;
  ids.reserve(state().count);
  const auto& pending = state().pending;
  for (std::uint32_t index = 0; index < pending.size(); ++index) {
    if (pending[index].is_there) ids.push_back({index, pending[index].generation});
  }
  return ids;
}

template <FloatOrDouble Scalar>
const Pose<Scalar>& Scene<Scalar>::pose(InstanceId id) const {
  return detail::known_instance(state().find_of_hit(id), id).placement.pose;
}

template <FloatOrDouble Scalar>
const Vector3<Scalar>& Scene<Scalar>::motion(InstanceId id) const {
  return detail::known_instance(state().find_of_hit(id), id).placement.motion;
}

template <FloatOrDouble Scalar>
std::uint32_t Scene<Scalar>::mask(InstanceId id) const {
  return detail::known_instance(state().find_of_hit(id), id).options.mask;
}

template <FloatOrDouble Scalar>
std::uint64_t Scene<Scalar>::user_data(InstanceId id) const {
  return detail::known_instance(state().find_of_hit(id), id).options.user_data;
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::triangle_count(InstanceId id) const {
  return detail::triangle_count(detail::known_instance(state().find_of_hit(id), id).mesh());
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::memory_bytes() const noexcept {
  if (!state_) return 0;
  return state_->memory_bytes() + this->committed().memory_bytes();
}

template <FloatOrDouble Scalar>
Triangle<Scalar> Scene<Scalar>::triangle(InstanceId id, std::uint32_t triangle) const {
  const detail::PendingInstance<Scalar>& instance = detail::known_instance(state().find_of_hit(id), id);
  return detail::placed_corners(instance.mesh(), instance.placement, triangle);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Scene<Scalar>::normal(InstanceId id, std::uint32_t triangle) const {
  const detail::PendingInstance<Scalar>& instance = detail::known_instance(state().find_of_hit(id), id);
  return detail::placed_normal(instance.mesh(), instance.placement, triangle);
}

template struct detail::DeleteSceneState<float>;
template struct detail::DeleteSceneState<double>;
template class Scene<float>;
template class Scene<double>;

}  // namespace surehit
