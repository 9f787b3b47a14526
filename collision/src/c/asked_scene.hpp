#pragma once

#include <cstddef>
#include <cstdint>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/handle.hpp"
#include "surehit/c/scene_values_d.h"
#include "surehit/c/scene_values_f.h"
#include "surehit/scene.hpp"
#include "surehit/scene_queries.hpp"
#include "surehit/scene_snapshot.hpp"

namespace surehit::c {

/// The structs that scenes of the C interface have besides those of `Structs`.
template <typename Scalar>
struct SceneStructs;

#define SUREHIT_SCENE_STRUCTS(Scalar, s)                 \
  template <>                                            \
  struct SceneStructs<Scalar> {                          \
    using Pose = surehit_pose##s;                        \
    using Hit = surehit_scene_hit##s;                    \
    using QueryOptions = surehit_scene_query_options##s; \
    using BatchOptions = surehit_scene_batch_options##s; \
    using Filter = surehit_scene_filter##s;              \
  };
SUREHIT_SCENE_STRUCTS(float, f)
SUREHIT_SCENE_STRUCTS(double, d)
#undef SUREHIT_SCENE_STRUCTS

inline InstanceId from_c(surehit_instance_id id) { return {id.index, id.generation}; }
inline surehit_instance_id to_c(InstanceId id) { return {id.index, id.generation}; }

template <typename Scalar>
struct Asked<Scene<Scalar>> : AskedAboutPaths<SceneQueries<Scalar>, Scalar, SceneHit<Scalar>, SceneQueryOptions<Scalar>,
                                              SceneBatchOptions<Scalar>, SceneStructs<Scalar>> {
  using typename Asked::AskedTypes::Answer;
  using typename Asked::AskedTypes::CHit;
  using typename Asked::AskedTypes::COptions;
  using typename Asked::AskedTypes::Options;
  static constexpr const char* name = "scene";

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    Options options;
    if (given == nullptr) return options;
    set_options(options, *given);
    options.instance_mask = given->instance_mask;
    options.ignored_instance = c::from_c(given->ignored_instance);
    return options;
  }
  /// Returns a hit, which may have any numbers.
  [[nodiscard]] static Answer from_c(const CHit& hit) {
    return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)}, c::from_c(hit.instance)};
  }
  /// Returns a hit for the caller.
  [[nodiscard]] static CHit to_c(const Answer& hit) {
    return {hit.t, hit.u, hit.v, hit.triangle, static_cast<std::uint8_t>(hit.side), c::to_c(hit.instance)};
  }
};

/// A call that asks a scene or a snapshot about its instances.
template <typename Scalar>
class SceneCall {
 public:
  SceneCall(const char* function, const void* handle) : arguments(function) {
    if (arguments.object_of<SceneQueries<Scalar>>(handle, Asked<Scene<Scalar>>::name) == nullptr) return;
    scene_ = static_cast<const Handle*>(handle)->get<Scene<Scalar>>();
    snapshot_ = static_cast<const Handle*>(handle)->get<SceneSnapshot<Scalar>>();
  }

  /// Returns what `get` returns for the scene or for the snapshot. The arguments must be valid.
  template <typename Get>
  [[nodiscard]] auto ask(const Get& get) const {
    return scene_ != nullptr ? get(*scene_) : get(*snapshot_);
  }
  /// Fails if there is no such instance.
  void check_instance(surehit_instance_id id) {
    if (!arguments.are_valid() || ask([&](const auto& of) { return of.contains(from_c(id)); })) return;
    arguments.refuse(SUREHIT_STALE_ID, id.index, "there is no instance with index %u and generation %u", id.index,
                     id.generation);
  }
  /// Fails if there is no such instance, or if it has no such triangle.
  void check_triangle(surehit_instance_id id, std::uint32_t triangle) {
    check_instance(id);
    if (!arguments.are_valid()) return;
    arguments.check_triangle(triangle, ask([&](const auto& of) { return of.triangle_count(from_c(id)); }));
  }
  /// Sets the result to what `ask(get)` returns.
  template <typename Result, typename Get>
  [[nodiscard]] surehit_status tell(Result* result, const char* name, const Get& get) {
    arguments.check_pointer(result, name);
    return arguments.then([&] { *result = ask(get); });
  }

  Arguments arguments;

 private:
  const Scene<Scalar>* scene_ = nullptr;             ///< The scene, or null if it is a snapshot.
  const SceneSnapshot<Scalar>* snapshot_ = nullptr;  ///< The snapshot, or null.
};

// As for colliders. `SceneHit` has a base, so the compiler need not tell where its members are. A test looks at them.
#define SUREHIT_SAME_SCENE_LAYOUT(Scalar, s)                                                     \
  static_assert(sizeof(SceneHit<Scalar>) == sizeof(surehit_scene_hit##s));                       \
  SUREHIT_SAME_OPTIONS(SceneQueryOptions<Scalar>, surehit_scene_query_options##s);               \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, instance_mask); \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignored_instance)
SUREHIT_SAME_SCENE_LAYOUT(float, f);
SUREHIT_SAME_SCENE_LAYOUT(double, d);

}  // namespace surehit::c
