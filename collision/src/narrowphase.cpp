#include "narrowphase.hpp"

#include <algorithm>
#include <optional>

#include "exact/exact_contact.hpp"
#include "filter/bounded_contact.hpp"
#include "filter/corner_contact.hpp"
#include "filter/plane_contact.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Rounds a number between two bounds. Returns true if both bounds round to the same value (Ziv 1991).
template <typename Scalar>
bool try_round(double lower, double upper, Scalar& rounded) {
  rounded = static_cast<Scalar>(upper) + Scalar{0};  // A zero becomes +0.
  return static_cast<Scalar>(lower) == rounded;
}

}  // namespace

template <typename Scalar>
bool try_round(const BoundedContact& bounded, Hit<Scalar>& hit) {
  if (bounded.verdict != Verdict::hit) return false;
  const auto [min_u, max_u] = bounded.by_det.of(bounded.u_scaled);
  const auto [min_v, max_v] = bounded.by_det.of(bounded.v_scaled);
  return try_round(bounded.contact.t_lower, bounded.contact.t_upper, hit.t) && try_round(min_u, max_u, hit.u) &&
         try_round(min_v, max_v, hit.v);
}

template bool try_round(const BoundedContact&, Hit<float>&);
template bool try_round(const BoundedContact&, Hit<double>&);

template <typename Scalar>
bool share_axis_plane(const Triangle<Scalar>& x, const Triangle<Scalar>& y) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Scalar height = x.a[axis];
    if (x.b[axis] == height && x.c[axis] == height && y.a[axis] == height && y.b[axis] == height &&
        y.c[axis] == height) {
      return true;
    }
  }
  return false;
}

template bool share_axis_plane(const Triangle<float>&, const Triangle<float>&);
template bool share_axis_plane(const Triangle<double>&, const Triangle<double>&);

template <typename Scalar>
bool Narrowphase<Scalar>::find_contact(const Triangle<Scalar>& triangle, Contact& found, Closeness closeness) const {
  if (const CornerContact<Scalar> corner = corner_contact(path_, triangle, range_);
      corner.verdict != Verdict::undecided) {
    found = corner.contact;
    return corner.verdict == Verdict::hit && admits(options_, found);
  }
  BoundedContact bounded;
  if (closeness == Closeness::unknown) bounded = double_contact(path_, triangle, range_);
  if (bounded.verdict == Verdict::undecided) bounded = plane_contact(path_, triangle, range_);
  if (bounded.verdict == Verdict::miss) return false;
  found = bounded.contact;
  if (bounded.verdict == Verdict::undecided && !find_exactly(triangle, found)) return false;
  return admits(options_, found);
}

// The three functions with exact steps are not inlined, because their stack frames are large. The frames of the walk
// are on the stack at the same time.
template <typename Scalar>
SUREHIT_NOINLINE bool Narrowphase<Scalar>::find_exactly(const Triangle<Scalar>& triangle, Contact& found) const {
  std::optional<Contact> contact;
  if (!try_compact_contact(path_, triangle, range_, contact)) {
    const BoundedContact bounded = bounded_contact(path_, triangle, range_);
    found = bounded.contact;
    if (bounded.verdict != Verdict::undecided) return bounded.verdict == Verdict::hit;
    contact = exact_contact(path_, triangle, range_);
  }
  ++statistics_.exact_decisions;
  if (contact) found = *contact;
  return contact.has_value();
}

template <typename Scalar>
bool Narrowphase<Scalar>::comes_before(const Candidate<Scalar>& x, const Candidate<Scalar>& y) const {
  if (x.contact.t_upper < y.contact.t_lower) return true;
  if (y.contact.t_upper < x.contact.t_lower) return false;
  // Where a path starts in two triangles, both t are the begin of the range.
  if (x.contact.at_start && y.contact.at_start) return x.id < y.id;
  // In levels, most ties are floors that lie on floors. If neither contact is edge-on, the path crosses the plane, so
  // both t are equal.
  if (x.contact.side != Side::edge_on && y.contact.side != Side::edge_on) {
    // Where a path ends in two triangles, both t are 1.
    const bool share_end = x.contact.at_end && y.contact.at_end;
    if (share_end || share_axis_plane(x.triangle, y.triangle)) return x.id < y.id;
  }
  // Where the bounds of both contacts are one number, both t are this number.
  if (x.contact.t_lower == y.contact.t_upper && x.contact.t_upper == y.contact.t_lower) return x.id < y.id;
  return exactly_before(x, y);
}

template <typename Scalar>
SUREHIT_NOINLINE bool Narrowphase<Scalar>::exactly_before(const Candidate<Scalar>& x,
                                                          const Candidate<Scalar>& y) const {
  ++statistics_.exact_orders;
  const auto order = exact_order(path_, x.triangle, y.triangle, range_);
  return order != 0 ? order < 0 : x.id < y.id;
}

template <typename Scalar>
void Narrowphase<Scalar>::sort(std::vector<Candidate<Scalar>>& found) const {
  using One = Candidate<Scalar>;
  std::sort(found.begin(), found.end(), [](const One& x, const One& y) { return x.id < y.id; });
  const auto same_id = [](const One& x, const One& y) { return x.id == y.id; };
  found.erase(std::unique(found.begin(), found.end(), same_id), found.end());
  std::sort(found.begin(), found.end(), [&](const One& x, const One& y) { return comes_before(x, y); });
}

template <typename Scalar>
Hit<Scalar> Narrowphase<Scalar>::hit(const Candidate<Scalar>& candidate) const {
  Hit<Scalar> hit;
  hit.triangle = candidate.id;
  hit.side = candidate.contact.side;
  if (const CornerContact<Scalar> corner = corner_contact(path_, candidate.triangle, range_);
      corner.verdict == Verdict::hit) {
    hit.t = static_cast<Scalar>(corner.contact.t_lower);
    hit.u = corner.u;
    hit.v = corner.v;
    return hit;
  }
  const bool crosses = hit.side != Side::edge_on;
  if (!try_round(crosses ? double_contact(path_, candidate.triangle, range_)
                         : plane_contact(path_, candidate.triangle, range_),
                 hit)) {
    round_exactly(candidate, hit);
  }
  return hit;
}

template <typename Scalar>
SUREHIT_NOINLINE void Narrowphase<Scalar>::round_exactly(const Candidate<Scalar>& candidate, Hit<Scalar>& hit) const {
  const bool crosses = candidate.contact.side != Side::edge_on;
  if (crosses && try_round(bounded_contact(path_, candidate.triangle, range_), hit)) return;
  ++statistics_.exact_roundings;
  exact_rounding(path_, candidate.triangle, range_, hit);
}

template class Narrowphase<float>;
template class Narrowphase<double>;

}  // namespace surehit::detail
