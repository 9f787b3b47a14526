#include "collider_judge.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "support/pair_text.hpp"
#include "support/same_bits.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
using Hits = std::vector<Hit<Scalar>>;

template <typename Scalar>
std::string text_of(const Hits<Scalar>& hits) {
  std::string text;
  for (const Hit<Scalar>& hit : hits) text.append("\n  ").append(hex_text(hit));
  return hits.empty() ? " none" : text;
}

template <typename Scalar>
class ColliderJudge {
 public:
  ColliderJudge(const Collider<Scalar>& collider, const ExactMeshOracle<Scalar>& oracle, const Path<Scalar>& path,
                const QueryOptions<Scalar>& options)
      : collider_(collider), oracle_(oracle), path_(path), options_(options) {}

  std::string difference() {
    const Hits<Scalar> expected = oracle_.all_hits(path_, options_);
    Hits<Scalar> answered(3);
    collider_.all_hits(path_, answered, options_);
    compare("all_hits", answered, expected);

    const auto first = collider_.first_hit(path_, options_);
    compare("first_hit", as_hits(first), first_of(expected));
    compare("any_hit", collider_.any_hit(path_, options_), !expected.empty());
    if (path_.kind == PathKind::segment) ask_batch(Segment<Scalar>{path_.start, path_.toward}, expected);
    if (path_.kind == PathKind::ray) ask_batch(Ray<Scalar>{path_.start, path_.toward}, expected);
    if (path_.kind == PathKind::line) ask_batch(Line<Scalar>{path_.start, path_.toward}, expected);

    ask_with_filter(expected);
    if (path_.kind == PathKind::segment && first) ask_last_free_point(*first);
    return difference_;
  }

 private:
  template <typename Shape>
  void ask_batch(const Shape& shape, const Hits<Scalar>& expected) {
    const std::span<const Shape> paths(&shape, 1);
    Hit<Scalar> hit;
    std::uint8_t blocked = 2;
    collider_.first_hits(paths, std::span(&hit, 1), {.options = options_});
    collider_.any_hits(paths, std::span(&blocked, 1), {.options = options_});
    compare("first_hits", Hits<Scalar>{hit}, expected.empty() ? Hits<Scalar>(1) : first_of(expected));
    compare("any_hits", blocked, static_cast<std::uint8_t>(!expected.empty()));
  }

  void ask_with_filter(const Hits<Scalar>& expected) {
    const auto is_odd = [](const Hit<Scalar>& hit) { return hit.triangle % 2 == 1; };
    Hits<Scalar> odd;
    std::copy_if(expected.begin(), expected.end(), std::back_inserter(odd), is_odd);
    Hits<Scalar> answered(3);
    collider_.all_hits(path_, answered, is_odd, options_);
    compare("all_hits of the odd triangles", answered, odd);
    compare("first_hit of the odd triangles", as_hits(collider_.first_hit(path_, is_odd, options_)), first_of(odd));
    compare("any_hit of the odd triangles", collider_.any_hit(path_, is_odd, options_), !odd.empty());
  }

  void ask_last_free_point(const Hit<Scalar>& first) {
    const Segment<Scalar> segment{path_.start, path_.toward};
    const auto free = collider_.last_free_point(segment, first, options_);
    const auto expected = oracle_.last_free_point(segment, first, options_);
    if (hex_text(free) != hex_text(expected)) report("last_free_point", hex_text(free), hex_text(expected));
  }

  static Hits<Scalar> as_hits(const std::optional<Hit<Scalar>>& hit) {
    return hit ? Hits<Scalar>{*hit} : Hits<Scalar>{};
  }
  static Hits<Scalar> first_of(const Hits<Scalar>& hits) { return {hits.begin(), hits.begin() + !hits.empty()}; }

  void compare(const char* question, const Hits<Scalar>& answered, const Hits<Scalar>& expected) {
    const auto same = [](const Hit<Scalar>& left, const Hit<Scalar>& right) { return same_bits(left, right); };
    if (!std::equal(answered.begin(), answered.end(), expected.begin(), expected.end(), same)) {
      report(question, text_of(answered), text_of(expected));
    }
  }
  template <std::integral Answer>
  void compare(const char* question, Answer answered, Answer expected) {
    if (answered != expected) report(question, std::to_string(answered), std::to_string(expected));
  }

  void report(const std::string& question, const std::string& answered, const std::string& expected) {
    if (!difference_.empty()) return;
    difference_ = question + " of " + hex_text(path_) + '\n' + hex_text(options_) + "\nexpected: " + expected +
                  "\nanswered: " + answered;
  }

  const Collider<Scalar>& collider_;
  const ExactMeshOracle<Scalar>& oracle_;
  const Path<Scalar>& path_;
  const QueryOptions<Scalar>& options_;
  std::string difference_;
};

}  // namespace

template <typename Scalar>
std::string collider_difference(const Collider<Scalar>& collider, const ExactMeshOracle<Scalar>& oracle,
                                const Path<Scalar>& path, const QueryOptions<Scalar>& options) {
  return ColliderJudge<Scalar>(collider, oracle, path, options).difference();
}

template std::string collider_difference(const Collider<float>&, const ExactMeshOracle<float>&, const Path<float>&,
                                         const QueryOptions<float>&);
template std::string collider_difference(const Collider<double>&, const ExactMeshOracle<double>&, const Path<double>&,
                                         const QueryOptions<double>&);

}  // namespace surehit::test
