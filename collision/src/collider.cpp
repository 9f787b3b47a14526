#include "surehit/collider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact_contact.hpp"
#include "path_range.hpp"
#include "query.hpp"
#include "surehit/floating_point_environment.hpp"

namespace surehit {

template <typename Scalar>
std::optional<InvalidMesh> Collider<Scalar>::try_build(const TriangleMeshView<Scalar>& mesh,
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
  built.grid_ = Grid(mesh, built.box_, options.grid);
  built.masks_.assign(options.masks.begin(), options.masks.end());
  built.triangles_.reserve(mesh.triangle_count());
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) built.triangles_.push_back(mesh.triangle(i));
  *this = std::move(built);
  return std::nullopt;
}

template <typename Scalar>
std::optional<Hit<Scalar>> Collider<Scalar>::find_first(const Path<Scalar>& path, const HitFilter<Scalar>* filter,
                                                        const QueryOptions<Scalar>& options,
                                                        QueryStatistics* statistics) const noexcept {
  QueryStatistics unread;
  return detail::Query<Scalar>(grid_, triangles_, masks_, path, options, filter,
                               statistics != nullptr ? *statistics : unread)
      .first_hit();
}

template <typename Scalar>
bool Collider<Scalar>::find_any(const Path<Scalar>& path, const HitFilter<Scalar>* filter,
                                const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  QueryStatistics unread;
  return detail::Query<Scalar>(grid_, triangles_, masks_, path, options, filter,
                               statistics != nullptr ? *statistics : unread)
      .any_hit();
}

template <typename Scalar>
void Collider<Scalar>::find_all(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits,
                                const HitFilter<Scalar>* filter, const QueryOptions<Scalar>& options,
                                QueryStatistics* statistics) const {
  QueryStatistics unread;
  hits.clear();
  detail::Query<Scalar>(grid_, triangles_, masks_, path, options, filter, statistics != nullptr ? *statistics : unread)
      .all_hits(hits);
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
template <typename AnyPath>
void Collider<Scalar>::find_each_first(std::span<const AnyPath> paths, std::span<Hit<Scalar>> hits,
                                       const QueryOptions<Scalar>& options,
                                       QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  for (std::size_t i = 0; i < std::min(paths.size(), hits.size()); ++i) {
    hits[i] = find_first(paths[i], nullptr, options, statistics).value_or(Hit<Scalar>{});
  }
}

template <typename Scalar>
template <typename AnyPath>
void Collider<Scalar>::find_each_any(std::span<const AnyPath> paths, std::span<std::uint8_t> blocked,
                                     const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {
  const FloatingPointEnvironment environment;
  for (std::size_t i = 0; i < std::min(paths.size(), blocked.size()); ++i) {
    blocked[i] = find_any(paths[i], nullptr, options, statistics) ? 1 : 0;
  }
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
    find_each_first(paths, hits, options, statistics);                                                                 \
  }                                                                                                                    \
  template <typename Scalar>                                                                                           \
  void Collider<Scalar>::any_hits(std::span<const AnyPath<Scalar>> paths, std::span<std::uint8_t> blocked,             \
                                  const QueryOptions<Scalar>& options, QueryStatistics* statistics) const noexcept {   \
    find_each_any(paths, blocked, options, statistics);                                                                \
  }
SUREHIT_BATCH(Segment)
SUREHIT_BATCH(Ray)
SUREHIT_BATCH(Line)
#undef SUREHIT_BATCH

template class Collider<float>;
template class Collider<double>;

}  // namespace surehit
