#include <cstddef>
#include <cstdint>

#include "c/arguments.hpp"
#include "c/asked_scene.hpp"
#include "c/asked_scene_shapes.hpp"
#include "c/queries.hpp"
#include "surehit/c/scene_shapes_d.h"
#include "surehit/c/scene_shapes_f.h"

namespace surehit::c {
namespace {

template <typename Scalar>
using SceneShapes = ShapesIn<Scene<Scalar>>;

/// Fails unless the hit is one of a triangle that is there.
template <typename Scalar>
void check_hit(SceneCall<Scalar>& call, const typename SceneShapeStructs<Scalar>::Hit* hit) {
  call.arguments.check_pointer(hit, "hit");
  if (call.arguments.are_valid()) call.check_triangle(hit->instance, hit->triangle);
}

template <typename Scalar>
surehit_status last_free_t_in_scene(const char* function, const void* handle,
                                    const typename ShapeStructs<Scalar>::Shape* shape,
                                    const typename SceneShapeStructs<Scalar>::Hit* hit, Scalar* t) {
  SceneCall<Scalar> call(function, handle);
  check_shape(call.arguments, shape);
  check_hit(call, hit);
  return call.tell(t, "t", [&](const auto& scene) {
    return scene.last_free_t(shape_of<Scalar>(*shape), Asked<SceneShapes<Scalar>>::from_c(*hit));
  });
}

template <typename Scalar>
surehit_status contact_point_in_scene(const char* function, const void* handle,
                                      const typename SceneShapeStructs<Scalar>::Hit* hit,
                                      typename Structs<Scalar>::Vector3* point) {
  SceneCall<Scalar> call(function, handle);
  check_hit(call, hit);
  return call.tell(point, "point", [&](const auto& scene) {
    return to_c(scene.contact_point(Asked<SceneShapes<Scalar>>::from_c(*hit)));
  });
}

template <typename Scalar>
surehit_status contact_normal_in_scene(const char* function, const void* handle,
                                       const typename ShapeStructs<Scalar>::Shape* shape,
                                       const typename SceneShapeStructs<Scalar>::Hit* hit,
                                       typename Structs<Scalar>::Vector3* normal) {
  SceneCall<Scalar> call(function, handle);
  check_shape(call.arguments, shape);
  check_hit(call, hit);
  return call.tell(normal, "normal", [&](const auto& scene) {
    return to_c(scene.contact_normal(shape_of<Scalar>(*shape), Asked<SceneShapes<Scalar>>::from_c(*hit)));
  });
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define SUREHIT_SCENE_SHAPE_FUNCTIONS(Scalar, s)                                                                      \
  SUREHIT_C_API surehit_scene_shape_query_options##s surehit_scene_shape_query_options##s##_default() {               \
    const surehit::SceneShapeQueryOptions<Scalar> options;                                                            \
    return {options.max_t,                                                                                            \
            static_cast<uint8_t>(options.culling),                                                                    \
            options.mask,                                                                                             \
            options.instance_mask,                                                                                    \
            to_c(options.ignored_instance),                                                                           \
            options.ignored_triangle,                                                                                 \
            options.ignore_start_contact};                                                                            \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_first_hit(                                                    \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape,                                             \
      const surehit_scene_shape_query_options##s* options, const surehit_scene_shape_filter##s* filter,               \
      surehit_statistics* statistics, surehit_scene_shape_hit##s* hit) {                                              \
    Arguments arguments(__func__);                                                                                    \
    return first_hit(SingleQuery<SceneShapes<Scalar>>(arguments, scene, shape, options, filter, statistics), hit);    \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_any_hit(                                                      \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape,                                             \
      const surehit_scene_shape_query_options##s* options, const surehit_scene_shape_filter##s* filter,               \
      surehit_statistics* statistics, uint8_t* blocked) {                                                             \
    Arguments arguments(__func__);                                                                                    \
    return any_hit(SingleQuery<SceneShapes<Scalar>>(arguments, scene, shape, options, filter, statistics), blocked);  \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_all_hits(                                                     \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape,                                             \
      const surehit_scene_shape_query_options##s* options, const surehit_scene_shape_filter##s* filter,               \
      surehit_statistics* statistics, surehit_scene_shape_hit##s* hits, size_t capacity, size_t* hit_count) {         \
    Arguments arguments(__func__);                                                                                    \
    return all_hits(SingleQuery<SceneShapes<Scalar>>(arguments, scene, shape, options, filter, statistics), hits,     \
                    capacity, hit_count);                                                                             \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_first_hits(                                                   \
      const surehit_scene##s* scene, const surehit_swept_shapes##s* shapes,                                           \
      const surehit_scene_shape_batch_options##s* options, surehit_scene_shape_hit##s* hits) {                        \
    Arguments arguments(__func__);                                                                                    \
    return first_hits(Batch<SceneShapes<Scalar>>(arguments, scene, shapes, options), hits);                           \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_any_hits(                                                     \
      const surehit_scene##s* scene, const surehit_swept_shapes##s* shapes,                                           \
      const surehit_scene_shape_batch_options##s* options, uint8_t* blocked) {                                        \
    Arguments arguments(__func__);                                                                                    \
    return any_hits(Batch<SceneShapes<Scalar>>(arguments, scene, shapes, options), blocked);                          \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_overlaps(                                                     \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape,                                             \
      const surehit_scene_shape_query_options##s* options, const surehit_scene_shape_filter##s* filter,               \
      surehit_statistics* statistics, uint8_t* touches) {                                                             \
    Arguments arguments(__func__);                                                                                    \
    return overlaps(SingleQuery<SceneShapes<Scalar>>(arguments, scene, shape, options, filter, statistics), touches); \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_last_free_t(                                                  \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape, const surehit_scene_shape_hit##s* hit,      \
      Scalar* t) {                                                                                                    \
    return last_free_t_in_scene<Scalar>(__func__, scene, shape, hit, t);                                              \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_last_free_point(                                              \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape, const surehit_scene_shape_hit##s* hit,      \
      const surehit_scene_shape_query_options##s* options, const surehit_scene_shape_filter##s* filter,               \
      surehit_vector3##s* point) {                                                                                    \
    Arguments arguments(__func__);                                                                                    \
    return last_free_centre(SingleQuery<SceneShapes<Scalar>>(arguments, scene, shape, options, filter, nullptr), hit, \
                            point);                                                                                   \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_contact_point(                                                \
      const surehit_scene##s* scene, const surehit_scene_shape_hit##s* hit, surehit_vector3##s* point) {              \
    return contact_point_in_scene<Scalar>(__func__, scene, hit, point);                                               \
  }                                                                                                                   \
  SUREHIT_C_API surehit_status surehit_scene##s##_shape_contact_normal(                                               \
      const surehit_scene##s* scene, const surehit_swept_shape##s* shape, const surehit_scene_shape_hit##s* hit,      \
      surehit_vector3##s* normal) {                                                                                   \
    return contact_normal_in_scene<Scalar>(__func__, scene, shape, hit, normal);                                      \
  }
// NOLINTEND(bugprone-macro-parentheses)
extern "C" {
SUREHIT_SCENE_SHAPE_FUNCTIONS(float, f)
SUREHIT_SCENE_SHAPE_FUNCTIONS(double, d)
}
#undef SUREHIT_SCENE_SHAPE_FUNCTIONS

}  // namespace surehit::c
