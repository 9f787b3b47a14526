#pragma once

#include <optional>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit {

/// Where a path first meets one triangle, or nothing if they do not meet: the exact answer on the numbers given, for
/// all finite input. A path or a triangle with a NaN or an infinity misses. `hit.triangle` is 0.
///
/// options.mask and options.ignored_triangle say nothing here: there is one triangle, without a mask or an id.
///
/// Method: Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), as the filter of its own
/// exact evaluation. Some 20 ns where the filter decides, around a microsecond where it does not. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API std::optional<Hit<Scalar>> intersect(
    const std::type_identity_t<Path<Scalar>>& path, const Triangle<Scalar>& triangle,
    const std::type_identity_t<QueryOptions<Scalar>>& options = {}) noexcept;

/// The limit that keeps a hit of `intersect`, as `Collider::max_t_keeping` gives it: the least Scalar that is not below
/// the exact t of `hit`.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Scalar max_t_keeping(const std::type_identity_t<Path<Scalar>>& path,
                                               const Triangle<Scalar>& triangle, const Hit<Scalar>& hit) noexcept;

#define SUREHIT_EXTERN(Scalar)                                                                                   \
  extern template SUREHIT_API std::optional<Hit<Scalar>> intersect(const Path<Scalar>&, const Triangle<Scalar>&, \
                                                                   const QueryOptions<Scalar>&) noexcept;        \
  extern template SUREHIT_API Scalar max_t_keeping(const Path<Scalar>&, const Triangle<Scalar>&,                 \
                                                   const Hit<Scalar>&) noexcept;
SUREHIT_EXTERN(float)
SUREHIT_EXTERN(double)
#undef SUREHIT_EXTERN

}  // namespace surehit
