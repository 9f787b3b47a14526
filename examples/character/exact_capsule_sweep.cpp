#include "character/exact_capsule_sweep.hpp"

namespace surehit::example {
namespace {

SweptCapsulef way_of_body(const Vector3f& from, const Vector3f& to) {
  return {from, to, Body::half_axis(), Body::radius};
}

}  // namespace

std::optional<Stop> ExactCapsuleSweep::find_stop(const Vector3f& from, const Vector3f& to, std::size_t& queries) const {
  const SweptCapsulef way = way_of_body(from, to);
  ++queries;
  const auto hit = collider_.first_hit(way);
  if (!hit) return std::nullopt;
  const Vector3f normal = contact_normal<float>(way, collider_.triangle(hit->triangle));
  ++queries;
  return Stop{collider_.last_free_point(way, *hit), normal, is_off_face(normal, collider_.normal(hit->triangle))};
}

}  // namespace surehit::example
