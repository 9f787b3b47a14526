#pragma once

#include <optional>
#include <vector>

#include "support/neighbour.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit::test {

/// Returns answers that are wrong in one field, by as little as can be. A judge must refuse all of them.
template <typename Scalar>
[[nodiscard]] std::vector<std::optional<ShapeHit<Scalar>>> wrong_answers(const std::optional<ShapeHit<Scalar>>& right) {
  using Hit = ShapeHit<Scalar>;
  if (!right) return {Hit{.triangle = 0}};
  std::vector<std::optional<Hit>> answers = {std::nullopt};
  for (Scalar Hit::*field : {&Hit::t, &Hit::u, &Hit::v}) {
    for (const int steps : {-1, 1}) {
      Hit wrong = *right;
      wrong.*field = neighbour(wrong.*field, steps);
      answers.push_back(wrong);
    }
  }
  Hit wrong = *right;
  wrong.feature = wrong.feature == Feature::face ? Feature::edge_ab : Feature::face;
  answers.push_back(wrong);
  wrong = *right;
  wrong.started_touching = !wrong.started_touching;
  answers.push_back(wrong);
  return answers;
}

}  // namespace surehit::test
