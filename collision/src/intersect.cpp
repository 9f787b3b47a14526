#include "surehit/intersect.hpp"

#include "narrowphase.hpp"
#include "surehit/floating_point_environment.hpp"

namespace surehit {

template <typename Scalar>
std::optional<Hit<Scalar>> intersect(const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
                                     const std::type_identity_t<QueryOptions<Scalar>>& options) noexcept {
  const FloatingPointEnvironment environment;
  QueryStatistics statistics;
  const detail::Narrowphase<Scalar> narrowphase(path, options, statistics);
  if (narrowphase.admits_nothing() || !detail::is_finite(triangle)) return std::nullopt;
  const std::optional<detail::Contact> contact = narrowphase.contact(triangle);
  if (!contact) return std::nullopt;
  return narrowphase.hit({&triangle, 0, *contact});
}

template std::optional<Hit<float>> intersect(const Path<float>&, const Triangle<float>&,
                                             const QueryOptions<float>&) noexcept;
template std::optional<Hit<double>> intersect(const Path<double>&, const Triangle<double>&,
                                              const QueryOptions<double>&) noexcept;

}  // namespace surehit
