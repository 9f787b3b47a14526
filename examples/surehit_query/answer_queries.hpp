#pragma once

#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Reads what the request names, asks the library and writes the answers as CSV. Throws InputError for bad input and
/// std::system_error where the output cannot be written; no output file is left behind then.
void answer_queries(const QueryRequest& request);

}  // namespace surehit::example
