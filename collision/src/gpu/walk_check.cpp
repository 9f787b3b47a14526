#include "gpu/walk_check.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace surehit::detail {
namespace {

/// Draws numbers that are the same everywhere.
class CheckDrawer {
 public:
  /// Returns a number in [-1, 1), in steps of 2^-23.
  float number() {
    bits_ = bits_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<float>(static_cast<std::int32_t>(bits_ >> 40) - (1 << 23)) * 0x1p-23F;
  }
  /// Returns a number of quarters in [-limit, limit].
  float quarters(std::uint32_t limit) {
    bits_ = bits_ * 6364136223846793005U + 1442695040888963407U;
    const std::uint64_t place = (bits_ >> 33) % (8 * std::uint64_t{limit} + 1);
    return static_cast<float>(place) * 0.25F - static_cast<float>(limit);
  }
  Vector3f point() {
    const float x = number();
    const float y = number();
    return {x, y, number()};
  }

 private:
  std::uint64_t bits_ = 1;
};

bool is_same(const Hitf& x, const Hitf& y) {
  const auto bits = [](const Hitf& hit) {
    return std::array{std::bit_cast<std::uint32_t>(hit.t), std::bit_cast<std::uint32_t>(hit.u),
                      std::bit_cast<std::uint32_t>(hit.v), hit.triangle, static_cast<std::uint32_t>(hit.side)};
  };
  return bits(x) == bits(y);
}

}  // namespace

bool is_right(const DeviceHit& hit, const Hitf& expected, std::size_t triangle_count) {
  switch (leftover_of(hit, triangle_count)) {
    case Leftover::nothing_of_miss:
      return expected.triangle == no_triangle;
    case Leftover::nothing_of_hit:
      return is_same(answer_of(hit), expected);
    case Leftover::rounding:
      return hit.triangle == expected.triangle;
    case Leftover::all:
      break;
  }
  return hit.side == DeviceHit::undecided;
}

bool is_right(DeviceAny blocked, bool expected) {
  constexpr DeviceAny undecided = 2;
  return blocked == undecided || blocked == (expected ? 1U : 0U);
}

WalkCheck::WalkCheck() {
  constexpr std::size_t needles = 24;
  CheckDrawer drawer;
  std::vector<Vector3f> corners;
  // Needles all around.
  for (std::size_t i = 0; i < needles; ++i) {
    const Vector3f a = drawer.point();
    const Vector3f b = drawer.point();
    corners.insert(corners.end(), {a, b, Vector3f((a + b) / 2 + 0x1p-9F * drawer.point())});
  }
  // A box, whose faces have two triangles each.
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const float side : {-0.5F, 0.5F}) {
      const auto corner = [&](float u, float v) {
        Vector3f point;
        point[axis] = side;
        point[(axis + 1) % 3] = u;
        point[(axis + 2) % 3] = v;
        return point;
      };
      const Vector3f a = corner(-0.5F, -0.5F);
      const Vector3f c = corner(0.5F, 0.5F);
      corners.insert(corners.end(), {a, corner(0.5F, -0.5F), c, a, c, corner(-0.5F, 0.5F)});
    }
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < corners.size(); i += 3) triangles.push_back({i, i + 1, i + 2});
  collider = Colliderf(TriangleMeshViewf(corners, triangles));
  tree = TriangleTree(collider);
  // Through points of edges of needles, rounded. Nothing is in the way of short paths.
  for (std::size_t i = 0; i < 3 * needles; ++i) {
    const Vector3f a = corners[i];
    const Vector3f b = corners[i % 3 == 2 ? i - 2 : i + 1];
    const Vector3f at = (a + b + b) / 3;
    for (const float length : {0.0625F, 1.0F}) {
      const Vector3f start = at + length * drawer.point();
      paths.push_back({start, 2 * at - start});
    }
  }
  // From quarters to quarters: many meet edges and corners of the box, and some lie in its faces.
  for (int i = 0; i < 112; ++i) {
    Segmentf path;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      path.start[axis] = drawer.quarters(2);
      path.end[axis] = drawer.quarters(1);
    }
    if (i % 4 == 0) path.start[i % 3] = path.end[i % 3] = i % 8 == 0 ? 0.5F : -0.5F;
    paths.push_back(path);
  }
  expected.resize(paths.size());
  collider.first_hits(paths, expected);
}

std::optional<std::string> WalkCheck::fault(std::span<const DeviceHit> hits, std::span<const DeviceAny> blocked) const {
  if (hits.size() != paths.size() || blocked.size() != paths.size()) return "it answers too few paths";
  char text[240];
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const bool is_hit = expected[i].triangle != no_triangle;
    if (!is_right(hits[i], expected[i], collider.triangle_count())) {
      const DeviceHit& hit = hits[i];
      const Hitf& right = expected[i];
      std::snprintf(text, sizeof text,
                    "it answers path %zu of a check by triangle %u with %a, %a and %a, not by %u with %a, %a and %a", i,
                    hit.triangle, double{hit.t}, double{hit.u}, double{hit.v}, right.triangle, double{right.t},
                    double{right.u}, double{right.v});
      return text;
    }
    if (!is_right(blocked[i], is_hit)) {
      std::snprintf(text, sizeof text, "it answers %u whether path %zu of a check hits anything, not %d", blocked[i], i,
                    is_hit ? 1 : 0);
      return text;
    }
  }
  return std::nullopt;
}

}  // namespace surehit::detail
