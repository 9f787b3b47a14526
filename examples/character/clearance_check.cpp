#include "character/clearance_check.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "character/capsule_sweep.hpp"
#include "character/core_distance.hpp"

namespace surehit::example {
namespace {

/// Metres more than a body needs, so roundings of boxes do not matter below 4096 metres.
constexpr float slack = 0x1p-10f;

}  // namespace

ClearanceCheck::ClearanceCheck(const Mesh<float>& mesh) {
  const TriangleMeshViewf view = mesh.view();
  const float infinity = std::numeric_limits<float>::infinity();
  box_ = {Vector3f::Constant(infinity), Vector3f::Constant(-infinity)};
  for (std::uint32_t i = 0; i < view.triangle_count(); ++i) {
    const Trianglef triangle = view.triangle(i);
    const Box box{triangle.a.cwiseMin(triangle.b).cwiseMin(triangle.c),
                  triangle.a.cwiseMax(triangle.b).cwiseMax(triangle.c)};
    triangles_.push_back(triangle);
    boxes_.push_back(box);
    box_ = {box_.low.cwiseMin(box.low), box_.high.cwiseMax(box.high)};
  }
  for (int axis = 0; axis < 2; ++axis) {
    counts_[static_cast<std::size_t>(axis)] = 1 + static_cast<std::size_t>(2 * (box_.high[axis] - box_.low[axis]));
  }
  squares_.resize(counts_[0] * counts_[1]);
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    const Range x = squares(0, boxes_[i].low.x(), boxes_[i].high.x());
    const Range y = squares(1, boxes_[i].low.y(), boxes_[i].high.y());
    for (std::size_t row = y.first; row <= y.last; ++row) {
      for (std::size_t column = x.first; column <= x.last; ++column) {
        squares_[row * counts_[0] + column].push_back(i);
      }
    }
  }
}

Clearance ClearanceCheck::check(const Vector3f& from, const Vector3f& to) const {
  const Vector3f reach = Vector3f::Constant(Body::radius + slack) + Body::half_axis();
  const Vector3f low = from.cwiseMin(to) - reach;
  const Vector3f high = from.cwiseMax(to) + reach;
  const Range x = squares(0, low.x(), high.x());
  const Range y = squares(1, low.y(), high.y());
  Clearance result;
  for (std::size_t row = y.first; row <= y.last; ++row) {
    for (std::size_t column = x.first; column <= x.last; ++column) {
      for (const std::uint32_t i : squares_[row * counts_[0] + column]) {
        if ((boxes_[i].low.array() > high.array()).any() || (boxes_[i].high.array() < low.array()).any()) continue;
        const CoreDistance distance = core_distance(from, to, triangles_[i]);
        if (distance.verdict == Verdict::free) continue;
        std::optional<bool> is_touching = true;
        if (distance.verdict == Verdict::unsure) is_touching = touches_exactly(from, to, triangles_[i]);
        if (!is_touching) result.is_certain = false;
        if (!is_touching.value_or(false)) continue;
        result.is_touching = true;
        result.depth = std::max(result.depth, double{Body::radius} - distance.upper);
      }
    }
  }
  return result;
}

/// The squares that an interval comes to. What is outside of the box counts to its outermost squares.
ClearanceCheck::Range ClearanceCheck::squares(int axis, float low, float high) const {
  const std::size_t count = counts_[static_cast<std::size_t>(axis)];
  const auto square = [&](float x) {
    const double place = (double{x} - double{box_.low[axis]}) * 2;
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
  };
  return {square(low), square(high)};
}

}  // namespace surehit::example
