#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <vector>

#include "surehit/grid.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

using ExactPoint = std::array<mpq_class, 3>;
using ExactPolygon = std::vector<ExactPoint>;

/// x 2^exponent
[[nodiscard]] mpq_class scaled_exactly(double x, int exponent);
/// Where a point, and where a triangle's corners truly stand in a grid's frame.
template <typename Scalar>
[[nodiscard]] ExactPoint in_frame(const GridFrame& frame, const Vector3<Scalar>& point);
template <typename Scalar>
[[nodiscard]] ExactPolygon in_frame(const GridFrame& frame, const Triangle<Scalar>& triangle);

/// Indices, ascending, of the cells that the convex polygon meets when each cell is grown by `growth` on all sides.
[[nodiscard]] std::vector<std::size_t> cells_met(const GridFrame& frame, const ExactPolygon& polygon, double growth);

/// Whether the path, between two parameters, meets a cell that is grown by `growth` on all sides. The parameters may be
/// infinite.
template <typename Scalar>
[[nodiscard]] bool meets_cell(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t,
                              std::size_t cell, double growth);

}  // namespace surehit::test
