#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "contact.hpp"
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

}  // namespace surehit::test
