#include "scene/scene_query.hpp"
#include "support/rounding_flags.hpp"

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/scene_search.cpp"
#include <hwy/foreach_target.h>
// These headers must come after foreach_target.h.
#include "scene/scene_batch-inl.hpp"
#include "scene/scene_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The searches that are compiled for this instruction set.
template <typename Scalar>
constexpr SceneSearches<Scalar> scene_searches = {search_scene_first<Scalar>, search_scene_any<Scalar>,
                                                  search_scene_all<Scalar>, search_scene_each_first<Scalar>,
                                                  search_scene_each_any<Scalar>};

// Highway cannot choose among templates, so these are functions.
const SceneSearches<float>* scene_searches_float() { return &scene_searches<float>; }
const SceneSearches<double>* scene_searches_double() { return &scene_searches<double>; }

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(scene_searches_float);
HWY_EXPORT(scene_searches_double);

template <>
const SceneSearches<float>* best_scene_searches() {
  return HWY_DYNAMIC_DISPATCH(scene_searches_float)();
}
template <>
const SceneSearches<double>* best_scene_searches() {
  return HWY_DYNAMIC_DISPATCH(scene_searches_double)();
}

}  // namespace surehit::detail
#endif
