// What surehit.js calls: functions of numbers and of addresses in the module's memory. The names end with the scalar.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "surehit/surehit.hpp"

// An allocation that fails stops the module, as there are no exceptions. surehit.js then refuses all that follows.
void* operator new(std::size_t bytes) {
  void* const memory = std::malloc(std::max(bytes, std::size_t{1}));
  if (memory == nullptr) __builtin_trap();
  return memory;
}
// The library's own ends of a program would print, and nothing here can.
void std::__libcpp_verbose_abort(const char*, ...) { __builtin_trap(); }
extern "C" void abort_message(const char*, ...) { __builtin_trap(); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace surehit::web {
namespace {

/// Why the last build failed.
std::optional<InvalidMesh> last_error;

/// Returns 1 for a success, and keeps the error of a failure.
int succeeded(const BuildResult& result) {
  if (result) return 1;
  last_error = result.error();
  return 0;
}

/// A collider, and room for the hits of its last query.
template <typename Scalar>
struct WebCollider {
  Collider<Scalar> collider;
  std::vector<Hit<Scalar>> hits;
};

/// The six numbers of a path, as in a `Segment`.
template <typename Scalar>
Path<Scalar> path_of(std::uint32_t kind, const Scalar* x) {
  return {static_cast<PathKind>(kind), {x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

/// `QueryOptions`, as surehit.js writes them.
template <typename Scalar>
struct WebOptions {
  Scalar min_t;
  Scalar max_t;
  std::uint32_t culling;
  std::uint32_t mask;
  std::uint32_t ignored_triangle;
  std::uint32_t ignored_contacts;  ///< The sum of 1 for the start, 2 for the end and 4 for all that is edge-on.

  [[nodiscard]] QueryOptions<Scalar> query() const {
    return {.min_t = min_t,
            .max_t = max_t,
            .culling = static_cast<Culling>(culling),
            .mask = mask,
            .ignored_triangle = ignored_triangle,
            .ignore_start_contact = (ignored_contacts & 1) != 0,
            .ignore_end_contact = (ignored_contacts & 2) != 0};
  }
  [[nodiscard]] bool ignores_edge_on() const { return (ignored_contacts & 4) != 0; }
};

/// Accepts what arrives from one of the two sides.
constexpr auto has_side = [](const auto& hit) { return hit.side != Side::edge_on; };

/// The columns of `capacity` hits: all t, all u, all v, all triangles, all sides.
template <typename Scalar>
struct HitColumns {
  HitColumns(void* memory, std::size_t capacity)
      : t(static_cast<Scalar*>(memory)),
        u(t + capacity),
        v(u + capacity),
        triangle(reinterpret_cast<std::uint32_t*>(v + capacity)),
        side(reinterpret_cast<std::uint8_t*>(triangle + capacity)) {}

  void store(std::span<const Hit<Scalar>> hits, std::size_t first) const {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      t[first + i] = hits[i].t;
      u[first + i] = hits[i].u;
      v[first + i] = hits[i].v;
      triangle[first + i] = hits[i].triangle;
      side[first + i] = static_cast<std::uint8_t>(hits[i].side);
    }
  }

  Scalar* t;
  Scalar* u;
  Scalar* v;
  std::uint32_t* triangle;
  std::uint8_t* side;
};

template <typename Scalar>
int build(WebCollider<Scalar>* self, const Scalar* numbers, std::size_t number_count, const void* indices,
          std::size_t index_count, std::size_t index_size, const std::uint32_t* masks, std::size_t mask_count) {
  const VertexView<Scalar> vertices = std::span(numbers, number_count);
  const TriangleIndexView triangles =
      index_size == sizeof(std::uint16_t)
          ? TriangleIndexView(std::span(static_cast<const std::uint16_t*>(indices), index_count))
          : TriangleIndexView(std::span(static_cast<const std::uint32_t*>(indices), index_count));
  return succeeded(self->collider.try_build({vertices, triangles}, {.masks = std::span(masks, mask_count)}));
}

template <typename Scalar>
int store(const std::optional<Hit<Scalar>>& hit, Hit<Scalar>* result) {
  if (hit) *result = *hit;
  return hit ? 1 : 0;
}

template <typename Scalar>
std::optional<Hit<Scalar>> first_hit(const WebCollider<Scalar>& self, const Path<Scalar>& path,
                                     const WebOptions<Scalar>& options) {
  const auto hit = self.collider.first_hit(path, options.query());
  // A filter takes time, and few first hits are edge-on.
  return hit && !has_side(*hit) && options.ignores_edge_on() ? self.collider.first_hit(path, has_side, options.query())
                                                             : hit;
}

template <typename Scalar>
bool any_hit(const WebCollider<Scalar>& self, const Path<Scalar>& path, const WebOptions<Scalar>& options) {
  return options.ignores_edge_on() ? self.collider.any_hit(path, has_side, options.query())
                                   : self.collider.any_hit(path, options.query());
}

template <typename Scalar>
std::size_t all_hits(WebCollider<Scalar>* self, const Path<Scalar>& path, const WebOptions<Scalar>& options) {
  if (options.ignores_edge_on()) {
    self->collider.all_hits(path, self->hits, has_side, options.query());
  } else {
    self->collider.all_hits(path, self->hits, options.query());
  }
  return self->hits.size();
}

template <typename Scalar>
BatchOptions<Scalar> batch_options(const WebOptions<Scalar>& options) {
  BatchOptions<Scalar> result = {.options = options.query()};
  if (options.ignores_edge_on()) result.filter.emplace(has_side);
  return result;
}

template <typename Scalar>
PathSpan<Scalar> paths_of(std::uint32_t kind, const Scalar* numbers, std::size_t count) {
  const std::size_t stride = 6 * sizeof(Scalar);
  const auto starts = VertexView<Scalar>::strided(numbers, count, stride);
  const auto towards = VertexView<Scalar>::strided(numbers + 3, count, stride);
  switch (static_cast<PathKind>(kind)) {
    case PathKind::ray:
      return PathSpan<Scalar>::rays(starts, towards);
    case PathKind::line:
      return PathSpan<Scalar>::lines(starts, towards);
    default:
      return PathSpan<Scalar>::segments(starts, towards);
  }
}

/// As in a single query, only hits that are edge-on need the filter.
template <typename Scalar>
void ask_again_if_edge_on(const Collider<Scalar>& collider, const PathSpan<Scalar>& paths,
                          const WebOptions<Scalar>& options, std::span<Hit<Scalar>> hits) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle == no_triangle || has_side(hits[i])) continue;
    hits[i] = collider.first_hit(paths[i], has_side, options.query()).value_or(Hit<Scalar>{});
  }
}

/// A part of a batch at a time, so that its hits are still in the cache when they go to their columns.
template <typename Scalar>
void first_hits(WebCollider<Scalar>* self, const PathSpan<Scalar>& paths, const WebOptions<Scalar>& options,
                const HitColumns<Scalar>& columns) {
  constexpr std::size_t part = 2048;
  self->hits.resize(std::min(paths.size(), part));
  for (std::size_t first = 0; first < paths.size(); first += part) {
    const std::span hits = std::span(self->hits).first(std::min(part, paths.size() - first));
    const PathSpan<Scalar> some = paths.subspan(first, hits.size());
    self->collider.first_hits(some, hits, {.options = options.query()});
    if (options.ignores_edge_on()) ask_again_if_edge_on(self->collider, some, options, hits);
    columns.store(hits, first);
  }
}

template <typename Scalar>
void store_vector(const Vector3<Scalar>& vector, Scalar* result) {
  std::copy_n(vector.data(), 3, result);
}

template <typename Scalar>
Triangle<Scalar> triangle_of(const Scalar* x) {
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}};
}

}  // namespace
}  // namespace surehit::web

using surehit::Hit;
using surehit::VertexView;
using namespace surehit::web;

#define SUREHIT_EXPORT(Result, name) extern "C" __attribute__((export_name(#name))) Result surehit_##name

SUREHIT_EXPORT(void*, allocate)(std::size_t bytes) { return std::malloc(bytes); }
SUREHIT_EXPORT(void, release)(void* memory) { std::free(memory); }
SUREHIT_EXPORT(std::uint32_t, error_reason)() { return static_cast<std::uint32_t>(last_error->reason); }
SUREHIT_EXPORT(std::size_t, error_element)() { return last_error->element; }
SUREHIT_EXPORT(const char*, error_message)() { return last_error->what(); }

#define SUREHIT_EXPORT_ALL(Scalar, end)                                                                             \
  SUREHIT_EXPORT(WebCollider<Scalar>*, create_##end)() { return new WebCollider<Scalar>; }                          \
  SUREHIT_EXPORT(void, destroy_##end)(WebCollider<Scalar> * self) { delete self; }                                  \
  SUREHIT_EXPORT(int, build_##end)                                                                                  \
  (WebCollider<Scalar> * self, const Scalar* numbers, std::size_t number_count, const void* indices,                \
   std::size_t index_count, std::size_t index_size, const std::uint32_t* masks, std::size_t mask_count) {           \
    return build(self, numbers, number_count, indices, index_count, index_size, masks, mask_count);                 \
  }                                                                                                                 \
  SUREHIT_EXPORT(int, move_##end)(WebCollider<Scalar> * self, const Scalar* numbers, std::size_t number_count) {    \
    return succeeded(self->collider.try_rebuild(VertexView<Scalar>(std::span(numbers, number_count))));             \
  }                                                                                                                 \
  SUREHIT_EXPORT(int, set_masks_##end)(WebCollider<Scalar> * self, const std::uint32_t* masks, std::size_t count) { \
    return succeeded(self->collider.try_set_masks(std::span(masks, count)));                                        \
  }                                                                                                                 \
  SUREHIT_EXPORT(std::size_t, triangle_count_##end)(const WebCollider<Scalar>* self) {                              \
    return self->collider.triangle_count();                                                                         \
  }                                                                                                                 \
  SUREHIT_EXPORT(std::size_t, memory_bytes_##end)(const WebCollider<Scalar>* self) {                                \
    return self->collider.memory_bytes();                                                                           \
  }                                                                                                                 \
  SUREHIT_EXPORT(void, normal_##end)(const WebCollider<Scalar>* self, std::uint32_t triangle, Scalar* result) {     \
    store_vector(self->collider.normal(triangle), result);                                                          \
  }                                                                                                                 \
  SUREHIT_EXPORT(int, first_hit_##end)                                                                              \
  (const WebCollider<Scalar>* self, std::uint32_t kind, const Scalar* path, const WebOptions<Scalar>* options,      \
   Hit<Scalar>* result) {                                                                                           \
    return store(first_hit(*self, path_of(kind, path), *options), result);                                          \
  }                                                                                                                 \
  SUREHIT_EXPORT(int, any_hit_##end)                                                                                \
  (const WebCollider<Scalar>* self, std::uint32_t kind, const Scalar* path, const WebOptions<Scalar>* options) {    \
    return any_hit(*self, path_of(kind, path), *options) ? 1 : 0;                                                   \
  }                                                                                                                 \
  SUREHIT_EXPORT(std::size_t, all_hits_##end)                                                                       \
  (WebCollider<Scalar> * self, std::uint32_t kind, const Scalar* path, const WebOptions<Scalar>* options) {         \
    return all_hits(self, path_of(kind, path), *options);                                                           \
  }                                                                                                                 \
  SUREHIT_EXPORT(void, store_all_hits_##end)                                                                        \
  (const WebCollider<Scalar>* self, void* columns, std::size_t capacity) {                                          \
    HitColumns<Scalar>(columns, capacity).store(self->hits, 0);                                                     \
  }                                                                                                                 \
  SUREHIT_EXPORT(void, first_hits_##end)                                                                            \
  (WebCollider<Scalar> * self, std::uint32_t kind, const Scalar* paths, std::size_t count,                          \
   const WebOptions<Scalar>* options, void* columns, std::size_t capacity) {                                        \
    first_hits(self, paths_of(kind, paths, count), *options, HitColumns<Scalar>(columns, capacity));                \
  }                                                                                                                 \
  SUREHIT_EXPORT(void, any_hits_##end)                                                                              \
  (const WebCollider<Scalar>* self, std::uint32_t kind, const Scalar* paths, std::size_t count,                     \
   const WebOptions<Scalar>* options, std::uint8_t* blocked) {                                                      \
    self->collider.any_hits(paths_of(kind, paths, count), std::span(blocked, count), batch_options(*options));      \
  }                                                                                                                 \
  SUREHIT_EXPORT(int, intersect_##end)                                                                              \
  (std::uint32_t kind, const Scalar* path, const Scalar* corners, const WebOptions<Scalar>* options,                \
   Hit<Scalar>* result) {                                                                                           \
    const auto hit = surehit::intersect<Scalar>(path_of(kind, path), triangle_of(corners), options->query());       \
    return store(hit && options->ignores_edge_on() && !has_side(*hit) ? std::nullopt : hit, result);                \
  }                                                                                                                 \
  SUREHIT_EXPORT(void, point_##end)                                                                                 \
  (std::uint32_t kind, const Scalar* path, const Hit<Scalar>* hit, Scalar* result) {                                \
    store_vector(surehit::point<Scalar>(path_of(kind, path), *hit), result);                                        \
  }                                                                                                                 \
  SUREHIT_EXPORT(Scalar, distance_##end)(std::uint32_t kind, const Scalar* path, const Hit<Scalar>* hit) {          \
    return surehit::distance<Scalar>(path_of(kind, path), *hit);                                                    \
  }

SUREHIT_EXPORT_ALL(float, f32)
SUREHIT_EXPORT_ALL(double, f64)
