#include "surehit/collider.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "c/arguments.hpp"
#include "c/asked_mesh.hpp"
#include "c/handle_call.hpp"
#include "c/queries.hpp"
#include "c/values.hpp"
#include "surehit/c/collider_d.h"
#include "surehit/c/collider_f.h"
#include "surehit/intersect.hpp"

namespace surehit::c {
namespace {

/// Fails if the collider has no such triangle.
template <typename Scalar>
void check_triangle(HandleCall<Collider<Scalar>>& call, std::uint32_t id) {
  if (call.arguments.are_valid()) call.arguments.check_triangle(id, call.object->triangle_count());
}

template <typename Scalar, typename CHandle>
surehit_status create(const char* function, const typename Structs<Scalar>::Mesh* mesh,
                      const surehit_build_options* options, CHandle** handle) {
  Arguments arguments(function);
  const auto view = mesh != nullptr ? mesh_of<Scalar>(arguments, mesh) : TriangleMeshView<Scalar>();
  const AskedBuild build(arguments, options);
  arguments.check_pointer(handle, "collider");
  return open(arguments, handle, [&] {
    auto collider = std::make_shared<Collider<Scalar>>();
    if (mesh != nullptr) tell(arguments, collider->try_build(view, build.get()));
    return collider;
  });
}

template <typename Scalar, typename CHandle>
surehit_status copy(const char* function, const void* from, CHandle** handle) {
  HandleCall<Collider<Scalar>> call(function, from);
  call.arguments.check_pointer(handle, "copy");
  return open(call.arguments, handle, [&] { return std::make_shared<Collider<Scalar>>(std::as_const(*call.object)); });
}

/// Builds a collider with `build(collider, mesh, options)`.
template <typename Scalar, typename Build>
surehit_status build(const char* function, void* handle, const typename Structs<Scalar>::Mesh* mesh,
                     const surehit_build_options* options, const Build& build) {
  HandleCall<Collider<Scalar>> call(function, handle);
  const auto view = mesh_of<Scalar>(call.arguments, mesh);
  const AskedBuild asked(call.arguments, options);
  return call.arguments.then([&] { tell(call.arguments, build(*call.object, view, asked.get())); });
}

template <typename Scalar>
surehit_status rebuild_vertices(const char* function, void* handle, const Scalar* vertices, std::size_t count,
                                std::size_t stride, const surehit_executor* executor) {
  HandleCall<Collider<Scalar>> call(function, handle);
  const auto view = vertices_of<Scalar>(call.arguments, vertices, count, stride);
  check_executor(call.arguments, executor);
  return call.arguments.then([&] { tell(call.arguments, call.object->try_rebuild(view, executor_of(executor))); });
}

template <typename Scalar>
surehit_status set_mask(const char* function, void* handle, std::uint32_t triangle, std::uint32_t mask) {
  HandleCall<Collider<Scalar>> call(function, handle);
  check_triangle(call, triangle);
  return call.arguments.then([&] { call.object->set_mask(triangle, mask); });
}

template <typename Scalar>
surehit_status set_masks(const char* function, void* handle, const std::uint32_t* masks, std::size_t count) {
  HandleCall<Collider<Scalar>> call(function, handle);
  call.arguments.check_array(masks, count, sizeof *masks, "masks");
  return call.arguments.then([&] { tell(call.arguments, call.object->try_set_masks(std::span(masks, count))); });
}

template <typename Scalar>
surehit_status max_t_keeping(const char* function, const void* handle, const typename Structs<Scalar>::Path* path,
                             const typename Structs<Scalar>::Hit* hit, Scalar* max_t) {
  HandleCall<Collider<Scalar>> call(function, handle);
  check_path(call.arguments, path, "path");
  call.arguments.check_pointer(hit, "hit");
  if (call.arguments.are_valid()) check_triangle(call, hit->triangle);
  return call.tell(max_t, "max_t", [&](const auto& collider) {
    return collider.max_t_keeping(from_c(*path), Asked<Collider<Scalar>>::from_c(*hit));
  });
}

/// Tells something about a triangle: what `get(collider, id)` returns.
template <typename Scalar, typename Result, typename Get>
surehit_status of_triangle(const char* function, const void* handle, std::uint32_t id, Result* result, const char* name,
                           const Get& get) {
  HandleCall<Collider<Scalar>> call(function, handle);
  check_triangle(call, id);
  return call.tell(result, name, [&](const auto& collider) { return get(collider, id); });
}

template <typename Scalar>
surehit_status grid_summary(const char* function, const void* handle, surehit_grid_summary* summary) {
  HandleCall<Collider<Scalar>> call(function, handle);
  call.arguments.check_sized_result(summary, "summary");
  return call.arguments.then([&] {
    const GridSummary grid = call.object->grid_summary();
    summary->cells = grid.cells;
    summary->entries = grid.entries;
    summary->memory_bytes = grid.memory_bytes;
    summary->resolution_x = grid.resolution[0];
    summary->resolution_y = grid.resolution[1];
    summary->resolution_z = grid.resolution[2];
    summary->levels = grid.levels;
  });
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define SUREHIT_COLLIDER_FUNCTIONS(Scalar, s)                                                                          \
  SUREHIT_C_API surehit_status surehit_collider##s##_create(                                                           \
      const surehit_mesh##s* mesh, const surehit_build_options* options, surehit_collider##s** collider) {             \
    return create<Scalar>(__func__, mesh, options, collider);                                                          \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_copy(const surehit_collider##s* collider,                         \
                                                          surehit_collider##s** copy_of) {                             \
    return copy<Scalar>(__func__, collider, copy_of);                                                                  \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_destroy(surehit_collider##s* collider) {                          \
    return destroy<Collider<Scalar>>(__func__, collider);                                                              \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_build(surehit_collider##s* collider, const surehit_mesh##s* mesh, \
                                                           const surehit_build_options* options) {                     \
    return build<Scalar>(__func__, collider, mesh, options,                                                            \
                         [](auto& of, const auto& view, const auto& asked) { return of.try_build(view, asked); });     \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_rebuild(                                                          \
      surehit_collider##s* collider, const surehit_mesh##s* mesh, const surehit_build_options* options) {              \
    return build<Scalar>(__func__, collider, mesh, options,                                                            \
                         [](auto& of, const auto& view, const auto& asked) { return of.try_rebuild(view, asked); });   \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_rebuild_vertices(                                                 \
      surehit_collider##s* collider, const Scalar* vertices, size_t vertex_count, size_t stride,                       \
      const surehit_executor* executor) {                                                                              \
    return rebuild_vertices<Scalar>(__func__, collider, vertices, vertex_count, stride, executor);                     \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_set_mask(surehit_collider##s* collider, uint32_t triangle,        \
                                                              uint32_t mask) {                                         \
    return set_mask<Scalar>(__func__, collider, triangle, mask);                                                       \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_set_masks(surehit_collider##s* collider, const uint32_t* masks,   \
                                                               size_t mask_count) {                                    \
    return set_masks<Scalar>(__func__, collider, masks, mask_count);                                                   \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_mask(const surehit_collider##s* collider, uint32_t triangle,      \
                                                          uint32_t* mask) {                                            \
    return of_triangle<Scalar>(__func__, collider, triangle, mask, "mask",                                             \
                               [](const auto& of, uint32_t id) { return of.mask(id); });                               \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_first_hit(                                                        \
      const surehit_collider##s* collider, const surehit_path##s* path, const surehit_query_options##s* options,       \
      const surehit_filter##s* filter, surehit_statistics* statistics, surehit_hit##s* hit) {                          \
    Arguments arguments(__func__);                                                                                     \
    return first_hit(SingleQuery<Collider<Scalar>>(arguments, collider, path, options, filter, statistics), hit);      \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_any_hit(                                                          \
      const surehit_collider##s* collider, const surehit_path##s* path, const surehit_query_options##s* options,       \
      const surehit_filter##s* filter, surehit_statistics* statistics, uint8_t* blocked) {                             \
    Arguments arguments(__func__);                                                                                     \
    return any_hit(SingleQuery<Collider<Scalar>>(arguments, collider, path, options, filter, statistics), blocked);    \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_all_hits(                                                         \
      const surehit_collider##s* collider, const surehit_path##s* path, const surehit_query_options##s* options,       \
      const surehit_filter##s* filter, surehit_statistics* statistics, surehit_hit##s* hits, size_t capacity,          \
      size_t* hit_count) {                                                                                             \
    Arguments arguments(__func__);                                                                                     \
    return all_hits(SingleQuery<Collider<Scalar>>(arguments, collider, path, options, filter, statistics), hits,       \
                    capacity, hit_count);                                                                              \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_first_hits(                                                       \
      const surehit_collider##s* collider, const surehit_paths##s* paths, const surehit_batch_options##s* options,     \
      surehit_hit##s* hits) {                                                                                          \
    Arguments arguments(__func__);                                                                                     \
    return first_hits(Batch<Collider<Scalar>>(arguments, collider, paths, options), hits);                             \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_any_hits(                                                         \
      const surehit_collider##s* collider, const surehit_paths##s* paths, const surehit_batch_options##s* options,     \
      uint8_t* blocked) {                                                                                              \
    Arguments arguments(__func__);                                                                                     \
    return any_hits(Batch<Collider<Scalar>>(arguments, collider, paths, options), blocked);                            \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_last_free_point(                                                  \
      const surehit_collider##s* collider, const surehit_path##s* segment, const surehit_hit##s* hit,                  \
      const surehit_query_options##s* options, const surehit_filter##s* filter, surehit_vector3##s* point) {           \
    Arguments arguments(__func__);                                                                                     \
    return last_free_point(SingleQuery<Collider<Scalar>>(arguments, collider, segment, options, filter, nullptr), hit, \
                           point);                                                                                     \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_max_t_keeping(                                                    \
      const surehit_collider##s* collider, const surehit_path##s* path, const surehit_hit##s* hit, Scalar* max_t) {    \
    return max_t_keeping<Scalar>(__func__, collider, path, hit, max_t);                                                \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_triangle_count(const surehit_collider##s* collider,               \
                                                                    size_t* count) {                                   \
    return HandleCall<Collider<Scalar>>(__func__, collider).tell(count, "count", [](const auto& of) {                  \
      return of.triangle_count();                                                                                      \
    });                                                                                                                \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_triangle(const surehit_collider##s* collider, uint32_t id,        \
                                                              surehit_triangle##s* triangle) {                         \
    return of_triangle<Scalar>(__func__, collider, id, triangle, "triangle",                                           \
                               [](const auto& of, uint32_t of_id) { return to_c(of.triangle(of_id)); });               \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_normal(const surehit_collider##s* collider, uint32_t id,          \
                                                            surehit_vector3##s* normal) {                              \
    return of_triangle<Scalar>(__func__, collider, id, normal, "normal",                                               \
                               [](const auto& of, uint32_t of_id) { return to_c(of.normal(of_id)); });                 \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_box(const surehit_collider##s* collider, surehit_box##s* box) {   \
    return HandleCall<Collider<Scalar>>(__func__, collider).tell(box, "box", [](const auto& of) {                      \
      return to_c(of.box());                                                                                           \
    });                                                                                                                \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_grid_summary(const surehit_collider##s* collider,                 \
                                                                  surehit_grid_summary* summary) {                     \
    return grid_summary<Scalar>(__func__, collider, summary);                                                          \
  }                                                                                                                    \
  SUREHIT_C_API surehit_status surehit_collider##s##_memory_bytes(const surehit_collider##s* collider,                 \
                                                                  size_t* bytes) {                                     \
    return HandleCall<Collider<Scalar>>(__func__, collider).tell(bytes, "bytes", [](const auto& of) {                  \
      return of.memory_bytes();                                                                                        \
    });                                                                                                                \
  }
// NOLINTEND(bugprone-macro-parentheses)
extern "C" {
SUREHIT_COLLIDER_FUNCTIONS(float, f)
SUREHIT_COLLIDER_FUNCTIONS(double, d)
}
#undef SUREHIT_COLLIDER_FUNCTIONS

}  // namespace surehit::c
