#include "game_physics/exact_sweep.hpp"

namespace surehit::example {

std::optional<Contact> ExactSweep::first_contact(const Segmentf& move) const {
  const auto hit = collider_.first_hit(move);
  if (!hit) return std::nullopt;
  return Contact{hit->triangle, hit->side, hit->t, collider_.last_free_point(move, *hit)};
}

}  // namespace surehit::example
