#pragma once

#include <string>

#include "support/exact_mesh_oracle.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

/// Asks a collider everything about one path: first, any and all hits, singly, in a batch of one and with a filter, and
/// the last free point. Tells the first answer that is not the oracle's, with the path; nothing where all are.
template <typename Scalar>
[[nodiscard]] std::string collider_difference(const Collider<Scalar>& collider, const ExactMeshOracle<Scalar>& oracle,
                                              const Path<Scalar>& path, const QueryOptions<Scalar>& options);

}  // namespace surehit::test
