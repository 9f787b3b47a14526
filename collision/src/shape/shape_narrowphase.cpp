#include "shape/shape_narrowphase.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "shape/bounded_box.hpp"
#include "shape/bounded_capsule.hpp"
#include "shape/bounded_sphere.hpp"
#include "shape/exact_box.hpp"
#include "shape/exact_capsule.hpp"
#include "shape/exact_sphere.hpp"
#include "shape/placed_shape_candidate.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Shape, typename Candidate>
ShapeNarrowphase<Shape, Candidate>::ShapeNarrowphase(const Shape& shape, const Options& options,
                                                     QueryStatistics& statistics)
    : shape_(shape), options_(options), statistics_(statistics) {}

template <typename Shape, typename Candidate>
bool ShapeNarrowphase<Shape, Candidate>::admits(const AnyTriangle& triangle, const ContactOf<Shape>& contact) const {
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

template <typename Shape, typename Candidate>
Verdict ShapeNarrowphase<Shape, Candidate>::find_simple_contact(const AnyTriangle& triangle, double limit,
                                                                ContactOf<Shape>& found) const {
  if constexpr (has_simple_contacts<Shape> && std::is_same_v<AnyTriangle, Triangle<Scalar>>) {
    const Verdict verdict = simple_contact(shape_, triangle, limit, found);
    return verdict == Verdict::hit && !admits(triangle, found) ? Verdict::miss : verdict;
  }
  return Verdict::undecided;
}

template <typename Shape, typename Candidate>
bool ShapeNarrowphase<Shape, Candidate>::find_contact(const AnyTriangle& triangle, double limit,
                                                      ContactOf<Shape>& found) const {
  Verdict verdict = Verdict::undecided;
  if constexpr (has_simple_contacts<Shape> && std::is_same_v<AnyTriangle, Triangle<Scalar>>) {
    verdict = simple_contact(shape_, triangle, limit, found);
  }
  FindingsOf<Shape> findings;
  if (verdict == Verdict::undecided) verdict = bounded_contact(shape_, triangle, found, findings);
  switch (verdict) {
    case Verdict::miss:
      return false;
    case Verdict::hit:
      break;
    case Verdict::undecided:
      ++statistics_.exact_decisions;
      const std::optional<ContactOf<Shape>> exact = exact_contact(shape_, triangle, findings);
      if (!exact) return false;
      found = *exact;
  }
  return found.t_lower <= limit && admits(triangle, found);
}

template <typename Shape, typename Candidate>
bool ShapeNarrowphase<Shape, Candidate>::comes_before(const Candidate& x, const Candidate& y) const {
  if (x.contact.t_upper < y.contact.t_lower) return true;
  if (y.contact.t_upper < x.contact.t_lower) return false;
  if (x.ids() == y.ids()) return false;
  const bool has_lower_ids = x.ids() < y.ids();
  if ((x.contact.at_start && y.contact.at_start) || x.is_timed_like(y)) return has_lower_ids;
  ++statistics_.exact_orders;
  const int order = compare_times(shape_, x.whole_triangle(), x.contact, y.whole_triangle(), y.contact);
  return order != 0 ? order < 0 : has_lower_ids;
}

template <typename Shape, typename Candidate>
void ShapeNarrowphase<Shape, Candidate>::sort(std::vector<Candidate>& found) const {
  std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) { return x.ids() < y.ids(); });
  const auto is_same = [](const Candidate& x, const Candidate& y) { return x.ids() == y.ids(); };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  std::sort(found.begin(), found.end(), [&](const Candidate& x, const Candidate& y) { return comes_before(x, y); });
}

template <typename Shape, typename Candidate>
ShapeHit<ScalarOf<Shape>> ShapeNarrowphase<Shape, Candidate>::hit(const Candidate& candidate) const {
  ShapeHit<Scalar> hit;
  hit.triangle = candidate.id;
  if constexpr (requires { candidate.contact.feature; }) hit.feature = candidate.contact.feature;
  hit.started_touching = candidate.contact.at_start;
  if (!try_round(shape_, candidate.whole_triangle(), candidate.contact, hit)) {
    ++statistics_.exact_roundings;
    round_exactly(shape_, candidate.whole_triangle(), candidate.contact, hit);
  }
  return hit;
}

#define SUREHIT_INSTANTIATE(Shape)        \
  template class ShapeNarrowphase<Shape>; \
  template class ShapeNarrowphase<Shape, PlacedShapeCandidate<Shape>>;
SUREHIT_INSTANTIATE(SweptBox<float>)
SUREHIT_INSTANTIATE(SweptBox<double>)
SUREHIT_INSTANTIATE(SweptSphere<float>)
SUREHIT_INSTANTIATE(SweptSphere<double>)
SUREHIT_INSTANTIATE(SweptCapsule<float>)
SUREHIT_INSTANTIATE(SweptCapsule<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
