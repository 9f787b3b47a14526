#pragma once

#include <variant>

#include "surehit/query_options.hpp"
#include "surehit/swept_shape.hpp"

namespace surehit::detail {

/// Returns whether a shape touches anything at its start: what `is_hit(resting, at_start)` says of the shape at rest
/// there. Its end plays no part, and neither do `max_t`, `culling` and `ignore_start_contact`.
template <typename Scalar, typename Options, typename IsHit>
[[nodiscard]] bool overlaps_anything(const SweptShape<Scalar>& shape, const Options& options,
                                     const IsHit& is_hit) noexcept {
  SweptShape<Scalar> resting = shape;
  std::visit([](auto& any) { any.end = any.start; }, resting);
  Options at_start = options;
  at_start.max_t = 0;
  at_start.culling = Culling::none;  // A shape at rest has no side from which it comes.
  at_start.ignore_start_contact = false;
  return is_hit(resting, at_start);
}

}  // namespace surehit::detail
