#pragma once

#include <array>

#include "contact.hpp"
#include "filter/bounded.hpp"
#include "path_range.hpp"
#include "placement.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Quotients by one denominator. Its sign must be certain. All quotients share two divisions.
class BoundedQuotients {
 public:
  BoundedQuotients() = default;
  explicit BoundedQuotients(const Bounded& denominator);

  /// Returns [lower, upper], which contains the exact quotient. Both are finite only if the bound is known.
  [[nodiscard]] std::array<double, 2> of(const Bounded& numerator) const;

 private:
  double inverse_ = 0;      ///< The inverse of the denominator.
  double radius_ = 0;       ///< The radius of the denominator.
  double max_inverse_ = 0;  ///< The largest size that the exact inverse may have.
};

/// The answer of doubles with error bounds about a path and a triangle.
struct BoundedContact {
  Verdict verdict = Verdict::undecided;  ///< The other members have a meaning only for a hit.
  Contact contact = {};                  ///< The contact, with an interval of t.
  BoundedQuotients by_det;               ///< The quotients by det, such as t = T / det.
  Bounded u_scaled;                      ///< The determinant U = u det.
  Bounded v_scaled;                      ///< The determinant V = v det.
};

/// The second stage: Möller-Trumbore in double, with the error bounds of kernel_bound.hpp. It is fast, and decides
/// nearly all pairs of float coordinates.
template <typename Scalar>
[[nodiscard]] BoundedContact double_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                            const PathRange<Scalar>& range);

/// The third stage: the same with running error bounds, which exact operations do not enlarge. A path in the triangle's
/// plane stays undecided. So does any pair that double cannot decide with certainty. `AnyTriangle` is `Triangle` or
/// `PlacedTriangle`.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] BoundedContact bounded_contact(const Path<Scalar>& path, const AnyTriangle& triangle,
                                             const PathRange<Scalar>& range);

}  // namespace surehit::detail
