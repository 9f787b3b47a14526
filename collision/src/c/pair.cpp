#include <cmath>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/asked_mesh.hpp"
#include "c/values.hpp"
#include "surehit/c/pair_d.h"
#include "surehit/c/pair_f.h"
#include "surehit/hit.hpp"
#include "surehit/intersect.hpp"

namespace surehit::c {
namespace {

template <typename Scalar>
using AskedCollider = Asked<Collider<Scalar>>;

/// Sets the result to what `get()` returns, if all arguments are valid.
template <typename Result, typename Get>
[[nodiscard]] surehit_status tell_result(Arguments& arguments, Result* result, const char* name, const Get& get) {
  arguments.check_pointer(result, name);
  return arguments.then([&] { *result = get(); });
}

template <typename Scalar>
surehit_status intersect_pair(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                              const typename Structs<Scalar>::Path* path,
                              const typename Structs<Scalar>::QueryOptions* options,
                              typename Structs<Scalar>::Hit* hit) {
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  check_path(arguments, path, "path");
  check_options(arguments, options);
  return tell_result(arguments, hit, "hit", [&] {
    const auto found = intersect<Scalar>(from_c(*path), from_c(*triangle), AskedCollider<Scalar>::options_of(options));
    return AskedCollider<Scalar>::to_c(found.value_or(Hit<Scalar>{}));
  });
}

template <typename Scalar>
surehit_status max_t_of_pair(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                             const typename Structs<Scalar>::Path* path, const typename Structs<Scalar>::Hit* hit,
                             Scalar* max_t) {
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  check_path(arguments, path, "path");
  arguments.check_pointer(hit, "hit");
  return tell_result(arguments, max_t, "max_t", [&] {
    return max_t_keeping<Scalar>(from_c(*path), from_c(*triangle), AskedCollider<Scalar>::from_c(*hit));
  });
}

template <typename Scalar>
surehit_status normal_of(const char* function, const typename Structs<Scalar>::Triangle* triangle,
                         typename Structs<Scalar>::Vector3* result) {
  Arguments arguments(function);
  arguments.check_pointer(triangle, "triangle");
  check_corners<Scalar>(arguments, triangle);
  return tell_result(arguments, result, "normal", [&] { return to_c(normal(from_c(*triangle))); });
}

/// Tells something about a hit: what `get(path, hit)` returns.
template <typename Scalar, typename Result, typename Get>
surehit_status of_hit(const char* function, const typename Structs<Scalar>::Path* path,
                      const typename Structs<Scalar>::Hit* hit, Result* result, const char* name, const Get& get) {
  Arguments arguments(function);
  check_path(arguments, path, "path");
  arguments.check_pointer(hit, "hit");
  return tell_result(arguments, result, name, [&] { return get(from_c(*path), AskedCollider<Scalar>::from_c(*hit)); });
}

template <typename Scalar>
surehit_status check_mesh(const char* function, const typename Structs<Scalar>::Mesh* mesh) {
  Arguments arguments(function);
  const auto view = mesh_of<Scalar>(arguments, mesh);
  return arguments.then([&] {
    if (const auto invalid = find_invalid(view)) tell(arguments, *invalid);
  });
}

template <typename Scalar>
surehit_status box_of_mesh(const char* function, const typename Structs<Scalar>::Mesh* mesh,
                           typename Structs<Scalar>::Box* box) {
  Arguments arguments(function);
  const auto view = mesh_of<Scalar>(arguments, mesh);
  arguments.check_pointer(box, "box");
  return arguments.then([&] {
    if (const auto invalid = find_invalid(view)) {
      tell(arguments, *invalid);
    } else {
      *box = to_c(box_of(view));
    }
  });
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define SUREHIT_PAIR_FUNCTIONS(Scalar, s)                                                                           \
  SUREHIT_C_API surehit_query_options##s surehit_query_options##s##_default() {                                     \
    const surehit::QueryOptions<Scalar> options;                                                                    \
    return {options.min_t,                                                                                          \
            options.max_t,                                                                                          \
            static_cast<uint8_t>(options.culling),                                                                  \
            options.mask,                                                                                           \
            options.ignored_triangle,                                                                               \
            options.ignore_start_contact,                                                                           \
            options.ignore_end_contact};                                                                            \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_triangle##s##_intersect(                                                     \
      const surehit_triangle##s* triangle, const surehit_path##s* path, const surehit_query_options##s* options,    \
      surehit_hit##s* hit) {                                                                                        \
    return intersect_pair<Scalar>(__func__, triangle, path, options, hit);                                          \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_triangle##s##_max_t_keeping(                                                 \
      const surehit_triangle##s* triangle, const surehit_path##s* path, const surehit_hit##s* hit, Scalar* max_t) { \
    return max_t_of_pair<Scalar>(__func__, triangle, path, hit, max_t);                                             \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_triangle##s##_normal(const surehit_triangle##s* triangle,                    \
                                                            surehit_vector3##s* normal) {                           \
    return normal_of<Scalar>(__func__, triangle, normal);                                                           \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_path##s##_point(const surehit_path##s* path, const surehit_hit##s* hit,      \
                                                       surehit_vector3##s* point) {                                 \
    return of_hit<Scalar>(__func__, path, hit, point, "point",                                                      \
                          [](const auto& way, const auto& met) { return to_c(surehit::point<Scalar>(way, met)); }); \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_path##s##_distance(const surehit_path##s* path, const surehit_hit##s* hit,   \
                                                          Scalar* distance) {                                       \
    return of_hit<Scalar>(__func__, path, hit, distance, "distance",                                                \
                          [](const auto& way, const auto& met) { return surehit::distance<Scalar>(way, met); });    \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_mesh##s##_check(const surehit_mesh##s* mesh) {                               \
    return check_mesh<Scalar>(__func__, mesh);                                                                      \
  }                                                                                                                 \
  SUREHIT_C_API surehit_status surehit_mesh##s##_box(const surehit_mesh##s* mesh, surehit_box##s* box) {            \
    return box_of_mesh<Scalar>(__func__, mesh, box);                                                                \
  }
// NOLINTEND(bugprone-macro-parentheses)
extern "C" {
SUREHIT_PAIR_FUNCTIONS(float, f)
SUREHIT_PAIR_FUNCTIONS(double, d)
}
#undef SUREHIT_PAIR_FUNCTIONS

}  // namespace surehit::c
