#include "shape/sphere_narrowphase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "path_range.hpp"
#include "shape/bounded_sphere.hpp"
#include "shape/exact_sphere.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Returns corner `index` of a triangle, where corner 3 is the first one again.
template <typename Scalar>
const Vector3<Scalar>& corner(const Triangle<Scalar>& triangle, std::size_t index) {
  return index == 1 ? triangle.b : index == 2 ? triangle.c : triangle.a;
}

/// Returns true if two triangles share the corner or the edge whose equation has t as a root. Neighbours often do.
template <typename Scalar>
bool are_timed_alike(const SphereCandidate<Scalar>& x, const SphereCandidate<Scalar>& y) {
  const Feature of_x = x.contact.timed_by;
  const Feature of_y = y.contact.timed_by;
  if (of_x == Feature::face || of_y == Feature::face || is_corner(of_x) != is_corner(of_y)) return false;
  const auto& x_first = corner(x.triangle, index_of(of_x));
  const auto& y_first = corner(y.triangle, index_of(of_y));
  if (is_corner(of_x)) return x_first == y_first;
  const auto& x_last = corner(x.triangle, index_of(of_x) + 1);
  const auto& y_last = corner(y.triangle, index_of(of_y) + 1);
  return (x_first == y_first && x_last == y_last) || (x_first == y_last && x_last == y_first);
}

}  // namespace

template <typename Scalar>
bool is_valid(const SweptSphere<Scalar>& sphere) {
  return is_finite(sphere.start) && is_finite(sphere.end) && std::isfinite(sphere.radius) && sphere.radius >= 0;
}

template <typename Scalar>
SphereNarrowphase<Scalar>::SphereNarrowphase(const SweptSphere<Scalar>& sphere,
                                             const ShapeQueryOptions<Scalar>& options, QueryStatistics& statistics)
    : sphere_(sphere), options_(options), statistics_(statistics) {}

template <typename Scalar>
bool SphereNarrowphase<Scalar>::admits(const Triangle<Scalar>& triangle, const SphereContact& contact) const {
  if (options_.ignore_start_contact && contact.at_start) return false;
  if (contact.t_upper > double{options_.max_t}) {
    if (contact.t_lower > double{options_.max_t}) return false;
    ++statistics_.exact_orders;
    if (compare_time(sphere_, triangle, contact, options_.max_t) > 0) return false;
  }
  if (options_.culling == Culling::none) return true;
  const int along = exact_sign_along(sphere_, triangle);
  return options_.culling == Culling::back ? along < 0 : along > 0;
}

template <typename Scalar>
bool SphereNarrowphase<Scalar>::find_contact(const Triangle<Scalar>& triangle, double limit,
                                             SphereContact& found) const {
  switch (bounded_sphere_contact(sphere_, triangle, found)) {
    case Verdict::miss:
      return false;
    case Verdict::hit:
      break;
    case Verdict::undecided:
      ++statistics_.exact_decisions;
      const std::optional<SphereContact> exact = exact_sphere_contact(sphere_, triangle);
      if (!exact) return false;
      found = *exact;
  }
  return found.t_lower <= limit && admits(triangle, found);
}

template <typename Scalar>
bool SphereNarrowphase<Scalar>::comes_before(const SphereCandidate<Scalar>& x, const SphereCandidate<Scalar>& y) const {
  if (x.contact.t_upper < y.contact.t_lower) return true;
  if (y.contact.t_upper < x.contact.t_lower) return false;
  if (x.id == y.id) return false;
  if (x.contact.at_start && y.contact.at_start) return x.id < y.id;
  if (are_timed_alike(x, y)) return x.id < y.id;
  ++statistics_.exact_orders;
  const int order = compare_times(sphere_, x.triangle, x.contact, y.triangle, y.contact);
  return order != 0 ? order < 0 : x.id < y.id;
}

template <typename Scalar>
void SphereNarrowphase<Scalar>::sort(std::vector<SphereCandidate<Scalar>>& found) const {
  using Candidate = SphereCandidate<Scalar>;
  std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) { return x.id < y.id; });
  const auto is_same = [](const Candidate& x, const Candidate& y) { return x.id == y.id; };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  std::sort(found.begin(), found.end(), [&](const Candidate& x, const Candidate& y) { return comes_before(x, y); });
}

template <typename Scalar>
ShapeHit<Scalar> SphereNarrowphase<Scalar>::hit(const SphereCandidate<Scalar>& candidate) const {
  ShapeHit<Scalar> hit;
  hit.triangle = candidate.id;
  hit.feature = candidate.contact.feature;
  hit.started_touching = candidate.contact.at_start;
  if (!try_round(sphere_, candidate.triangle, candidate.contact, hit)) {
    ++statistics_.exact_roundings;
    round_exactly(sphere_, candidate.triangle, candidate.contact, hit);
  }
  return hit;
}

template bool is_valid(const SweptSphere<float>&);
template bool is_valid(const SweptSphere<double>&);
template class SphereNarrowphase<float>;
template class SphereNarrowphase<double>;

}  // namespace surehit::detail
