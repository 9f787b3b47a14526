#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surehit::detail {

/// The three numbers a, b and c of a case.
using RoundingCase = std::array<float, 3>;
/// What a device computes of a case: a + b, a - b, a b, a / b and a b + c. After these come the high and low parts of
/// the pairs that are the sum and the product of a and b.
using RoundingResult = std::array<float, 9>;

/// Returns the cases that a device computes when it is opened. They are always the same.
[[nodiscard]] std::vector<RoundingCase> rounding_cases();

/// Returns the first thing that a device does not compute as G1, G2, G10 and G11 say, or nothing. There is one result
/// for each case.
[[nodiscard]] std::optional<std::string> rounding_fault(std::span<const RoundingCase> cases,
                                                        std::span<const RoundingResult> results);

}  // namespace surehit::detail
