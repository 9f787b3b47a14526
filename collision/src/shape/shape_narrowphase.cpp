#include "shape/shape_narrowphase.hpp"

#include <algorithm>
#include <cstddef>

#include "shape/bounded_box.hpp"
#include "shape/bounded_capsule.hpp"
#include "shape/bounded_sphere.hpp"
#include "shape/exact_box.hpp"
#include "shape/exact_capsule.hpp"
#include "shape/exact_sphere.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Shape>
ShapeNarrowphase<Shape>::ShapeNarrowphase(const Shape& shape, const ShapeQueryOptions<Scalar>& options,
                                          QueryStatistics& statistics)
    : shape_(shape), options_(options), statistics_(statistics) {}

template <typename Shape>
bool ShapeNarrowphase<Shape>::admits(const Triangle<Scalar>& triangle, const ContactOf<Shape>& contact) const {
  if (options_.ignore_start_contact && contact.at_start) return false;
  if (contact.t_upper > double{options_.max_t}) {
    if (contact.t_lower > double{options_.max_t}) return false;
    ++statistics_.exact_orders;
    if (compare_time(shape_, triangle, contact, options_.max_t) > 0) return false;
  }
  if (options_.culling == Culling::none) return true;
  const int along = sign_along(shape_, triangle);
  return options_.culling == Culling::back ? along < 0 : along > 0;
}

template <typename Shape>
bool ShapeNarrowphase<Shape>::find_contact(const Triangle<Scalar>& triangle, double limit,
                                           ContactOf<Shape>& found) const {
  switch (bounded_contact(shape_, triangle, found)) {
    case Verdict::miss:
      return false;
    case Verdict::hit:
      break;
    case Verdict::undecided:
      ++statistics_.exact_decisions;
      const std::optional<ContactOf<Shape>> exact = exact_contact(shape_, triangle);
      if (!exact) return false;
      found = *exact;
  }
  return found.t_lower <= limit && admits(triangle, found);
}

template <typename Shape>
bool ShapeNarrowphase<Shape>::comes_before(const ShapeCandidate<Shape>& x, const ShapeCandidate<Shape>& y) const {
  if (x.contact.t_upper < y.contact.t_lower) return true;
  if (y.contact.t_upper < x.contact.t_lower) return false;
  if (x.id == y.id) return false;
  if (x.contact.at_start && y.contact.at_start) return x.id < y.id;
  if (are_timed_alike(x.triangle, x.contact, y.triangle, y.contact)) return x.id < y.id;
  ++statistics_.exact_orders;
  const int order = compare_times(shape_, x.triangle, x.contact, y.triangle, y.contact);
  return order != 0 ? order < 0 : x.id < y.id;
}

template <typename Shape>
void ShapeNarrowphase<Shape>::sort(std::vector<ShapeCandidate<Shape>>& found) const {
  using Candidate = ShapeCandidate<Shape>;
  std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) { return x.id < y.id; });
  const auto is_same = [](const Candidate& x, const Candidate& y) { return x.id == y.id; };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  std::sort(found.begin(), found.end(), [&](const Candidate& x, const Candidate& y) { return comes_before(x, y); });
}

template <typename Shape>
ShapeHit<ScalarOf<Shape>> ShapeNarrowphase<Shape>::hit(const ShapeCandidate<Shape>& candidate) const {
  ShapeHit<Scalar> hit;
  hit.triangle = candidate.id;
  if constexpr (requires { candidate.contact.feature; }) hit.feature = candidate.contact.feature;
  hit.started_touching = candidate.contact.at_start;
  if (!try_round(shape_, candidate.triangle, candidate.contact, hit)) {
    ++statistics_.exact_roundings;
    round_exactly(shape_, candidate.triangle, candidate.contact, hit);
  }
  return hit;
}

template class ShapeNarrowphase<SweptBox<float>>;
template class ShapeNarrowphase<SweptBox<double>>;
template class ShapeNarrowphase<SweptSphere<float>>;
template class ShapeNarrowphase<SweptSphere<double>>;
template class ShapeNarrowphase<SweptCapsule<float>>;
template class ShapeNarrowphase<SweptCapsule<double>>;

}  // namespace surehit::detail
