#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace surehit::test {

/// Returns the number `steps` positions above x, or below for negative steps, in the order of all finite numbers. Both
/// zeros have one position. It uses integer arithmetic alone, so neither libm nor a floating-point mode has a say.
template <typename Scalar>
Scalar neighbour(Scalar x, int steps) {
  using Integer = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  constexpr Integer least = std::numeric_limits<Integer>::min();
  const auto mirror_negative = [](Integer i) { return i < 0 ? static_cast<Integer>(least - i) : i; };
  const Integer place = mirror_negative(std::bit_cast<Integer>(x));
  return std::bit_cast<Scalar>(mirror_negative(static_cast<Integer>(place + steps)));
}

}  // namespace surehit::test
