#include "surehit/intersect.hpp"

#include "narrowphase.hpp"
#include "support/floating_point_environment.hpp"

namespace surehit {

template <typename Scalar>
std::optional<Hit<Scalar>> intersect(const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
                                     const std::type_identity_t<QueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics statistics;
  const Path<Scalar>& whole = path;
  const detail::PathRange<Scalar> range(whole, options);
  if (!detail::is_finite(whole) || range.is_empty() || !detail::is_finite(triangle)) return std::nullopt;
  const detail::Narrowphase<Scalar> narrowphase(whole, options, range, statistics);
  detail::Candidate<Scalar> candidate{0, triangle, {}};
  if (!narrowphase.find_contact(triangle, candidate.contact)) return std::nullopt;
  return narrowphase.hit(candidate);
}

template std::optional<Hit<float>> intersect(const Path<float>&, const Triangle<float>&,
                                             const QueryOptions<float>&) noexcept;
template std::optional<Hit<double>> intersect(const Path<double>&, const Triangle<double>&,
                                              const QueryOptions<double>&) noexcept;

}  // namespace surehit
