#pragma once

#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Answers where moving shapes first touch triangles, for the questions pair, first, any and all. Throws InputError.
void answer_shapes(const QueryRequest& request);

}  // namespace surehit::example
