#include "level/terrain.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::example {
namespace {

/// A number in [0, 1) that belongs to a lattice point.
float lattice_value(std::int32_t x, std::int32_t y) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24f;
}

float smooth(float s) { return s * s * (3 - 2 * s); }

/// Values of the lattice points, blended smoothly between them.
float value_noise(float x, float y) {
  const float column = std::floor(x);
  const float row = std::floor(y);
  const float s = smooth(x - column);
  const float t = smooth(y - row);
  const auto i = static_cast<std::int32_t>(column);
  const auto j = static_cast<std::int32_t>(row);
  const float near = lattice_value(i, j) + s * (lattice_value(i + 1, j) - lattice_value(i, j));
  const float far = lattice_value(i, j + 1) + s * (lattice_value(i + 1, j + 1) - lattice_value(i, j + 1));
  return near + t * (far - near);
}

}  // namespace

Terrain::Terrain(const std::array<float, 2>& low, const std::array<float, 2>& high,
                 const std::array<float, 2>& plateau_low, const std::array<float, 2>& plateau_high,
                 float plateau_height)
    : low_(low), high_(high), plateau_low_(plateau_low), plateau_high_(plateau_high), plateau_height_(plateau_height) {}

float Terrain::height_at(float x, float y) const {
  const float dx = std::max({plateau_low_[0] - x, x - plateau_high_[0], 0.0f});
  const float dy = std::max({plateau_low_[1] - y, y - plateau_high_[1], 0.0f});
  const float wildness = smooth(std::min(1.0f, std::sqrt(dx * dx + dy * dy) / 10));
  const float hills = 7.0f * (value_noise(x / 11, y / 11) - 0.42f);
  const float bumps = 0.6f * (value_noise(x / 2.5f + 40, y / 2.5f + 40) - 0.5f);
  return plateau_height_ + wildness * (hills + bumps);
}

void Terrain::add_to(SolidBuilder& builder) const {
  const std::uint32_t columns = builder.pieces(high_[0] - low_[0]);
  const std::uint32_t rows = builder.pieces(high_[1] - low_[1]);
  std::vector<Point> vertices;
  vertices.reserve(std::size_t{columns + 1} * (rows + 1));
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const float y = low_[1] + (high_[1] - low_[1]) * (static_cast<float>(row) / static_cast<float>(rows));
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const float x = low_[0] + (high_[0] - low_[0]) * (static_cast<float>(column) / static_cast<float>(columns));
      vertices.push_back({x, y, height_at(x, y)});
    }
  }
  builder.add_surface(vertices, columns, rows);
}

}  // namespace surehit::example
