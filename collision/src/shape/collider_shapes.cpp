#include <algorithm>
#include <cmath>
#include <cstddef>

#include "collider_state.hpp"
#include "query/answer_batch.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/free_centre.hpp"
#include "shape/overlap.hpp"
#include "shape/shape_batch.hpp"
#include "shape/shape_query.hpp"
#include "shape/sphere_contact.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

// The functions of a collider that take moving shapes.

namespace surehit {
namespace {

/// The number of shapes in a task of a batch.
constexpr std::size_t shapes_in_a_task = 512;

/// Calls `search(query, shape)` with the query of one shape, in the floating-point environment of the library.
template <typename Scalar, typename Search>
decltype(auto) ask(const detail::ColliderState<Scalar>& state, const SweptShape<Scalar>& shape,
                   const ShapeQueryOptions<Scalar>& options, const ShapeHitFilter<Scalar>* filter,
                   QueryStatistics* statistics, const Search& search) {
  const FloatingPointEnvironment environment;
  QueryStatistics unread;
  const detail::ShapeQuery<Scalar> query{
      state.grid, state.mesh, state.masks, options, filter, statistics != nullptr ? *statistics : unread, 0};
  return std::visit([&](const auto& any) { return search(query, any); }, shape);
}

constexpr auto search_first = [](const auto& query, const auto& shape) { return detail::search_first(query, shape); };
constexpr auto search_any = [](const auto& query, const auto& shape) { return detail::search_any(query, shape); };

/// Answers a batch. `search(part, answers)` answers a part of it.
template <typename Scalar, typename Answer, typename Search>
void ask_batch(const detail::ColliderState<Scalar>& state, const SweptShapeSpan<Scalar>& shapes,
               std::span<Answer> answers, const ShapeBatchOptions<Scalar>& options, const Search& search) noexcept {
  const ShapeHitFilter<Scalar>* const filter = options.filter ? &*options.filter : nullptr;
  const auto ask_all = [&]<typename Shape>(std::span<const Shape> all) {
    const auto ask_part = [&](std::size_t first, std::size_t last, auto own_options, QueryStatistics& statistics) {
      const FloatingPointEnvironment environment;
      search(detail::ShapeBatch<Shape>{state.grid, state.mesh, state.masks, options.options, own_options, filter,
                                       statistics, first, all.subspan(first, last - first)},
             answers.subspan(first, last - first));
    };
    detail::answer_batch(std::min(all.size(), answers.size()), options, shapes_in_a_task, ask_part);
  };
  std::visit(ask_all, shapes);
}

/// Returns where the centre of a shape may stop in front of a hit.
template <typename Scalar>
Vector3<Scalar> find_free_centre(const detail::ColliderState<Scalar>& state, const SweptShape<Scalar>& shape,
                                 const ShapeHit<Scalar>& hit, const ShapeQueryOptions<Scalar>& options,
                                 const ShapeHitFilter<Scalar>* filter) noexcept {
  return detail::find_free_centre(
      shape, hit.t, options,
      [&](const SweptShape<Scalar>& shorter, const ShapeQueryOptions<Scalar>& shortened, Scalar /*s*/) {
        return ask<Scalar>(state, shorter, shortened, filter, nullptr, search_any);
      },
      false);
}

}  // namespace

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(const SweptShape<Scalar>& shape,
                                                            const ShapeQueryOptions<Scalar>& options,
                                                            QueryStatistics* statistics) const noexcept {
  return ask<Scalar>(state(), shape, options, nullptr, statistics, search_first);
}

template <FloatOrDouble Scalar>
std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(const SweptShape<Scalar>& shape,
                                                            ShapeHitFilter<Scalar> filter,
                                                            const ShapeQueryOptions<Scalar>& options,
                                                            QueryStatistics* statistics) const noexcept {
  return ask<Scalar>(state(), shape, options, &filter, statistics, search_first);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const SweptShape<Scalar>& shape, const ShapeQueryOptions<Scalar>& options,
                               QueryStatistics* statistics) const noexcept {
  return ask<Scalar>(state(), shape, options, nullptr, statistics, search_any);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::any_hit(const SweptShape<Scalar>& shape, ShapeHitFilter<Scalar> filter,
                               const ShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  return ask<Scalar>(state(), shape, options, &filter, statistics, search_any);
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::overlaps(const SweptShape<Scalar>& shape, const ShapeQueryOptions<Scalar>& options,
                                QueryStatistics* statistics) const noexcept {
  return detail::overlaps_anything(shape, options, [&](const auto& resting, const auto& at_start) {
    return any_hit(resting, at_start, statistics);
  });
}

template <FloatOrDouble Scalar>
bool Collider<Scalar>::overlaps(const SweptShape<Scalar>& shape, ShapeHitFilter<Scalar> filter,
                                const ShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  return detail::overlaps_anything(shape, options, [&](const auto& resting, const auto& at_start) {
    return any_hit(resting, filter, at_start, statistics);
  });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const SweptShape<Scalar>& shape, std::vector<ShapeHit<Scalar>>& hits,
                                const ShapeQueryOptions<Scalar>& options, QueryStatistics* statistics) const {
  hits.clear();
  ask<Scalar>(state(), shape, options, nullptr, statistics,
              [&](const auto& query, const auto& any) { detail::search_all(query, any, hits); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::all_hits(const SweptShape<Scalar>& shape, std::vector<ShapeHit<Scalar>>& hits,
                                ShapeHitFilter<Scalar> filter, const ShapeQueryOptions<Scalar>& options,
                                QueryStatistics* statistics) const {
  hits.clear();
  ask<Scalar>(state(), shape, options, &filter, statistics,
              [&](const auto& query, const auto& any) { detail::search_all(query, any, hits); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::first_hits(const SweptShapeSpan<Scalar>& shapes, std::span<ShapeHit<Scalar>> hits,
                                  const ShapeBatchOptions<Scalar>& options) const noexcept {
  ask_batch<Scalar>(state(), shapes, hits, options,
                    [](const auto& part, auto of_part) { detail::search_first(part, of_part); });
}

template <FloatOrDouble Scalar>
void Collider<Scalar>::any_hits(const SweptShapeSpan<Scalar>& shapes, std::span<std::uint8_t> blocked,
                                const ShapeBatchOptions<Scalar>& options) const noexcept {
  ask_batch<Scalar>(state(), shapes, blocked, options,
                    [](const auto& part, auto of_part) { detail::search_any(part, of_part); });
}

template <FloatOrDouble Scalar>
Scalar Collider<Scalar>::last_free_t(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit) const noexcept {
  const FloatingPointEnvironment environment;
  if (hit.started_touching || !(hit.t > 0)) return 0;
  const bool is_touched = surehit::intersect(shape, triangle(hit.triangle), {.max_t = hit.t}).has_value();
  return is_touched ? std::nextafter(hit.t, Scalar{0}) : hit.t;
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit,
                                                  const ShapeQueryOptions<Scalar>& options) const noexcept {
  return find_free_centre<Scalar>(state(), shape, hit, options, nullptr);
}

template <FloatOrDouble Scalar>
Vector3<Scalar> Collider<Scalar>::last_free_point(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit,
                                                  ShapeHitFilter<Scalar> filter,
                                                  const ShapeQueryOptions<Scalar>& options) const noexcept {
  return find_free_centre(state(), shape, hit, options, &filter);
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                    \
  template std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(                                                \
      const SweptShape<Scalar>&, const ShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;                   \
  template std::optional<ShapeHit<Scalar>> Collider<Scalar>::first_hit(                                                \
      const SweptShape<Scalar>&, ShapeHitFilter<Scalar>, const ShapeQueryOptions<Scalar>&, QueryStatistics*)           \
      const noexcept;                                                                                                  \
  template bool Collider<Scalar>::any_hit(const SweptShape<Scalar>&, const ShapeQueryOptions<Scalar>&,                 \
                                          QueryStatistics*) const noexcept;                                            \
  template bool Collider<Scalar>::any_hit(const SweptShape<Scalar>&, ShapeHitFilter<Scalar>,                           \
                                          const ShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;          \
  template bool Collider<Scalar>::overlaps(const SweptShape<Scalar>&, const ShapeQueryOptions<Scalar>&,                \
                                           QueryStatistics*) const noexcept;                                           \
  template bool Collider<Scalar>::overlaps(const SweptShape<Scalar>&, ShapeHitFilter<Scalar>,                          \
                                           const ShapeQueryOptions<Scalar>&, QueryStatistics*) const noexcept;         \
  template void Collider<Scalar>::all_hits(const SweptShape<Scalar>&, std::vector<ShapeHit<Scalar>>&,                  \
                                           const ShapeQueryOptions<Scalar>&, QueryStatistics*) const;                  \
  template void Collider<Scalar>::all_hits(const SweptShape<Scalar>&, std::vector<ShapeHit<Scalar>>&,                  \
                                           ShapeHitFilter<Scalar>, const ShapeQueryOptions<Scalar>&, QueryStatistics*) \
      const;                                                                                                           \
  template void Collider<Scalar>::first_hits(const SweptShapeSpan<Scalar>&, std::span<ShapeHit<Scalar>>,               \
                                             const ShapeBatchOptions<Scalar>&) const noexcept;                         \
  template void Collider<Scalar>::any_hits(const SweptShapeSpan<Scalar>&, std::span<std::uint8_t>,                     \
                                           const ShapeBatchOptions<Scalar>&) const noexcept;                           \
  template Scalar Collider<Scalar>::last_free_t(const SweptShape<Scalar>&, const ShapeHit<Scalar>&) const noexcept;    \
  template Vector3<Scalar> Collider<Scalar>::last_free_point(const SweptShape<Scalar>&, const ShapeHit<Scalar>&,       \
                                                             const ShapeQueryOptions<Scalar>&) const noexcept;         \
  template Vector3<Scalar> Collider<Scalar>::last_free_point(const SweptShape<Scalar>&, const ShapeHit<Scalar>&,       \
                                                             ShapeHitFilter<Scalar>, const ShapeQueryOptions<Scalar>&) \
      const noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
