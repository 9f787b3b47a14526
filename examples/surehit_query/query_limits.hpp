#pragma once

#include <cmath>
#include <string>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Returns a limit of t that an option gives. Throws InputError, which names the option.
template <typename Scalar>
[[nodiscard]] Scalar parse_limit(const char* option, const std::string& text) {
  try {
    const auto limit = parse_number_or_non_finite<Scalar>(text);
    if (std::isnan(limit)) throw InputError(example::quoted(text) + " is not a number");
    return limit;
  } catch (const InputError& error) {
    throw error.at(option);
  }
}

/// Returns options with what narrows any query: of a pair, a mesh or a scene. Throws InputError.
template <typename Options>
[[nodiscard]] Options limits_of(const QueryRequest& request) {
  Options options;
  using Scalar = decltype(options.min_t);
  options.min_t = parse_limit<Scalar>("--min-t", request.min_t);
  options.max_t = parse_limit<Scalar>("--max-t", request.max_t);
  options.culling = request.culling;
  options.ignore_start_contact = request.ignore_start_contact;
  options.ignore_end_contact = request.ignore_end_contact;
  return options;
}

}  // namespace surehit::example
