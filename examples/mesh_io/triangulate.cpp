#include "mesh_io/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh_io/axis_view.hpp"
#include "mesh_io/ear_clipper.hpp"

namespace surehit::example {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

template <typename Scalar>
using Outline = std::vector<std::array<Scalar, 3>>;

Triangles fan_of(std::size_t corner_count) {
  Triangles fan;
  for (std::uint32_t i = 2; i < corner_count; ++i) fan.push_back({0, i - 1, i});
  return fan;
}

/// How the outline looks along each axis: the areas of its fan, as seen, summed with their signs and without. Rounded,
/// and in a unit of its own: it orders what is tried, and decides nothing.
struct Looks {
  std::array<double, 3> signed_area = {};
  std::array<double, 3> size = {};
};

template <typename Scalar>
Looks looks_of(const Outline<Scalar>& outline) {
  // A quarter, so that no difference overflows.
  const auto from_first = [&](std::size_t i, std::size_t axis) {
    return double{outline[i][axis]} / 4 - double{outline[0][axis]} / 4;
  };
  double unit = 0;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) unit = std::max(unit, std::fabs(from_first(i, axis)));
  }
  Looks looks;
  if (unit == 0) return looks;
  for (std::size_t i = 2; i < outline.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t x = (axis + 1) % 3;
      const std::size_t y = (axis + 2) % 3;
      const double area = (from_first(i - 1, x) / unit) * (from_first(i, y) / unit) -
                          (from_first(i - 1, y) / unit) * (from_first(i, x) / unit);
      looks.signed_area[axis] += area;
      looks.size[axis] += std::fabs(area);
    }
  }
  return looks;
}

template <typename Scalar>
bool is_in_line(const AxisView<Scalar>& view, const Outline<Scalar>& outline) {
  const auto other = std::find_if(outline.begin(), outline.end(),
                                  [&](const auto& corner) { return !view.coincide(corner, outline[0]); });
  return other == outline.end() || std::all_of(outline.begin(), outline.end(), [&](const auto& corner) {
           return view.orientation(outline[0], *other, corner) == 0;
         });
}

/// Whether no two triangles that turn by `turn` have more in common than their edges. Others have no area.
template <typename Scalar>
bool are_apart(const AxisView<Scalar>& view, const Outline<Scalar>& outline, const Triangles& triangles, int turn) {
  struct Seen {
    std::array<std::array<Scalar, 3>, 3> corners;
    Scalar min_x, max_x, min_y, max_y;
  };
  std::vector<Seen> seen;
  for (const auto& [a, b, c] : triangles) {
    if (view.orientation(outline[a], outline[b], outline[c]) == 0) continue;
    const auto [min_x, max_x] = std::minmax({view.x(outline[a]), view.x(outline[b]), view.x(outline[c])});
    const auto [min_y, max_y] = std::minmax({view.y(outline[a]), view.y(outline[b]), view.y(outline[c])});
    seen.push_back({{outline[a], outline[b], outline[c]}, min_x, max_x, min_y, max_y});
  }
  std::sort(seen.begin(), seen.end(), [](const Seen& one, const Seen& other) { return one.min_x < other.min_x; });

  // Two triangles are apart if and only if all of one is beyond an edge of the other.
  const auto has_edge_before = [&](const Seen& one, const Seen& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto is_beyond = [&](const auto& corner) {
        return turn * view.orientation(one.corners[i], one.corners[(i + 1) % 3], corner) <= 0;
      };
      if (std::all_of(other.corners.begin(), other.corners.end(), is_beyond)) return true;
    }
    return false;
  };
  for (auto one = seen.begin(); one != seen.end(); ++one) {
    for (auto other = one + 1; other != seen.end() && other->min_x < one->max_x; ++other) {
      if (one->max_y <= other->min_y || other->max_y <= one->min_y) continue;
      if (!has_edge_before(*one, *other) && !has_edge_before(*other, *one)) return false;
    }
  }
  return true;
}

/// Whether the fan of the first corner is a triangulation of the outline as it is seen.
template <typename Scalar>
bool is_fan(const AxisView<Scalar>& view, const Outline<Scalar>& outline) {
  const auto& first = outline[0];
  const auto is_within = [](Scalar a, Scalar at, Scalar b) { return std::min(a, b) <= at && at <= std::max(a, b); };
  int turn = 0;
  bool turns_onwards = true;  // each corner is further round the first one than the corner before, or as far
  for (std::size_t i = 2; i < outline.size(); ++i) {
    const auto& before = outline[i - 1];
    const int orientation = view.orientation(first, before, outline[i]);
    if (orientation == 0) {
      turns_onwards &= !is_within(view.x(before), view.x(first), view.x(outline[i])) ||
                       !is_within(view.y(before), view.y(first), view.y(outline[i]));
    } else if (turn == 0) {
      turn = orientation;
    } else if (orientation != turn) {
      return false;
    }
  }
  if (turn == 0) return false;
  if (outline.size() == 4) return true;  // its two triangles are on either side of their common edge
  const auto is_in_half_turn = [&](const auto& corner) {
    return turn * view.orientation(first, outline[1], corner) >= 0;
  };
  if (turns_onwards && std::all_of(outline.begin() + 2, outline.end(), is_in_half_turn)) return true;
  return are_apart(view, outline, fan_of(outline.size()), turn);
}

/// The triangles by positions in the outline. None where there is no triangulation.
template <typename Scalar>
Triangles triangulate_outline(const Outline<Scalar>& outline) {
  const Looks looks = looks_of(outline);
  std::array<std::size_t, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](std::size_t a, std::size_t b) { return looks.size[a] > looks.size[b]; });

  // A plane polygon is the same from everywhere but from within its plane. A bent one may be clear from one side alone;
  // from where it looks much smaller, what is seen is how it is bent.
  constexpr double min_share = 0.25;
  double min_size = 0;
  bool is_line = true;
  for (const std::size_t axis : axes) {
    const AxisView<Scalar> view(axis);
    if (looks.size[axis] < min_size) break;
    if (is_fan(view, outline)) return fan_of(outline.size());
    if (is_in_line(view, outline)) continue;
    is_line = false;
    min_size = std::max(min_size, min_share * looks.size[axis]);
    const int likely_turn = looks.signed_area[axis] < 0 ? -1 : 1;
    for (const int turn : {likely_turn, -likely_turn}) {
      auto ears = EarClipper<Scalar>(view, outline, turn).clip();
      if (ears && are_apart(view, outline, *ears, turn)) return *std::move(ears);
    }
  }
  return is_line ? fan_of(outline.size()) : Triangles();
}

}  // namespace

template <typename Scalar>
bool triangulate(const std::vector<std::array<Scalar, 3>>& vertices, const std::vector<std::uint32_t>& corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  Outline<Scalar> outline;
  for (const std::uint32_t corner : corners) outline.push_back(vertices[corner]);
  const Triangles cut = triangulate_outline(outline);
  for (const auto& [a, b, c] : cut) triangles.push_back({corners[a], corners[b], corners[c]});
  return !cut.empty();
}

template bool triangulate(const std::vector<std::array<float, 3>>&, const std::vector<std::uint32_t>&,
                          std::vector<std::array<std::uint32_t, 3>>&);
template bool triangulate(const std::vector<std::array<double, 3>>&, const std::vector<std::uint32_t>&,
                          std::vector<std::array<std::uint32_t, 3>>&);

}  // namespace surehit::example
