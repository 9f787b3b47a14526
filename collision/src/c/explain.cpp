#include "surehit/explain.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/handle_call.hpp"
#include "c/values.hpp"
#include "surehit/c/explain_d.h"
#include "surehit/c/explain_f.h"

namespace surehit::c {
namespace {

surehit_explained_cell cell_to_c(const ExplainedCell& cell) {
  return {to_c(cell.box),
          cell.enters,
          cell.leaves,
          cell.first_candidate,
          cell.candidate_count,
          static_cast<std::uint8_t>(cell.finding),
          static_cast<std::uint8_t>(cell.is_inner ? 1 : 0)};
}

surehit_explained_candidate candidate_to_c(const ExplainedCandidate& candidate) {
  const auto number = [](const FilterNumber& given) { return surehit_filter_number{given.value, given.bound}; };
  const FilterNumbers numbers = candidate.numbers.value_or(FilterNumbers{});
  return {number(numbers.det),
          number(numbers.t_det),
          number(numbers.u_det),
          number(numbers.v_det),
          number(numbers.w_det),
          candidate.triangle,
          static_cast<std::uint8_t>(candidate.numbers ? 1 : 0),
          static_cast<std::uint8_t>(candidate.filter_verdict),
          static_cast<std::uint8_t>(candidate.decided_by),
          static_cast<std::uint8_t>(candidate.outcome)};
}

template <typename CHit, typename Scalar>
CHit explained_hit_to_c(const ExplainedHit<Scalar>& hit) {
  return {Asked<Collider<Scalar>>::to_c(hit.hit), hit.t_lower, hit.t_upper, static_cast<std::uint8_t>(hit.ordered_by),
          static_cast<std::uint8_t>(hit.is_rounded_by_integers ? 1 : 0)};
}

/// Calls `tell` with each element as `convert` returns it, unless it is null.
template <typename Tell, typename Element, typename Convert>
void tell_each(Tell tell, void* user, const std::vector<Element>& elements, const Convert& convert) {
  if (tell == nullptr) return;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto told = convert(elements[i]);
    tell(user, i, &told);
  }
}

template <typename CHit, typename Scalar, typename CExplainer>
surehit_status explain_query(const char* function, const void* handle, const typename Structs<Scalar>::Path* path,
                             const typename Structs<Scalar>::QueryOptions* options, const CExplainer* explainer,
                             std::uint32_t* walk) {
  HandleCall<Collider<Scalar>> call(function, handle);
  check_path(call.arguments, path, "path");
  check_options(call.arguments, options);
  call.arguments.check_pointer(explainer, "explainer");
  const CExplainer told = call.arguments.read_sized(explainer, "explainer");
  call.arguments.check_pointer(walk, "walk");
  return call.arguments.then([&] {
    const Explanation<Scalar> explanation =
        explain<Scalar>(*call.object, from_c(*path), Asked<Collider<Scalar>>::options_of(options));
    *walk = static_cast<std::uint32_t>(explanation.walk);
    tell_each(told.cell, told.user, explanation.cells, [](const auto& cell) { return cell_to_c(cell); });
    tell_each(told.candidate, told.user, explanation.candidates, [](const auto& one) { return candidate_to_c(one); });
    tell_each(told.hit, told.user, explanation.hits, [](const auto& hit) { return explained_hit_to_c<CHit>(hit); });
  });
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define SUREHIT_EXPLAIN_FUNCTIONS(Scalar, s)                                                                     \
  SUREHIT_C_API surehit_status surehit_collider##s##_explain(                                                    \
      const surehit_collider##s* collider, const surehit_path##s* path, const surehit_query_options##s* options, \
      const surehit_explainer##s* explainer, uint32_t* walk) {                                                   \
    return explain_query<surehit_explained_hit##s, Scalar>(__func__, collider, path, options, explainer, walk);  \
  }
// NOLINTEND(bugprone-macro-parentheses)
extern "C" {
SUREHIT_EXPLAIN_FUNCTIONS(float, f)
SUREHIT_EXPLAIN_FUNCTIONS(double, d)
}
#undef SUREHIT_EXPLAIN_FUNCTIONS

}  // namespace surehit::c
