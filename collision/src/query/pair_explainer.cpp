#include "query/pair_explainer.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "filter/bounded_contact.hpp"
#include "filter/corner_contact.hpp"
#include "filter/plane_contact.hpp"
#include "misses_box.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Scalar>
bool PairExplainer<Scalar>::decide(ExplainedCandidate& candidate) {
  if (!query_.takes_part(candidate.triangle)) {
    candidate.decided_by = DecidedBy::options;
    candidate.outcome = PairOutcome::left_out;
    return false;
  }
  // The narrowphase is asked without the options on contacts, so that a contact which they leave out is told.
  QueryStatistics statistics;
  const QueryOptions<Scalar> all_contacts;
  const Narrowphase<Scalar> narrowphase(path_, all_contacts, range_, statistics);
  Candidate<Scalar> found{candidate.triangle, query_.mesh.triangle(candidate.triangle), {}};
  const bool meets = narrowphase.find_contact(found.triangle, found.contact);
  const bool is_decided =
      candidate.filter_verdict == FilterVerdict::miss || candidate.filter_verdict == FilterVerdict::hit;
  candidate.decided_by = is_decided ? DecidedBy::filter : stage_of(found.triangle, statistics.exact_decisions != 0);
  if (!meets) {
    candidate.outcome = PairOutcome::miss;
    return false;
  }
  if (!admits(query_.options, found.contact)) {
    candidate.outcome = PairOutcome::contact_left_out;
    return false;
  }
  candidate.outcome = PairOutcome::hit;
  found_.push_back(found);
  const bool is_nearer = found.contact.t_upper < limit_;
  if (is_nearer) limit_ = found.contact.t_upper;
  return is_nearer;
}

template <typename Scalar>
DecidedBy PairExplainer<Scalar>::stage_of(const Triangle<Scalar>& triangle, bool is_by_integers) const {
  if (misses_box(path_, triangle)) return DecidedBy::coordinates;
  if (corner_contact(path_, triangle, range_).verdict != Verdict::undecided) return DecidedBy::coordinates;
  if (double_contact(path_, triangle, range_).verdict != Verdict::undecided) return DecidedBy::doubles;
  if (plane_contact(path_, triangle, range_).verdict != Verdict::undecided) return DecidedBy::plane;
  return is_by_integers ? DecidedBy::integers : DecidedBy::running_bounds;
}

template <typename Scalar>
OrderedBy PairExplainer<Scalar>::order_of(const Narrowphase<Scalar>& narrowphase, const Candidate<Scalar>& previous,
                                          const Candidate<Scalar>& next) {
  if (previous.contact.t_upper < next.contact.t_lower) return OrderedBy::bounds;
  // If only the ids order them, other ids turn the order round.
  Candidate<Scalar> x = previous;
  Candidate<Scalar> y = next;
  std::swap(x.id, y.id);
  return narrowphase.comes_before(x, y) == narrowphase.comes_before(previous, next) ? OrderedBy::exact_t
                                                                                    : OrderedBy::triangle;
}

template <typename Scalar>
std::vector<ExplainedHit<Scalar>> PairExplainer<Scalar>::sorted_hits() {
  QueryStatistics statistics;
  const Narrowphase<Scalar> narrowphase(path_, query_.options, range_, statistics);
  narrowphase.sort(found_);
  std::vector<ExplainedHit<Scalar>> hits;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const std::uint64_t exact_roundings = statistics.exact_roundings;
    ExplainedHit<Scalar>& hit = hits.emplace_back();
    hit.hit = narrowphase.hit(found_[i]);
    hit.is_rounded_by_integers = statistics.exact_roundings != exact_roundings;
    hit.t_lower = found_[i].contact.t_lower;
    hit.t_upper = found_[i].contact.t_upper;
    if (i > 0) hit.ordered_by = order_of(narrowphase, found_[i - 1], found_[i]);
  }
  return hits;
}

template class PairExplainer<float>;
template class PairExplainer<double>;

}  // namespace surehit::detail
