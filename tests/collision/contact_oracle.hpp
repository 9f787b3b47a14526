#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "contact.hpp"
#include "filter/bounded_contact.hpp"
#include "support/exact_oracle.hpp"

namespace surehit::test {

/// The stages below `Narrowphase` know limits on t alone: culling and ignored ends come after them.
template <typename Scalar>
void keep_limits_alone(QueryOptions<Scalar>& options) {
  options.culling = Culling::none;
  options.ignore_start_contact = false;
  options.ignore_end_contact = false;
}

/// What a stage says of a contact must be true of the exact one.
template <typename Scalar>
void expect_contact_of(const ExactContact& truth, const detail::Contact& contact, const Path<Scalar>& path,
                       const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& limits) {
  EXPECT_TRUE(std::isinf(contact.t_lower) ? contact.t_lower < 0 : mpq_class(contact.t_lower) <= truth.t);
  EXPECT_TRUE(std::isinf(contact.t_upper) ? contact.t_upper > 0 : mpq_class(contact.t_upper) >= truth.t);
  EXPECT_EQ(contact.side, truth.side);
  QueryOptions<Scalar> ignoring_start = limits;
  ignoring_start.ignore_start_contact = true;
  QueryOptions<Scalar> ignoring_end = limits;
  ignoring_end.ignore_end_contact = true;
  EXPECT_EQ(contact.at_start, !exact_contact(path, triangle, ignoring_start).has_value());
  EXPECT_EQ(contact.at_end, !exact_contact(path, triangle, ignoring_end).has_value());
}

/// What a stage in double has decided must be true. Returns the exact contact if it is a hit.
template <typename Scalar>
[[nodiscard]] std::optional<ExactContact> expect_decided(const detail::BoundedContact& bounded,
                                                         const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                                         const QueryOptions<Scalar>& limits) {
  if (bounded.verdict == detail::Verdict::undecided) return std::nullopt;
  const auto truth = exact_contact(path, triangle, limits);
  EXPECT_EQ(bounded.verdict == detail::Verdict::hit, truth.has_value());
  if (bounded.verdict != detail::Verdict::hit || !truth) return std::nullopt;
  expect_contact_of(*truth, bounded.contact, path, triangle, limits);
  return truth;
}

}  // namespace surehit::test
