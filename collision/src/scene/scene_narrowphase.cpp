#include "scene/scene_narrowphase.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "exact/exact_contact.hpp"
#include "narrowphase.hpp"
#include "scene/placed_contact.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Scalar>
bool SceneNarrowphase<Scalar>::find_contact(const PlacedPath<Scalar>& path, PlacedCandidate<Scalar>& candidate) const {
  candidate.bounded = placed_contact(path, candidate.placed->frame.is_mirrored, candidate.local);
  if (candidate.bounded.verdict == Verdict::miss) return false;
  if (candidate.bounded.verdict == Verdict::undecided && !find_exactly(candidate)) return false;
  return admits(options_, candidate.bounded.contact);
}

template <typename Scalar>
bool SceneNarrowphase<Scalar>::find_certain(PlacedCandidate<Scalar>& candidate) const {
  const PlacedPath<Scalar> path(path_, candidate.placed->placement, candidate.placed->frame,
                                typename PlacedPath<Scalar>::Carefully());
  return find_contact(path, candidate);
}

template <typename Scalar>
SUREHIT_NOINLINE bool SceneNarrowphase<Scalar>::find_exactly(PlacedCandidate<Scalar>& candidate) const {
  const PlacedTriangle<Scalar> triangle = placed(candidate);
  std::optional<Contact> contact;
  if (!try_compact_contact(path_.path, triangle, path_.range, contact)) {
    candidate.bounded = bounded_contact(path_.path, triangle, path_.range);
    if (candidate.bounded.verdict != Verdict::undecided) return candidate.bounded.verdict == Verdict::hit;
    contact = exact_contact(path_.path, triangle, path_.range);
  }
  ++statistics_.exact_decisions;
  candidate.bounded.verdict = Verdict::undecided;
  if (contact) candidate.bounded.contact = *contact;
  return contact.has_value();
}

template <typename Scalar>
bool SceneNarrowphase<Scalar>::comes_before(const PlacedCandidate<Scalar>& x, const PlacedCandidate<Scalar>& y) const {
  const Contact& first = x.bounded.contact;
  const Contact& second = y.bounded.contact;
  if (first.t_upper < second.t_lower) return true;
  if (second.t_upper < first.t_lower) return false;
  const bool has_lower_id = std::tie(x.instance, x.id) < std::tie(y.instance, y.id);
  // Where a path starts in two triangles, both t are the begin of the range.
  if (first.at_start && second.at_start) return has_lower_id;
  const bool cross = first.side != Side::edge_on && second.side != Side::edge_on;
  if (cross && ((first.at_end && second.at_end) || (x.placed == y.placed && share_axis_plane(x.local, y.local)))) {
    return has_lower_id;
  }
  return exactly_before(x, y);
}

template <typename Scalar>
SUREHIT_NOINLINE bool SceneNarrowphase<Scalar>::exactly_before(const PlacedCandidate<Scalar>& x,
                                                               const PlacedCandidate<Scalar>& y) const {
  ++statistics_.exact_orders;
  const auto order = exact_order(path_.path, placed(x), placed(y), path_.range);
  return order != 0 ? order < 0 : std::tie(x.instance, x.id) < std::tie(y.instance, y.id);
}

template <typename Scalar>
void SceneNarrowphase<Scalar>::sort(std::vector<PlacedCandidate<Scalar>>& found) const {
  using One = PlacedCandidate<Scalar>;
  const auto ids = [](const One& x) { return std::tie(x.instance, x.id); };
  std::sort(found.begin(), found.end(), [&](const One& x, const One& y) { return ids(x) < ids(y); });
  found.erase(std::unique(found.begin(), found.end(), [&](const One& x, const One& y) { return ids(x) == ids(y); }),
              found.end());
  std::sort(found.begin(), found.end(), [&](const One& x, const One& y) { return comes_before(x, y); });
}

template <typename Scalar>
SceneHit<Scalar> SceneNarrowphase<Scalar>::hit(const PlacedCandidate<Scalar>& candidate,
                                               std::uint32_t generation) const {
  SceneHit<Scalar> hit;
  hit.triangle = candidate.id;
  hit.side = candidate.bounded.contact.side;
  hit.instance = {candidate.instance, generation};
  if (!detail::try_round<Scalar>(candidate.bounded, hit)) round_exactly(candidate, hit);
  return hit;
}

template <typename Scalar>
SUREHIT_NOINLINE void SceneNarrowphase<Scalar>::round_exactly(const PlacedCandidate<Scalar>& candidate,
                                                              Hit<Scalar>& hit) const {
  ++statistics_.exact_roundings;
  exact_rounding(path_.path, placed(candidate), path_.range, hit);
}

template class SceneNarrowphase<float>;
template class SceneNarrowphase<double>;

}  // namespace surehit::detail
