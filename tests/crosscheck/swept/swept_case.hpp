#pragma once

#include <string>

#include "support/random.hpp"
#include "support/shape_families.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit::test {

/// Returns what the text calls a part of a triangle.
[[nodiscard]] std::string name_of(Feature feature);

/// Draws the next case of a family, and returns its line without an end: the shape, the triangle, and what is true of
/// them. README.md describes it.
template <typename Scalar, typename Family>
[[nodiscard]] std::string draw_swept_case(Family family, Random& random);

/// Returns the seed of a family's cases in a file of cases with this seed. So each family has cases of its own.
template <typename Family>
[[nodiscard]] std::uint64_t seed_of(Family family, std::uint64_t seed) {
  return Random(seed).bits() + static_cast<std::uint64_t>(family);
}

}  // namespace surehit::test
