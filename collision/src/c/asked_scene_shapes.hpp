#pragma once

#include <cstddef>
#include <cstdint>

#include "c/asked.hpp"
#include "c/asked_scene.hpp"
#include "c/asked_shapes.hpp"
#include "surehit/c/scene_shape_values_d.h"
#include "surehit/c/scene_shape_values_f.h"
#include "surehit/scene_queries.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"

namespace surehit::c {

/// The structs that moving shapes in scenes of the C interface have.
template <typename Scalar>
struct SceneShapeStructs;

#define SUREHIT_SCENE_SHAPE_STRUCTS(Scalar, s)                 \
  template <>                                                  \
  struct SceneShapeStructs<Scalar> {                           \
    using Hit = surehit_scene_shape_hit##s;                    \
    using QueryOptions = surehit_scene_shape_query_options##s; \
    using BatchOptions = surehit_scene_shape_batch_options##s; \
    using Filter = surehit_scene_shape_filter##s;              \
  };
SUREHIT_SCENE_SHAPE_STRUCTS(float, f)
SUREHIT_SCENE_SHAPE_STRUCTS(double, d)
#undef SUREHIT_SCENE_SHAPE_STRUCTS

template <typename Scalar>
struct Asked<ShapesIn<Scene<Scalar>>>
    : AskedAboutShapes<SceneQueries<Scalar>, Scalar, SceneShapeHit<Scalar>, SceneShapeQueryOptions<Scalar>,
                       SceneShapeBatchOptions<Scalar>, SceneShapeStructs<Scalar>> {
  using typename Asked::AskedTypes::Answer;
  using typename Asked::AskedTypes::CHit;
  using typename Asked::AskedTypes::COptions;
  using typename Asked::AskedTypes::Options;
  static constexpr const char* name = Asked<Scene<Scalar>>::name;

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    if (given == nullptr) return {};
    return {given->max_t,
            static_cast<Culling>(given->culling),
            given->mask,
            given->instance_mask,
            c::from_c(given->ignored_instance),
            given->ignored_triangle,
            given->ignore_start_contact != 0};
  }
  /// Returns a hit, which may have any numbers.
  [[nodiscard]] static Answer from_c(const CHit& hit) {
    return {{hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0},
            c::from_c(hit.instance)};
  }
  /// Returns a hit for the caller.
  [[nodiscard]] static CHit to_c(const Answer& hit) {
    return {hit.t,
            hit.u,
            hit.v,
            hit.triangle,
            static_cast<std::uint8_t>(hit.feature),
            static_cast<std::uint8_t>(hit.started_touching ? 1 : 0),
            c::to_c(hit.instance)};
  }
};

// As for colliders. `SceneShapeHit` has a base, so the compiler need not tell where its members are. A test looks at
// them.
#define SUREHIT_SAME_SCENE_SHAPE_LAYOUT(Scalar, s)                                                             \
  static_assert(sizeof(SceneShapeHit<Scalar>) == sizeof(surehit_scene_shape_hit##s));                          \
  static_assert(sizeof(SceneShapeQueryOptions<Scalar>) == sizeof(surehit_scene_shape_query_options##s));       \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, max_t);            \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, culling);          \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, mask);             \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, instance_mask);    \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, ignored_instance); \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, ignored_triangle); \
  SUREHIT_SAME_MEMBER(SceneShapeQueryOptions<Scalar>, surehit_scene_shape_query_options##s, ignore_start_contact)
SUREHIT_SAME_SCENE_SHAPE_LAYOUT(float, f);
SUREHIT_SAME_SCENE_SHAPE_LAYOUT(double, d);

}  // namespace surehit::c
