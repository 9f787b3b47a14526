#include "surehit/scene_queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/answer_batch.hpp"
#include "query/free_point.hpp"
#include "scene/committed_scene.hpp"
#include "scene/instance_in_place.hpp"
#include "scene/scene_query.hpp"
#include "support/floating_point_environment.hpp"
#include "support/never_destroyed.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

/// The number of paths in a task of a batch. Paths of a scene take longer than those of a collider.
constexpr std::size_t scene_paths_in_a_task = 1024;

/// A query of one path, with what it needs while it runs.
template <typename Scalar>
class SingleSceneQuery {
 public:
  SingleSceneQuery(const detail::CommittedScene<Scalar>& scene, const SceneQueryOptions<Scalar>& options,
                   const SceneHitFilter<Scalar>* filter, QueryStatistics* statistics, Scalar share = 1)
      : query_{scene.instances, scene.tree, options, filter, statistics != nullptr ? *statistics : unread_, 0, share} {}
  [[nodiscard]] const detail::SceneQuery<Scalar>& get() const { return query_; }

 private:
  FloatingPointEnvironment environment_;
  QueryStatistics unread_;  ///< Counts if the caller has no statistics.
  detail::SceneQuery<Scalar> query_;
};

/// Answers a batch in parts. `search` is one of the searches for batches.
template <typename Scalar, typename Answer, typename Search>
void answer_batch(const detail::CommittedScene<Scalar>& scene, const PathSpan<Scalar>& paths, std::span<Answer> answers,
                  const SceneBatchOptions<Scalar>& options, const Search& search) noexcept {
  const SceneHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_part = [&](std::size_t first, std::size_t last, std::span<const SceneQueryOptions<Scalar>> own_options,
                            QueryStatistics& statistics) {
    const FloatingPointEnvironment environment;
    const detail::SceneQuery<Scalar> part{scene.instances, scene.tree, options.options, filter, statistics, first};
    const PathSpan<Scalar> some = paths.subspan(first, last - first);
    if (own_options.empty() && detail::InstanceInPlace<Scalar>::answers(part)) {
      detail::InstanceInPlace<Scalar>(part).each(some, answers.subspan(first, some.size()));
    } else {
      search(part, some, own_options, answers.subspan(first, some.size()));
    }
  };
  detail::answer_batch(std::min(paths.size(), answers.size()), options, scene_paths_in_a_task, ask_part);
}

/// The instances go the same share of their ways as the point.
template <typename Scalar>
Vector3<Scalar> find_free_point(const detail::CommittedScene<Scalar>& scene, const Segment<Scalar>& segment,
                                const SceneHit<Scalar>& hit, const SceneQueryOptions<Scalar>& options,
                                const SceneHitFilter<Scalar>* filter, Scalar* share) noexcept {
  Scalar free_share = 0;
  const auto is_blocked = [&](const Path<Scalar>& path, const SceneQueryOptions<Scalar>& shortened, Scalar s) {
    const SingleSceneQuery<Scalar> query(scene, shortened, filter, nullptr, s);
    if (scene.searches->any(query.get(), path)) return true;
    free_share = s;
    return false;
  };
  const Vector3<Scalar> point = detail::find_free_point(segment, hit.t, options, is_blocked, true);
  if (share != nullptr) *share = free_share;
  return point;
}

}  // namespace

template <FloatOrDouble Scalar>
const detail::CommittedScene<Scalar>& SceneQueries<Scalar>::committed() const noexcept {
  const detail::CommittedScene<Scalar>* const committed = committed_.get();
  return committed != nullptr ? *committed : detail::never_destroyed<detail::CommittedScene<Scalar>>();
}

template <FloatOrDouble Scalar>
Box<Scalar> SceneQueries<Scalar>::box() const noexcept {
  const FloatingPointEnvironment environment;
  Box<Scalar> box;
  const detail::InstanceTree& tree = committed().tree;
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
std::optional<SceneHit<Scalar>> SceneQueries<Scalar>::first_hit(const Path<Scalar>& path,
                                                                const SceneQueryOptions<Scalar>& options,
                                                                QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(committed(), options, nullptr, statistics);
  using InPlace = detail::InstanceInPlace<Scalar>;
  if (InPlace::answers(query.get())) return InPlace(query.get()).first(path);
  return committed().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
std::optional<SceneHit<Scalar>> SceneQueries<Scalar>::first_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                                                                const SceneQueryOptions<Scalar>& options,
                                                                QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(committed(), options, &filter, statistics);
  return committed().searches->first(query.get(), path);
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::any_hit(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options,
                                   QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(committed(), options, nullptr, statistics);
  using InPlace = detail::InstanceInPlace<Scalar>;
  if (InPlace::answers(query.get())) return InPlace(query.get()).any(path);
  return committed().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::any_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                                   const SceneQueryOptions<Scalar>& options,
                                   QueryStatistics* statistics) const noexcept {
  const SingleSceneQuery<Scalar> query(committed(), options, &filter, statistics);
  return committed().searches->any(query.get(), path);
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                                    const SceneQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  const SingleSceneQuery<Scalar> query(committed(), options, nullptr, statistics);
  hits.clear();
  committed().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                                    SceneHitFilter<Scalar> filter, const SceneQueryOptions<Scalar>& options,
                                    QueryStatistics* statistics) const {
  const SingleSceneQuery<Scalar> query(committed(), options, &filter, statistics);
  hits.clear();
  committed().searches->all(query.get(), path, hits);
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::first_hits(const PathSpan<Scalar>& paths, std::span<SceneHit<Scalar>> hits,
                                      const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(committed(), paths, hits, options, committed().searches->each_first);
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                                    const SceneBatchOptions<Scalar>& options) const noexcept {
  answer_batch(committed(), paths, blocked, options, committed().searches->each_any);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                      const SceneQueryOptions<Scalar>& options,
                                                      Scalar* share) const noexcept {
  return find_free_point<Scalar>(committed(), segment, hit, options, nullptr, share);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                      SceneHitFilter<Scalar> filter,
                                                      const SceneQueryOptions<Scalar>& options,
                                                      Scalar* share) const noexcept {
  return find_free_point(committed(), segment, hit, options, &filter, share);
}

template class SceneQueries<float>;
template class SceneQueries<double>;

}  // namespace surehit
