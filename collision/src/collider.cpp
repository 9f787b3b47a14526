#include "surehit/collider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "exact_contact.hpp"
#include "path_range.hpp"
#include "query.hpp"
#include "surehit/floating_point_environment.hpp"

namespace surehit {
namespace {

/// Large enough that what a task costs is nothing beside it, small enough that the last ones end together.
constexpr std::size_t paths_in_a_task = 4096;

/// By the executor's tasks, each of which holds an environment of its own, for it may run on another thread. Apart, so
/// that other batches need not its stack.
template <typename Answer>
[[gnu::noinline]] void run_tasks(std::size_t count, const Executor& executor, QueryStatistics* statistics,
                                 const Answer& answer) {
  std::mutex mutex;
  executor.run((count + paths_in_a_task - 1) / paths_in_a_task, [&](std::size_t task) {
    const FloatingPointEnvironment environment;
    const std::size_t first = task * paths_in_a_task;
    QueryStatistics of_task;
    answer(first, std::min(paths_in_a_task, count - first), of_task);
    if (statistics == nullptr) return;
    const std::lock_guard lock(mutex);
    *statistics += of_task;
  });
}

/// Calls `answer(first, count, statistics)` for parts of `count` paths: all at once, or by the executor's tasks.
template <typename Answer>
void in_tasks(std::size_t count, const Executor* executor, QueryStatistics* statistics, const Answer& answer) {
  if (count == 0) return;
  if (executor != nullptr) {
    run_tasks(count, *executor, statistics, answer);
    return;
  }
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  answer(std::size_t{0}, count, statistics != nullptr ? *statistics : unread);
}

}  // namespace

template <typename Scalar>
detail::Query<Scalar> Collider<Scalar>::query(Filter filter, const QueryOptions<Scalar>& options,
                                              QueryStatistics* statistics, QueryStatistics& unread) const noexcept {
  return {grid_, mesh_, masks_, options, filter, statistics != nullptr ? *statistics : unread};
}

template <typename Scalar>
std::optional<InvalidMesh> Collider<Scalar>::build(const TriangleMeshView<Scalar>& mesh, const Executor* executor,
                                                   const BuildOptions& options) {
  const FloatingPointEnvironment environment;
  if (std::optional<InvalidMesh> invalid = find_invalid(mesh)) return invalid;
  if (!options.masks.empty() && options.masks.size() != mesh.triangle_count()) {
    return InvalidMesh(
        InvalidMesh::Reason::masks_do_not_match, options.masks.size(),
        std::to_string(options.masks.size()) + " masks for " + std::to_string(mesh.triangle_count()) + " triangles");
  }
  Collider built;
  built.box_ = box_of(mesh);
  built.grid_ = Grid(mesh, built.box_, options.grid, executor);
  built.masks_.assign(options.masks.begin(), options.masks.end());
  built.grid_options_ = options.grid;
  built.mesh_ = MeshBlocks<Scalar>(mesh, built.grid_, executor);
  *this = std::move(built);
  return std::nullopt;
}

template <typename Scalar>
std::optional<InvalidMesh> Collider<Scalar>::move_vertices(const VertexView<Scalar>& vertices,
                                                           const Executor* executor) {
  const FloatingPointEnvironment environment;
  const TriangleMeshView<Scalar> old = mesh_.view();
  if (vertices.count != old.vertex_count()) {
    return InvalidMesh(
        InvalidMesh::Reason::vertices_do_not_match, vertices.count,
        std::to_string(vertices.count) + " vertices for a mesh of " + std::to_string(old.vertex_count()));
  }
  const TriangleMeshView<Scalar> mesh = mesh_.view_with(vertices);
  if (std::optional<InvalidMesh> invalid = find_invalid(mesh)) return invalid;
  const Box<Scalar> box = box_of(mesh);
  spare_.grid.rebuild(mesh, box, grid_options_, spare_.scratch, executor);
  spare_.mesh.rebuild(mesh_, vertices, spare_.grid, executor);
  std::swap(spare_.grid, grid_);
  std::swap(spare_.mesh, mesh_);
  box_ = box;
  return std::nullopt;
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::find_first(const Path<Scalar>& path, const HitFilter<Scalar>* filter,
                                                        const QueryOptions<Scalar>& options,
                                                        QueryStatistics* statistics) const noexcept {
  QueryStatistics unread;
  return detail::first_hit(query(filter, options, statistics, unread), path);
}

template <typename Scalar>
bool Collider<Scalar>::find_any(const Path<Scalar>& path, const HitFilter<Scalar>* filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  QueryStatistics unread;
  return detail::any_hit(query(filter, options, statistics, unread), path);
}

template <typename Scalar>
void Collider<Scalar>::find_all(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const HitFilter<Scalar>* filter, const QueryOptions<Scalar>& options,
                                QueryStatistics* statistics) const {
  QueryStatistics unread;
  hits.clear();
  detail::all_hits(query(filter, options, statistics, unread), path, hits);
}

template <typename Scalar>
[[gnu::noinline]] Vector3<Scalar> Collider<Scalar>::find_free_point(
    const Segment<Scalar>& segment, const Hit<Scalar>& hit, const HitFilter<Scalar>* filter,
    const QueryOptions<Scalar>& options) const noexcept {
  const Path<Scalar> path = segment;
  if (!detail::is_finite(path) || !std::isfinite(hit.t)) return segment.start;
  // s is t less a multiple of ulp(t), so that it is exact.
  const Scalar ulp = std::nextafter(hit.t, std::numeric_limits<Scalar>::infinity()) - hit.t;
  for (Scalar back = ulp; hit.t - back > 0; back *= 2) {
    const Scalar s = hit.t - back;
    const Segment<Scalar> free{segment.start, detail::exact_point(path, s)};
    QueryOptions<Scalar> shortened = options;
    shortened.max_t = std::isnan(options.max_t) ? options.max_t : std::numeric_limits<Scalar>::infinity();
    if (options.min_t > 0) shortened.min_t = std::nextafter(options.min_t / s, Scalar{0});
    if (!find_any(free, filter, shortened, nullptr)) return free.end;
  }
  return segment.start;
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  return find_first(path, nullptr, options, statistics);
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                       const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  return find_first(path, &filter, options, statistics);
}

template <typename Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  return find_any(path, nullptr, options, statistics);
}

template <typename Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  return find_any(path, &filter, options, statistics);
}

template <typename Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const FloatingPointEnvironment environment;
  find_all(path, hits, nullptr, options, statistics);
}

template <typename Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const FloatingPointEnvironment environment;
  find_all(path, hits, &filter, options, statistics);
}

template <typename Scalar>
void Collider<Scalar>::find_each_first(const detail::PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                                       const Executor* executor, const QueryOptions<Scalar>& options,
                                       QueryStatistics* statistics) const noexcept {
  in_tasks(std::min(paths.size(), hits.size()), executor, statistics,
           [&](std::size_t first, std::size_t count, QueryStatistics& of_task) {
             detail::first_hits(query(nullptr, options, nullptr, of_task), paths.subspan(first, count), &hits[first]);
           });
}

template <typename Scalar>
void Collider<Scalar>::find_each_any(const detail::PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                                     const Executor* executor, const QueryOptions<Scalar>& options,
                                     QueryStatistics* statistics) const noexcept {
  in_tasks(std::min(paths.size(), blocked.size()), executor, statistics,
           [&](std::size_t first, std::size_t count, QueryStatistics& of_task) {
             detail::any_hits(query(nullptr, options, nullptr, of_task), paths.subspan(first, count), &blocked[first]);
           });
}

template <typename Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  const FloatingPointEnvironment environment;
  return find_free_point(segment, hit, nullptr, options);
}

template <typename Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  HitFilter<Scalar> filter,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  const FloatingPointEnvironment environment;
  return find_free_point(segment, hit, &filter, options);
}

#define SUREHIT_BATCH(AnyPath)                                                                                         \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::first_hits(std::span<const AnyPath<Scalar>> paths, std::span<Hit<Scalar>> hits,               \
                                    const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept { \
    find_each_first(paths, hits, nullptr, options, statistics);                                                        \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::first_hits(std::span<const AnyPath<Scalar>> paths, std::span<Hit<Scalar>> hits,               \
                                    Executor executor, const QueryOptions<Scalar>& options,                            \
                                    QueryStatistics* statistics) const noexcept {                                      \
    find_each_first(paths, hits, &executor, options, statistics);                                                      \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::any_hits(std::span<const AnyPath<Scalar>> paths, std::span<std::uint8_t> blocked,             \
                                  const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {   \
    find_each_any(paths, blocked, nullptr, options, statistics);                                                       \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::any_hits(std::span<const AnyPath<Scalar>> paths, std::span<std::uint8_t> blocked,             \
                                  Executor executor, const QueryOptions<Scalar>& options, QueryStatistics* statistics) \
      const noexcept {                                                                                                 \
    find_each_any(paths, blocked, &executor, options, statistics);                                                     \
  }
SUREHIT_BATCH(Segment)
SUREHIT_BATCH(Ray)
SUREHIT_BATCH(Line)
#undef SUREHIT_BATCH

template class Collider<float>;
template class Collider<double>;

}  // namespace surehit
