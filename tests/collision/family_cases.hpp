#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// Calls `visit(path, triangle, options)` for pairs of a family, each as a segment, a ray and a line, without options
/// and with some that are drawn; up to the first failure.
template <typename Scalar, typename Visit>
void visit_family(PairFamily family, std::uint64_t seed, std::size_t pairs, const Visit& visit) {
  Random random(seed);
  for (std::size_t i = case_count(pairs); i > 0 && !testing::Test::HasFailure(); --i) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const Path<Scalar> path = path_along(segment, kind);
      visit(path, triangle, QueryOptions<Scalar>{});
      visit(path, triangle, draw_options(random, random.unit<Scalar>()));
    }
  }
}

/// Up to 35 pairs of a family: segments, and the triangles that were drawn for them.
template <typename Scalar>
struct FamilyList {
  FamilyList(PairFamily family, Random& random) : segments(1 + random.below(35)), triangles(segments.size()) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto pair = draw_pair<Scalar>(family, random);
      segments[i] = pair.segment;
      triangles[i] = pair.triangle;
    }
  }

  std::vector<Segment<Scalar>> segments;
  std::vector<Triangle<Scalar>> triangles;
};

}  // namespace surehit::test
