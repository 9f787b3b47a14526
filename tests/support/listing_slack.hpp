#pragma once

#include "support/exact_cells.hpp"

namespace surehit::test {

/// By how many finest cells a triangle may miss a cell grown by the padding and yet be listed there: what the roundings
/// of the tests of separating axes may add, for coordinates up to `size`.
[[nodiscard]] double listing_slack(const ExactPolygon& triangle, double size);

}  // namespace surehit::test
