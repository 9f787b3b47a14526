#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "c/arguments.hpp"
#include "c/asked_paths.hpp"
#include "c/values.hpp"
#include "surehit/batch_options.hpp"
#include "surehit/collider.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/query_options.hpp"

namespace surehit::c {

/// The types of queries of what is asked: of a collider or of a scene about paths, or of one of them about shapes.
template <typename Subject>
struct Asked;

/// The types of queries by their names, of which some are in C.
template <typename ObjectOfQuery, typename ScalarOfAll, typename AnswerOfQuery, typename OptionsOfQuery,
          typename OptionsOfBatch, typename CStructs>
struct AskedTypes {
  using Object = ObjectOfQuery;
  using Scalar = ScalarOfAll;
  using Answer = AnswerOfQuery;
  using Options = OptionsOfQuery;
  using AnyBatchOptions = OptionsOfBatch;
  using CHit = typename CStructs::Hit;
  using CFilter = typename CStructs::Filter;
  using COptions = typename CStructs::QueryOptions;
  using CBatchOptions = typename CStructs::BatchOptions;
};

/// The same for queries about paths.
template <typename Object, typename Scalar, typename Answer, typename Options, typename AnyBatchOptions,
          typename CStructs>
struct AskedAboutPaths : AskedTypes<Object, Scalar, Answer, Options, AnyBatchOptions, CStructs> {
  using CPath = typename Structs<Scalar>::Path;
  using Paths = AskedPaths<Scalar>;

  /// Fails unless the path can be read.
  static void check(Arguments& arguments, const CPath* path) { check_path(arguments, path, "path"); }
  /// Returns the path, which must have been checked.
  [[nodiscard]] static Path<Scalar> path_of(const CPath& path) { return from_c(path); }
};

/// Sets the options that queries of colliders and of scenes share. They have been checked.
template <typename Options, typename COptions>
void set_options(Options& options, const COptions& given) {
  options.min_t = given.min_t;
  options.max_t = given.max_t;
  options.culling = static_cast<Culling>(given.culling);
  options.mask = given.mask;
  options.ignored_triangle = given.ignored_triangle;
  options.ignore_start_contact = given.ignore_start_contact != 0;
  options.ignore_end_contact = given.ignore_end_contact != 0;
}

template <typename Scalar>
struct Asked<Collider<Scalar>> : AskedAboutPaths<Collider<Scalar>, Scalar, Hit<Scalar>, QueryOptions<Scalar>,
                                                 BatchOptions<Scalar>, Structs<Scalar>> {
  using typename Asked::AskedTypes::Answer;
  using typename Asked::AskedTypes::CHit;
  using typename Asked::AskedTypes::COptions;
  using typename Asked::AskedTypes::Options;
  static constexpr const char* name = "collider";

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    Options options;
    if (given != nullptr) set_options(options, *given);
    return options;
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
#define SUREHIT_SAME_OPTIONS(Options, COptions)                 \
  static_assert(sizeof(Options) == sizeof(COptions));           \
  SUREHIT_SAME_MEMBER(Options, COptions, min_t);                \
  SUREHIT_SAME_MEMBER(Options, COptions, max_t);                \
  SUREHIT_SAME_MEMBER(Options, COptions, culling);              \
  SUREHIT_SAME_MEMBER(Options, COptions, mask);                 \
  SUREHIT_SAME_MEMBER(Options, COptions, ignored_triangle);     \
  SUREHIT_SAME_MEMBER(Options, COptions, ignore_start_contact); \
  SUREHIT_SAME_MEMBER(Options, COptions, ignore_end_contact)
#define SUREHIT_SAME_LAYOUT(Scalar, s)                          \
  static_assert(sizeof(Hit<Scalar>) == sizeof(surehit_hit##s)); \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, t);          \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, u);          \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, v);          \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, triangle);   \
  SUREHIT_SAME_MEMBER(Hit<Scalar>, surehit_hit##s, side);       \
  SUREHIT_SAME_OPTIONS(QueryOptions<Scalar>, surehit_query_options##s)
SUREHIT_SAME_LAYOUT(float, f);
SUREHIT_SAME_LAYOUT(double, d);

/// Fails if an option has a value that it cannot have. `element` is the index of the path.
template <typename COptions>
void check_options(Arguments& arguments, const COptions& options, std::size_t element) {
  arguments.check_value(options.culling, 3, element, "options.culling");
  arguments.check_value(options.ignore_start_contact, 2, element, "options.ignore_start_contact");
  if constexpr (requires { options.ignore_end_contact; }) {
    arguments.check_value(options.ignore_end_contact, 2, element, "options.ignore_end_contact");
  }
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

/// A filter of C for a query of a `Subject`. Once it has said stop, it is not asked again.
template <typename Subject>
class AskedFilter {
 public:
  using Types = Asked<Subject>;

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
