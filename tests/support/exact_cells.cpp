#include "support/exact_cells.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace surehit::test {
namespace {

/// Keeps what lies where sign (x[axis] - plane) >= 0.
ExactPolygon cut(const ExactPolygon& polygon, std::size_t axis, const mpq_class& plane, int sign) {
  ExactPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactPoint& from = polygon[i];
    const ExactPoint& to = polygon[(i + 1) % polygon.size()];
    const mpq_class height = from[axis] - plane;
    const mpq_class to_height = to[axis] - plane;
    if (sign * sgn(height) >= 0) kept.push_back(from);
    if (sgn(height) * sgn(to_height) >= 0) continue;
    const mpq_class weight = height / (height - to_height);
    ExactPoint crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = from[k] + weight * (to[k] - from[k]);
    kept.push_back(crossing);
  }
  return kept;
}

std::array<mpq_class, 2> cell_range(const GridFrame& frame, std::size_t axis, std::uint32_t cell, double growth) {
  return {mpq_class(frame.plane(axis, cell)) - growth, mpq_class(frame.plane(axis, cell + 1)) + growth};
}

}  // namespace

mpq_class scaled_exactly(double x, int exponent) {
  mpq_class scaled = x;
  if (exponent >= 0) {
    mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return scaled;
}

template <typename Scalar>
ExactPoint in_frame(const GridFrame& frame, const Vector3<Scalar>& point) {
  ExactPoint exact;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    exact[axis] = scaled_exactly(point[static_cast<Eigen::Index>(axis)], frame.exponent) - frame.origin[axis];
  }
  return exact;
}

template <typename Scalar>
ExactPolygon in_frame(const GridFrame& frame, const Triangle<Scalar>& triangle) {
  return {in_frame(frame, triangle.a), in_frame(frame, triangle.b), in_frame(frame, triangle.c)};
}

std::vector<std::size_t> cells_met(const GridFrame& frame, const ExactPolygon& polygon, double growth) {
  std::vector<std::size_t> cells;
  const auto& [cells_x, cells_y, cells_z] = frame.resolution;
  const auto part_in = [&](const ExactPolygon& whole, std::size_t axis, std::uint32_t cell) {
    const auto [low, high] = cell_range(frame, axis, cell, growth);
    return cut(cut(whole, axis, low, 1), axis, high, -1);
  };
  for (std::uint32_t x = 0; x < cells_x; ++x) {
    const ExactPolygon slab = part_in(polygon, 0, x);
    for (std::uint32_t y = 0; !slab.empty() && y < cells_y; ++y) {
      const ExactPolygon bar = part_in(slab, 1, y);
      for (std::uint32_t z = 0; !bar.empty() && z < cells_z; ++z) {
        const auto [low, high] = cell_range(frame, 2, z, growth);
        const auto [lowest, highest] = std::minmax_element(
            bar.begin(), bar.end(), [](const ExactPoint& p, const ExactPoint& q) { return p[2] < q[2]; });
        if ((*highest)[2] < low || high < (*lowest)[2]) continue;
        cells.push_back((std::size_t{z} * cells_y + y) * cells_x + x);
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <typename Scalar>
bool meets_cell(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t, std::size_t cell,
                double growth) {
  const auto& [cells_x, cells_y, cells_z] = frame.resolution;
  const std::array<std::size_t, 3> place = {cell % cells_x, cell / cells_x % cells_y, cell / cells_x / cells_y};
  const ExactPoint start = in_frame(frame, path.start);
  std::optional<mpq_class> first;
  std::optional<mpq_class> last;
  if (std::isfinite(first_t)) first = first_t;
  if (std::isfinite(last_t)) last = last_t;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto toward = path.toward[static_cast<Eigen::Index>(axis)];
    const mpq_class rate = path.has_end() ? scaled_exactly(toward, frame.exponent) - frame.origin[axis] - start[axis]
                                          : scaled_exactly(toward, frame.exponent);
    const auto [low, high] = cell_range(frame, axis, static_cast<std::uint32_t>(place[axis]), growth);
    if (rate == 0) {
      if (start[axis] < low || high < start[axis]) return false;
      continue;
    }
    mpq_class enters = (low - start[axis]) / rate;
    mpq_class leaves = (high - start[axis]) / rate;
    if (rate < 0) std::swap(enters, leaves);
    if (!first || *first < enters) first = enters;
    if (!last || *last > leaves) last = leaves;
  }
  return !first || !last || *first <= *last;
}

#define SUREHIT_INSTANTIATE(Scalar)                                          \
  template ExactPoint in_frame(const GridFrame&, const Vector3<Scalar>&);    \
  template ExactPolygon in_frame(const GridFrame&, const Triangle<Scalar>&); \
  template bool meets_cell(const GridFrame&, const Path<Scalar>&, double, double, std::size_t, double);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
