#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/task_run.hpp"
#include "c/values.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit::c {

/// A query about one path or one shape. `Subject` is as in `Asked`.
template <typename Subject>
class SingleQuery {
 public:
  using Types = Asked<Subject>;
  using CPath = typename Types::CPath;

  /// Checks all arguments.
  SingleQuery(Arguments& arguments, const void* object, const CPath* path, const typename Types::COptions* options,
              const typename Types::CFilter* filter, surehit_statistics* statistics)
      : arguments_(arguments),
        object_(arguments.object_of<typename Types::Object>(object, Types::name)),
        path_(path),
        options_(options),
        filter_(filter),
        statistics_(statistics) {
    Types::check(arguments, path);
    check_options(arguments, options);
    check_filter(arguments, filter);
    if (statistics != nullptr) arguments.check_sized_result(statistics, "statistics");
  }

  [[nodiscard]] Arguments& arguments() const { return arguments_; }
  /// Fails unless the path is a segment.
  void check_segment() const {
    if (arguments_.are_valid()) arguments_.check_value(path_->kind, SUREHIT_RAY, 0, "the kind of a segment");
  }

  /// Calls `ask(object, path, options, filter, statistics)`, and adds its work to the caller's statistics. `filter` is
  /// null if there is none. `accepts_after_stop` is as in `AskedFilter`.
  template <typename Ask>
  [[nodiscard]] surehit_status answer(bool accepts_after_stop, const Ask& ask) const {
    return arguments_.then([&] {
      const AskedFilter<Subject> filter(filter_, accepts_after_stop);
      QueryStatistics work;
      QueryStatistics* const counted = statistics_ != nullptr ? &work : nullptr;
      const auto options = Types::options_of(options_);
      ask(*object_, Types::path_of(*path_), options, filter.is_there() ? &filter : nullptr, counted);
      add_work(work, statistics_);
      filter.tell_stop(arguments_);
    });
  }

 private:
  Arguments& arguments_;
  const typename Types::Object* object_;
  const CPath* path_;
  const typename Types::COptions* options_;
  const typename Types::CFilter* filter_;
  surehit_statistics* statistics_;
};

template <typename Subject>
[[nodiscard]] surehit_status first_hit(const SingleQuery<Subject>& query, typename Asked<Subject>::CHit* hit) {
  query.arguments().check_pointer(hit, "hit");
  return query.answer(
      true, [&](const auto& object, const auto& path, const auto& options, const auto* filter, QueryStatistics* work) {
        using Types = Asked<Subject>;
        const auto found =
            filter != nullptr ? object.first_hit(path, *filter, options, work) : object.first_hit(path, options, work);
        const bool is_answer = filter == nullptr || !filter->has_stopped();
        *hit = Types::to_c(found && is_answer ? *found : typename Types::Answer{});
      });
}

/// Sets `result` to 1 if `ask(object, path, ...)` says yes, and to 0 otherwise. The rest is the filter, if there is
/// one, the options and the statistics.
template <typename Subject, typename Ask>
[[nodiscard]] surehit_status yes_or_no(const SingleQuery<Subject>& query, std::uint8_t* result, const Ask& ask) {
  return query.answer(
      true, [&](const auto& object, const auto& path, const auto& options, const auto* filter, QueryStatistics* work) {
        const bool is_true =
            filter != nullptr ? ask(object, path, *filter, options, work) : ask(object, path, options, work);
        *result = is_true && (filter == nullptr || !filter->has_stopped()) ? 1 : 0;
      });
}

template <typename Subject>
[[nodiscard]] surehit_status any_hit(const SingleQuery<Subject>& query, std::uint8_t* blocked) {
  query.arguments().check_pointer(blocked, "blocked");
  return yes_or_no(query, blocked,
                   [](const auto& object, const auto&... asked) -> bool { return object.any_hit(asked...); });
}

template <typename Subject>
[[nodiscard]] surehit_status overlaps(const SingleQuery<Subject>& query, std::uint8_t* touches) {
  query.arguments().check_pointer(touches, "touches");
  return yes_or_no(query, touches,
                   [](const auto& object, const auto&... asked) -> bool { return object.overlaps(asked...); });
}

template <typename Subject>
[[nodiscard]] surehit_status all_hits(const SingleQuery<Subject>& query, typename Asked<Subject>::CHit* hits,
                                      std::size_t capacity, std::size_t* hit_count) {
  query.arguments().check_array(hits, capacity, sizeof *hits, "hits");
  query.arguments().check_pointer(hit_count, "hit_count");
  return query.answer(
      false, [&](const auto& object, const auto& path, const auto& options, const auto* filter, QueryStatistics* work) {
        std::vector<typename Asked<Subject>::Answer> found;
        if (filter != nullptr) {
          object.all_hits(path, found, *filter, options, work);
          if (filter->has_stopped()) found.clear();
        } else {
          object.all_hits(path, found, options, work);
        }
        *hit_count = found.size();
        for (std::size_t i = 0; i < std::min(found.size(), capacity); ++i) hits[i] = Asked<Subject>::to_c(found[i]);
      });
}

template <typename Subject>
[[nodiscard]] surehit_status last_free_point(const SingleQuery<Subject>& query,
                                             const typename Asked<Subject>::CHit* hit,
                                             typename Structs<typename Asked<Subject>::Scalar>::Vector3* point) {
  query.check_segment();
  query.arguments().check_pointer(hit, "hit");
  query.arguments().check_pointer(point, "point");
  return query.answer(true, [&](const auto& object, const auto& path, const auto& options, const auto* filter,
                                QueryStatistics* /*work*/) {
    const Segment<typename Asked<Subject>::Scalar> segment{path.start, path.toward};
    const auto found = filter != nullptr
                           ? object.last_free_point(segment, Asked<Subject>::from_c(*hit), *filter, options)
                           : object.last_free_point(segment, Asked<Subject>::from_c(*hit), options);
    *point = to_c(filter == nullptr || !filter->has_stopped() ? found : segment.start);
  });
}

template <typename Subject>
[[nodiscard]] surehit_status last_free_centre(const SingleQuery<Subject>& query,
                                              const typename Asked<Subject>::CHit* hit,
                                              typename Structs<typename Asked<Subject>::Scalar>::Vector3* point) {
  query.arguments().check_pointer(hit, "hit");
  query.arguments().check_pointer(point, "point");
  return query.answer(true, [&](const auto& object, const auto& shape, const auto& options, const auto* filter,
                                QueryStatistics* /*work*/) {
    const auto found = filter != nullptr ? object.last_free_point(shape, Asked<Subject>::from_c(*hit), *filter, options)
                                         : object.last_free_point(shape, Asked<Subject>::from_c(*hit), options);
    const bool is_answer = filter == nullptr || !filter->has_stopped();
    *point = to_c(is_answer ? found : std::visit([](const auto& any) { return any.start; }, shape));
  });
}

/// A batch of paths or shapes.
template <typename Subject>
class Batch {
 public:
  using Types = Asked<Subject>;
  using CPaths = typename Types::Paths::CPaths;

  /// Checks all arguments but the room for the answers.
  Batch(Arguments& arguments, const void* object, const CPaths* paths, const typename Types::CBatchOptions* options)
      : arguments_(arguments),
        object_(arguments.object_of<typename Types::Object>(object, Types::name)),
        paths_(arguments, paths),
        options_(arguments.read_sized(options, "options")) {
    if (!arguments.are_valid()) return;
    check_options(arguments, options_.options);
    check_filter(arguments, options_.filter);
    check_executor(arguments, options_.executor);
    if (options_.statistics != nullptr) arguments.check_sized_result(options_.statistics, "options.statistics");
    if (options_.path_options == nullptr) return;
    arguments.check_array(options_.path_options, paths_.size(), sizeof *options_.path_options, "options.path_options");
    for (std::size_t i = 0; i < paths_.size() && arguments.are_valid(); ++i) {
      check_options(arguments, options_.path_options[i], i);
    }
  }

  /// Calls `ask(object, paths, answers, options)` with room for the answers, which it checks.
  template <typename Answer, typename CAnswer, typename Ask>
  [[nodiscard]] surehit_status answer(CAnswer* answers, const char* name, const Ask& ask) const {
    static_assert(sizeof(Answer) == sizeof(CAnswer));
    arguments_.check_array(answers, paths_.size(), sizeof *answers, name);
    return arguments_.then([&] {
      const AskedFilter<Subject> filter(options_.filter, true);
      QueryStatistics work;
      typename Types::AnyBatchOptions options;
      options.options = Types::options_of(options_.options);
      if (options_.path_options != nullptr) {
        options.path_options = {reinterpret_cast<const typename Types::Options*>(options_.path_options), paths_.size()};
      }
      if (filter.is_there()) options.filter.emplace(filter);
      options.executor = executor_of(options_.executor);
      if (options_.statistics != nullptr) options.statistics = &work;
      ask(*object_, paths_.span(), std::span(reinterpret_cast<Answer*>(answers), paths_.size()), options);
      add_work(work, options_.statistics);
      filter.tell_stop(arguments_);
    });
  }

 private:
  Arguments& arguments_;
  const typename Types::Object* object_;
  typename Types::Paths paths_;
  typename Types::CBatchOptions options_;
};

template <typename Subject>
[[nodiscard]] surehit_status first_hits(const Batch<Subject>& batch, typename Asked<Subject>::CHit* hits) {
  return batch.template answer<typename Asked<Subject>::Answer>(
      hits, "hits", [](const auto& object, const auto& paths, auto answers, const auto& options) {
        object.first_hits(paths, answers, options);
      });
}

template <typename Subject>
[[nodiscard]] surehit_status any_hits(const Batch<Subject>& batch, std::uint8_t* blocked) {
  return batch.template answer<std::uint8_t>(
      blocked, "blocked", [](const auto& object, const auto& paths, auto answers, const auto& options) {
        object.any_hits(paths, answers, options);
      });
}

}  // namespace surehit::c
