#pragma once

#include <gtest/gtest.h>

#include <cstddef>

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

}  // namespace surehit::test
