#include "surehit/collider.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <new>
#include <utility>

#include "collider_state.hpp"
#include "exact/exact_contact.hpp"
#include "query/path_range.hpp"
#include "query/query.hpp"
#include "support/floating_point_environment.hpp"

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

template <typename Scalar>
using State = detail::ColliderState<Scalar>;

template <typename Scalar>
detail::Query<Scalar> query_of(const State<Scalar>& state, const QueryOptions<Scalar>& options,
                               const HitFilter<Scalar>* filter, QueryStatistics& statistics) {
  return {state.grid, state.mesh, state.masks, options, filter, statistics};
}

template <typename Scalar>
std::optional<Hit<Scalar>> ask_first(const State<Scalar>& state, const Path<Scalar>& path,
                                     const QueryOptions<Scalar>& options, const HitFilter<Scalar>* filter,
                                     QueryStatistics* statistics) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  return detail::first_hit(query_of(state, options, filter, statistics != nullptr ? *statistics : unread), path);
}

template <typename Scalar>
bool ask_any(const State<Scalar>& state, const Path<Scalar>& path, const QueryOptions<Scalar>& options,
             const HitFilter<Scalar>* filter, QueryStatistics* statistics) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  return detail::any_hit(query_of(state, options, filter, statistics != nullptr ? *statistics : unread), path);
}

template <typename Scalar>
void ask_all(const State<Scalar>& state, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
             const QueryOptions<Scalar>& options, const HitFilter<Scalar>* filter, QueryStatistics* statistics) {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  hits.clear();
  detail::all_hits(query_of(state, options, filter, statistics != nullptr ? *statistics : unread), path, hits);
}

template <typename Scalar>
[[gnu::noinline]] Vector3<Scalar> ask_free_point(const State<Scalar>& state, const Segment<Scalar>& segment,
                                                 const Hit<Scalar>& hit, const QueryOptions<Scalar>& options,
                                                 const HitFilter<Scalar>* filter) noexcept {
  const FloatingPointEnvironment environment;
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
    if (!ask_any<Scalar>(state, free, shortened, filter, nullptr)) return free.end;
  }
  return segment.start;
}

template <typename Scalar>
void ask_each_first(const State<Scalar>& state, const detail::PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                    const Executor* executor, const QueryOptions<Scalar>& options,
                    QueryStatistics* statistics) noexcept {
  in_tasks(std::min(paths.size(), hits.size()), executor, statistics,
           [&](std::size_t first, std::size_t count, QueryStatistics& of_task) {
             detail::first_hits(query_of<Scalar>(state, options, nullptr, of_task), paths.subspan(first, count),
                                &hits[first]);
           });
}

template <typename Scalar>
void ask_each_any(const State<Scalar>& state, const detail::PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                  const Executor* executor, const QueryOptions<Scalar>& options, QueryStatistics* statistics) noexcept {
  in_tasks(std::min(paths.size(), blocked.size()), executor, statistics,
           [&](std::size_t first, std::size_t count, QueryStatistics& of_task) {
             detail::any_hits(query_of<Scalar>(state, options, nullptr, of_task), paths.subspan(first, count),
                              &blocked[first]);
           });
}

}  // namespace

template <typename Scalar>
void detail::DeleteColliderState<Scalar>::operator()(State<Scalar>* state) const noexcept {
  delete state;
}

template <typename Scalar>
Collider<Scalar>::Collider(const Collider& other) : state_(other.state_ ? new State<Scalar>(*other.state_) : nullptr) {}

template <typename Scalar>
Collider<Scalar>& Collider<Scalar>::operator=(const Collider& other) {
  if (this != &other) *this = Collider(other);
  return *this;
}

template <typename Scalar>
const State<Scalar>& Collider<Scalar>::state() const noexcept {
  if (state_) return *state_;
  // Never destroyed: a collider may be asked until the program ends.
  alignas(State<Scalar>) static std::byte memory[sizeof(State<Scalar>)];
  static const State<Scalar>& empty = *new (memory) State<Scalar>;
  return empty;
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
  StatePointer built(new State<Scalar>);
  built->box = box_of(mesh);
  built->grid = Grid(mesh, built->box, options.grid, executor);
  built->masks.assign(options.masks.begin(), options.masks.end());
  built->grid_options = options.grid;
  built->mesh = MeshBlocks<Scalar>(mesh, built->grid, executor);
  state_ = std::move(built);
  return std::nullopt;
}

template <typename Scalar>
std::optional<InvalidMesh> Collider<Scalar>::move_vertices(const VertexView<Scalar>& vertices,
                                                           const Executor* executor) {
  const FloatingPointEnvironment environment;
  const TriangleMeshView<Scalar> old = state().mesh.view();
  if (vertices.count != old.vertex_count()) {
    return InvalidMesh(
        InvalidMesh::Reason::vertices_do_not_match, vertices.count,
        std::to_string(vertices.count) + " vertices for a mesh of " + std::to_string(old.vertex_count()));
  }
  const TriangleMeshView<Scalar> mesh = state().mesh.view_with(vertices);
  if (std::optional<InvalidMesh> invalid = find_invalid(mesh)) return invalid;
  if (!state_) return std::nullopt;  // there were no vertices, and there are none
  const Box<Scalar> box = box_of(mesh);
  auto& spare = state_->spare;
  spare.grid.rebuild(mesh, box, state_->grid_options, spare.scratch, executor);
  spare.mesh.rebuild(state_->mesh, vertices, spare.grid, executor);
  std::swap(spare.grid, state_->grid);
  std::swap(spare.mesh, state_->mesh);
  state_->box = box;
  return std::nullopt;
}

template <typename Scalar>
std::size_t Collider<Scalar>::triangle_count() const noexcept {
  return state().mesh.triangle_count();
}

template <typename Scalar>
Triangle<Scalar> Collider<Scalar>::triangle(std::uint32_t id) const noexcept {
  return state().mesh.triangle(id);
}

template <typename Scalar>
const Box<Scalar>& Collider<Scalar>::box() const noexcept {
  return state().box;
}

template <typename Scalar>
GridSummary Collider<Scalar>::grid_summary() const noexcept {
  const Grid& grid = state().grid;
  return {grid.resolution(), grid.levels(), grid.cell_count(), grid.entry_count(), grid.memory_bytes()};
}

template <typename Scalar>
std::size_t Collider<Scalar>::memory_bytes() const noexcept {
  const auto& [mesh, masks, box, grid, grid_options, spare] = state();
  return grid.memory_bytes() + mesh.memory_bytes() + masks.capacity() * sizeof(std::uint32_t) +
         spare.grid.memory_bytes() + spare.mesh.memory_bytes() + spare.scratch.memory_bytes();
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  return ask_first<Scalar>(state(), path, options, nullptr, statistics);
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                       const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  return ask_first(state(), path, options, &filter, statistics);
}

template <typename Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  return ask_any<Scalar>(state(), path, options, nullptr, statistics);
}

template <typename Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  return ask_any(state(), path, options, &filter, statistics);
}

template <typename Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  ask_all<Scalar>(state(), path, hits, options, nullptr, statistics);
}

template <typename Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  ask_all(state(), path, hits, options, &filter, statistics);
}

template <typename Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  return ask_free_point<Scalar>(state(), segment, hit, options, nullptr);
}

template <typename Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  HitFilter<Scalar> filter,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  return ask_free_point(state(), segment, hit, options, &filter);
}

#define SUREHIT_BATCH(AnyPath)                                                                                         \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::first_hits(std::span<const AnyPath<Scalar>> paths, std::span<Hit<Scalar>> hits,               \
                                    const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept { \
    ask_each_first<Scalar>(state(), paths, hits, nullptr, options, statistics);                                        \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::first_hits(std::span<const AnyPath<Scalar>> paths, std::span<Hit<Scalar>> hits,               \
                                    Executor executor, const QueryOptions<Scalar>& options,                            \
                                    QueryStatistics* statistics) const noexcept {                                      \
    ask_each_first<Scalar>(state(), paths, hits, &executor, options, statistics);                                      \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::any_hits(std::span<const AnyPath<Scalar>> paths, std::span<std::uint8_t> blocked,             \
                                  const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {   \
    ask_each_any<Scalar>(state(), paths, blocked, nullptr, options, statistics);                                       \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::any_hits(std::span<const AnyPath<Scalar>> paths, std::span<std::uint8_t> blocked,             \
                                  Executor executor, const QueryOptions<Scalar>& options, QueryStatistics* statistics) \
      const noexcept {                                                                                                 \
    ask_each_any<Scalar>(state(), paths, blocked, &executor, options, statistics);                                     \
  }
SUREHIT_BATCH(Segment)
SUREHIT_BATCH(Ray)
SUREHIT_BATCH(Line)
#undef SUREHIT_BATCH

template struct detail::DeleteColliderState<float>;
template struct detail::DeleteColliderState<double>;
template class Collider<float>;
template class Collider<double>;

}  // namespace surehit
