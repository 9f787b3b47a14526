#pragma once

#include <optional>
#include <string>

#include "surehit_query/asked_mesh.hpp"
#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Saves the collider of the mesh that a request names, with its masks, to the output. Throws InputError.
void bake(const QueryRequest& request);

/// Loads the collider that was saved in the file that a request names. Returns nothing if the file does not begin as a
/// saved collider does. Throws InputError if it cannot be loaded, or if the request speaks of faces, which are not
/// saved.
template <typename Scalar>
[[nodiscard]] std::optional<Collider<Scalar>> load_baked(const QueryRequest& request);

}  // namespace surehit::example
