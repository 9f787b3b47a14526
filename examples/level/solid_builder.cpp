#include "level/solid_builder.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::example {
namespace {

float length(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

Point between(const Point& origin, const Point& u, float s, const Point& v, float t) {
  return {origin[0] + s * u[0] + t * v[0], origin[1] + s * u[1] + t * v[1], origin[2] + s * u[2] + t * v[2]};
}

float fraction(std::uint32_t part, std::uint32_t whole) { return static_cast<float>(part) / static_cast<float>(whole); }

}  // namespace

std::uint32_t SolidBuilder::pieces(float length) const {
  return std::max(1u, static_cast<std::uint32_t>(std::ceil(length / edge_)));
}

std::uint32_t SolidBuilder::add_vertex(const Point& vertex) {
  mesh_.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void SolidBuilder::add_quads(std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t near = first + row * (columns + 1) + column;
      const std::uint32_t far = near + columns + 1;
      // Diagonals alternate, so that a surface shows no grain.
      if ((row + column) % 2 == 0) {
        add_triangle(near, near + 1, far + 1);
        add_triangle(near, far + 1, far);
      } else {
        add_triangle(near, near + 1, far);
        add_triangle(near + 1, far + 1, far);
      }
    }
  }
}

void SolidBuilder::add_parallelogram(const Point& origin, const Point& u, const Point& v) {
  const std::uint32_t columns = pieces(length(u));
  const std::uint32_t rows = pieces(length(v));
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      add_vertex(between(origin, u, fraction(column, columns), v, fraction(row, rows)));
    }
  }
  add_quads(first, columns, rows);
}

void SolidBuilder::add_box(const Point& low, const Point& high) {
  const Point centre = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]};
  add_turned_box(centre, {high[0] - low[0], high[1] - low[1], high[2] - low[2]}, 1, 0);
}

void SolidBuilder::add_turned_box(const Point& base_centre, const Point& size, float cosine, float sine) {
  const Point x = {size[0] * cosine, size[0] * sine, 0};
  const Point y = {-size[1] * sine, size[1] * cosine, 0};
  const Point z = {0, 0, size[2]};
  const Point minus_x = {-x[0], -x[1], 0};
  const Point low = between(base_centre, x, -0.5f, y, -0.5f);
  const Point low_x = between(low, x, 1, y, 0);
  const Point low_y = between(low, x, 0, y, 1);
  add_parallelogram(low, y, x);
  add_parallelogram(between(low, z, 1, x, 0), x, y);
  add_parallelogram(low, x, z);
  add_parallelogram(between(low_x, y, 1, x, 0), minus_x, z);
  add_parallelogram(low_x, y, z);
  add_parallelogram(low_y, {-y[0], -y[1], 0}, z);
}

SolidBuilder::Circle SolidBuilder::circle(float radius) const {
  Circle directions = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  // Halving the angles takes a square root; sines would differ between platforms.
  const auto deserved = static_cast<std::size_t>(std::min(4096.0f, 12 * radius / edge_ + 4));
  while (directions.size() < deserved) {
    Circle finer;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto& here = directions[i];
      const auto& next = directions[(i + 1) % directions.size()];
      const float x = here[0] + next[0];
      const float y = here[1] + next[1];
      const float scale = 1 / std::sqrt(x * x + y * y);
      finer.push_back(here);
      finer.push_back({x * scale, y * scale});
    }
    directions = std::move(finer);
  }
  return directions;
}

void SolidBuilder::add_disc(const Circle& circle, const Point& centre, float radius, bool faces_up) {
  const std::uint32_t hub = add_vertex(centre);
  for (const auto& d : circle) add_vertex({centre[0] + radius * d[0], centre[1] + radius * d[1], centre[2]});
  const auto sides = static_cast<std::uint32_t>(circle.size());
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t here = hub + 1 + side;
    const std::uint32_t next = hub + 1 + (side + 1) % sides;
    add_triangle(hub, faces_up ? here : next, faces_up ? next : here);
  }
}

void SolidBuilder::add_round(const Point& base_centre, float height, float bottom_radius, float top_radius) {
  const Circle directions = circle(std::max(bottom_radius, top_radius));
  const auto sides = static_cast<std::uint32_t>(directions.size());
  const std::uint32_t rows = pieces(height);
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const float s = fraction(row, rows);
    const float radius = bottom_radius + s * (top_radius - bottom_radius);
    for (std::uint32_t side = 0; side <= sides; ++side) {
      const auto& d = directions[side % sides];
      add_vertex({base_centre[0] + radius * d[0], base_centre[1] + radius * d[1], base_centre[2] + s * height});
    }
  }
  add_quads(first, sides, rows);
  add_disc(directions, base_centre, bottom_radius, false);
  add_disc(directions, {base_centre[0], base_centre[1], base_centre[2] + height}, top_radius, true);
}

void SolidBuilder::add_surface(const std::vector<Point>& vertices, std::uint32_t columns, std::uint32_t rows) {
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  mesh_.vertices.insert(mesh_.vertices.end(), vertices.begin(), vertices.end());
  add_quads(first, columns, rows);
}

}  // namespace surehit::example
