#pragma once

#include <string>

#include "support/random.hpp"
#include "support/sphere_families.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit::test {

/// Returns what the text calls a part of a triangle.
[[nodiscard]] std::string name_of(Feature feature);

/// Draws the next case of a family, and returns its line without an end: the ball, the triangle, and what is true of
/// them. README.md describes it.
template <typename Scalar>
[[nodiscard]] std::string draw_swept_case(SphereFamily family, Random& random);

/// Returns the seed of a family's cases in a file of cases with this seed. So each family has cases of its own.
[[nodiscard]] std::uint64_t seed_of(SphereFamily family, std::uint64_t seed);

}  // namespace surehit::test
