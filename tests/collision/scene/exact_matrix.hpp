#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace surehit::test {

using ExactVector = std::array<mpq_class, 3>;
using ExactMatrix = std::array<ExactVector, 3>;

template <typename Vector>
ExactVector exact(const Vector& x) {
  return {mpq_class(double{x[0]}), mpq_class(double{x[1]}), mpq_class(double{x[2]})};
}

inline ExactVector operator+(const ExactVector& x, const ExactVector& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
inline ExactVector operator-(const ExactVector& x, const ExactVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
inline ExactVector operator*(const mpq_class& t, const ExactVector& x) { return {t * x[0], t * x[1], t * x[2]}; }
inline ExactVector operator*(const ExactMatrix& m, const ExactVector& x) {
  ExactVector y;
  for (std::size_t i = 0; i < 3; ++i) y[i] = m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2];
  return y;
}

inline ExactMatrix inverse(const ExactMatrix& m) {
  ExactMatrix n;
  mpq_class det;
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactVector& x = m[(i + 1) % 3];
    const ExactVector& y = m[(i + 2) % 3];
    for (std::size_t j = 0; j < 3; ++j) n[j][i] = x[(j + 1) % 3] * y[(j + 2) % 3] - x[(j + 2) % 3] * y[(j + 1) % 3];
    if (i == 0) det = m[0][0] * n[0][0] + m[0][1] * n[1][0] + m[0][2] * n[2][0];
  }
  for (ExactVector& row : n) row = (1 / det) * row;
  return n;
}

/// Returns the share of a bound that an error takes up.
inline double share_of(const mpq_class& error, double bound) {
  if (error == 0 || std::isinf(bound)) return 0;
  return bound > 0 ? mpq_class(abs(error) / mpq_class(bound)).get_d() : std::numeric_limits<double>::infinity();
}

inline double largest_share(const ExactVector& error, double bound) {
  return std::max({share_of(error[0], bound), share_of(error[1], bound), share_of(error[2], bound)});
}

}  // namespace surehit::test
