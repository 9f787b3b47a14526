#pragma once

#include <string>

#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

struct PairVerdict {
  bool meets = false;      ///< by the rationals
  std::string difference;  ///< the pair and what each says of it; empty where all agree
};

/// Three judges, one pair: CGAL says whether they meet, the rationals say that and where, and the library must agree
/// with both in every bit. CGAL is not asked about what is not finite.
template <typename Scalar>
[[nodiscard]] PairVerdict judge_pair(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                     const QueryOptions<Scalar>& options);

}  // namespace surehit::test
