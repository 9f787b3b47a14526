#include "game_physics/wall_check.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace surehit::example {
namespace {

int sign(__int128 value) { return (value > 0) - (value < 0); }

/// Whether three signs are all at least 0 or all at most 0.
bool agree(int a, int b, int c) { return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0; }

}  // namespace

WallCheck::WallCheck(const Arena& arena) : room_(arena.room) {
  if (!(room_.low.minCoeff() >= 32 && room_.high.maxCoeff() <= 64)) {
    throw std::invalid_argument("the room must lie in [32, 64] on each axis to be checked in integers");
  }
  for (std::size_t i = 0; i < arena.walls.triangles.size(); ++i) {
    Wall wall;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto& [x, y, z] = arena.walls.vertices[arena.walls.triangles[i][corner]];
      if (!room_.contains({x, y, z})) throw std::invalid_argument("wall " + std::to_string(i) + " leaves the room");
      wall.corners[corner] = on_lattice({x, y, z});
    }
    const auto& [a, b, c] = wall.corners;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wall.low[axis] = std::min({a[axis], b[axis], c[axis]});
      wall.high[axis] = std::max({a[axis], b[axis], c[axis]});
    }
    walls_.push_back(wall);
  }
}

bool WallCheck::is_breach(const Vector3f& from, const Vector3f& to) const {
  if (!room_.contains(from) || !room_.contains(to)) return true;
  const Lattice p = on_lattice(from);
  const Lattice q = on_lattice(to);
  Lattice low;
  Lattice high;
  for (std::size_t axis = 0; axis < 3; ++axis) std::tie(low[axis], high[axis]) = std::minmax(p[axis], q[axis]);
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (wall.high[axis] < low[axis] || high[axis] < wall.low[axis]) return false;
    }
    return touches(wall, p, q);
  });
}

std::optional<std::size_t> WallCheck::first_breach(std::span<const Vector3f> positions) const {
  for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
    if (is_breach(positions[i], positions[i + 1])) return i;
  }
  return std::nullopt;
}

WallCheck::Lattice WallCheck::on_lattice(const Vector3f& point) {
  const auto integer = [](float x) { return static_cast<std::int64_t>(x * 0x1p18f); };
  return {integer(point.x()), integer(point.y()), integer(point.z())};
}

/// On which side of the plane through a, b and c the point d lies; 0 on it. Differences are below 2^24, so that the
/// products of two fit 64 bits with room to spare, and those of three 128.
int WallCheck::side(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  const Lattice u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Lattice v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Lattice w = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
  return sign(static_cast<__int128>(u[1] * v[2] - u[2] * v[1]) * w[0] +
              static_cast<__int128>(u[2] * v[0] - u[0] * v[2]) * w[1] +
              static_cast<__int128>(u[0] * v[1] - u[1] * v[0]) * w[2]);
}

bool WallCheck::touches(const Wall& wall, const Lattice& from, const Lattice& to) {
  const auto& [a, b, c] = wall.corners;
  const int start = side(a, b, c, from);
  const int end = side(a, b, c, to);
  if (start * end > 0) return false;
  if (start == 0 && end == 0) return touches_in_plane(wall, from, to);
  return agree(side(from, to, a, b), side(from, to, b, c), side(from, to, c, a));
}

/// For a way in the wall's own plane, seen along an axis in which the wall does not vanish. The two miss each other
/// only if they are parted by a line along one of the wall's edges or along the way.
bool WallCheck::touches_in_plane(const Wall& wall, const Lattice& from, const Lattice& to) {
  const auto& [a, b, c] = wall.corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t x = (axis + 1) % 3;
    const std::size_t y = (axis + 2) % 3;
    const auto turn = [&](const Lattice& o, const Lattice& p, const Lattice& q) {
      return sign((p[x] - o[x]) * (q[y] - o[y]) - (p[y] - o[y]) * (q[x] - o[x]));
    };
    const int winding = turn(a, b, c);
    if (winding == 0) continue;
    const auto parted_by_edge = [&](const Lattice& o, const Lattice& p) {
      return turn(o, p, from) * winding < 0 && turn(o, p, to) * winding < 0;
    };
    const std::array<int, 3> corners = {turn(from, to, a), turn(from, to, b), turn(from, to, c)};
    const bool parted_by_way = std::abs(corners[0] + corners[1] + corners[2]) == 3;
    return !(parted_by_edge(a, b) || parted_by_edge(b, c) || parted_by_edge(c, a) || parted_by_way);
  }
  throw std::logic_error("a wall of the arena has no area");
}

}  // namespace surehit::example
