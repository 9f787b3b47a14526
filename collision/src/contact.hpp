#pragma once

#include "surehit/hit.hpp"

namespace surehit::detail {

/// That a path meets a triangle, and what decides whether the hit counts and which of two comes first. Not set unless
/// by `{}`: each path has one, and few ever have it filled in.
struct Contact {
  double t_lower;  ///< the exact t lies in [t_lower, t_upper]
  double t_upper;  //
  Side side;       //
  bool at_start;   ///< the triangle contains the start of the segment or the ray
  bool at_end;     ///< the triangle contains the end of the segment
};
static_assert(Contact{}.side == Side::edge_on);

}  // namespace surehit::detail
