#pragma once

#include <string>
#include <surehit/explain.hpp>

namespace surehit::example {

/// Returns the whole way of a query in lines for people to read.
template <typename Scalar>
[[nodiscard]] std::string text_of(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                                  const Explanation<Scalar>& explanation);

}  // namespace surehit::example
