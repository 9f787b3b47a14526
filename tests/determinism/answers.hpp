#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "questions.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "surehit/collider.hpp"
#include "surehit/executor.hpp"

namespace surehit::test {

/// How questions are put. None of it may change an answer.
struct Way {
  std::size_t batch = std::size_t{1} << 30;  ///< paths in a batch at most
  std::uint64_t shuffled = 0;                ///< the seed of the order; 0: as drawn
  std::optional<Executor> executor = std::nullopt;
};

/// All that a collider says about one path.
template <typename Scalar>
struct Answer {
  Hit<Scalar> first;
  bool any = false;
  std::vector<Hit<Scalar>> all;
  Vector3<Scalar> free{0, 0, 0};  ///< of a segment that hits
  Hit<Scalar> first_of_batch;
  std::uint8_t any_of_batch = 0;

  [[nodiscard]] bool same_as(const Answer& other) const {
    return same_bits(first, other.first) && any == other.any &&
           std::equal(all.begin(), all.end(), other.all.begin(), other.all.end(),
                      [](const auto& left, const auto& right) { return same_bits(left, right); }) &&
           std::equal(free.begin(), free.end(), other.free.begin(),
                      [](Scalar left, Scalar right) { return same_bits(left, right); }) &&
           same_bits(first_of_batch, other.first_of_batch) && any_of_batch == other.any_of_batch;
  }
};

/// FNV-1a over 32-bit words, as in the level's test: fields one by one, so neither padding nor byte order has a say.
class AnswerHash {
 public:
  void take(std::uint32_t bits) { value_ = (value_ ^ bits) * 0x100000001b3u; }
  void take(float x) { take(std::bit_cast<std::uint32_t>(x)); }
  void take(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    take(static_cast<std::uint32_t>(bits));
    take(static_cast<std::uint32_t>(bits >> 32));
  }
  template <typename Scalar>
  void take(const Hit<Scalar>& hit) {
    take(hit.t);
    take(hit.u);
    take(hit.v);
    take(hit.triangle);
    take(static_cast<std::uint32_t>(hit.side));
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The answers to some questions, by their ids.
template <typename Scalar>
class Answers {
 public:
  Answers(const Collider<Scalar>& collider, const Questions<Scalar>& questions, const Way& way = {})
      : collider_(collider), questions_(questions), way_(way), answers_(questions.all.size()) {
    std::vector<std::size_t> order(answers_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (way.shuffled != 0) {
      Random random(way.shuffled);
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    }
    ask_one_by_one(order);
    ask_in_batches<Segment<Scalar>>(order, PathKind::segment);
    ask_in_batches<Ray<Scalar>>(order, PathKind::ray);
    ask_in_batches<Line<Scalar>>(order, PathKind::line);
  }

  [[nodiscard]] const std::vector<Answer<Scalar>>& all() const { return answers_; }
  [[nodiscard]] std::size_t hit_count() const {
    return static_cast<std::size_t>(
        std::count_if(answers_.begin(), answers_.end(), [](const auto& answer) { return answer.any; }));
  }

  [[nodiscard]] std::uint64_t hash() const {
    AnswerHash hash;
    for (const Answer<Scalar>& answer : answers_) {
      hash.take(answer.first);
      hash.take(std::uint32_t{answer.any});
      hash.take(static_cast<std::uint32_t>(answer.all.size()));
      for (const Hit<Scalar>& hit : answer.all) hash.take(hit);
      for (const Scalar x : answer.free) hash.take(x);
      hash.take(answer.first_of_batch);
      hash.take(std::uint32_t{answer.any_of_batch});
    }
    return hash.value();
  }

 private:
  void ask_one_by_one(const std::vector<std::size_t>& order) {
    constexpr std::size_t per_task = 100;
    const auto ask = [&](std::size_t task) {
      const std::size_t end = std::min(order.size(), (task + 1) * per_task);
      for (std::size_t i = task * per_task; i < end; ++i) ask_one(order[i]);
    };
    const std::size_t tasks = (order.size() + per_task - 1) / per_task;
    if (way_.executor) {
      way_.executor->run(tasks, ask);
    } else {
      for (std::size_t task = 0; task < tasks; ++task) ask(task);
    }
  }

  void ask_one(std::size_t id) {
    const Path<Scalar>& path = questions_.all[id].path;
    const QueryOptions<Scalar>& options = questions_.options_of(id);
    Answer<Scalar>& answer = answers_[id];
    answer.first = collider_.first_hit(path, options).value_or(Hit<Scalar>{});
    answer.any = collider_.any_hit(path, options);
    if (id % questions_.every_all == 0) collider_.all_hits(path, answer.all, options);
    if (path.has_end() && answer.any) {
      answer.free = collider_.last_free_point({path.start, path.toward}, answer.first, options);
    }
  }

  template <typename AnyPath>
  void ask_in_batches(const std::vector<std::size_t>& order, PathKind kind) {
    for (std::size_t options = 0; options < questions_.options.size(); ++options) {
      std::vector<std::size_t> ids;
      std::vector<AnyPath> paths;
      for (const std::size_t id : order) {
        const Question<Scalar>& question = questions_.all[id];
        if (question.options != options || question.path.kind != kind) continue;
        ids.push_back(id);
        paths.push_back({question.path.start, question.path.toward});
      }
      std::vector<Hit<Scalar>> first(ids.size());
      std::vector<std::uint8_t> any(ids.size());
      for (std::size_t begin = 0; begin < ids.size(); begin += way_.batch) {
        const std::size_t count = std::min(way_.batch, ids.size() - begin);
        ask_batch(std::span<const AnyPath>(paths).subspan(begin, count), std::span(first).subspan(begin, count),
                  std::span(any).subspan(begin, count), questions_.options[options]);
      }
      for (std::size_t i = 0; i < ids.size(); ++i) {
        answers_[ids[i]].first_of_batch = first[i];
        answers_[ids[i]].any_of_batch = any[i];
      }
    }
  }

  template <typename AnyPath>
  void ask_batch(std::span<const AnyPath> paths, std::span<Hit<Scalar>> first, std::span<std::uint8_t> any,
                 const QueryOptions<Scalar>& options) {
    if (way_.executor) {
      collider_.first_hits(paths, first, {.options = options, .executor = *way_.executor});
      collider_.any_hits(paths, any, {.options = options, .executor = *way_.executor});
    } else {
      collider_.first_hits(paths, first, {.options = options});
      collider_.any_hits(paths, any, {.options = options});
    }
  }

  const Collider<Scalar>& collider_;
  const Questions<Scalar>& questions_;
  Way way_;
  std::vector<Answer<Scalar>> answers_;
};

}  // namespace surehit::test
