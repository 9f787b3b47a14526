#include "surehit/scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "exact/exact_contact.hpp"
#include "file/scene_file.hpp"
#include "query/answer_batch.hpp"
#include "query/free_point.hpp"
#include "scene/invalid_pose.hpp"
#include "scene/scene_state.hpp"
#include "support/floating_point_environment.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"
#include "unit_of_cross.hpp"

namespace surehit {
namespace {

/// The number of paths in a task of a batch. Paths of a scene take longer than those of a collider.
constexpr std::size_t scene_paths_in_a_task = 1024;

template <typename Scalar>
using SceneStateOf = detail::SceneState<Scalar>;

InvalidInstance stale(InstanceId id) {
  return {InvalidInstance::Reason::stale_id, id.index,
          "there is no instance with index " + std::to_string(id.index) + " and generation " +
              std::to_string(id.generation)};
}

/// A query of one path, with what it needs while it runs.
template <typename Scalar>
class SingleSceneQuery {
 public:
  SingleSceneQuery(const SceneStateOf<Scalar>& state, const SceneQueryOptions<Scalar>& options,
                   const SceneHitFilter<Scalar>* filter, QueryStatistics* statistics, Scalar share = 1)
      : query_{state.committed, state.tree, options, filter, statistics != nullptr ? *statistics : unread_, 0, share} {}
  [[nodiscard]] const detail::SceneQuery<Scalar>& get() const { return query_; }

 private:
  FloatingPointEnvironment environment_;
  QueryStatistics unread_;  ///< Counts if the caller has no statistics.
  detail::SceneQuery<Scalar> query_;
};

/// Answers a batch in parts. `search` is one of the searches for batches.
template <typename Scalar, typename Answer, typename Search>
void answer_batch(const SceneStateOf<Scalar>& state, const PathSpan<Scalar>& paths, std::span<Answer> answers,
                  const SceneBatchOptions<Scalar>& options, const Search& search) noexcept {
  const SceneHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_part = [&](std::size_t first, std::size_t last, std::span<const SceneQueryOptions<Scalar>> own_options,
                            QueryStatistics& statistics) {
    const FloatingPointEnvironment environment;
    const detail::SceneQuery<Scalar> part{state.committed, state.tree, options.options, filter, statistics, first};
    search(part, paths.subspan(first, last - first), own_options, answers.subspan(first, last - first));
  };
  detail::answer_batch(std::min(paths.size(), answers.size()), options, scene_paths_in_a_task, ask_part);
}

/// The instances go the same share of their ways as the point.
template <typename Scalar>
Vector3<Scalar> find_free_point(const SceneStateOf<Scalar>& state, const Segment<Scalar>& segment,
                                const SceneHit<Scalar>& hit, const SceneQueryOptions<Scalar>& options,
                                const SceneHitFilter<Scalar>* filter) noexcept {
  return detail::find_free_point(segment, hit.t, options,
                                 [&](const Path<Scalar>& path, const SceneQueryOptions<Scalar>& shortened, Scalar s) {
                                   const SingleSceneQuery<Scalar> query(state, shortened, filter, nullptr, s);
                                   return state.searches->any(query.get(), path);
                                 });
}

}  // namespace

template <FloatOrDouble Scalar>
void detail::DeleteSceneState<Scalar>::operator()(SceneStateOf<Scalar>* state) const noexcept {
  delete state;
}

template <FloatOrDouble Scalar>
const SceneStateOf<Scalar>& Scene<Scalar>::state() const noexcept {
  if (state_) return *state_;
  // It is never destroyed, because a scene may be asked until the program ends.
  union Kept {
    Kept() : empty() {}
    ~Kept() {}
    SceneStateOf<Scalar> empty;
  };
  static const Kept kept;
  return kept.empty;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::add_instance(ColliderPointer collider,
                                           std::shared_ptr<const Collider<float>> float_collider,
                                           const Pose<Scalar>& pose, const InstanceOptions& options) {
  const FloatingPointEnvironment environment;
  if (!collider && !float_collider) {
    return InvalidInstance(InvalidInstance::Reason::no_collider, 0, "the pointer to the collider is null");
  }
  if (std::optional<InvalidInstance> invalid = detail::find_invalid(pose)) return *std::move(invalid);
  if (!state_) state_ = StatePointer(new SceneStateOf<Scalar>);
  auto& pending = state_->pending;
  if (state_->unused.empty()) {
    // An index is below the bit of the tree that marks an instance.
    constexpr std::size_t max_instances = detail::InstanceTree::instance_bit - 1;
    if (pending.size() >= max_instances) {
      return InvalidInstance(InvalidInstance::Reason::too_many_instances, pending.size(),
                             std::to_string(pending.size()) + " instances are the maximum");
    }
    const std::size_t room = std::max<std::size_t>(8, 2 * pending.size());
    if (pending.size() == pending.capacity()) pending.reserve(room);
    // Later changes and removals need no memory.
    state_->changed.reserve(pending.capacity());
    state_->unused.reserve(pending.capacity());
    state_->unused.push_back(static_cast<std::uint32_t>(pending.size()));
    pending.emplace_back();
  }
  const std::uint32_t index = state_->unused.back();
  state_->unused.pop_back();
  detail::PendingInstance<Scalar>& instance = pending[index];
  instance.collider = std::move(collider);
  instance.float_collider = std::move(float_collider);
  instance.placement = {pose};
  instance.options = options;
  instance.is_there = true;
  state_->note_change(index);
  ++state_->count;
  return InstanceId{index, instance.generation};
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_add(ColliderPointer collider, const Pose<Scalar>& pose,
                                      const InstanceOptions& options) {
  return add_instance(std::move(collider), nullptr, pose, options);
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_add(FloatColliderPointer collider, const Pose<Scalar>& pose,
                                      const InstanceOptions& options) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return add_instance(nullptr, std::move(collider), pose, options);
  } else {
    return add_instance(nullptr, nullptr, pose, options);  // No one can call it.
  }
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_remove(InstanceId id) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return stale(id);
  // The collider stays until the commit, because queries may still use it. So does the index.
  instance->is_there = false;
  ++instance->generation;
  state_->note_change(id.index);
  --state_->count;
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_pose(InstanceId id, const Pose<Scalar>& pose) {
  const FloatingPointEnvironment environment;
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return stale(id);
  if (std::optional<InvalidInstance> invalid = detail::find_invalid(pose)) return *std::move(invalid);
  instance->placement.pose = pose;
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_motion(InstanceId id, const Vector3<Scalar>& motion) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return stale(id);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isfinite(motion[static_cast<Eigen::Index>(axis)])) continue;
    return InvalidInstance(InvalidInstance::Reason::non_finite_motion, axis,
                           "motion[" + std::to_string(axis) + "] is not finite");
  }
  instance->placement.motion = motion;
  instance->placement.moves = motion != Vector3<Scalar>::Zero();
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::try_set_mask(InstanceId id, std::uint32_t mask) {
  auto* const instance = state_ ? state_->find(id) : nullptr;
  if (instance == nullptr) return stale(id);
  instance->options.mask = mask;
  state_->note_change(id.index);
  return id;
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::commit(const std::optional<Executor>& executor) {
  const FloatingPointEnvironment environment;
  if (state_) state_->commit(detail::address_of(executor));
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::save(const ByteSink& sink) const {
  return detail::save(state(), sink);
}

template <FloatOrDouble Scalar>
LoadResult Scene<Scalar>::try_load(std::span<const std::byte> bytes, const LoadOptions& options) {
  const FloatingPointEnvironment environment;
  StatePointer loaded(new SceneStateOf<Scalar>);
  if (std::optional<InvalidFile> invalid = detail::load(bytes, options, *loaded)) return *std::move(invalid);
  state_ = std::move(loaded);
  return {};
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::instance_count() const noexcept {
  return state().count;
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::contains(InstanceId id) const noexcept {
  return state().find(id) != nullptr;
}

template <FloatOrDouble Scalar>
std::vector<InstanceId> Scene<Scalar>::instances() const {
  std::vector<InstanceId> ids;
  ids.reserve(state().count);
  const auto& pending = state().pending;
  for (std::uint32_t index = 0; index < pending.size(); ++index) {
    if (pending[index].is_there) ids.push_back({index, pending[index].generation});
  }
  return ids;
}

template <FloatOrDouble Scalar>
const Pose<Scalar>& Scene<Scalar>::pose(InstanceId id) const noexcept {
  assert(contains(id));
  return state().find(id)->placement.pose;
}

template <FloatOrDouble Scalar>
const Vector3<Scalar>& Scene<Scalar>::motion(InstanceId id) const noexcept {
  assert(contains(id));
  return state().find(id)->placement.motion;
}

template <FloatOrDouble Scalar>
std::uint32_t Scene<Scalar>::mask(InstanceId id) const noexcept {
  assert(contains(id));
  return state().find(id)->options.mask;
}

template <FloatOrDouble Scalar>
std::uint64_t Scene<Scalar>::user_data(InstanceId id) const noexcept {
  assert(contains(id));
  return state().find(id)->options.user_data;
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::triangle_count(InstanceId id) const noexcept {
  assert(contains(id));
  const auto* const instance = state().find(id);
  return instance->collider ? instance->collider->triangle_count() : instance->float_collider->triangle_count();
}

template <FloatOrDouble Scalar>
Box<Scalar> Scene<Scalar>::box() const noexcept {
  const FloatingPointEnvironment environment;
  Box<Scalar> box;
  const detail::InstanceTree& tree = state().tree;
  if (tree.is_empty()) return box;
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const auto low = static_cast<Scalar>(tree.box().low[axis]);
    const auto high = static_cast<Scalar>(tree.box().high[axis]);
    box.low[i] = double{low} <= tree.box().low[axis] ? low : std::nextafter(low, -infinity);
    box.high[i] = double{high} >= tree.box().high[axis] ? high : std::nextafter(high, infinity);
  }
  return box;
}

template <FloatOrDouble Scalar>
std::size_t Scene<Scalar>::memory_bytes() const noexcept {
  if (!state_) return 0;
  const SceneStateOf<Scalar>& of = *state_;
  return sizeof of + of.pending.capacity() * sizeof(of.pending[0]) +
         (of.changed.capacity() + of.unused.capacity()) * sizeof(std::uint32_t) +
         of.committed.capacity() * sizeof(of.committed[0]) + of.boxes.capacity() * sizeof(of.boxes[0]) +
         of.tree.memory_bytes();
}

namespace {

/// Calls `use(triangle)` for a triangle of an instance, as a `PlacedTriangle` of the scene's Scalar.
template <typename Scalar, typename Use>
auto use_triangle(const detail::PendingInstance<Scalar>& instance, std::uint32_t triangle, const Use& use) {
  const auto placed = [&](const auto& local) {
    return use(detail::PlacedTriangle<Scalar>{
        {local.a.template cast<Scalar>(), local.b.template cast<Scalar>(), local.c.template cast<Scalar>()},
        instance.placement});
  };
  return instance.collider ? placed(instance.collider->triangle(triangle))
                           : placed(instance.float_collider->triangle(triangle));
}

}  // namespace

template <FloatOrDouble Scalar>
Triangle<Scalar> Scene<Scalar>::triangle(InstanceId id, std::uint32_t triangle) const noexcept {
  assert(contains(id));
  const FloatingPointEnvironment environment;
  return use_triangle(*state().find(id), triangle,
                      [](const auto& placed) -> Triangle<Scalar> { return detail::exact_corners(placed); });
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Scene<Scalar>::normal(InstanceId id, std::uint32_t triangle) const noexcept {
  assert(contains(id));
  const FloatingPointEnvironment environment;
  return use_triangle(*state().find(id), triangle, [](const auto& placed) -> Vector3<Scalar> {
    return detail::unit_of_cross<Scalar>(detail::exact_cross(placed));
  });
}

template <FloatOrDouble Scalar>
std::optional<SceneHit<Scalar>> Scene<Scalar>::first_hit(const Path<Scalar>& path,
                                                         const SceneQueryOptions<Scalar>& options,
                                                         QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
std::optional<SceneHit<Scalar>> Scene<Scalar>::first_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                                                         const SceneQueryOptions<Scalar>& options,
                                                         QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::any_hit(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options,
                            QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::any_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                            const SceneQueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                             const SceneQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleSceneQuery<Scalar> query(state(), options, nullptr, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                             SceneHitFilter<Scalar> filter, const SceneQueryOptions<Scalar>& options,
                             QueryStatistics* statistics) const {
  const SingleSceneQuery<Scalar> query(state(), options, &filter, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::first_hits(const PathSpan<Scalar>& paths, std::span<SceneHit<Scalar>> hits,
                               const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, hits, options, state().searches->each_first);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                             const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, blocked, options, state().searches->each_any);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Scene<Scalar>::last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                               const SceneQueryOptions<Scalar>& options) const noexcept {
  return find_free_point<Scalar>(state(), segment, hit, options, nullptr);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Scene<Scalar>::last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                               SceneHitFilter<Scalar> filter,
                                               const SceneQueryOptions<Scalar>& options) const noexcept {
  return find_free_point(state(), segment, hit, options, &filter);
}

template struct detail::DeleteSceneState<float>;
template struct detail::DeleteSceneState<double>;
template class Scene<float>;
template class Scene<double>;

}  // namespace surehit
