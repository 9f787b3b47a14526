#pragma once

#include <cstdint>
#include <string_view>

namespace surehit::example {

/// The Scalar nearest to the number that the whole text spells, ties to even. It is rounded once, so an exact answer is
/// an answer about the numbers in the file.
///
/// Decimal (`-1.5e3`) or hex (`0x1.8p-3`), with or without a sign. What is too small for a Scalar rounds to a denormal
/// or to a zero of its sign. Throws InputError for anything else, and for what rounds beyond the largest finite Scalar.
template <typename Scalar>
[[nodiscard]] Scalar parse_number(std::string_view text);

/// The same for a number that may not be finite. C spells it nan or inf, in any case, with or without a sign, also
/// infinity and nan(…). What is beyond the largest finite Scalar is still an error.
template <typename Scalar>
[[nodiscard]] Scalar parse_number_or_non_finite(std::string_view text);

/// The whole text as a decimal integer. Throws InputError.
[[nodiscard]] std::int64_t parse_integer(std::string_view text);

}  // namespace surehit::example
