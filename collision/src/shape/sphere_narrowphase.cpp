#include "shape/sphere_narrowphase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "path_range.hpp"
#include "shape/bounded_sphere.hpp"
#include "shape/exact_sphere.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Scalar>
bool is_valid(const SweptSphere<Scalar>& sphere) {
  return is_finite(sphere.start) && is_finite(sphere.end) && std::isfinite(sphere.radius) && sphere.radius >= 0;
}

template <typename Scalar>
SphereNarrowphase<Scalar>::SphereNarrowphase(const SweptSphere<Scalar>& sphere,
                                             const ShapeQueryOptions<Scalar>& options, QueryStatistics& statistics)
    : sphere_(sphere), options_(options), statistics_(statistics) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    // Each bound is rounded once, so the next double beyond it is safe.
    low_[axis] = std::nextafter(double{std::min(sphere.start[i], sphere.end[i])} - double{sphere.radius}, -infinity);
    high_[axis] = std::nextafter(double{std::max(sphere.start[i], sphere.end[i])} + double{sphere.radius}, infinity);
  }
}

template <typename Scalar>
bool SphereNarrowphase<Scalar>::misses_box(const Triangle<Scalar>& triangle) const {
  const auto& [a, b, c] = triangle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    if (std::max({a[i], b[i], c[i]}) < low_[axis] || std::min({a[i], b[i], c[i]}) > high_[axis]) return true;
  }
  return false;
}

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
  if (misses_box(triangle)) return false;
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
