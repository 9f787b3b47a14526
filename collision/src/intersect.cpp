#include "surehit/intersect.hpp"

#include <cmath>
#include <limits>

#include "misses_box.hpp"
#include "narrowphase.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
std::optional<Hit<Scalar>> intersect(const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
                                     const std::type_identity_t<QueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics statistics;
  const Path<Scalar>& whole = path;
  const detail::PathRange<Scalar> range(whole, options);
  if (!detail::is_finite(whole) || range.is_empty() || !detail::is_finite(triangle)) return std::nullopt;
  if (detail::misses_box(whole, triangle)) return std::nullopt;
  const detail::Narrowphase<Scalar> narrowphase(whole, options, range, statistics);
  detail::Candidate<Scalar> candidate{0, triangle, {}};
  if (!narrowphase.find_contact(triangle, candidate.contact)) return std::nullopt;
  return narrowphase.hit(candidate);
}

// A path that is cut at hit.t still meets the triangle if and only if the exact t is not above hit.t.
template <FloatOrDouble Scalar>
Scalar max_t_keeping(const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
                     const Hit<Scalar>& hit) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics statistics;
  const Path<Scalar>& whole = path;
  const QueryOptions<Scalar> cut{.max_t = hit.t};
  const detail::PathRange<Scalar> range(whole, cut);
  detail::Contact contact;
  const bool is_kept = detail::is_finite(whole) && !range.is_empty() && detail::is_finite(triangle) &&
                       detail::Narrowphase<Scalar>(whole, cut, range, statistics).find_contact(triangle, contact);
  return is_kept ? hit.t : std::nextafter(hit.t, std::numeric_limits<Scalar>::infinity());
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                       \
  template SUREHIT_API std::optional<Hit<Scalar>> intersect(const Path<Scalar>&, const Triangle<Scalar>&, \
                                                            const QueryOptions<Scalar>&) noexcept;        \
  template SUREHIT_API Scalar max_t_keeping(const Path<Scalar>&, const Triangle<Scalar>&, const Hit<Scalar>&) noexcept;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit
