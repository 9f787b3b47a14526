#include "moving_platforms/way_check.hpp"

#include <algorithm>
#include <stdexcept>

namespace surehit::example {
namespace {

/// A fraction with a positive denominator. Both parts are below 2^26 in size, so products fit 64 bits.
struct Fraction {
  std::int64_t numerator;
  std::int64_t denominator;

  friend bool operator<(const Fraction& a, const Fraction& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
};

}  // namespace

WayCheck::WayCheck(const Hall& hall) : hall_(hall), low_(on_lattice(hall.room.low)), high_(on_lattice(hall.room.high)) {
  if (!(hall.room.low.minCoeff() >= 32 && hall.room.high.maxCoeff() <= 64)) {
    throw std::invalid_argument("the room must lie in [32, 64] on each axis to be checked in integers");
  }
  for (std::uint32_t step = 0; step <= Hall::period; ++step) {
    set_step(step);
    if (!std::ranges::all_of(boxes_, [&](const MovingBox& box) { return is_in_room(box.low) && is_in_room(box.high); }))
      throw std::invalid_argument("a platform leaves the room in step " + std::to_string(step));
  }
}

void WayCheck::set_step(std::uint32_t step) {
  boxes_.clear();
  for (const Platform& platform : hall_.platforms) {
    const Lattice now = on_lattice(platform.position(step));
    const Lattice next = on_lattice(platform.position(step + 1));
    for (const Boxf& box : platform.boxes) {
      MovingBox moving{on_lattice(box.low), on_lattice(box.high), {}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        moving.low[axis] += now[axis];
        moving.high[axis] += now[axis];
        moving.motion[axis] = next[axis] - now[axis];
      }
      boxes_.push_back(moving);
    }
  }
}

bool WayCheck::is_breach(const Vector3f& from, const Vector3f& to) const {
  // The room has a corner at 32 or above, so what is far outside is not on the lattice.
  if (!hall_.room.contains(from) || !hall_.room.contains(to)) return true;
  const Lattice p = on_lattice(from);
  const Lattice q = on_lattice(to);
  if (!is_in_room(p) || !is_in_room(q)) return true;
  return std::ranges::any_of(boxes_, [&](const MovingBox& box) { return touches(box, p, q); });
}

WayCheck::Lattice WayCheck::on_lattice(const Vector3f& point) {
  const auto integer = [](float x) { return static_cast<std::int64_t>(x * 0x1p18f); };
  return {integer(point.x()), integer(point.y()), integer(point.z())};
}

bool WayCheck::is_in_room(const Lattice& point) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(low_[axis] < point[axis] && point[axis] < high_[axis])) return false;
  }
  return true;
}

/// The shares of the step in which the piece is between two opposite faces are a range. The piece touches the box if
/// the three ranges have a share in common.
bool WayCheck::touches(const MovingBox& box, const Lattice& from, const Lattice& to) {
  Fraction enters = {0, 1};
  Fraction leaves = {1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t way = to[axis] - box.motion[axis] - from[axis];
    const std::int64_t to_low = box.low[axis] - from[axis];
    const std::int64_t to_high = box.high[axis] - from[axis];
    if (way == 0) {
      if (to_low > 0 || to_high < 0) return false;
    } else {
      enters = std::max(enters, way > 0 ? Fraction{to_low, way} : Fraction{-to_high, -way});
      leaves = std::min(leaves, way > 0 ? Fraction{to_high, way} : Fraction{-to_low, -way});
    }
  }
  return !(leaves < enters);
}

}  // namespace surehit::example
