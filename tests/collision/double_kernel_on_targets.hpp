#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bounded.hpp"

namespace surehit::test {

/// Of a path from a start in a direction, and of corners a, b and c: three coordinates each.
using PairCoordinates = std::array<double, 15>;

struct LaneDeterminants {
  detail::Bounded det, height, u, v;
};

/// `detail::DoubleDeterminants` on the instruction set that is chosen at the moment, as many pairs at a time as it has
/// lanes.
void double_determinants(std::span<const PairCoordinates> pairs, std::span<LaneDeterminants> results);

/// `detail::Quotients` there: [lower, upper] of each numerator by the denominator of the same index.
void quotients(std::span<const detail::Bounded> numerators, std::span<const detail::Bounded> denominators,
               std::span<std::array<double, 2>> results);

[[nodiscard]] std::size_t double_lanes();

}  // namespace surehit::test
