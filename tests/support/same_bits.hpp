#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "surehit/hit.hpp"
#include "surehit/scene_hit.hpp"

namespace surehit::test {

/// Equality that tells -0 from +0, which operator== does not.
template <typename Scalar>
bool same_bits(Scalar left, Scalar right) {
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<Bits>(left) == std::bit_cast<Bits>(right);
}

template <typename Scalar>
bool same_bits(const Hit<Scalar>& left, const Hit<Scalar>& right) {
  return same_bits(left.t, right.t) && same_bits(left.u, right.u) && same_bits(left.v, right.v) &&
         left.triangle == right.triangle && left.side == right.side;
}

template <typename Scalar>
bool same_bits(const SceneHit<Scalar>& left, const SceneHit<Scalar>& right) {
  return same_bits<Scalar>(static_cast<const Hit<Scalar>&>(left), static_cast<const Hit<Scalar>&>(right)) &&
         left.instance == right.instance;
}

}  // namespace surehit::test
