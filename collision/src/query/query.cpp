#include "query/query.hpp"

#include "support/rounding_flags.hpp"

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

#define SUREHIT_DEFINE(Scalar)                                                                                \
  std::optional<Hit<Scalar>> first_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path) {           \
    return search_first(query, path);                                                                         \
  }                                                                                                           \
  bool any_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path) { return search_any(query, path); } \
  void all_##Scalar(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) {   \
    search_all(query, path, hits);                                                                            \
  }                                                                                                           \
  void each_first_##Scalar(const Query<Scalar>& query, const PathSpan<Scalar>& paths,                         \
                           std::span<const QueryOptions<Scalar>> own_options, Hit<Scalar>* hits) {            \
    search_each_first<Scalar>(query, paths, own_options, {hits, paths.size()});                               \
  }                                                                                                           \
  void each_any_##Scalar(const Query<Scalar>& query, const PathSpan<Scalar>& paths,                           \
                         std::span<const QueryOptions<Scalar>> own_options, std::uint8_t* blocked) {          \
    search_each_any<Scalar>(query, paths, own_options, {blocked, paths.size()});                              \
  }
SUREHIT_FOR_SCALARS(SUREHIT_DEFINE)
#undef SUREHIT_DEFINE

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

#define SUREHIT_EXPORT(Scalar)                                                                                   \
  HWY_EXPORT(first_##Scalar);                                                                                    \
  HWY_EXPORT(any_##Scalar);                                                                                      \
  HWY_EXPORT(all_##Scalar);                                                                                      \
  HWY_EXPORT(each_first_##Scalar);                                                                               \
  HWY_EXPORT(each_any_##Scalar);                                                                                 \
  template <>                                                                                                    \
  std::optional<Hit<Scalar>> dispatch_first_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept { \
    return HWY_DYNAMIC_DISPATCH(first_##Scalar)(query, path);                                                    \
  }                                                                                                              \
  template <>                                                                                                    \
  bool dispatch_any_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept {                         \
    return HWY_DYNAMIC_DISPATCH(any_##Scalar)(query, path);                                                      \
  }                                                                                                              \
  template <>                                                                                                    \
  void dispatch_all_hits(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) { \
    HWY_DYNAMIC_DISPATCH(all_##Scalar)(query, path, hits);                                                       \
  }                                                                                                              \
  template <>                                                                                                    \
  void dispatch_first_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths,                            \
                           std::span<const QueryOptions<Scalar>> own_options, Hit<Scalar>* hits) noexcept {      \
    HWY_DYNAMIC_DISPATCH(each_first_##Scalar)(query, paths, own_options, hits);                                  \
  }                                                                                                              \
  template <>                                                                                                    \
  void dispatch_any_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths,                              \
                         std::span<const QueryOptions<Scalar>> own_options, std::uint8_t* blocked) noexcept {    \
    HWY_DYNAMIC_DISPATCH(each_any_##Scalar)(query, paths, own_options, blocked);                                 \
  }
SUREHIT_FOR_SCALARS(SUREHIT_EXPORT)
#undef SUREHIT_EXPORT

}  // namespace surehit::detail
#endif
// NOLINTEND(bugprone-macro-parentheses)
