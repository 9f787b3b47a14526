#include "surehit/scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "c/arguments.hpp"
#include "c/asked_scene.hpp"
#include "c/handle_call.hpp"
#include "c/queries.hpp"
#include "c/values.hpp"
#include "surehit/c/mixed_scene.h"
#include "surehit/c/scene_d.h"
#include "surehit/c/scene_f.h"
#include "surehit/scene_snapshot.hpp"

namespace surehit::c {
namespace {

template <typename Scalar>
[[nodiscard]] Pose<Scalar> pose_of(const typename SceneStructs<Scalar>::Pose* given) {
  Pose<Scalar> pose;
  if (given == nullptr) return pose;
  pose.linear << from_c(given->x_axis), from_c(given->y_axis), from_c(given->z_axis);
  pose.translation = from_c(given->translation);
  return pose;
}

template <typename Scalar>
[[nodiscard]] typename SceneStructs<Scalar>::Pose pose_to_c(const Pose<Scalar>& pose) {
  return {to_c(Vector3<Scalar>(pose.linear.col(0))), to_c(Vector3<Scalar>(pose.linear.col(1))),
          to_c(Vector3<Scalar>(pose.linear.col(2))), to_c(pose.translation)};
}

/// Fails if an instance or a change of one was refused.
void tell_change(Arguments& arguments, const InstanceResult& result) {
  if (result) return;
  using Reason = InvalidInstance::Reason;
  const InvalidInstance& error = result.error();
  const bool is_entry = error.reason == Reason::non_finite_pose || error.reason == Reason::pose_out_of_range;
  // The columns of a pose lie one after the other here.
  const std::size_t element = is_entry ? 3 * (error.element % 4) + error.element / 4 : error.element;
  // The first reason is a collider that is null, which an argument of C is before.
  const int status =
      SUREHIT_NON_FINITE_POSE + static_cast<int>(error.reason) - static_cast<int>(Reason::non_finite_pose);
  arguments.refuse(static_cast<surehit_status>(status), element, "%s", error.what());
}

/// Adds an instance of a collider of `MeshScalar`.
template <typename Scalar, typename MeshScalar>
[[nodiscard]] surehit_status add(const char* function, void* handle, const void* collider,
                                 const typename SceneStructs<Scalar>::Pose* pose, std::uint32_t mask,
                                 std::uint64_t user_data, surehit_instance_id* id) {
  HandleCall<Scene<Scalar>> call(function, handle);
  std::shared_ptr<const Collider<MeshScalar>> mesh =
      call.arguments.template share_of<Collider<MeshScalar>>(collider, "collider");
  call.arguments.check_optional(pose, "pose");
  call.arguments.check_pointer(id, "id");
  return call.arguments.then([&] {
    const InstanceResult added = call.object->try_add(std::move(mesh), pose_of<Scalar>(pose), {mask, user_data});
    tell_change(call.arguments, added);
    if (added) *id = to_c(added.id());
  });
}

/// Changes a scene by `change(scene)`, which returns an InstanceResult.
template <typename Scalar, typename Change>
[[nodiscard]] surehit_status change(HandleCall<Scene<Scalar>>&& call, const Change& change_scene) {
  return call.arguments.then([&] { tell_change(call.arguments, change_scene(*call.object)); });
}

/// Gives an instance a collider of `MeshScalar`.
template <typename Scalar, typename MeshScalar>
[[nodiscard]] surehit_status set_collider(const char* function, void* handle, surehit_instance_id id,
                                          const void* collider) {
  HandleCall<Scene<Scalar>> call(function, handle);
  std::shared_ptr<const Collider<MeshScalar>> mesh =
      call.arguments.template share_of<Collider<MeshScalar>>(collider, "collider");
  return change(std::move(call), [&](auto& scene) { return scene.try_set_collider(from_c(id), std::move(mesh)); });
}

template <typename Scalar>
[[nodiscard]] surehit_status set_pose(const char* function, void* handle, surehit_instance_id id,
                                      const typename SceneStructs<Scalar>::Pose* pose) {
  HandleCall<Scene<Scalar>> call(function, handle);
  call.arguments.check_pointer(pose, "pose");
  return change(std::move(call), [&](auto& scene) { return scene.try_set_pose(from_c(id), pose_of<Scalar>(pose)); });
}

template <typename Scalar>
[[nodiscard]] surehit_status set_motion(const char* function, void* handle, surehit_instance_id id,
                                        const typename Structs<Scalar>::Vector3* motion) {
  HandleCall<Scene<Scalar>> call(function, handle);
  call.arguments.check_pointer(motion, "motion");
  return change(std::move(call), [&](auto& scene) { return scene.try_set_motion(from_c(id), from_c(*motion)); });
}

template <typename Scalar>
[[nodiscard]] surehit_status commit(const char* function, void* handle, const surehit_executor* executor) {
  HandleCall<Scene<Scalar>> call(function, handle);
  check_executor(call.arguments, executor);
  return call.arguments.then([&] { call.object->commit(executor_of(executor)); });
}

/// Sets `snapshot` to a handle of what a scene or a snapshot has committed.
template <typename Scalar, typename CScene>
[[nodiscard]] surehit_status make_snapshot(const char* function, const CScene* scene, CScene** snapshot) {
  SceneCall<Scalar> call(function, scene);
  call.arguments.check_pointer(snapshot, "snapshot");
  return open(call.arguments, snapshot, [&] {
    return call.ask([](const auto& of) {
      if constexpr (requires { of.snapshot(); }) {
        return std::make_shared<SceneSnapshot<Scalar>>(of.snapshot());
      } else {
        return std::make_shared<SceneSnapshot<Scalar>>(of);
      }
    });
  });
}

/// Gives up a scene or a snapshot. Null is allowed.
template <typename Scalar>
[[nodiscard]] surehit_status destroy_scene(const char* function, void* handle) {
  if (handle == nullptr) return SUREHIT_OK;
  SceneCall<Scalar> call(function, handle);
  return call.arguments.then([&] { static_cast<Handle*>(handle)->close(); });
}

template <typename Scalar>
[[nodiscard]] surehit_status instances(const char* function, const void* handle, surehit_instance_id* ids,
                                       std::size_t capacity, std::size_t* id_count) {
  SceneCall<Scalar> call(function, handle);
  call.arguments.check_array(ids, capacity, sizeof *ids, "ids");
  call.arguments.check_pointer(id_count, "id_count");
  return call.arguments.then([&] {
    const std::vector<InstanceId> all = call.ask([](const auto& of) { return of.instances(); });
    *id_count = all.size();
    for (std::size_t i = 0; i < std::min(all.size(), capacity); ++i) ids[i] = to_c(all[i]);
  });
}

/// Tells something about an instance: what `get(scene, id)` returns.
template <typename Scalar, typename Result, typename Get>
[[nodiscard]] surehit_status of_instance(const char* function, const void* handle, surehit_instance_id id,
                                         Result* result, const char* name, const Get& get) {
  SceneCall<Scalar> call(function, handle);
  call.check_instance(id);
  return call.tell(result, name, [&](const auto& of) { return get(of, from_c(id)); });
}

/// Tells something about a placed triangle: what `get(scene, id, triangle)` returns.
template <typename Scalar, typename Result, typename Get>
[[nodiscard]] surehit_status of_placed(const char* function, const void* handle, surehit_instance_id id,
                                       std::uint32_t triangle, Result* result, const char* name, const Get& get) {
  SceneCall<Scalar> call(function, handle);
  call.check_triangle(id, triangle);
  return call.tell(result, name, [&](const auto& of) { return get(of, from_c(id), triangle); });
}

}  // namespace

#define SUREHIT_SCENE_FUNCTIONS(Scalar, s)                                                                            \
  SUREHIT_C_API surehit_pose##s surehit_pose##s##_identity() { return pose_to_c(Pose<Scalar>()); }                    \
  SUREHIT_C_API surehit_pose##s surehit_pose##s##_rigid(Scalar x, Scalar y, Scalar z, Scalar w,                       \
                                                        surehit_vector3##s translation) {                             \
    return pose_to_c(Pose<Scalar>::rigid(std::array<Scalar, 4>{x, y, z, w}, from_c(translation)));                    \
  }                                                                                                                   \
  SUREHIT_C_API surehit_scene_query_options##s surehit_scene_query_options##s##_default() {                           \
    const SceneQueryOptions<Scalar> options;                                                                          \
    return {options.min_t,                                                                                            \
            options.max_t,                                                                                            \
            static_cast<uint8_t>(options.culling),                                                                    \
            options.mask,                                                                                             \
            options.instance_mask,                                                                                    \
            to_c(options.ignored_instance),                                                                           \
            options.ignored_triangle,                                                                                 \
            options.ignore_start_contact,                                                                             \
            options.ignore_end_contact};                                                                              \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_create(surehit_scene##s** scene) {                                  \
    Arguments arguments(__func__);                                                                                    \
    arguments.check_pointer(scene, "scene");                                                                          \
    return open(arguments, scene, [] { return std::make_shared<Scene<Scalar>>(); });                                  \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_destroy(surehit_scene##s* scene) {                                  \
    return destroy_scene<Scalar>(__func__, scene);                                                                    \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_add(surehit_scene##s* scene, const surehit_collider##s* collider,   \
                                                      const surehit_pose##s* pose, uint32_t mask, uint64_t user_data, \
                                                      surehit_instance_id* id) {                                      \
    return add<Scalar, Scalar>(__func__, scene, collider, pose, mask, user_data, id);                                 \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_remove(surehit_scene##s* scene, surehit_instance_id id) {           \
    return change(HandleCall<Scene<Scalar>>(__func__, scene), [&](auto& of) { return of.try_remove(from_c(id)); });   \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_set_collider(surehit_scene##s* scene, surehit_instance_id id,       \
                                                               const surehit_collider##s* collider) {                 \
    return set_collider<Scalar, Scalar>(__func__, scene, id, collider);                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_set_pose(surehit_scene##s* scene, surehit_instance_id id,           \
                                                           const surehit_pose##s* pose) {                             \
    return set_pose<Scalar>(__func__, scene, id, pose);                                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_set_motion(surehit_scene##s* scene, surehit_instance_id id,         \
                                                             const surehit_vector3##s* motion) {                      \
    return set_motion<Scalar>(__func__, scene, id, motion);                                                           \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_set_mask(surehit_scene##s* scene, surehit_instance_id id,           \
                                                           uint32_t mask) {                                           \
    return change(HandleCall<Scene<Scalar>>(__func__, scene),                                                         \
                  [&](auto& of) { return of.try_set_mask(from_c(id), mask); });                                       \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_commit(surehit_scene##s* scene, const surehit_executor* executor) { \
    return commit<Scalar>(__func__, scene, executor);                                                                 \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_snapshot(const surehit_scene##s* scene,                             \
                                                           surehit_scene##s** snapshot) {                             \
    return make_snapshot<Scalar>(__func__, scene, snapshot);                                                          \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_instance_count(const surehit_scene##s* scene, size_t* count) {      \
    return SceneCall<Scalar>(__func__, scene).tell(count, "count", [](const auto& of) {                               \
      return of.instance_count();                                                                                     \
    });                                                                                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_contains(const surehit_scene##s* scene, surehit_instance_id id,     \
                                                           uint8_t* is_there) {                                       \
    return SceneCall<Scalar>(__func__, scene).tell(is_there, "is_there", [&](const auto& of) -> uint8_t {             \
      return of.contains(from_c(id)) ? 1 : 0;                                                                         \
    });                                                                                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_instances(const surehit_scene##s* scene, surehit_instance_id* ids,  \
                                                            size_t capacity, size_t* id_count) {                      \
    return instances<Scalar>(__func__, scene, ids, capacity, id_count);                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_pose(const surehit_scene##s* scene, surehit_instance_id id,         \
                                                       surehit_pose##s* pose) {                                       \
    return of_instance<Scalar>(__func__, scene, id, pose, "pose",                                                     \
                               [](const auto& of, InstanceId of_id) { return pose_to_c(of.pose(of_id)); });           \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_motion(const surehit_scene##s* scene, surehit_instance_id id,       \
                                                         surehit_vector3##s* motion) {                                \
    return of_instance<Scalar>(__func__, scene, id, motion, "motion",                                                 \
                               [](const auto& of, InstanceId of_id) { return to_c(of.motion(of_id)); });              \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_mask(const surehit_scene##s* scene, surehit_instance_id id,         \
                                                       uint32_t* mask) {                                              \
    return of_instance<Scalar>(__func__, scene, id, mask, "mask",                                                     \
                               [](const auto& of, InstanceId of_id) { return of.mask(of_id); });                      \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_user_data(const surehit_scene##s* scene, surehit_instance_id id,    \
                                                            uint64_t* user_data) {                                    \
    return of_instance<Scalar>(__func__, scene, id, user_data, "user_data",                                           \
                               [](const auto& of, InstanceId of_id) { return of.user_data(of_id); });                 \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_triangle_count(const surehit_scene##s* scene,                       \
                                                                 surehit_instance_id id, size_t* count) {             \
    return of_instance<Scalar>(__func__, scene, id, count, "count",                                                   \
                               [](const auto& of, InstanceId of_id) { return of.triangle_count(of_id); });            \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_triangle(const surehit_scene##s* scene, surehit_instance_id id,     \
                                                           uint32_t triangle_id, surehit_triangle##s* triangle) {     \
    return of_placed<Scalar>(                                                                                         \
        __func__, scene, id, triangle_id, triangle, "triangle",                                                       \
        [](const auto& of, InstanceId of_id, uint32_t corner_of) { return to_c(of.triangle(of_id, corner_of)); });    \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_normal(const surehit_scene##s* scene, surehit_instance_id id,       \
                                                         uint32_t triangle_id, surehit_vector3##s* normal) {          \
    return of_placed<Scalar>(                                                                                         \
        __func__, scene, id, triangle_id, normal, "normal",                                                           \
        [](const auto& of, InstanceId of_id, uint32_t normal_of) { return to_c(of.normal(of_id, normal_of)); });      \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_box(const surehit_scene##s* scene, surehit_box##s* box) {           \
    return SceneCall<Scalar>(__func__, scene).tell(box, "box", [](const auto& of) { return to_c(of.box()); });        \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_memory_bytes(const surehit_scene##s* scene, size_t* bytes) {        \
    return HandleCall<Scene<Scalar>>(__func__, scene).tell(bytes, "bytes", [](const auto& of) {                       \
      return of.memory_bytes();                                                                                       \
    });                                                                                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_first_hit(                                                          \
      const surehit_scene##s* scene, const surehit_path##s* path, const surehit_scene_query_options##s* options,      \
      const surehit_scene_filter##s* filter, surehit_statistics* statistics, surehit_scene_hit##s* hit) {             \
    Arguments arguments(__func__);                                                                                    \
    return first_hit(SingleQuery<Scene<Scalar>>(arguments, scene, path, options, filter, statistics), hit);           \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_any_hit(                                                            \
      const surehit_scene##s* scene, const surehit_path##s* path, const surehit_scene_query_options##s* options,      \
      const surehit_scene_filter##s* filter, surehit_statistics* statistics, uint8_t* blocked) {                      \
    Arguments arguments(__func__);                                                                                    \
    return any_hit(SingleQuery<Scene<Scalar>>(arguments, scene, path, options, filter, statistics), blocked);         \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_all_hits(                                                           \
      const surehit_scene##s* scene, const surehit_path##s* path, const surehit_scene_query_options##s* options,      \
      const surehit_scene_filter##s* filter, surehit_statistics* statistics, surehit_scene_hit##s* hits,              \
      size_t capacity, size_t* hit_count) {                                                                           \
    Arguments arguments(__func__);                                                                                    \
    return all_hits(SingleQuery<Scene<Scalar>>(arguments, scene, path, options, filter, statistics), hits, capacity,  \
                    hit_count);                                                                                       \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_first_hits(                                                         \
      const surehit_scene##s* scene, const surehit_paths##s* paths, const surehit_scene_batch_options##s* options,    \
      surehit_scene_hit##s* hits) {                                                                                   \
    Arguments arguments(__func__);                                                                                    \
    return first_hits(Batch<Scene<Scalar>>(arguments, scene, paths, options), hits);                                  \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_any_hits(                                                           \
      const surehit_scene##s* scene, const surehit_paths##s* paths, const surehit_scene_batch_options##s* options,    \
      uint8_t* blocked) {                                                                                             \
    Arguments arguments(__func__);                                                                                    \
    return any_hits(Batch<Scene<Scalar>>(arguments, scene, paths, options), blocked);                                 \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_last_free_point(                                                    \
      const surehit_scene##s* scene, const surehit_path##s* segment, const surehit_scene_hit##s* hit,                 \
      const surehit_scene_query_options##s* options, const surehit_scene_filter##s* filter,                           \
      surehit_vector3##s* point) {                                                                                    \
    Arguments arguments(__func__);                                                                                    \
    return last_free_point(SingleQuery<Scene<Scalar>>(arguments, scene, segment, options, filter, nullptr), hit,      \
                           point);                                                                                    \
  }
extern "C" {
SUREHIT_SCENE_FUNCTIONS(float, f)
SUREHIT_SCENE_FUNCTIONS(double, d)

SUREHIT_C_API surehit_status surehit_scened_add_colliderf(surehit_scened* scene, const surehit_colliderf* collider,
                                                          const surehit_posed* pose, uint32_t mask, uint64_t user_data,
                                                          surehit_instance_id* id) {
  return add<double, float>(__func__, scene, collider, pose, mask, user_data, id);
}
SUREHIT_C_API surehit_status surehit_scened_set_colliderf(surehit_scened* scene, surehit_instance_id id,
                                                          const surehit_colliderf* collider) {
  return set_collider<double, float>(__func__, scene, id, collider);
}
}
#undef SUREHIT_SCENE_FUNCTIONS

}  // namespace surehit::c
