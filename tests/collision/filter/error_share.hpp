#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "filter/bounded.hpp"

namespace surehit::test {

/// What share of the bound the error takes up; 0 where nothing is claimed.
inline double share_of(const detail::Bounded& x, const mpq_class& truth) {
  if (!std::isfinite(x.value) || !std::isfinite(x.radius)) {
    EXPECT_FALSE(std::fabs(x.value) > x.radius) << "certain of a sign that it does not know";
    return 0;
  }
  const mpq_class error = abs(mpq_class(x.value) - truth);
  if (error == 0) return 0;
  return x.radius > 0 ? mpq_class(error / mpq_class(x.radius)).get_d() : std::numeric_limits<double>::infinity();
}

/// By how much the truth is off the middle of an interval, in half its width.
inline double share_of(const std::array<double, 2>& interval, const mpq_class& truth) {
  if (!std::isfinite(interval[0]) || !std::isfinite(interval[1])) {
    EXPECT_TRUE(std::isnan(interval[0]) || std::isinf(interval[0]) || mpq_class(interval[0]) <= truth);
    EXPECT_TRUE(std::isnan(interval[1]) || std::isinf(interval[1]) || mpq_class(interval[1]) >= truth);
    EXPECT_FALSE(interval[0] == interval[1]) << "rounds to one number, and knows none";
    return 0;
  }
  const mpq_class lower(interval[0]);
  const mpq_class upper(interval[1]);
  if (truth < lower || truth > upper) return std::numeric_limits<double>::infinity();
  if (lower == upper) return 0;
  return mpq_class(abs(2 * truth - lower - upper) / (upper - lower)).get_d();
}

}  // namespace surehit::test
