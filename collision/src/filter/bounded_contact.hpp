#pragma once

#include <array>

#include "contact.hpp"
#include "filter/bounded.hpp"
#include "query/path_range.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Quotients by one denominator, whose sign is certain: two divisions for all of them.
class BoundedQuotients {
 public:
  BoundedQuotients() = default;
  explicit BoundedQuotients(const Bounded& denominator);

  /// [lower, upper] around numerator / denominator; not finite where that cannot be told.
  [[nodiscard]] std::array<double, 2> of(const Bounded& numerator) const;

 private:
  double inverse_ = 0;
  double radius_ = 0;
  double max_inverse_ = 0;  ///< of what the denominator may be, by size
};

/// What doubles with error bounds say of a path and a triangle.
struct BoundedContact {
  Verdict verdict = Verdict::undecided;
  Contact contact = {};     ///< of a hit
  BoundedQuotients by_det;  ///< of a hit, as are the rest: t = height / det, u = u_scaled / det, v = v_scaled / det
  Bounded u_scaled;
  Bounded v_scaled;
};

/// The second stage: Möller-Trumbore in double, with bounds that are known beforehand. Some 15 ns; for float
/// coordinates it settles nearly everything.
template <typename Scalar>
[[nodiscard]] BoundedContact double_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                            const PathRange<Scalar>& range);

/// The third stage: the same with running error bounds, which exact operations do not enlarge. What lies in the
/// triangle's plane, and what double cannot tell apart, stays undecided. Nothing undecided is ever guessed.
template <typename Scalar>
[[nodiscard]] BoundedContact bounded_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                             const PathRange<Scalar>& range);

}  // namespace surehit::detail
