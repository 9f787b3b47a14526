#include "surehit/explain.hpp"

#include "collider_state.hpp"
#include "query/query.hpp"
#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/explain.cpp"
#include <hwy/foreach_target.h>
// This header must come after foreach_target.h.
#include "query/path_explainer-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

// Highway cannot choose among templates, so these are functions.
void explain_path_float(const Query<float>& query, const Path<float>& path, Explanation<float>& explanation) {
  explain_path(query, path, explanation);
}
void explain_path_double(const Query<double>& query, const Path<double>& path, Explanation<double>& explanation) {
  explain_path(query, path, explanation);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit {
namespace detail {

HWY_EXPORT(explain_path_float);
HWY_EXPORT(explain_path_double);

void explain_path(const Query<float>& query, const Path<float>& path, Explanation<float>& explanation) {
  HWY_DYNAMIC_DISPATCH(explain_path_float)(query, path, explanation);
}
void explain_path(const Query<double>& query, const Path<double>& path, Explanation<double>& explanation) {
  HWY_DYNAMIC_DISPATCH(explain_path_double)(query, path, explanation);
}

}  // namespace detail

template <FloatOrDouble Scalar>
Explanation<Scalar> explain(const Collider<Scalar>& collider, const std::type_identity_t<Path<Scalar>>& path,
                            const std::type_identity_t<QueryOptions<Scalar>>& options) {
  const FloatingPointEnvironment environment;
  const auto& state = detail::ColliderState<Scalar>::of(collider);
  QueryStatistics statistics;
  Explanation<Scalar> explanation;
  detail::explain_path({state.grid, state.mesh, state.masks, options, nullptr, statistics, 0}, path, explanation);
  return explanation;
}

template SUREHIT_API Explanation<float> explain(const Collider<float>&, const Path<float>&, const QueryOptions<float>&);
template SUREHIT_API Explanation<double> explain(const Collider<double>&, const Path<double>&,
                                                 const QueryOptions<double>&);

}  // namespace surehit
#endif
