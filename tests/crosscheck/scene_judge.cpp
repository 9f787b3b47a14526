#include "scene_judge.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>

#include "support/same_bits.hpp"
#include "support/scene_text.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
using Hits = std::vector<SceneHit<Scalar>>;

template <typename Scalar>
bool is_odd(const SceneHit<Scalar>& hit) {
  return (hit.triangle + hit.instance.index) % 2 == 1;
}

template <typename Scalar>
class SceneJudge {
 public:
  SceneJudge(const Scene<Scalar>& scene, const SceneOracle<Scalar>& oracle,
             const std::vector<SceneQuestion<Scalar>>& questions)
      : scene_(scene), oracle_(oracle), questions_(questions) {
    for (const auto& [path, options] : questions) expected_.push_back(oracle.all_hits(path, options));
  }

  std::string difference() {
    for (asked_ = 0; asked_ < questions_.size() && difference_.empty(); ++asked_) ask_singly();
    ask_batches<Segment<Scalar>>(PathKind::segment);
    ask_batches<Ray<Scalar>>(PathKind::ray);
    ask_batches<Line<Scalar>>(PathKind::line);
    return difference_;
  }

 private:
  void ask_singly() {
    const auto& [path, options] = questions_[asked_];
    const Hits<Scalar>& expected = expected_[asked_];
    Hits<Scalar> answered(3);
    scene_.all_hits(path, answered, options);
    compare("all_hits", answered, expected);
    const auto first = scene_.first_hit(path, options);
    compare("first_hit", as_hits(first), first_of(expected));
    compare("any_hit", scene_.any_hit(path, options), !expected.empty());

    const Hits<Scalar> odd = odd_ones(expected);
    answered.resize(3);
    scene_.all_hits(path, answered, is_odd<Scalar>, options);
    compare("all_hits of the odd ones", answered, odd);
    const auto first_odd = scene_.first_hit(path, is_odd<Scalar>, options);
    compare("first_hit of the odd ones", as_hits(first_odd), first_of(odd));
    compare("any_hit of the odd ones", scene_.any_hit(path, is_odd<Scalar>, options), !odd.empty());

    if (path.kind != PathKind::segment || !difference_.empty()) return;
    const Segment<Scalar> segment{path.start, path.toward};
    if (first) {
      compare("last_free_point", scene_.last_free_point(segment, *first, options),
              oracle_.last_free_point(segment, *first, options));
    }
    if (first_odd && asked_ % 4 == 0) {
      compare("last_free_point of the odd ones", scene_.last_free_point(segment, *first_odd, is_odd<Scalar>, options),
              oracle_.last_free_point(segment, *first_odd, options, is_odd<Scalar>));
    }
  }

  /// Each path with its own options, with and without a filter. The filter knows the path too. Each question comes
  /// several times, so that a path follows others in the batch.
  template <typename AnyPath>
  void ask_batches(PathKind kind) {
    std::vector<std::size_t> ids;
    std::vector<AnyPath> paths;
    std::vector<SceneQueryOptions<Scalar>> options;
    for (std::size_t k = 0; k < 8 * questions_.size(); ++k) {
      const std::size_t i = (k + 5 * (k / questions_.size())) % questions_.size();
      const Path<Scalar>& path = questions_[i].path;
      if (path.kind != kind) continue;
      ids.push_back(i);
      paths.push_back({path.start, path.toward});
      options.push_back(questions_[i].options);
    }
    Hits<Scalar> hits(paths.size());
    std::vector<std::uint8_t> blocked(paths.size(), 2);
    scene_.first_hits(paths, hits, {.path_options = options});
    scene_.any_hits(paths, blocked, {.path_options = options});
    Hits<Scalar> odd_hits(paths.size());
    std::vector<std::uint8_t> odd_blocked(paths.size(), 2);
    const auto is_odd_here = [&](std::size_t path, const SceneHit<Scalar>& hit) {
      return path < paths.size() && is_odd(hit) == (path % 3 != 0);
    };
    scene_.first_hits(paths, odd_hits, {.path_options = options, .filter = is_odd_here});
    scene_.any_hits(paths, odd_blocked, {.path_options = options, .filter = is_odd_here});

    for (std::size_t i = 0; i < ids.size() && difference_.empty(); ++i) {
      asked_ = ids[i];
      const Hits<Scalar>& all = expected_[asked_];
      compare("first_hits", Hits<Scalar>{hits[i]}, first_or_miss(all));
      compare("any_hits", blocked[i], static_cast<std::uint8_t>(!all.empty()));
      Hits<Scalar> odd;
      std::copy_if(all.begin(), all.end(), std::back_inserter(odd),
                   [&](const auto& hit) { return is_odd_here(i, hit); });
      compare("first_hits with a filter", Hits<Scalar>{odd_hits[i]}, first_or_miss(odd));
      compare("any_hits with a filter", odd_blocked[i], static_cast<std::uint8_t>(!odd.empty()));
    }
  }

  static Hits<Scalar> odd_ones(const Hits<Scalar>& hits) {
    Hits<Scalar> odd;
    std::copy_if(hits.begin(), hits.end(), std::back_inserter(odd), is_odd<Scalar>);
    return odd;
  }
  static Hits<Scalar> as_hits(const std::optional<SceneHit<Scalar>>& hit) {
    return hit ? Hits<Scalar>{*hit} : Hits<Scalar>{};
  }
  static Hits<Scalar> first_of(const Hits<Scalar>& hits) { return {hits.begin(), hits.begin() + !hits.empty()}; }
  static Hits<Scalar> first_or_miss(const Hits<Scalar>& hits) {
    return hits.empty() ? Hits<Scalar>(1) : first_of(hits);
  }

  void compare(const char* query, const Hits<Scalar>& answered, const Hits<Scalar>& expected) {
    const bool same = std::equal(answered.begin(), answered.end(), expected.begin(), expected.end(),
                                 [](const auto& left, const auto& right) { return same_bits(left, right); });
    if (!same) report(query, hex_text(answered), hex_text(expected));
  }
  void compare(const char* query, const Vector3<Scalar>& answered, const Vector3<Scalar>& expected) {
    for (int axis = 0; axis < 3; ++axis) {
      if (same_bits(answered[axis], expected[axis])) continue;
      return report(query, hex_text(answered), hex_text(expected));
    }
  }
  void compare(const char* query, bool answered, bool expected) {
    if (answered != expected) report(query, answered ? "a hit" : "a miss", expected ? "a hit" : "a miss");
  }
  void compare(const char* query, std::uint8_t answered, std::uint8_t expected) {
    if (answered != expected) report(query, std::to_string(int{answered}), std::to_string(int{expected}));
  }

  void report(const char* query, const std::string& answered, const std::string& expected) {
    if (!difference_.empty()) return;
    const auto& [path, options] = questions_[asked_];
    difference_ =
        hex_text(path) + '\n' + hex_text(options) + '\n' + query + " answered: " + answered + "\nexpected: " + expected;
  }

  const Scene<Scalar>& scene_;
  const SceneOracle<Scalar>& oracle_;
  const std::vector<SceneQuestion<Scalar>>& questions_;
  std::vector<Hits<Scalar>> expected_;
  std::size_t asked_ = 0;
  std::string difference_;
};

}  // namespace

template <typename Scalar>
std::string scene_difference(const Scene<Scalar>& scene, const SceneOracle<Scalar>& oracle,
                             const std::vector<SceneQuestion<Scalar>>& questions) {
  return SceneJudge<Scalar>(scene, oracle, questions).difference();
}

template std::string scene_difference(const Scene<float>&, const SceneOracle<float>&,
                                      const std::vector<SceneQuestion<float>>&);
template std::string scene_difference(const Scene<double>&, const SceneOracle<double>&,
                                      const std::vector<SceneQuestion<double>>&);

}  // namespace surehit::test
