#include "query/query.hpp"

// Compiled once for each instruction set; the best one is chosen when the first query runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/query.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include "query/batch-inl.hpp"
#include "query/query_walk-inl.hpp"

// Highway exports plain functions, so each kind of query has a name for each Scalar.
// NOLINTBEGIN(bugprone-macro-parentheses): template arguments cannot have any
#define SUREHIT_FOR_SCALARS(define) define(float) define(double)

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#define SUREHIT_DEFINE(Scalar)                                                                              \
  std::optional<Hit<Scalar>> first_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path) {         \
    return find_first(query, path);                                                                         \
  }                                                                                                         \
  bool any_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path) { return find_any(query, path); } \
  void all_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) { \
    find_all(query, path, hits);                                                                            \
  }
SUREHIT_FOR_SCALARS(SUREHIT_DEFINE)
#undef SUREHIT_DEFINE

void each_first(const Query<float>& query, const PathSpan<float>& paths, Hit<float>* hits) {
  find_each_first(query, paths, {hits, paths.size()});
}
void each_any(const Query<float>& query, const PathSpan<float>& paths, std::uint8_t* blocked) {
  find_each_any(query, paths, {blocked, paths.size()});
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

#define SUREHIT_EXPORT(Scalar)                                                                          \
  HWY_EXPORT(first_##Scalar);                                                                           \
  HWY_EXPORT(any_##Scalar);                                                                             \
  HWY_EXPORT(all_##Scalar);                                                                             \
  template <>                                                                                           \
  std::optional<Hit<Scalar>> first_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept { \
    return HWY_DYNAMIC_DISPATCH(first_##Scalar)(query, path);                                           \
  }                                                                                                     \
  template <>                                                                                           \
  bool any_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept {                         \
    return HWY_DYNAMIC_DISPATCH(any_##Scalar)(query, path);                                             \
  }                                                                                                     \
  template <>                                                                                           \
  void all_hits(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) { \
    HWY_DYNAMIC_DISPATCH(all_##Scalar)(query, path, hits);                                              \
  }
SUREHIT_FOR_SCALARS(SUREHIT_EXPORT)
#undef SUREHIT_EXPORT

HWY_EXPORT(each_first);
HWY_EXPORT(each_any);
template <>
void first_hits(const Query<float>& query, const PathSpan<float>& paths, Hit<float>* hits) noexcept {
  HWY_DYNAMIC_DISPATCH(each_first)(query, paths, hits);
}
template <>
void any_hits(const Query<float>& query, const PathSpan<float>& paths, std::uint8_t* blocked) noexcept {
  HWY_DYNAMIC_DISPATCH(each_any)(query, paths, blocked);
}
template <>
void first_hits(const Query<double>& query, const PathSpan<double>& paths, Hit<double>* hits) noexcept {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    hits[i] = first_hit(query, paths[i]).value_or(Hit<double>{});
  }
}
template <>
void any_hits(const Query<double>& query, const PathSpan<double>& paths, std::uint8_t* blocked) noexcept {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    blocked[i] = any_hit(query, paths[i]) ? 1 : 0;
  }
}

}  // namespace surehit::detail
#endif
// NOLINTEND(bugprone-macro-parentheses)
