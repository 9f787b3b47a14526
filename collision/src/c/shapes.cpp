#include <cstddef>
#include <cstdint>

#include "c/arguments.hpp"
#include "c/asked_shapes.hpp"
#include "c/handle_call.hpp"
#include "c/queries.hpp"
#include "c/values.hpp"
#include "surehit/c/shapes_d.h"
#include "surehit/c/shapes_f.h"
#include "surehit/intersect.hpp"

namespace surehit::c {
namespace {

template <typename Scalar>
using Shapes = ShapesIn<Collider<Scalar>>;

template <typename Scalar>
surehit_status last_free_t(const char* function, const void* handle, const typename ShapeStructs<Scalar>::Shape* shape,
                           const typename ShapeStructs<Scalar>::Hit* hit, Scalar* t) {
  HandleCall<Collider<Scalar>> call(function, handle);
  check_shape(call.arguments, shape);
  call.arguments.check_pointer(hit, "hit");
  if (call.arguments.are_valid()) call.arguments.check_triangle(hit->triangle, call.object->triangle_count());
  return call.tell(t, "t", [&](const auto& collider) {
    return collider.last_free_t(shape_of<Scalar>(*shape), Asked<Shapes<Scalar>>::from_c(*hit));
  });
}

template <typename Scalar>
surehit_status intersect_shape(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                               const typename ShapeStructs<Scalar>::Shape* shape,
                               const typename ShapeStructs<Scalar>::QueryOptions* options,
                               typename ShapeStructs<Scalar>::Hit* hit) {
  using Types = Asked<Shapes<Scalar>>;
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  check_shape(arguments, shape);
  check_options(arguments, options);
  arguments.check_pointer(hit, "hit");
  return arguments.then([&] {
    const auto found = intersect<Scalar>(shape_of<Scalar>(*shape), from_c(*triangle), Types::options_of(options));
    *hit = Types::to_c(found.value_or(ShapeHit<Scalar>{}));
  });
}

template <typename Scalar>
surehit_status contact_point_of(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                                const typename ShapeStructs<Scalar>::Hit* hit,
                                typename Structs<Scalar>::Vector3* point) {
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  arguments.check_pointer(hit, "hit");
  check_corners<Scalar>(arguments, triangle);
  arguments.check_pointer(point, "point");
  return arguments.then(
      [&] { *point = to_c(contact_point<Scalar>(from_c(*triangle), Asked<Shapes<Scalar>>::from_c(*hit))); });
}

template <typename Scalar>
surehit_status contact_normal_of(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                                 const typename ShapeStructs<Scalar>::Shape* shape,
                                 typename Structs<Scalar>::Vector3* normal) {
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  check_shape(arguments, shape);
  arguments.check_pointer(normal, "normal");
  return arguments.then([&] { *normal = to_c(contact_normal<Scalar>(shape_of<Scalar>(*shape), from_c(*triangle))); });
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define SUREHIT_SHAPE_FUNCTIONS(Scalar, s)                                                                           \
  SUREHIT_C_API surehit_shape_query_options##s surehit_shape_query_options##s##_default() {                          \
    const surehit::ShapeQueryOptions<Scalar> options;                                                                \
    return {options.max_t, static_cast<uint8_t>(options.culling), options.mask, options.ignored_triangle,            \
            options.ignore_start_contact};                                                                           \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_first_hit(                                                \
      const surehit_collider##s* collider, const surehit_swept_shape##s* shape,                                      \
      const surehit_shape_query_options##s* options, const surehit_shape_filter##s* filter,                          \
      surehit_statistics* statistics, surehit_shape_hit##s* hit) {                                                   \
    Arguments arguments(__func__);                                                                                   \
    return first_hit(SingleQuery<Shapes<Scalar>>(arguments, collider, shape, options, filter, statistics), hit);     \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_any_hit(                                                  \
      const surehit_collider##s* collider, const surehit_swept_shape##s* shape,                                      \
      const surehit_shape_query_options##s* options, const surehit_shape_filter##s* filter,                          \
      surehit_statistics* statistics, uint8_t* blocked) {                                                            \
    Arguments arguments(__func__);                                                                                   \
    return any_hit(SingleQuery<Shapes<Scalar>>(arguments, collider, shape, options, filter, statistics), blocked);   \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_all_hits(                                                 \
      const surehit_collider##s* collider, const surehit_swept_shape##s* shape,                                      \
      const surehit_shape_query_options##s* options, const surehit_shape_filter##s* filter,                          \
      surehit_statistics* statistics, surehit_shape_hit##s* hits, size_t capacity, size_t* hit_count) {              \
    Arguments arguments(__func__);                                                                                   \
    return all_hits(SingleQuery<Shapes<Scalar>>(arguments, collider, shape, options, filter, statistics), hits,      \
                    capacity, hit_count);                                                                            \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_first_hits(                                               \
      const surehit_collider##s* collider, const surehit_swept_shapes##s* shapes,                                    \
      const surehit_shape_batch_options##s* options, surehit_shape_hit##s* hits) {                                   \
    Arguments arguments(__func__);                                                                                   \
    return first_hits(Batch<Shapes<Scalar>>(arguments, collider, shapes, options), hits);                            \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_any_hits(                                                 \
      const surehit_collider##s* collider, const surehit_swept_shapes##s* shapes,                                    \
      const surehit_shape_batch_options##s* options, uint8_t* blocked) {                                             \
    Arguments arguments(__func__);                                                                                   \
    return any_hits(Batch<Shapes<Scalar>>(arguments, collider, shapes, options), blocked);                           \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_overlaps(                                                 \
      const surehit_collider##s* collider, const surehit_swept_shape##s* shape,                                      \
      const surehit_shape_query_options##s* options, const surehit_shape_filter##s* filter,                          \
      surehit_statistics* statistics, uint8_t* touches) {                                                            \
    Arguments arguments(__func__);                                                                                   \
    return overlaps(SingleQuery<Shapes<Scalar>>(arguments, collider, shape, options, filter, statistics), touches);  \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_last_free_t(const surehit_collider##s* collider,          \
                                                                       const surehit_swept_shape##s* shape,          \
                                                                       const surehit_shape_hit##s* hit, Scalar* t) { \
    return last_free_t<Scalar>(__func__, collider, shape, hit, t);                                                   \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_collider##s##_shape_last_free_point(                                          \
      const surehit_collider##s* collider, const surehit_swept_shape##s* shape, const surehit_shape_hit##s* hit,     \
      const surehit_shape_query_options##s* options, const surehit_shape_filter##s* filter,                          \
      surehit_vector3##s* point) {                                                                                   \
    Arguments arguments(__func__);                                                                                   \
    return last_free_centre(SingleQuery<Shapes<Scalar>>(arguments, collider, shape, options, filter, nullptr), hit,  \
                            point);                                                                                  \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_triangle##s##_shape_intersect(                                                \
      const surehit_triangle##s* triangle, const surehit_swept_shape##s* shape,                                      \
      const surehit_shape_query_options##s* options, surehit_shape_hit##s* hit) {                                    \
    return intersect_shape<Scalar>(__func__, triangle, shape, options, hit);                                         \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_triangle##s##_shape_contact_point(                                            \
      const surehit_triangle##s* triangle, const surehit_shape_hit##s* hit, surehit_vector3##s* point) {             \
    return contact_point_of<Scalar>(__func__, triangle, hit, point);                                                 \
  }                                                                                                                  \
  SUREHIT_C_API surehit_status surehit_triangle##s##_shape_contact_normal(                                           \
      const surehit_triangle##s* triangle, const surehit_swept_shape##s* shape, surehit_vector3##s* normal) {        \
    return contact_normal_of<Scalar>(__func__, triangle, shape, normal);                                             \
  }
// NOLINTEND(bugprone-macro-parentheses)
extern "C" {
SUREHIT_SHAPE_FUNCTIONS(float, f)
SUREHIT_SHAPE_FUNCTIONS(double, d)
}
#undef SUREHIT_SHAPE_FUNCTIONS

}  // namespace surehit::c
