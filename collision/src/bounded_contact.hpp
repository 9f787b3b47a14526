#pragma once

#include <array>

#include "bounded.hpp"
#include "contact.hpp"
#include "path_range.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// What doubles with error bounds say of a path and a triangle.
struct BoundedContact {
  Verdict verdict = Verdict::undecided;
  Contact contact;  ///< of a hit
  Bounded det;      ///< of a hit, as are the rest: t = height / det, u = u_scaled / det, v = v_scaled / det
  Bounded height;
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

/// [lower, upper] around numerator / denominator, whose denominator has a certain sign.
[[nodiscard]] std::array<double, 2> bounded_quotient(const Bounded& numerator, const Bounded& denominator);

}  // namespace surehit::detail
