#pragma once

#include <cstddef>
#include <cstdint>

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

template <typename ScalarOfScene>
struct Asked<Scene<ScalarOfScene>> {
  using Scalar = ScalarOfScene;
  using Answer = SceneHit<Scalar>;
  using Options = SceneQueryOptions<Scalar>;
  using AnyBatchOptions = SceneBatchOptions<Scalar>;
  using CHit = typename SceneStructs<Scalar>::Hit;
  using CFilter = typename SceneStructs<Scalar>::Filter;
  using COptions = typename SceneStructs<Scalar>::QueryOptions;
  using CBatchOptions = typename SceneStructs<Scalar>::BatchOptions;
  static constexpr const char* name = "scene";

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    if (given == nullptr) return {};
    return {given->min_t,
            given->max_t,
            static_cast<Culling>(given->culling),
            given->mask,
            given->instance_mask,
            c::from_c(given->ignored_instance),
            given->ignored_triangle,
            given->ignore_start_contact != 0,
            given->ignore_end_contact != 0};
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
#define SUREHIT_SAME_SCENE_LAYOUT(Scalar, s)                                                            \
  static_assert(sizeof(SceneHit<Scalar>) == sizeof(surehit_scene_hit##s));                              \
  static_assert(sizeof(SceneQueryOptions<Scalar>) == sizeof(surehit_scene_query_options##s));           \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, min_t);                \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, max_t);                \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, culling);              \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, mask);                 \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, instance_mask);        \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignored_instance);     \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignored_triangle);     \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignore_start_contact); \
  SUREHIT_SAME_MEMBER(SceneQueryOptions<Scalar>, surehit_scene_query_options##s, ignore_end_contact)
SUREHIT_SAME_SCENE_LAYOUT(float, f);
SUREHIT_SAME_SCENE_LAYOUT(double, d);

}  // namespace surehit::c
