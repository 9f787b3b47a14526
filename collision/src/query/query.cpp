#include "query/query.hpp"

#include "support/rounding_flags.hpp"

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/query.cpp"
#include <hwy/foreach_target.h>
// These headers must come after foreach_target.h.
#include "query/batch-inl.hpp"
#include "query/query_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The searches that are compiled for this instruction set.
template <typename Scalar>
constexpr Searches<Scalar> searches = {search_first<Scalar>, search_any<Scalar>, search_all<Scalar>,
                                       search_each_first<Scalar>, search_each_any<Scalar>};

// Highway cannot choose among templates, so these are functions.
const Searches<float>* searches_float() { return &searches<float>; }
const Searches<double>* searches_double() { return &searches<double>; }

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(searches_float);
HWY_EXPORT(searches_double);

template <>
const Searches<float>* best_searches() {
  return HWY_DYNAMIC_DISPATCH(searches_float)();
}
template <>
const Searches<double>* best_searches() {
  return HWY_DYNAMIC_DISPATCH(searches_double)();
}

}  // namespace surehit::detail
#endif
