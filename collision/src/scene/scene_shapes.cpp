#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "query/answer_batch.hpp"
#include "scene/committed_scene.hpp"
#include "scene/instance_triangle.hpp"
#include "scene/scene_shape_query.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/free_centre.hpp"
#include "shape/overlap.hpp"
#include "shape/sphere_contact.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/scene_queries.hpp"

// The queries of a scene that take moving shapes.

namespace surehit {
namespace {

/// The number of shapes in a task of a batch.
constexpr std::size_t scene_shapes_in_a_task = 256;

/// Calls `search(query, shape)` with the query of one shape, in the floating-point environment of the library.
template <typename Scalar, typename Search>
decltype(auto) ask_scene(const detail::CommittedScene<Scalar>& scene, const SweptShape<Scalar>& shape,
                         const SceneShapeQueryOptions<Scalar>& options, const SceneShapeHitFilter<Scalar>* filter,
                         QueryStatistics* statistics, const Search& search, Scalar share = 1) {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  const detail::SceneShapeQuery<Scalar> query{
      scene.instances, scene.tree, options, filter, statistics != nullptr ? *statistics : unread, 0, share};
  return std::visit([&](const auto& any) { return search(query, any); }, shape);
}

constexpr auto search_scene_first = [](const auto& query, const auto& shape) {
  return detail::search_first(query, shape);
};
constexpr auto search_scene_any = [](const auto& query, const auto& shape) { return detail::search_any(query, shape); };

/// Answers a batch. `search(query, shape, index)` answers one shape.
template <typename Scalar, typename Search>
void ask_scene_batch(const detail::CommittedScene<Scalar>& scene, const SweptShapeSpan<Scalar>& shapes,
                     std::size_t answers, const SceneShapeBatchOptions<Scalar>& options,
                     const Search& search) noexcept {
  const SceneShapeHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_all = [&](const auto& all) {
    const auto ask_part = [&](std::size_t first, std::size_t last, auto own_options, QueryStatistics& statistics) {
      const FloatingPointEnvironment environment;
      for (std::size_t i = first; i < last; ++i) {
        const SceneShapeQueryOptions<Scalar>& of_shape = own_options.empty() ? options.options : own_options[i - first];
        search(detail::SceneShapeQuery<Scalar>{scene.instances, scene.tree, of_shape, filter, statistics, i}, all[i],
               i);
      }
    };
    detail::answer_batch(std::min(all.size(), answers), options, scene_shapes_in_a_task, ask_part);
  };
  std::visit(ask_all, shapes);
}

/// Returns where the centre of a shape may stop in front of a hit. The instances go the same share of their ways.
template <typename Scalar>
Vector3<Scalar> find_free_centre_in_scene(const detail::CommittedScene<Scalar>& scene, const SweptShape<Scalar>& shape,
                                          const SceneShapeHit<Scalar>& hit,
                                          const SceneShapeQueryOptions<Scalar>& options,
                                          const SceneShapeHitFilter<Scalar>* filter, Scalar* share) noexcept {
  Scalar free_share = 0;
  const Vector3<Scalar> centre = detail::find_free_centre(
      shape, hit.t, options,
      [&](const SweptShape<Scalar>& shorter, const SceneShapeQueryOptions<Scalar>& shortened, Scalar s) {
        const bool is_blocked = ask_scene<Scalar>(scene, shorter, shortened, filter, nullptr, search_scene_any, s);
        if (!is_blocked) free_share = s;
        return is_blocked;
      },
      true);
  if (share != nullptr) *share = free_share;
  return centre;
}

}  // namespace

template <FloatOrDouble Scalar>
std::optional<SceneShapeHit<Scalar>> SceneQueries<Scalar>::first_hit(const SweptShape<Scalar>& shape,
                                                                     const SceneShapeQueryOptions<Scalar>& options,
                                                                     QueryStatistics* statistics) const noexcept {
  return ask_scene<Scalar>(committed(), shape, options, nullptr, statistics, search_scene_first);
}

template <FloatOrDouble Scalar>
std::optional<SceneShapeHit<Scalar>> SceneQueries<Scalar>::first_hit(const SweptShape<Scalar>& shape,
                                                                     SceneShapeHitFilter<Scalar> filter,
                                                                     const SceneShapeQueryOptions<Scalar>& options,
                                                                     QueryStatistics* statistics) const noexcept {
  return ask_scene<Scalar>(committed(), shape, options, &filter, statistics, search_scene_first);
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::any_hit(const SweptShape<Scalar>& shape, const SceneShapeQueryOptions<Scalar>& options,
                                   QueryStatistics* statistics) const noexcept {
  return ask_scene<Scalar>(committed(), shape, options, nullptr, statistics, search_scene_any);
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::any_hit(const SweptShape<Scalar>& shape, SceneShapeHitFilter<Scalar> filter,
                                   const SceneShapeQueryOptions<Scalar>& options,
                                   QueryStatistics* statistics) const noexcept {
  return ask_scene<Scalar>(committed(), shape, options, &filter, statistics, search_scene_any);
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::overlaps(const SweptShape<Scalar>& shape, const SceneShapeQueryOptions<Scalar>& options,
                                    QueryStatistics* statistics) const noexcept {
  return detail::overlaps_anything(shape, options, [&](const auto& resting, const auto& at_start) {
    return any_hit(resting, at_start, statistics);
  });
}

template <FloatOrDouble Scalar>
bool SceneQueries<Scalar>::overlaps(const SweptShape<Scalar>& shape, SceneShapeHitFilter<Scalar> filter,
                                    const SceneShapeQueryOptions<Scalar>& options,
                                    QueryStatistics* statistics) const noexcept {
  return detail::overlaps_anything(shape, options, [&](const auto& resting, const auto& at_start) {
    return any_hit(resting, filter, at_start, statistics);
  });
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::all_hits(const SweptShape<Scalar>& shape, std::vector<SceneShapeHit<Scalar>>& hits,
                                    const SceneShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  hits.clear();
  ask_scene<Scalar>(committed(), shape, options, nullptr, statistics,
                    [&](const auto& query, const auto& any) { detail::search_all(query, any, hits); });
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::all_hits(const SweptShape<Scalar>& shape, std::vector<SceneShapeHit<Scalar>>& hits,
                                    SceneShapeHitFilter<Scalar> filter, const SceneShapeQueryOptions<Scalar>& options,
                                    QueryStatistics* statistics) const {
  hits.clear();
  ask_scene<Scalar>(committed(), shape, options, &filter, statistics,
                    [&](const auto& query, const auto& any) { detail::search_all(query, any, hits); });
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::first_hits(const SweptShapeSpan<Scalar>& shapes, std::span<SceneShapeHit<Scalar>> hits,
                                      const SceneShapeBatchOptions<Scalar>& options) const noexcept {
  ask_scene_batch<Scalar>(committed(), shapes, hits.size(), options,
                          [&](const auto& query, const auto& shape, std::size_t i) {
                            hits[i] = detail::search_first(query, shape).value_or(SceneShapeHit<Scalar>{});
                          });
}

template <FloatOrDouble Scalar>
void SceneQueries<Scalar>::any_hits(const SweptShapeSpan<Scalar>& shapes, std::span<std::uint8_t> blocked,
                                    const SceneShapeBatchOptions<Scalar>& options) const noexcept {
  ask_scene_batch<Scalar>(committed(), shapes, blocked.size(), options,
                          [&](const auto& query, const auto& shape, std::size_t i) {
                            blocked[i] = detail::search_any(query, shape) ? 1 : 0;
                          });
}

template <FloatOrDouble Scalar>
Scalar SceneQueries<Scalar>::last_free_t(const SweptShape<Scalar>& shape,
                                         const SceneShapeHit<Scalar>& hit) const noexcept {
  const FloatingPointEnvironment environment;
  if (hit.started_touching || !(hit.t > 0)) return 0;
  const auto* const instance = detail::instance_of(committed(), hit);
  if (instance == nullptr) return 0;
  const bool is_touched =
      std::visit([&](const auto& any) { return detail::touches(*instance, hit.triangle, any, hit.t); }, shape);
  return is_touched ? std::nextafter(hit.t, Scalar{0}) : hit.t;
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::last_free_point(const SweptShape<Scalar>& shape, const SceneShapeHit<Scalar>& hit,
                                                      const SceneShapeQueryOptions<Scalar>& options,
                                                      Scalar* share) const noexcept {
  return find_free_centre_in_scene<Scalar>(committed(), shape, hit, options, nullptr, share);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> SceneQueries<Scalar>::last_free_point(const SweptShape<Scalar>& shape, const SceneShapeHit<Scalar>& hit,
                                                      SceneShapeHitFilter<Scalar> filter,
                                                      const SceneShapeQueryOptions<Scalar>& options,
                                                      Scalar* share) const noexcept {
  return find_free_centre_in_scene(committed(), shape, hit, options, &filter, share);
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                    \
  template std::optional<SceneShapeHit<Scalar>> SceneQueries<Scalar>::first_hit(                                       \
      const SweptShape<Scalar>&, const SceneShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;              \
  template std::optional<SceneShapeHit<Scalar>> SceneQueries<Scalar>::first_hit(                                       \
      const SweptShape<Scalar>&, SceneShapeHitFilter<Scalar>, const SceneShapeQueryOptions<Scalar>&, QueryStatistics*) \
      const noexcept;                                                                                                  \
  template bool SceneQueries<Scalar>::any_hit(const SweptShape<Scalar>&, const SceneShapeQueryOptions<Scalar>&,        \
                                              QueryStatistics*) const noexcept;                                        \
  template bool SceneQueries<Scalar>::any_hit(const SweptShape<Scalar>&, SceneShapeHitFilter<Scalar>,                  \
                                              const SceneShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept; \
  template bool SceneQueries<Scalar>::overlaps(const SweptShape<Scalar>&, const SceneShapeQueryOptions<Scalar>&,       \
                                               QueryStatistics*) const noexcept;                                       \
  template bool SceneQueries<Scalar>::overlaps(const SweptShape<Scalar>&, SceneShapeHitFilter<Scalar>,                 \
                                               const SceneShapeQueryOptions<Scalar>&, QueryStatistics*)                \
      const noexcept;                                                                                                  \
  template void SceneQueries<Scalar>::all_hits(const SweptShape<Scalar>&, std::vector<SceneShapeHit<Scalar>>&,         \
                                               const SceneShapeQueryOptions<Scalar>&, QueryStatistics*) const;         \
  template void SceneQueries<Scalar>::all_hits(const SweptShape<Scalar>&, std::vector<SceneShapeHit<Scalar>>&,         \
                                               SceneShapeHitFilter<Scalar>, const SceneShapeQueryOptions<Scalar>&,     \
                                               QueryStatistics*) const;                                                \
  template void SceneQueries<Scalar>::first_hits(const SweptShapeSpan<Scalar>&, std::span<SceneShapeHit<Scalar>>,      \
                                                 const SceneShapeBatchOptions<Scalar>&) const noexcept;                \
  template void SceneQueries<Scalar>::any_hits(const SweptShapeSpan<Scalar>&, std::span<std::uint8_t>,                 \
                                               const SceneShapeBatchOptions<Scalar>&) const noexcept;                  \
  template Scalar SceneQueries<Scalar>::last_free_t(const SweptShape<Scalar>&, const SceneShapeHit<Scalar>&)           \
      const noexcept;                                                                                                  \
  template Vector3<Scalar> SceneQueries<Scalar>::last_free_point(                                                      \
      const SweptShape<Scalar>&, const SceneShapeHit<Scalar>&, const SceneShapeQueryOptions<Scalar>&, Scalar*)         \
      const noexcept;                                                                                                  \
  template Vector3<Scalar> SceneQueries<Scalar>::last_free_point(                                                      \
      const SweptShape<Scalar>&, const SceneShapeHit<Scalar>&, SceneShapeHitFilter<Scalar>,                            \
      const SceneShapeQueryOptions<Scalar>&, Scalar*) const noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
