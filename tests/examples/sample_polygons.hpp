#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <surehit/collider.hpp>
#include <utility>
#include <vector>

#include "mesh_io/mesh.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// A point of whole numbers in a polygon's own plane.
using Spot = std::array<std::int64_t, 2>;
using Position = std::array<std::int64_t, 3>;

/// Corners are indices into `spots`. An outline may pass a spot twice.
struct SamplePolygon {
  std::string name;
  std::vector<Spot> spots;
  std::vector<std::uint32_t> corners;
};

/// A face of a file, and the file's vertices.
struct SampleFace {
  std::vector<Position> vertices;
  std::vector<std::uint32_t> corners;
};

/// Where a polygon's own plane is in space.
struct SamplePlane {
  std::string name;
  Position origin, along_x, along_y;
  Position across;                        ///< at right angles to both
  std::vector<std::int64_t> bends = {0};  ///< how far vertices are moved across, in turn
};

// Those that are made of others are not inline: only then is their order that of the file with every compiler.
const SamplePolygon dart = {"dart", {{-4, 4}, {0, 0}, {4, 4}, {0, 2}}, {0, 1, 2, 3}};
const SamplePolygon l_shape = {"L", {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {0, 1, 2, 3, 4, 5}};
/// A bridge from its first corner leads round a window and back.
const SamplePolygon keyholed_wall = {
    "keyholed wall", {{0, 0}, {6, 0}, {6, 4}, {0, 4}, {2, 1}, {2, 3}, {4, 3}, {4, 1}}, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}};
const SamplePolygon wall_of_two_windows = {
    "wall of two windows",
    {{0, 0}, {9, 0}, {9, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {5, 1}, {5, 3}, {8, 3}, {8, 1}},
    {0, 1, 2, 3, 0, 4, 5, 6, 7, 8, 9, 10, 11, 8, 7, 4}};
const SamplePolygon comb = {
    "comb",
    {{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {5, 1}, {4, 4}, {3, 1}, {2, 1}, {2, 5}, {1, 5}, {1, 1}, {0, 1}},
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
const SamplePolygon spiral = {
    "spiral",
    {{0, 0}, {7, 0}, {7, 7}, {1, 7}, {1, 3}, {4, 3}, {4, 4}, {2, 4}, {2, 6}, {6, 6}, {6, 1}, {0, 1}},
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
const SamplePolygon cross = {
    "cross",
    {{2, 0}, {4, 0}, {4, 2}, {6, 2}, {6, 4}, {4, 4}, {4, 6}, {2, 6}, {2, 4}, {0, 4}, {0, 2}, {2, 2}},
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
/// Corners in one line, on convex and on concave sides, and a corner twice.
const SamplePolygon arrow_of_needless_corners = {
    "arrow of needless corners",
    {{0, 0}, {3, 1}, {6, 2}, {6, 2}, {3, 3}, {0, 4}, {1, 3}, {2, 2}, {1, 1}},
    {0, 1, 2, 3, 4, 5, 6, 7, 8}};

const std::vector<SamplePolygon> sample_polygons = {dart, l_shape, keyholed_wall, wall_of_two_windows,
                                                    comb, spiral,  cross,         arrow_of_needless_corners};

const SamplePlane floor_plane = {"floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
/// The plane of the walls that look along y.
const SamplePlane wall_plane = {"wall", {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
const std::vector<SamplePlane> sample_planes = {
    floor_plane,
    wall_plane,
    {"side wall", {5, -9, 1}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
    {"tilted", {7, -3, 2}, {2, 1, -1}, {-1, 3, 1}, {4, -1, 7}},
    {"bent floor", {0, 0, 3}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {0, 1, -1}},
};

inline SamplePolygon begun_at(std::size_t corner, SamplePolygon polygon) {
  std::rotate(polygon.corners.begin(), polygon.corners.begin() + static_cast<std::ptrdiff_t>(corner),
              polygon.corners.end());
  return polygon;
}

inline SamplePolygon turned_round(SamplePolygon polygon) {
  std::reverse(polygon.corners.begin(), polygon.corners.end());
  return polygon;
}

/// Sees all of its outline from a point inside, and is concave in most cases.
inline SamplePolygon random_star(Random& random) {
  SamplePolygon star = {"star", {{9, 0}, {0, 9}, {-9, 0}, {0, -9}}, {}};
  for (std::uint64_t i = 2 + random.below(12); i > 0; --i)
    star.spots.push_back({random.between(-9, 9), random.between(-9, 9)});
  std::erase(star.spots, Spot{0, 0});
  const auto is_lower = [](const Spot& spot) { return spot[1] < 0 || (spot[1] == 0 && spot[0] < 0); };
  const auto is_before = [&](const Spot& a, const Spot& b) {
    if (is_lower(a) != is_lower(b)) return is_lower(b);
    return a[0] * b[1] - a[1] * b[0] > 0;
  };
  const auto is_level = [&](const Spot& a, const Spot& b) { return !is_before(a, b) && !is_before(b, a); };
  std::stable_sort(star.spots.begin(), star.spots.end(), is_before);
  star.spots.erase(std::unique(star.spots.begin(), star.spots.end(), is_level), star.spots.end());
  for (std::uint32_t i = 0; i < star.spots.size(); ++i) star.corners.push_back(i);
  return star;
}

/// Whether the outline passes the spot, or winds round it by the even-odd rule: exactly, `scale` spots to a unit.
inline bool is_closed_over(const SamplePolygon& polygon, std::int64_t scale, const Spot& spot) {
  bool is_odd = false;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    Spot a = polygon.spots[polygon.corners[i]];
    Spot b = polygon.spots[polygon.corners[(i + 1) % polygon.corners.size()]];
    for (std::int64_t* number : {&a[0], &a[1], &b[0], &b[1]}) *number *= scale;
    const std::int64_t turn = (b[0] - a[0]) * (spot[1] - a[1]) - (b[1] - a[1]) * (spot[0] - a[0]);
    const auto is_within = [&](std::size_t axis) {
      return std::min(a[axis], b[axis]) <= spot[axis] && spot[axis] <= std::max(a[axis], b[axis]);
    };
    if (turn == 0 && is_within(0) && is_within(1)) return true;
    if ((a[1] > spot[1]) != (b[1] > spot[1])) is_odd ^= (turn > 0) == (b[1] > a[1]);
  }
  return is_odd;
}

inline Position placed(const SamplePlane& plane, const Spot& spot, std::int64_t scale, std::int64_t across) {
  Position position;
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] =
        scale * plane.origin[i] + spot[0] * plane.along_x[i] + spot[1] * plane.along_y[i] + across * plane.across[i];
  }
  return position;
}

/// The number of units of space for one of a polygon's own. It is above 1, so whole numbers lie between the corners.
inline constexpr std::int64_t sample_scale = 6;

inline SampleFace placed(const SamplePlane& plane, const SamplePolygon& polygon) {
  SampleFace face = {{}, polygon.corners};
  for (std::size_t i = 0; i < polygon.spots.size(); ++i) {
    const Spot& spot = polygon.spots[i];
    face.vertices.push_back(placed(plane, {sample_scale * spot[0], sample_scale * spot[1]}, sample_scale,
                                   plane.bends[i % plane.bends.size()]));
  }
  return face;
}

struct JudgedSpot {
  Spot spot;
  bool is_closed;
};

/// Spots all over the polygon and around it, some of them on its outline.
inline std::vector<JudgedSpot> judged_spots(const SamplePolygon& polygon) {
  const auto [min_x, max_x] = std::minmax_element(polygon.spots.begin(), polygon.spots.end());
  const auto [min_y, max_y] = std::minmax_element(polygon.spots.begin(), polygon.spots.end(),
                                                  [](const Spot& a, const Spot& b) { return a[1] < b[1]; });
  std::vector<JudgedSpot> judged;
  for (std::int64_t x = sample_scale * (*min_x)[0] - 1; x <= sample_scale * (*max_x)[0] + 1; x += 2) {
    for (std::int64_t y = sample_scale * (*min_y)[1] - 3; y <= sample_scale * (*max_y)[1] + 3; y += 3) {
      judged.push_back({{x, y}, is_closed_over(polygon, sample_scale, {x, y})});
    }
  }
  return judged;
}

/// Shoots across the plane of the polygon at each of the spots.
template <typename Scalar>
void expect_is_cut_rightly(const SamplePlane& plane, const SamplePolygon& polygon,
                           const std::vector<JudgedSpot>& judged, const example::Mesh<Scalar>& mesh) {
  ASSERT_FALSE(find_invalid(mesh.view()));
  const std::size_t triangles = polygon.corners.size() - 2;
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_EQ(mesh.faces, std::vector<std::uint32_t>(triangles == 1 ? 0 : triangles, 0));
  EXPECT_EQ(mesh.face_count(), 1u);
  EXPECT_TRUE(mesh.warnings.empty());

  const auto vector = [](const Position& p) {
    return Vector3<Scalar>(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
  };
  const Collider<Scalar> collider(mesh.view());
  for (const auto& [spot, is_closed] : judged) {
    const Segment<Scalar> path{vector(placed(plane, spot, sample_scale, 50)),
                               vector(placed(plane, spot, sample_scale, -50))};
    ASSERT_EQ(collider.any_hit(path), is_closed) << "at " << spot[0] << " " << spot[1];
  }
}

/// Reads each sample by `read(face)` as a file's one face: in every plane, from every corner and in both directions.
template <typename Scalar, typename Read>
void expect_every_sample_is_cut_rightly(Read read) {
  std::vector<SamplePolygon> polygons = sample_polygons;
  Random random(32);
  for (std::size_t i = case_count(12); i > 0; --i) polygons.push_back(random_star(random));
  for (const SamplePolygon& sample : polygons) {
    const std::vector<JudgedSpot> judged = judged_spots(sample);
    for (const SamplePlane& plane : sample_planes) {
      for (std::size_t corner = 0; corner < sample.corners.size(); ++corner) {
        for (const SamplePolygon& polygon : {begun_at(corner, sample), turned_round(begun_at(corner, sample))}) {
          SCOPED_TRACE(polygon.name + " in the plane " + plane.name + ", from corner " +
                       std::to_string(polygon.corners.front()) + " to " + std::to_string(polygon.corners.back()));
          example::Mesh<Scalar> mesh;
          ASSERT_NO_THROW(mesh = read(placed(plane, polygon)));
          expect_is_cut_rightly(plane, polygon, judged, mesh);
          if (testing::Test::HasFailure()) return;
        }
      }
    }
  }
}

/// The wall in its own numbers, from each corner and in both directions, and the two paths that show its window.
template <typename Read>
void expect_keyholed_wall_has_its_window(Read read) {
  for (std::size_t corner = 0; corner < keyholed_wall.corners.size(); ++corner) {
    for (const SamplePolygon& wall : {begun_at(corner, keyholed_wall), turned_round(begun_at(corner, keyholed_wall))}) {
      SampleFace face = {{}, wall.corners};
      for (const Spot& spot : wall.spots) face.vertices.push_back({spot[0], 0, spot[1]});
      const auto mesh = read(face);
      const Collider<double> collider(mesh.view());
      EXPECT_FALSE(collider.any_hit(Segmentd{{3, -5, 2}, {3, 5, 2}})) << "from corner " << corner;
      EXPECT_TRUE(collider.any_hit(Segmentd{{1, -5, 2}, {1, 5, 2}})) << "from corner " << corner;
    }
  }
}

}  // namespace surehit::test
