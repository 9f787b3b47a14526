#include <algorithm>
#include <cmath>
#include <cstddef>

#include "collider_state.hpp"
#include "query/answer_batch.hpp"
#include "shape/sphere_query.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

// The functions of a collider that take moving balls.

namespace surehit {
namespace {

/// The number of balls in a task of a batch.
constexpr std::size_t spheres_in_a_task = 512;

/// Calls `ask` with the query of one ball, in the floating-point environment of the library.
template <typename Scalar, typename Ask>
decltype(auto) with_query(const detail::ColliderState<Scalar>& state, const ShapeQueryOptions<Scalar>& options,
                          const ShapeHitFilter<Scalar>* filter, QueryStatistics* statistics, const Ask& ask) {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  return ask(detail::SphereQuery<Scalar>{state.grid, state.mesh, state.masks, options, filter,
                                         statistics != nullptr ? *statistics : unread, 0});
}

/// Answers a batch. `ask(query, index)` answers one ball.
template <typename Scalar, typename Ask>
void answer_batch(const detail::ColliderState<Scalar>& state, std::size_t count,
                  const ShapeBatchOptions<Scalar>& options, const Ask& ask) noexcept {
  const ShapeHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_part = [&](std::size_t first, std::size_t last, auto own_options, QueryStatistics& statistics) {
    const FloatingPointEnvironment environment;
    for (std::size_t i = first; i < last; ++i) {
      const ShapeQueryOptions<Scalar>& of_ball = own_options.empty() ? options.options : own_options[i - first];
      ask(detail::SphereQuery<Scalar>{state.grid, state.mesh, state.masks, of_ball, filter, statistics, i}, i);
    }
  };
  detail::answer_batch(count, options, spheres_in_a_task, ask_part);
}

}  // namespace

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(const SweptSphere<Scalar>& sphere,
                                                            const ShapeQueryOptions<Scalar>& options,
                                                            QueryStatistics* statistics) const noexcept {
  return with_query<Scalar>(state(), options, nullptr, statistics,
                            [&](const auto& query) { return detail::search_first(query, sphere); });
}

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(const SweptSphere<Scalar>& sphere,
                                                            ShapeHitFilter<Scalar> filter,
                                                            const ShapeQueryOptions<Scalar>& options,
                                                            QueryStatistics* statistics) const noexcept {
  return with_query<Scalar>(state(), options, &filter, statistics,
                            [&](const auto& query) { return detail::search_first(query, sphere); });
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const SweptSphere<Scalar>& sphere, const ShapeQueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  return with_query<Scalar>(state(), options, nullptr, statistics,
                            [&](const auto& query) { return detail::search_any(query, sphere); });
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const SweptSphere<Scalar>& sphere, ShapeHitFilter<Scalar> filter,
                               const ShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  return with_query<Scalar>(state(), options, &filter, statistics,
                            [&](const auto& query) { return detail::search_any(query, sphere); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const SweptSphere<Scalar>& sphere, std::vector<ShapeHit<Scalar>>& hits,
                                const ShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  hits.clear();
  with_query<Scalar>(state(), options, nullptr, statistics,
                     [&](const auto& query) { detail::search_all(query, sphere, hits); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const SweptSphere<Scalar>& sphere, std::vector<ShapeHit<Scalar>>& hits,
                                ShapeHitFilter<Scalar> filter, const ShapeQueryOptions<Scalar>& options,
                                QueryStatistics* statistics) const {
  hits.clear();
  with_query<Scalar>(state(), options, &filter, statistics,
                     [&](const auto& query) { detail::search_all(query, sphere, hits); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::first_hits(std::span<const SweptSphere<Scalar>> spheres, std::span<ShapeHit<Scalar>> hits,
                                  const ShapeBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), std::min(spheres.size(), hits.size()), options, [&](const auto& query, std::size_t i) {
    hits[i] = detail::search_first(query, spheres[i]).value_or(ShapeHit<Scalar>{});
  });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::any_hits(std::span<const SweptSphere<Scalar>> spheres, std::span<std::uint8_t> blocked,
                                const ShapeBatchOptions<Scalar>& options) const noexcept {
  answer_batch(state(), std::min(spheres.size(), blocked.size()), options,
               [&](const auto& query, std::size_t i) { blocked[i] = detail::search_any(query, spheres[i]) ? 1 : 0; });
}

template <FloatOrDouble Scalar>
Scalar Collider<Scalar>::last_free_t(const SweptSphere<Scalar>& sphere, const ShapeHit<Scalar>& hit) const noexcept {
  const FloatingPointEnvironment environment;
  if (hit.started_touching || !(hit.t > 0)) return 0;
  const bool is_touched = surehit::intersect(sphere, triangle(hit.triangle), {.max_t = hit.t}).has_value();
  return is_touched ? std::nextafter(hit.t, Scalar{0}) : hit.t;
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                    \
  template std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(                                                \
      const SweptSphere<Scalar>&, const ShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;                  \
  template std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(                                                \
      const SweptSphere<Scalar>&, ShapeHitFilter<Scalar>, const ShapeQueryOptions<Scalar>&, QueryStatistics*)          \
      const noexcept;                                                                                                  \
  template bool Collider<Scalar>::any_hit(const SweptSphere<Scalar>&, const ShapeQueryOptions<Scalar>&,                \
                                          QueryStatistics*) const noexcept;                                            \
  template bool Collider<Scalar>::any_hit(const SweptSphere<Scalar>&, ShapeHitFilter<Scalar>,                          \
                                          const ShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;          \
  template void Collider<Scalar>::all_hits(const SweptSphere<Scalar>&, std::vector<ShapeHit<Scalar>>&,                 \
                                           const ShapeQueryOptions<Scalar>&, QueryStatistics*) const;                  \
  template void Collider<Scalar>::all_hits(const SweptSphere<Scalar>&, std::vector<ShapeHit<Scalar>>&,                 \
                                           ShapeHitFilter<Scalar>, const ShapeQueryOptions<Scalar>&, QueryStatistics*) \
      const;                                                                                                           \
  template void Collider<Scalar>::first_hits(std::span<const SweptSphere<Scalar>>, std::span<ShapeHit<Scalar>>,        \
                                             const ShapeBatchOptions<Scalar>&) const noexcept;                         \
  template void Collider<Scalar>::any_hits(std::span<const SweptSphere<Scalar>>, std::span<std::uint8_t>,              \
                                           const ShapeBatchOptions<Scalar>&) const noexcept;                           \
  template Scalar Collider<Scalar>::last_free_t(const SweptSphere<Scalar>&, const ShapeHit<Scalar>&) const noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
