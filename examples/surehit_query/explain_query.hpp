#pragma once

#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Reads what the request names, and writes the whole way of one path, as text and as drawings. Throws InputError for
/// bad input and std::system_error where a file cannot be written; no file is left behind then.
void explain_query(const QueryRequest& request);

}  // namespace surehit::example
