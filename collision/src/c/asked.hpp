#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "c/arguments.hpp"
#include "c/values.hpp"
#include "surehit/batch_options.hpp"
#include "surehit/collider.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/query_options.hpp"

namespace surehit::c {

/// The types of queries of what is asked: a collider or a scene.
template <typename Object>
struct Asked;

template <typename ScalarOfMesh>
struct Asked<Collider<ScalarOfMesh>> {
  using Scalar = ScalarOfMesh;
  using Answer = Hit<Scalar>;
  using Options = QueryOptions<Scalar>;
  using AnyBatchOptions = BatchOptions<Scalar>;
  using CHit = typename Structs<Scalar>::Hit;
  using CFilter = typename Structs<Scalar>::Filter;
  using COptions = typename Structs<Scalar>::QueryOptions;
  using CBatchOptions = typename Structs<Scalar>::BatchOptions;
  static constexpr const char* name = "collider";

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    if (given == nullptr) return {};
    return {given->min_t,
            given->max_t,
            static_cast<Culling>(given->culling),
            given->mask,
            given->ignored_triangle,
            given->ignore_start_contact != 0,
            given->ignore_end_contact != 0};
  }

  /// Returns a hit, which may have any numbers.
  [[nodiscard]] static Answer from_c(const CHit& hit) {
    return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Side>(hit.side)};
  }
  /// Returns a hit for the caller.
  [[nodiscard]] static CHit to_c(const Answer& hit) {
    return {hit.t, hit.u, hit.v, hit.triangle, static_cast<std::uint8_t>(hit.side)};
  }
};

// A batch reads its options and writes its hits where the caller has them. So the structs have the same layout.
#define SUREHIT_SAME_MEMBER(Struct, CStruct, member)                    \
  static_assert(offsetof(Struct, member) == offsetof(CStruct, member)); \
  static_assert(sizeof(Struct::member) == sizeof(CStruct::member))
#define SUREHIT_SAME_LAYOUT(Scalar, s)                                                       \
  static_assert(sizeof(Hit<Scalar>) == sizeof(surehit_hit##s));                              \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, t);                                       \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, u);                                       \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, v);                                       \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, triangle);                                \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, side);                                    \
  static_assert(sizeof(QueryOptions<Scalar>) == sizeof(surehit_query_options##s));           \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, min_t);                \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, max_t);                \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, culling);              \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, mask);                 \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, ignored_triangle);     \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, ignore_start_contact); \
  SUREHIT_SAME_MEMBER(QueryOptions<Scalar>, surehit_query_options##s, ignore_end_contact)
SUREHIT_SAME_LAYOUT(float, f);
SUREHIT_SAME_LAYOUT(double, d);

/// Fails if an option has a value that it cannot have. `element` is the index of the path.
template <typename COptions>
void check_options(Arguments& arguments, const COptions& options, std::size_t element) {
  arguments.check_value(options.culling, 3, element, "options.culling");
  arguments.check_value(options.ignore_start_contact, 2, element, "options.ignore_start_contact");
  arguments.check_value(options.ignore_end_contact, 2, element, "options.ignore_end_contact");
}

/// Fails unless the options can be read. Null is allowed.
template <typename COptions>
void check_options(Arguments& arguments, const COptions* options) {
  arguments.check_optional(options, "options");
  if (options != nullptr && arguments.are_valid()) check_options(arguments, *options, 0);
}

/// Fails unless the filter can be called. Null is allowed.
template <typename CFilter>
void check_filter(Arguments& arguments, const CFilter* filter) {
  arguments.check_optional(filter, "filter");
  if (filter != nullptr && arguments.are_valid()) {
    arguments.check_pointer(reinterpret_cast<const void*>(filter->accept), "filter.accept");
  }
}

/// A filter of C for a query of an `Object`. Once it has said stop, it is not asked again.
template <typename Object>
class AskedFilter {
 public:
  using Types = Asked<Object>;

  /// After a stop, all hits count if `accepts_after_stop`, so that a search for the first hit ends soon.
  AskedFilter(const typename Types::CFilter* filter, bool accepts_after_stop)
      : filter_(filter), accepts_after_stop_(accepts_after_stop) {}
  AskedFilter(const AskedFilter&) = delete;
  AskedFilter& operator=(const AskedFilter&) = delete;

  [[nodiscard]] bool operator()(std::size_t path, const typename Types::Answer& hit) const {
    if (has_stopped()) return accepts_after_stop_;
    const typename Types::CHit given = Types::to_c(hit);
    const std::int32_t verdict = filter_->accept(filter_->user, path, &given);
    if (verdict >= 0) return verdict != SUREHIT_REJECT;
    has_stopped_.store(true, std::memory_order_relaxed);
    return accepts_after_stop_;
  }

  /// Returns true if there is a filter.
  [[nodiscard]] bool is_there() const { return filter_ != nullptr; }
  /// Returns true if the filter has said stop.
  [[nodiscard]] bool has_stopped() const { return has_stopped_.load(std::memory_order_relaxed); }
  /// Fails if the filter has said stop.
  void tell_stop(Arguments& arguments) const {
    if (has_stopped()) arguments.refuse(SUREHIT_STOPPED, 0, "the filter said stop");
  }

 private:
  const typename Types::CFilter* filter_;
  bool accepts_after_stop_;
  mutable std::atomic<bool> has_stopped_ = false;
};

}  // namespace surehit::c
