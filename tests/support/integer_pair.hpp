#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"

namespace surehit::test {

using ExactIntegerVector = std::array<mpz_class, 3>;

/// A path and a triangle whose coordinates are whole numbers of one unit. Neither t nor a weight depends on the unit.
/// Rationals would lose time, because each of their sums and products is reduced by common divisors.
struct IntegerPair {
  PathKind kind;
  ExactIntegerVector start;
  ExactIntegerVector direction;  ///< The way from t = 0 to t = 1, of a segment too.
  std::array<ExactIntegerVector, 3> corners;
};

/// Where a path first meets a triangle, in rationals.
struct ExactContact {
  mpq_class t;
  mpq_class u;
  mpq_class v;
  Side side;
};

/// Returns the first contact by the meaning of a query alone. All options are doubles, as a float is one too. Masks and
/// ids say nothing here.
[[nodiscard]] std::optional<ExactContact> first_contact(IntegerPair pair, const QueryOptions<double>& options);

}  // namespace surehit::test
