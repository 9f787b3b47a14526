#include "pair_judge.hpp"

#include <optional>

#include "cgal_oracle.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
bool is_finite(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  return path.start.allFinite() && path.toward.allFinite() && triangle.a.allFinite() && triangle.b.allFinite() &&
         triangle.c.allFinite();
}

}  // namespace

template <typename Scalar>
PairVerdict judge_pair(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                       const QueryOptions<Scalar>& options) {
  const std::optional<ExactContact> expected = exact_contact(path, triangle, options);
  const std::optional<Hit<Scalar>> answer = intersect(path, triangle, options);
  PairVerdict verdict{expected.has_value(), {}};
  const bool answer_is_right = expected ? answer && same_bits(*answer, rounded_hit<Scalar>(*expected)) : !answer;
  const bool cgal_agrees = !is_finite(path, triangle) || cgal_meets(path, triangle, options) == expected.has_value();
  if (answer_is_right && cgal_agrees) return verdict;
  verdict.difference = hex_text(path) + '\n' + hex_text(triangle) + '\n' + hex_text(options) +
                       "\nexpected: " + (expected ? hex_text(rounded_hit<Scalar>(*expected)) : "a miss") +
                       "\nanswered: " + (answer ? hex_text(*answer) : "a miss");
  if (!cgal_agrees) verdict.difference += "\nCGAL disagrees with the rationals";
  return verdict;
}

template PairVerdict judge_pair(const Path<float>&, const Triangle<float>&, const QueryOptions<float>&);
template PairVerdict judge_pair(const Path<double>&, const Triangle<double>&, const QueryOptions<double>&);

}  // namespace surehit::test
