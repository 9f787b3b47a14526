#pragma once

#include <cstddef>
#include <cstdint>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "surehit/c/scene_values_d.h"
#include "surehit/c/scene_values_f.h"
#include "surehit/scene.hpp"

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

/// Fails if there is no such instance.
template <typename Scalar>
void check_instance(Arguments& arguments, const Scene<Scalar>* scene, surehit_instance_id id) {
  if (!arguments.are_valid() || scene->contains(from_c(id))) return;
  arguments.refuse(SUREHIT_STALE_ID, id.index, "there is no instance with index %u and generation %u", id.index,
                   id.generation);
}

template <typename Scalar>
struct Asked<Scene<Scalar>> : AskedAboutPaths<Scene<Scalar>, Scalar, SceneHit<Scalar>, SceneQueryOptions<Scalar>,
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

// As for colliders. `SceneHit` has a base, so the compiler need not tell where its members are. A test looks at them.
#define SUREHIT_SAME_SCENE_LAYOUT(Scalar, s)                                                     \
  static_assert(sizeof(SceneHit<Scalar>) == sizeof(surehit_scene_hit##s));                       \
  SUREHIT_SAME_OPTIONS(SceneQueryOptions<Scalar>, surehit_scene_query_options##s);               \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, instance_mask); \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignored_instance)
SUREHIT_SAME_SCENE_LAYOUT(float, f);
SUREHIT_SAME_SCENE_LAYOUT(double, d);

}  // namespace surehit::c
