#include "surehit/scene_snapshot.hpp"

#include "scene/committed_scene.hpp"
#include "scene/instance_triangle.hpp"
#include "scene/stale_id.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
std::size_t SceneSnapshot<Scalar>::instance_count() const noexcept {
  return this->committed().count;
}

template <FloatOrDouble Scalar>
bool SceneSnapshot<Scalar>::contains(InstanceId id) const noexcept {
  return this->committed().find(id) != nullptr;
}

template <FloatOrDouble Scalar>
std::vector<InstanceId> SceneSnapshot<Scalar>::instances() const {
  const detail::CommittedScene<Scalar>& scene = this->committed();
  std::vector<InstanceId> ids;
  ids.reserve(scene.count);
  for (std::uint32_t index = 0; index < scene.instances.size(); ++index) {
    const InstanceId id = {index, scene.instances[index].generation};
    if (scene.find(id) != nullptr) ids.push_back(id);
  }
  return ids;
}

template <FloatOrDouble Scalar>
const Pose<Scalar>& SceneSnapshot<Scalar>::pose(InstanceId id) const {
  return detail::known_instance(this->committed().find(id), id).placed.placement.pose;
}

template <FloatOrDouble Scalar>
const Vector3<Scalar>& SceneSnapshot<Scalar>::motion(InstanceId id) const {
  return detail::known_instance(this->committed().find(id), id).placed.placement.motion;
}

template <FloatOrDouble Scalar>
std::uint32_t SceneSnapshot<Scalar>::mask(InstanceId id) const {
  return detail::known_instance(this->committed().find(id), id).mask;
}

template <FloatOrDouble Scalar>
std::uint64_t SceneSnapshot<Scalar>::user_data(InstanceId id) const {
  static_cast<void>(detail::known_instance(this->committed().find(id), id));
  return this->committed().kept[id.index].user_data;
}

template <FloatOrDouble Scalar>
std::size_t SceneSnapshot<Scalar>::triangle_count(InstanceId id) const {
  return detail::triangle_count(detail::known_instance(this->committed().find(id), id).mesh);
}

template <FloatOrDouble Scalar>
Triangle<Scalar> SceneSnapshot<Scalar>::triangle(InstanceId id, std::uint32_t triangle) const {
  const detail::CommittedInstance<Scalar>& instance = detail::known_instance(this->committed().find(id), id);
  return detail::placed_corners(instance.mesh, instance.placed.placement, triangle);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneSnapshot<Scalar>::normal(InstanceId id, std::uint32_t triangle) const {
  const detail::CommittedInstance<Scalar>& instance = detail::known_instance(this->committed().find(id), id);
  return detail::placed_normal(instance.mesh, instance.placed.placement, triangle);
}

template class SceneSnapshot<float>;
template class SceneSnapshot<double>;

}  // namespace surehit
