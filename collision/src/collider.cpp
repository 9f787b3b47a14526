#include "surehit/collider.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "collider_state.hpp"
#include "exact/exact_contact.hpp"
#include "query/path_range.hpp"
#include "query/query.hpp"
#include "support/floating_point_environment.hpp"
#include "surehit/intersect.hpp"

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
void answer_in_tasks(std::size_t count, const std::optional<Executor>& executor, QueryStatistics* statistics,
                     const Answer& answer) {
  if (count == 0) return;
  if (executor) {
    run_tasks(count, *executor, statistics, answer);
    return;
  }
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  answer(std::size_t{0}, count, statistics != nullptr ? *statistics : unread);
}

template <typename Scalar>
using State = detail::ColliderState<Scalar>;

/// A query of one path, and what it needs while it runs: the floating-point environment, and somewhere to count.
template <typename Scalar>
class SingleQuery {
 public:
  SingleQuery(const State<Scalar>& state, const QueryOptions<Scalar>& options, const HitFilter<Scalar>* filter,
              QueryStatistics* statistics)
      : query_{state.grid, state.mesh, state.masks, options, filter, statistics != nullptr ? *statistics : unread_, 0} {
  }
  [[nodiscard]] const detail::Query<Scalar>& get() const { return query_; }

 private:
  FloatingPointEnvironment environment_;
  QueryStatistics unread_;
  detail::Query<Scalar> query_;
};

template <typename Scalar>
[[gnu::noinline]] Vector3<Scalar> find_free_point(const State<Scalar>& state, const Segment<Scalar>& segment,
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
    const SingleQuery<Scalar> query(state, shortened, filter, nullptr);
    if (!detail::dispatch_any_hit<Scalar>(query.get(), free)) return free.end;
  }
  return segment.start;
}

/// Answers a batch: `ask(query, paths, path_options, first)` for each part of it, from path `first` on.
template <typename Scalar, typename Ask>
void answer_batch(const State<Scalar>& state, const PathSpan<Scalar>& paths, std::size_t answers,
                  const BatchOptions<Scalar>& options, const Ask& ask) noexcept {
  const bool has_own_options = !options.path_options.empty();
  const std::size_t count =
      std::min({paths.size(), answers, has_own_options ? options.path_options.size() : paths.size()});
  const HitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  answer_in_tasks(count, options.executor, options.statistics,
                  [&](std::size_t first, std::size_t in_task, QueryStatistics& statistics) {
                    const detail::Query<Scalar> query{state.grid, state.mesh, state.masks, options.options,
                                                      filter,     statistics, first};
                    const auto own_options =
                        options.path_options.subspan(has_own_options ? first : 0, has_own_options ? in_task : 0);
                    ask(query, paths.subspan(first, in_task), own_options, first);
                  });
}

BuildResult check_masks(std::span<const std::uint32_t> masks, std::size_t triangle_count) {
  if (masks.empty() || masks.size() == triangle_count) return {};
  return InvalidMesh(InvalidMesh::Reason::masks_do_not_match, masks.size(),
                     std::to_string(masks.size()) + " masks for " + std::to_string(triangle_count) + " triangles");
}

template <typename Scalar>
BuildResult check_mesh(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options) {
  if (std::optional<InvalidMesh> invalid = find_invalid(mesh)) return *std::move(invalid);
  return check_masks(options.masks, mesh.triangle_count());
}

const Executor* address_of(const std::optional<Executor>& executor) { return executor ? &*executor : nullptr; }

}  // namespace

template <FloatOrDouble Scalar>
void detail::DeleteColliderState<Scalar>::operator()(State<Scalar>* state) const noexcept {
  delete state;
}

template <FloatOrDouble Scalar>
Collider<Scalar>::Collider(const Collider& other) : state_(other.state_ ? new State<Scalar>(*other.state_) : nullptr) {}

template <FloatOrDouble Scalar>
Collider<Scalar>& Collider<Scalar>::operator=(const Collider& other) {
  if (this != &other) *this = Collider(other);
  return *this;
}

template <FloatOrDouble Scalar>
const State<Scalar>& Collider<Scalar>::state() const noexcept {
  if (state_) return *state_;
  // Never destroyed: a collider may be asked until the program ends.
  alignas(State<Scalar>) static std::byte memory[sizeof(State<Scalar>)];
  static const State<Scalar>& empty = *new (memory) State<Scalar>;
  return empty;
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_build(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options) {
  const FloatingPointEnvironment environment;
  if (BuildResult checked = check_mesh(mesh, options); !checked) return checked;
  StatePointer built(new State<Scalar>);
  built->box = box_of(mesh);
  built->grid = Grid(mesh, built->box, options.grid, address_of(options.executor));
  built->masks.assign(options.masks.begin(), options.masks.end());
  built->grid_options = options.grid;
  built->mesh = MeshBlocks<Scalar>(mesh, built->grid, address_of(options.executor));
  state_ = std::move(built);
  return {};
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_rebuild(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options) {
  if (!state_) return try_build(mesh, options);
  const FloatingPointEnvironment environment;
  if (BuildResult checked = check_mesh(mesh, options); !checked) return checked;
  auto& spare = state_->spare;
  const Box<Scalar> box = box_of(mesh);
  spare.grid.rebuild(mesh, box, options.grid, spare.scratch, address_of(options.executor));
  spare.mesh.rebuild(mesh, spare.grid, address_of(options.executor));
  state_->masks.reserve(options.masks.size());
  // Nothing below throws.
  state_->masks.assign(options.masks.begin(), options.masks.end());
  state_->grid_options = options.grid;
  state_->box = box;
  std::swap(spare.grid, state_->grid);
  std::swap(spare.mesh, state_->mesh);
  return {};
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_rebuild(const VertexView<Scalar>& vertices, const std::optional<Executor>& executor) {
  const FloatingPointEnvironment environment;
  const std::size_t vertex_count = state().mesh.view().vertex_count();
  const TriangleMeshView<Scalar> mesh = state().mesh.view_with(vertices);
  if (vertices.is_valid() && vertices.size() != vertex_count) {
    return InvalidMesh(InvalidMesh::Reason::vertices_do_not_match, vertices.size(),
                       std::to_string(vertices.size()) + " vertices for a mesh of " + std::to_string(vertex_count));
  }
  if (std::optional<InvalidMesh> invalid = find_invalid(mesh)) return *std::move(invalid);
  if (!state_) return {};  // there were no vertices, and there are none
  const Box<Scalar> box = box_of(mesh);
  auto& spare = state_->spare;
  spare.grid.rebuild(mesh, box, state_->grid_options, spare.scratch, address_of(executor));
  spare.mesh.rebuild(state_->mesh, vertices, spare.grid, address_of(executor));
  std::swap(spare.grid, state_->grid);
  std::swap(spare.mesh, state_->mesh);
  state_->box = box;
  return {};
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::set_mask(std::uint32_t triangle, std::uint32_t mask) {
  assert(triangle < triangle_count());
  if (state_->masks.empty()) state_->masks.assign(triangle_count(), ~std::uint32_t{0});
  state_->masks[triangle] = mask;
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_set_masks(std::span<const std::uint32_t> masks) {
  if (BuildResult checked = check_masks(masks, triangle_count()); !checked) return checked;
  if (state_) state_->masks.assign(masks.begin(), masks.end());
  return {};
}

template <FloatOrDouble Scalar>
std::uint32_t Collider<Scalar>::mask(std::uint32_t triangle) const noexcept {
  return state().masks.empty() ? ~std::uint32_t{0} : state().masks[triangle];
}

template <FloatOrDouble Scalar>
std::size_t Collider<Scalar>::triangle_count() const noexcept {
  return state().mesh.triangle_count();
}

template <FloatOrDouble Scalar>
Triangle<Scalar> Collider<Scalar>::triangle(std::uint32_t id) const noexcept {
  return state().mesh.triangle(id);
}

template <FloatOrDouble Scalar>
const Box<Scalar>& Collider<Scalar>::box() const noexcept {
  return state().box;
}

template <FloatOrDouble Scalar>
GridSummary Collider<Scalar>::grid_summary() const noexcept {
  const Grid& grid = state().grid;
  return {grid.resolution(), grid.levels(), grid.cell_count(), grid.entry_count(), grid.memory_bytes()};
}

template <FloatOrDouble Scalar>
std::size_t Collider<Scalar>::memory_bytes() const noexcept {
  const auto& [mesh, masks, box, grid, grid_options, spare] = state();
  return grid.memory_bytes() + mesh.memory_bytes() + masks.capacity() * sizeof(std::uint32_t) +
         spare.grid.memory_bytes() + spare.mesh.memory_bytes() + spare.scratch.memory_bytes();
}

template <FloatOrDouble Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return detail::dispatch_first_hit(query.get(), path);
}

template <FloatOrDouble Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                       const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return detail::dispatch_first_hit(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return detail::dispatch_any_hit(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return detail::dispatch_any_hit(query.get(), path);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  hits.clear();
  detail::dispatch_all_hits(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  hits.clear();
  detail::dispatch_all_hits(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::first_hits(const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                                  const BatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, hits.size(), options,
               [&](const auto& query, const auto& some, const auto& own_options, std::size_t first) {
                 detail::dispatch_first_hits(query, some, own_options, &hits[first]);
               });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                                const BatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, blocked.size(), options,
               [&](const auto& query, const auto& some, const auto& own_options, std::size_t first) {
                 detail::dispatch_any_hits(query, some, own_options, &blocked[first]);
               });
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  return find_free_point<Scalar>(state(), segment, hit, options, nullptr);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                  HitFilter<Scalar> filter,
                                                  const QueryOptions<Scalar>& options) const noexcept {
  return find_free_point(state(), segment, hit, options, &filter);
}

template <FloatOrDouble Scalar>
Scalar Collider<Scalar>::max_t_keeping(const Path<Scalar>& path, const Hit<Scalar>& hit) const noexcept {
  return surehit::max_t_keeping(path, triangle(hit.triangle), hit);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Collider<Scalar>::normal(std::uint32_t id) const noexcept {
  return surehit::normal(triangle(id));
}

template struct SUREHIT_API detail::DeleteColliderState<float>;
template struct SUREHIT_API detail::DeleteColliderState<double>;
template class SUREHIT_API Collider<float>;
template class SUREHIT_API Collider<double>;

}  // namespace surehit
