#include "support/listing_slack.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::test {

// Corners are off by 3 eps R, and the axes that are square to an edge by 8 eps R. This makes 12 eps R with a little
// room. The plane is off by its own slack on either side, which is a share of the normal. If the triangle is so thin
// that this says nothing, the axes of its longest edge keep it apart, except for its width.
double listing_slack(const ExactPolygon& triangle, double size) {
  constexpr double eps = 0x1p-24;
  std::array<std::array<double, 3>, 2> edges;
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = mpq_class(triangle[i][axis] - triangle[0][axis]).get_d();
    edges[0][axis] = x[1];
    edges[1][axis] = x[2];
    longest = std::max({longest, std::fabs(x[1]), std::fabs(x[2]), std::fabs(x[2] - x[1])});
  }
  double taxicab_length = 0;
  double squared_length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    const double component = edges[0][l] * edges[1][m] - edges[0][m] * edges[1][l];
    taxicab_length += std::fabs(component);
    squared_length += component * component;
  }
  const double axes = 12 * eps * size;
  if (taxicab_length == 0) return axes;
  const double plane = 2 * (64 * eps * longest * longest * longest / taxicab_length + 16 * eps * (size + longest));
  const double width = std::sqrt(squared_length) / longest;
  return axes + std::min(plane, width);
}

}  // namespace surehit::test
