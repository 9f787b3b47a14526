#include "narrowphase.hpp"

#include "bounded_contact.hpp"
#include "exact_contact.hpp"

namespace surehit::detail {
namespace {

/// Rounds a quotient if all that its bounds allow rounds to the same number (Ziv 1991).
template <typename Scalar>
bool try_round(const Bounded& numerator, const Bounded& denominator, Scalar& rounded) {
  const auto [lower, upper] = bounded_quotient(numerator, denominator);
  rounded = static_cast<Scalar>(upper) + Scalar{0};  // a zero is +0
  return static_cast<Scalar>(lower) == rounded;
}

}  // namespace

template <typename Scalar>
Narrowphase<Scalar>::Narrowphase(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                 QueryStatistics& statistics)
    : path_(path),
      options_(options),
      statistics_(statistics),
      range_(path, options),
      kernel_(path, range_),
      admits_nothing_(!is_finite(path) || range_.is_empty()),
      every_hit_counts_(options.culling == Culling::none && !options.ignore_start_contact &&
                        !options.ignore_end_contact) {
  ++statistics.paths;
}

template <typename Scalar>
std::optional<Contact> Narrowphase<Scalar>::contact(const Triangle<Scalar>& triangle) const {
  ++statistics_.candidates;
  const Verdict verdict = kernel_.classify(triangle);
  if (verdict == Verdict::miss) return std::nullopt;
  if (verdict == Verdict::undecided) ++statistics_.undecided;
  return resolve(triangle);
}

template <typename Scalar>
bool Narrowphase<Scalar>::meets(const Triangle<Scalar>& triangle) const {
  ++statistics_.candidates;
  const Verdict verdict = kernel_.classify(triangle);
  if (verdict == Verdict::miss) return false;
  if (verdict == Verdict::hit && every_hit_counts_) return true;
  if (verdict == Verdict::undecided) ++statistics_.undecided;
  return resolve(triangle).has_value();
}

template <typename Scalar>
std::optional<Contact> Narrowphase<Scalar>::resolve(const Triangle<Scalar>& triangle) const {
  const BoundedContact bounded = bounded_contact(path_, triangle, range_);
  if (bounded.verdict == Verdict::miss) return std::nullopt;
  std::optional<Contact> contact = bounded.contact;
  if (bounded.verdict == Verdict::undecided) {
    ++statistics_.exact_decisions;
    contact = exact_contact(path_, triangle, range_);
  }
  return contact && admits(*contact) ? contact : std::nullopt;
}

template <typename Scalar>
bool Narrowphase<Scalar>::admits(const Contact& contact) const {
  if (options_.culling == Culling::back && contact.side != Side::front) return false;
  if (options_.culling == Culling::front && contact.side != Side::back) return false;
  if (options_.ignore_start_contact && contact.at_start) return false;
  if (options_.ignore_end_contact && contact.at_end) return false;
  return true;
}

template <typename Scalar>
bool Narrowphase<Scalar>::comes_before(const Candidate& x, const Candidate& y) const {
  if (x.contact.t_upper < y.contact.t_lower) return true;
  if (y.contact.t_upper < x.contact.t_lower) return false;
  ++statistics_.exact_orders;
  const auto order = exact_order(path_, *x.triangle, *y.triangle, range_);
  return order != 0 ? order < 0 : x.id < y.id;
}

template <typename Scalar>
Hit<Scalar> Narrowphase<Scalar>::hit(const Candidate& candidate) const {
  Hit<Scalar> hit;
  hit.triangle = candidate.id;
  hit.side = candidate.contact.side;
  const BoundedContact bounded = bounded_contact(path_, *candidate.triangle, range_);
  if (bounded.verdict != Verdict::hit || !try_round(bounded.height, bounded.det, hit.t) ||
      !try_round(bounded.u_scaled, bounded.det, hit.u) || !try_round(bounded.v_scaled, bounded.det, hit.v)) {
    ++statistics_.exact_roundings;
    exact_rounding(path_, *candidate.triangle, range_, hit);
  }
  return hit;
}

template class Narrowphase<float>;
template class Narrowphase<double>;

}  // namespace surehit::detail
