#include "surehit/collider.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <string>
#include <utility>

#include "collider_state.hpp"
#include "file/collider_file.hpp"
#include "query/answer_batch.hpp"
#include "query/free_point.hpp"
#include "query/query.hpp"
#include "support/floating_point_environment.hpp"
#include "support/in_parts.hpp"
#include "support/never_destroyed.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/intersect.hpp"

namespace surehit {
namespace {

/// The number of paths in a task of a batch. It is so large that the cost of a task is small in comparison. It is so
/// small that the last tasks end at about the same time.
constexpr std::size_t paths_in_a_task = 4096;

template <typename Scalar>
using State = detail::ColliderState<Scalar>;

/// A query of one path. It also has what the query needs while it runs: the floating-point environment, and a place to
/// count.
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
  QueryStatistics unread_;  ///< Counts if the caller has no statistics.
  detail::Query<Scalar> query_;
};

template <typename Scalar>
Vector3<Scalar> find_free_point(const State<Scalar>& state, const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                const QueryOptions<Scalar>& options, const HitFilter<Scalar>* filter) noexcept {
  return detail::find_free_point(
      segment, hit.t, options,
      [&](const Path<Scalar>& path, const QueryOptions<Scalar>& shortened, Scalar /*s*/) {
        const SingleQuery<Scalar> query(state, shortened, filter, nullptr);
        return state.searches->any(query.get(), path);
      },
      options.min_t > 0);
}

/// Answers a batch. `ask(query, paths, own_options, first)` answers the part that begins with path `first`.
template <typename Scalar, typename Ask>
void answer_batch(const State<Scalar>& state, const PathSpan<Scalar>& paths, std::size_t answers,
                  const BatchOptions<Scalar>& options, const Ask& ask) noexcept {
  const HitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_part = [&](std::size_t first, std::size_t last, std::span<const QueryOptions<Scalar>> own_options,
                            QueryStatistics& statistics) {
    const detail::Query<Scalar> query{state.grid, state.mesh, state.masks, options.options, filter, statistics, first};
    ask(query, paths.subspan(first, last - first), own_options, first);
  };
  detail::answer_batch(std::min(paths.size(), answers), options, paths_in_a_task, ask_part);
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

}  // namespace

template <FloatOrDouble Scalar>
void detail::DeleteColliderState<Scalar>::operator()(State<Scalar>* state) const noexcept {
  delete state;
}

template <FloatOrDouble Scalar>
std::uint64_t detail::ColliderState<Scalar>::next_version() noexcept {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

template <FloatOrDouble Scalar>
Collider<Scalar>::Collider(const Collider& other) : state_(other.state_ ? new State<Scalar>(*other.state_) : nullptr) {
  if (state_) state_->searches = detail::best_searches<Scalar>();  // A new collider chooses them in the same way.
}

template <FloatOrDouble Scalar>
Collider<Scalar>& Collider<Scalar>::operator=(const Collider& other) {
  if (this != &other) *this = Collider(other);
  return *this;
}

template <FloatOrDouble Scalar>
const State<Scalar>& Collider<Scalar>::state() const noexcept {
  return state_ ? *state_ : detail::never_destroyed<State<Scalar>>();
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_build(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options) {
  const FloatingPointEnvironment environment;
  if (BuildResult checked = check_mesh(mesh, options); !checked) return checked;
  StatePointer built(new State<Scalar>);
  built->box = box_of(mesh);
  built->grid = Grid(mesh, built->box, options.grid, detail::address_of(options.executor));
  built->masks.assign(options.masks.begin(), options.masks.end());
  built->grid_options = options.grid;
  built->mesh = MeshBlocks<Scalar>(mesh, built->grid, detail::address_of(options.executor));
  built->version = State<Scalar>::next_version();
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
  spare.grid.rebuild(mesh, box, options.grid, spare.scratch, detail::address_of(options.executor));
  spare.mesh.rebuild(mesh, spare.grid, detail::address_of(options.executor));
  state_->masks.reserve(options.masks.size());
  // Nothing below throws.
  state_->masks.assign(options.masks.begin(), options.masks.end());
  state_->grid_options = options.grid;
  state_->box = box;
  state_->version = State<Scalar>::next_version();
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
  if (!state_) return {};  // The mesh has no vertices, and none are given.
  const Box<Scalar> box = box_of(mesh);
  auto& spare = state_->spare;
  spare.grid.rebuild(mesh, box, state_->grid_options, spare.scratch, detail::address_of(executor));
  spare.mesh.rebuild(state_->mesh, vertices, spare.grid, detail::address_of(executor));
  std::swap(spare.grid, state_->grid);
  std::swap(spare.mesh, state_->mesh);
  state_->box = box;
  state_->version = State<Scalar>::next_version();
  return {};
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::save(const ByteSink& sink) const {
  return detail::save(state(), sink);
}

template <FloatOrDouble Scalar>
LoadResult Collider<Scalar>::try_load(std::span<const std::byte> bytes, const LoadOptions& options) {
  if (std::optional<InvalidFile> invalid = State<Scalar>::load_into(*this, bytes, 0, options)) {
    return *std::move(invalid);
  }
  return {};
}

template <FloatOrDouble Scalar>
std::optional<InvalidFile> detail::ColliderState<Scalar>::load_into(Collider<Scalar>& collider,
                                                                    std::span<const std::byte> bytes, std::size_t base,
                                                                    const LoadOptions& options) {
  const FloatingPointEnvironment environment;
  typename Collider<Scalar>::StatePointer loaded(new State<Scalar>);
  std::optional<InvalidFile> invalid = detail::load(bytes, base, options, *loaded);
  if (!invalid) collider.state_ = std::move(loaded);
  return invalid;
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::set_mask(std::uint32_t triangle, std::uint32_t mask) {
  assert(triangle < triangle_count());
  if (state_->masks.empty()) state_->masks.assign(triangle_count(), ~std::uint32_t{0});
  state_->masks[triangle] = mask;
  state_->mask_version = State<Scalar>::next_version();
}

template <FloatOrDouble Scalar>
BuildResult Collider<Scalar>::try_set_masks(std::span<const std::uint32_t> masks) {
  if (BuildResult checked = check_masks(masks, triangle_count()); !checked) return checked;
  if (!state_) return {};
  state_->masks.assign(masks.begin(), masks.end());
  state_->mask_version = State<Scalar>::next_version();
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
  const auto& [mesh, masks, box, grid, grid_options, spare, version, mask_version, searches] = state();
  return grid.memory_bytes() + mesh.memory_bytes() + masks.capacity() * sizeof(std::uint32_t) +
         spare.grid.memory_bytes() + spare.mesh.memory_bytes() + spare.scratch.memory_bytes();
}

template <FloatOrDouble Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                       const QueryOptions<Scalar>& options,
                                                       QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter, const QueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::first_hits(const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                                  const BatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, hits.size(), options,
               [&](const auto& query, const auto& some, const auto& own_options, std::size_t first) {
                 state().searches->each_first(query, some, own_options, hits.subspan(first, some.size()));
               });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                                const BatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, blocked.size(), options,
               [&](const auto& query, const auto& some, const auto& own_options, std::size_t first) {
                 state().searches->each_any(query, some, own_options, blocked.subspan(first, some.size()));
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

template struct detail::ColliderState<float>;
template struct detail::ColliderState<double>;
template struct detail::DeleteColliderState<float>;
template struct detail::DeleteColliderState<double>;
template class Collider<float>;
template class Collider<double>;

}  // namespace surehit
