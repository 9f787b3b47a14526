#include "character/exact_capsule_sweep.hpp"

#include <cmath>

namespace surehit::example {
namespace {

/// The largest gap between neighbouring floats at coordinates below 128.
constexpr float ulp = 0x1p-17f;
/// The last one moves off the surface by 4 millimetres.
constexpr int max_proposals = 11;

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
  Stop stop{from, normal, is_off_face(normal, collider_.normal(hit->triangle))};
  const Vector3f last_free = from + collider_.last_free_t(way, *hit) * (to - from);
  for (int i = 0; i < max_proposals; ++i) {
    const float back = i == 0 ? 0 : std::ldexp(ulp, i - 1);
    const Vector3f proposal = last_free + back * normal;
    if (proposal == from) break;
    ++queries;
    if (collider_.any_hit(way_of_body(from, proposal))) continue;
    stop.position = proposal;
    break;
  }
  return stop;
}

}  // namespace surehit::example
