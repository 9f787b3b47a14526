#pragma once

#include "support/inlining.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Returns the direction D of a path. For a segment, `toward` is the end. For a ray or a line, it is the direction. T
/// may be a scalar or a vector.
template <typename T>
SUREHIT_ALWAYS_INLINE inline T direction_of(PathKind kind, const T& start, const T& toward) {
  return kind == PathKind::segment ? toward - start : toward;
}

}  // namespace surehit::detail
