#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <optional>

#include "support/integer_pair.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// The first contact of one path and one triangle by the meaning of a query alone: an independent judge that shares
/// nothing with the library but the types of its arguments. Masks and ids say nothing here. Call it in the default
/// floating-point environment.
template <typename Scalar>
[[nodiscard]] std::optional<ExactContact> exact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                                        const QueryOptions<Scalar>& options = {});

/// The Scalar nearest to x, ties to even: infinite from halfway beyond the largest, denormal near zero, never -0.
template <typename Scalar>
[[nodiscard]] Scalar nearest(const mpq_class& x);

/// The hit that has to be reported for the contact.
template <typename Scalar>
[[nodiscard]] Hit<Scalar> rounded_hit(const ExactContact& contact, std::uint32_t triangle = 0) {
  return {nearest<Scalar>(contact.t), nearest<Scalar>(contact.u), nearest<Scalar>(contact.v), triangle, contact.side};
}

}  // namespace surehit::test
