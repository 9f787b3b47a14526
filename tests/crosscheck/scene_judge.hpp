#pragma once

#include <string>
#include <vector>

#include "support/scene_oracle.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {

/// What is asked of a scene about one path.
template <typename Scalar>
struct SceneQuestion {
  Path<Scalar> path;
  SceneQueryOptions<Scalar> options = {};
};

/// Asks a scene each question in every way that there is: first, any and all hits, with a filter and without, in
/// batches too, and last free points. Returns the first answer that is not the oracle's, with its question, or nothing.
template <typename Scalar>
[[nodiscard]] std::string scene_difference(const Scene<Scalar>& scene, const SceneOracle<Scalar>& oracle,
                                           const std::vector<SceneQuestion<Scalar>>& questions);

}  // namespace surehit::test
