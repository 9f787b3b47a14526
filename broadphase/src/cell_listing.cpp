#include "cell_listing.hpp"

namespace surehit::detail {
namespace {

/// Keeps what lies on one side of x[axis] = plane: above it for sign = 1, below it for -1 (Sutherland and Hodgman
/// 1974).
ClippedTriangle clip_side(const ClippedTriangle& polygon, std::size_t axis, double plane, double sign) {
  ClippedTriangle kept;
  const auto push = [&](const FramePoint& corner) { kept.corners[static_cast<std::size_t>(kept.count++)] = corner; };
  for (int i = 0; i < polygon.count; ++i) {
    const FramePoint& from = polygon.corners[static_cast<std::size_t>(i)];
    const FramePoint& to = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double from_height = sign * (from[axis] - plane);
    const double to_height = sign * (to[axis] - plane);
    if (from_height >= 0) push(from);
    if ((from_height > 0 && to_height < 0) || (from_height < 0 && to_height > 0)) {
      const double weight = from_height / (from_height - to_height);
      FramePoint crossing;
      for (std::size_t k = 0; k < 3; ++k) crossing[k] = from[k] + weight * (to[k] - from[k]);
      push(crossing);
    }
  }
  return kept;
}

}  // namespace

ClippedTriangle clip(const ClippedTriangle& polygon, std::size_t axis, double low, double high) {
  return clip_side(clip_side(polygon, axis, low, 1), axis, high, -1);
}

}  // namespace surehit::detail
