#include "moving_platforms/gun.hpp"

namespace surehit::example {

Shot Gun::shoot(std::size_t slot) { return {slot, slot % 4 == 0 ? bullet() : debris()}; }

Piece Gun::bullet() {
  Piece piece{.kind = Piece::Kind::bullet, .is_there = true};
  const bool is_left = between(0, 1) < 0.5f;
  const float inset = between(0.25f, 0.5f);
  piece.position = {is_left ? room_.low.x() + inset : room_.high.x() - inset, between(32.5f, 39.5f), between(35, 47)};
  piece.velocity = {is_left ? 80.0f : -80.0f, between(-24, 24), between(-24, 24)};
  return piece;
}

Piece Gun::debris() {
  Piece piece{.kind = Piece::Kind::debris, .is_there = true};
  piece.position = {between(32.5f, 63.5f), between(32.5f, 39.5f), between(47.25f, 47.75f)};
  piece.velocity = {between(-6, 6), between(-3, 3), between(-6, 0)};
  return piece;
}

}  // namespace surehit::example
