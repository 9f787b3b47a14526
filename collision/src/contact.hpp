#pragma once

#include "surehit/hit.hpp"

namespace surehit::detail {

/// A contact of a path with a triangle. It holds what decides whether the hit counts, and which of two hits is first.
/// `Contact` without `{}` leaves all members unset, because each path has a contact and few paths fill it in.
struct Contact {
  double t_lower;  ///< The exact t is at least this.
  double t_upper;  ///< The exact t is at most this.
  Side side;       ///< The side of the triangle at which the path arrives.
  bool at_start;   ///< True if the triangle contains the start of the segment or ray.
  bool at_end;     ///< True if the triangle contains the end of the segment.
};
static_assert(Contact{}.side == Side::edge_on);

}  // namespace surehit::detail
