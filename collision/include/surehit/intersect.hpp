#pragma once

#include <optional>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_shape.hpp"
#include "surehit/triangle.hpp"

namespace surehit {

/// Returns where a path first meets one triangle, or nothing if they do not meet. The answer is that of exact real
/// arithmetic on the given numbers, for every finite input. A path or a triangle with a NaN or an infinity misses. The
/// result has `triangle` 0.
///
/// `options.mask` and `options.ignored_triangle` are not used, because the triangle has no mask and no id.
///
/// The test is that of Möller and Trumbore (1997), "Fast, Minimum Storage Ray/Triangle Intersection". Its determinants
/// are first computed in floating point, with proved error bounds. Exact integers decide what the bounds do not.
///
/// Takes tens of nanoseconds if the bounds decide, and about a microsecond if they do not. Both depend on the machine
/// and the numbers. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API std::optional<Hit<Scalar>> intersect(
    const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
    const std::type_identity_t<QueryOptions<Scalar>>& options = {}) noexcept;

/// Returns the limit that keeps a hit: the smallest Scalar that is not below the exact t. As `max_t` it keeps the hit,
/// and `hit.t` may lose it. `hit` must be a hit of this path and this triangle.
///
/// Decides one pair, as `intersect` does. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Scalar max_t_keeping(const std::type_identity_t<Path<Scalar>>& path,
                                               const Triangle<Scalar>& triangle, const Hit<Scalar>& hit) noexcept;

/// Returns where a moving shape first touches one triangle, or nothing if they do not touch. The answer is that of
/// exact real arithmetic on the given numbers. A triangle with a NaN or an infinity is not touched. The result has
/// `triangle` 0, and `options.mask` and `options.ignored_triangle` are not used.
///
/// They touch if their distance is zero somewhere during the step. Signs of polynomials decide this, and no root is
/// taken. Doubles with error bounds compute most signs, and exact integers the others. Takes some hundred nanoseconds,
/// and with integers some ten microseconds. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API std::optional<ShapeHit<Scalar>> intersect(
    const std::type_identity_t<SweptShape<Scalar>>& shape, const Triangle<Scalar>& triangle,
    const std::type_identity_t<ShapeQueryOptions<Scalar>>& options = {}) noexcept;

#define SUREHIT_EXTERN(Scalar)                                                                                   \
  extern template SUREHIT_API std::optional<Hit<Scalar>> intersect(const Path<Scalar>&, const Triangle<Scalar>&, \
                                                                   const QueryOptions<Scalar>&) noexcept;        \
  extern template SUREHIT_API std::optional<ShapeHit<Scalar>> intersect(                                         \
      const SweptShape<Scalar>&, const Triangle<Scalar>&, const ShapeQueryOptions<Scalar>&) noexcept;            \
  extern template SUREHIT_API Scalar max_t_keeping(const Path<Scalar>&, const Triangle<Scalar>&,                 \
                                                   const Hit<Scalar>&) noexcept;
SUREHIT_EXTERN(float)
SUREHIT_EXTERN(double)
#undef SUREHIT_EXTERN

}  // namespace surehit
