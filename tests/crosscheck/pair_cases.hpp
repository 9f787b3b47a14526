#pragma once

#include <cstddef>

#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/random.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {

/// The cases of one family, the same in every test that asks for them. `visit(path, triangle, options)` is called for
/// each.
template <typename Scalar, typename Visit>
void visit_segments(PairFamily family, const Visit& visit) {
  Random random(1);
  for (std::size_t i = case_count(50'000); i > 0; --i) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    visit(Path<Scalar>(segment), triangle, QueryOptions<Scalar>{});
  }
}

template <typename Scalar, typename Visit>
void visit_rays_and_lines(PairFamily family, const Visit& visit) {
  Random random(2);
  for (std::size_t i = case_count(25'000); i > 0; --i) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    for (const PathKind kind : {PathKind::ray, PathKind::line}) {
      visit(path_along(segment, kind), triangle, QueryOptions<Scalar>{});
    }
  }
}

template <typename Scalar, typename Visit>
void visit_options(PairFamily family, const Visit& visit) {
  Random random(3);
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const Path<Scalar> path = path_along(segment, kind);
      const auto unlimited = intersect(path, triangle);
      visit(path, triangle, draw_options(random, unlimited ? unlimited->t : random.unit<Scalar>()));
    }
  }
}

}  // namespace surehit::test
