#pragma once

#include <gmpxx.h>

#include <vector>

namespace surehit::test {

/// A point in rationals.
struct ExactPoint {
  mpq_class x, y;
};
using ExactOutline = std::vector<ExactPoint>;

/// Returns whether two edges cross, each inside, in a point to which no other edge comes.
[[nodiscard]] bool crosses_properly(const ExactOutline& outline);

/// Returns whether edges have nothing in common but the corners between neighbours.
[[nodiscard]] bool is_simple(const ExactOutline& outline);

}  // namespace surehit::test
