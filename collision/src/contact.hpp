#pragma once

#include "surehit/hit.hpp"

namespace surehit::detail {

/// That a path meets a triangle, and what decides whether the hit counts and which of two comes first.
struct Contact {
  double t_lower = 0;         ///< the exact t lies in [t_lower, t_upper]
  double t_upper = 0;         //
  Side side = Side::edge_on;  //
  bool at_start = false;      ///< the triangle contains the start of the segment or the ray
  bool at_end = false;        ///< the triangle contains the end of the segment
};

}  // namespace surehit::detail
