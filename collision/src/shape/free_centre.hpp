#pragma once

#include <variant>

#include "query/free_point.hpp"
#include "surehit/swept_shape.hpp"

namespace surehit::detail {

/// The minimum s that is tried. A product with s then needs no more digits than one with an entry of a pose.
template <typename Scalar>
inline constexpr Scalar min_share = Scalar(0x1p-64);

/// Returns where the centre of a shape may stop, as `find_free_point` does. `is_blocked(shape, options, s)` returns
/// true if the shape that ends at s has a hit. If `sees_s` is false, this depends on its end alone.
///
/// A query includes the end of its step. So a shape that comes to its end without a hit touches nothing there.
template <typename Scalar, typename Options, typename IsBlocked>
[[nodiscard]] Vector3<Scalar> find_free_centre(const SweptShape<Scalar>& shape, Scalar t, const Options& options,
                                               const IsBlocked& is_blocked, bool sees_s) noexcept {
  const auto way = std::visit([](const auto& any) { return Segment<Scalar>{any.start, any.end}; }, shape);
  SweptShape<Scalar> shorter = shape;
  return find_free_point(
      way, t, options,
      [&](const Path<Scalar>& path, const Options& shortened, Scalar s) {
        if (s < min_share<Scalar>) return true;
        std::visit([&](auto& any) { any.end = path.toward; }, shorter);
        return is_blocked(shorter, shortened, s);
      },
      sees_s);
}

}  // namespace surehit::detail
