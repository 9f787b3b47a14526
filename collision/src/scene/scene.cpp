#include "surehit/scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "exact/exact_contact.hpp"
#include "path_range.hpp"
#include "scene/scene_state.hpp"
#include "support/floating_point_environment.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"
#include "unit_of_cross.hpp"

namespace surehit {
namespace {

/// The number of paths in a task of a batch, and of instances in a task of a commit.
constexpr std::size_t paths_in_a_task = 1024;
constexpr std::size_t instances_in_a_task = 1024;

template <typename Scalar>
using State = detail::SceneState<Scalar>;

const Executor* address_of(const std::optional<Executor>& executor) { return executor ? &*executor : nullptr; }

/// Returns the name of an entry of [linear | translation].
std::string name_of_entry(std::size_t row, std::size_t column) {
  return column == 3 ? "translation[" + std::to_string(row) + "]"
                     : "linear(" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

template <typename Scalar>
std::optional<InvalidInstance> find_invalid(const Pose<Scalar>& pose) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      const auto i = static_cast<Eigen::Index>(row);
      const Scalar entry = column == 3 ? pose.translation[i] : pose.linear(i, static_cast<Eigen::Index>(column));
      const auto invalid = [&](InvalidInstance::Reason reason, const char* what) {
        return InvalidInstance(reason, 4 * row + column, "pose: " + name_of_entry(row, column) + " " + what);
      };
      if (!std::isfinite(entry)) return invalid(InvalidInstance::Reason::non_finite_pose, "is not finite");
      const Scalar size = std::fabs(entry);
      if (column < 3 && size != 0 && !(size >= Scalar(0x1p-64) && size <= Scalar(0x1p64))) {
        return invalid(InvalidInstance::Reason::pose_out_of_range, "is neither 0 nor between 2^-64 and 2^64 in size");
      }
    }
  }
  if (detail::is_singular<Scalar>(pose.linear)) {
    return InvalidInstance(InvalidInstance::Reason::singular_pose, 0, "pose: the determinant of linear is 0");
  }
  return std::nullopt;
}

InvalidInstance stale(InstanceId id) {
  return {InvalidInstance::Reason::stale_id, id.index,
          "there is no instance with index " + std::to_string(id.index) + " and generation " +
              std::to_string(id.generation)};
}

/// A query of one path, with what it needs while it runs.
template <typename Scalar>
class SingleQuery {
 public:
  SingleQuery(const State<Scalar>& state, const SceneQueryOptions<Scalar>& options,
              const SceneHitFilter<Scalar>* filter, QueryStatistics* statistics, Scalar share = 1)
      : query_{state.committed, state.tree, options, filter, statistics != nullptr ? *statistics : unread_, 0, share} {}
  [[nodiscard]] const detail::SceneQuery<Scalar>& get() const { return query_; }

 private:
  FloatingPointEnvironment environment_;
  QueryStatistics unread_;  ///< Counts if the caller has no statistics.
  detail::SceneQuery<Scalar> query_;
};

/// Answers a batch in parts, in tasks of the executor. `ask(query, path, index)` answers one path.
template <typename Scalar, typename Ask>
void answer_batch(const State<Scalar>& state, const PathSpan<Scalar>& paths, std::size_t answers,
                  const SceneBatchOptions<Scalar>& options, const Ask& ask) noexcept {
  const bool has_own_options = !options.path_options.empty();
  const std::size_t count =
      std::min({paths.size(), answers, has_own_options ? options.path_options.size() : paths.size()});
  if (count == 0) return;
  const SceneHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  std::mutex mutex;
  detail::in_parts(address_of(options.executor), count, paths_in_a_task, [&](std::size_t first, std::size_t last) {
    QueryStatistics statistics;
    for (std::size_t i = first; i < last; ++i) {
      const detail::SceneQuery<Scalar> query{
          state.committed, state.tree, has_own_options ? options.path_options[i] : options.options,
          filter,          statistics, i};
      ask(query, paths[i], i);
    }
    if (options.statistics == nullptr) return;
    const std::lock_guard lock(mutex);
    *options.statistics += statistics;
  });
}

/// Does what `find_free_point` of a collider does. The instances go the same share of their ways as the point.
template <typename Scalar>
[[gnu::noinline]] Vector3<Scalar> find_free_point(const State<Scalar>& state, const Segment<Scalar>& segment,
                                                  const SceneHit<Scalar>& hit, const SceneQueryOptions<Scalar>& options,
                                                  const SceneHitFilter<Scalar>* filter) noexcept {
  const FloatingPointEnvironment environment;
  const Path<Scalar> path = segment;
  if (!detail::is_finite(path) || !std::isfinite(hit.t)) return segment.start;
  const Scalar ulp = std::nextafter(hit.t, std::numeric_limits<Scalar>::infinity()) - hit.t;
  for (Scalar back = ulp; hit.t - back > 0; back *= 2) {
    const Scalar s = hit.t - back;
    const Segment<Scalar> free{segment.start, detail::exact_point(path, s)};
    SceneQueryOptions<Scalar> shortened = options;
    shortened.max_t = std::isnan(options.max_t) ? options.max_t : std::numeric_limits<Scalar>::infinity();
    if (options.min_t > 0) shortened.min_t = std::nextafter(options.min_t / s, Scalar{0});
    const SingleQuery<Scalar> query(state, shortened, filter, nullptr, s);
    if (!state.searches->any(query.get(), free)) return free.end;
  }
  return segment.start;
}

}  // namespace

template <FloatOrDouble Scalar>
void detail::DeleteSceneState<Scalar>::operator()(State<Scalar>* state) const noexcept {
  delete state;
}

template <FloatOrDouble Scalar>
const State<Scalar>& Scene<Scalar>::state() const noexcept {
  if (state_) return *state_;
  // It is never destroyed, because a scene may be asked until the program ends.
  alignas(State<Scalar>) static std::byte memory[sizeof(State<Scalar>)];
  static const State<Scalar>& empty = *new (memory) State<Scalar>;
  return empty;
}

template <FloatOrDouble Scalar>
InstanceResult Scene<Scalar>::add_instance(ColliderPointer collider,
                                           std::shared_ptr<const Collider<float>> float_collider,
                                           const Pose<Scalar>& pose, const InstanceOptions& options) {
  const FloatingPointEnvironment environment;
  if (!collider && !float_collider) {
    return InvalidInstance(InvalidInstance::Reason::no_collider, 0, "the pointer to the collider is null");
  }
  if (std::optional<InvalidInstance> invalid = find_invalid(pose)) return *std::move(invalid);
  if (!state_) state_ = StatePointer(new State<Scalar>);
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
  if (std::optional<InvalidInstance> invalid = find_invalid(pose)) return *std::move(invalid);
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
void detail::SceneState<Scalar>::commit(const Executor* executor) {
  // A collider that was rebuilt is a change too. There is room for all indices.
  for (std::uint32_t index = 0; index < committed.size(); ++index) {
    if (!pending[index].is_there || pending[index].has_changed) continue;
    if (pending[index].mesh().version != committed[index].mesh.version) note_change(index);
  }
  if (changed.empty()) return;

  // All that may throw comes first.
  std::vector<CommittedInstance<Scalar>> made(changed.size());
  in_parts(executor, changed.size(), instances_in_a_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const PendingInstance<Scalar>& instance = pending[changed[i]];
      CommittedInstance<Scalar>& of = made[i];
      of.generation = instance.generation;
      if (!instance.is_there) continue;
      of.mask = instance.options.mask;
      of.mesh = instance.mesh();
      of.placed.placement = instance.placement;
      const auto set_frame = [&](const auto& box) {
        of.is_in_tree = !box.is_empty();
        if (!of.is_in_tree) return;
        const Box<double> mesh_box{box.low.template cast<double>(), box.high.template cast<double>()};
        of.placed.frame = InstanceFrame::of(of.placed.placement, mesh_box);
      };
      of.mesh.own != nullptr ? set_frame(of.mesh.own->box) : set_frame(of.mesh.floats->box);
    }
  });
  bool is_same_tree = !tree.is_worn();
  for (std::size_t i = 0; i < changed.size() && is_same_tree; ++i) {
    const bool was_in_tree = changed[i] < committed.size() && committed[changed[i]].is_in_tree;
    is_same_tree = was_in_tree == made[i].is_in_tree;
  }
  committed.reserve(pending.capacity());
  std::vector<InstanceBox> new_boxes;
  new_boxes.reserve(pending.capacity());
  new_boxes = boxes;
  new_boxes.resize(pending.size());
  for (std::size_t i = 0; i < changed.size(); ++i) {
    new_boxes[changed[i]] = {made[i].placed.frame.low, made[i].placed.frame.high};
  }
  InstanceTree new_tree;
  if (!is_same_tree) {
    std::vector<std::uint8_t> is_in_tree(pending.size(), 0);
    for (std::size_t i = 0; i < committed.size(); ++i) is_in_tree[i] = committed[i].is_in_tree ? 1 : 0;
    for (std::size_t i = 0; i < changed.size(); ++i) is_in_tree[changed[i]] = made[i].is_in_tree ? 1 : 0;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < is_in_tree.size(); ++i) {
      if (is_in_tree[i] != 0) indices.push_back(i);
    }
    new_tree.build(indices, new_boxes);
  }

  // Nothing below throws.
  committed.resize(pending.size());
  for (std::size_t i = 0; i < changed.size(); ++i) committed[changed[i]] = made[i];
  boxes.swap(new_boxes);
  if (is_same_tree) {
    tree.refit(boxes);
  } else {
    tree = std::move(new_tree);
  }
  for (const std::uint32_t index : changed) {
    PendingInstance<Scalar>& instance = pending[index];
    instance.has_changed = false;
    if (instance.is_there || (!instance.collider && !instance.float_collider)) continue;
    instance.collider.reset();
    instance.float_collider.reset();
    // An index whose generations are used up is not used again.
    if (instance.generation != std::numeric_limits<std::uint32_t>::max()) unused.push_back(index);
  }
  changed.clear();
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::commit(const std::optional<Executor>& executor) {
  const FloatingPointEnvironment environment;
  if (state_) state_->commit(address_of(executor));
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
  const State<Scalar>& of = *state_;
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
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
std::optional<SceneHit<Scalar>> Scene<Scalar>::first_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                                                         const SceneQueryOptions<Scalar>& options,
                                                         QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::any_hit(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options,
                            QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
bool Scene<Scalar>::any_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                            const SceneQueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  return state().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                             const SceneQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, nullptr, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                             SceneHitFilter<Scalar> filter, const SceneQueryOptions<Scalar>& options,
                             QueryStatistics* statistics) const {
  const SingleQuery<Scalar> query(state(), options, &filter, statistics);
  hits.clear();
  state().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::first_hits(const PathSpan<Scalar>& paths, std::span<SceneHit<Scalar>> hits,
                               const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, hits.size(), options, [&](const auto& query, const Path<Scalar>& path, std::size_t i) {
    hits[i] = state().searches->first(query, path).value_or(SceneHit<Scalar>{});
  });
}

template <FloatOrDouble Scalar>
void Scene<Scalar>::any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                             const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), paths, blocked.size(), options,
               [&](const auto& query, const Path<Scalar>& path, std::size_t i) {
                 blocked[i] = state().searches->any(query, path) ? 1 : 0;
               });
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

template struct SUREHIT_API detail::DeleteSceneState<float>;
template struct SUREHIT_API detail::DeleteSceneState<double>;
template class SUREHIT_API Scene<float>;
template class SUREHIT_API Scene<double>;

}  // namespace surehit
