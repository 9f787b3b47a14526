#include "mesh_io/parse_number.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <type_traits>

#include "mesh_io/input_error.hpp"
#include "mesh_io/lower_case.hpp"

namespace surehit::example {
namespace {

/// How a number without its sign and its prefix is spelled.
struct Notation {
  std::chars_format format;
  std::string_view digits;
  std::string_view exponent_marks;
  std::int64_t digit_weight;  ///< by how much a digit's place counts in the exponent
};

const Notation decimal = {std::chars_format::general, "0123456789", "eE", 1};
const Notation hex = {std::chars_format::hex, "0123456789abcdefABCDEF", "pP", 4};

/// Whether the exponent of the leading digit, as far as it can be told without arithmetic on the digits, is positive.
/// Exact enough to tell an overflow from an underflow, which std::from_chars reports alike.
bool is_large(std::string_view spelled, const Notation& notation) {
  const std::size_t mark = spelled.find_first_of(notation.exponent_marks);
  const std::string_view significand = spelled.substr(0, mark);
  const auto point = static_cast<std::int64_t>(std::min(significand.find('.'), significand.size()));
  const auto leading = static_cast<std::int64_t>(significand.find_first_not_of("0."));
  const std::int64_t place = (point - leading) * notation.digit_weight;
  if (mark == std::string_view::npos) return place > 0;

  std::string_view exponent = spelled.substr(mark + 1);
  if (exponent.front() == '+') exponent.remove_prefix(1);
  std::int64_t value = 0;
  if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), value).ec == std::errc{}) {
    return value > -place;
  }
  return exponent.front() != '-';
}

[[noreturn]] void throw_not_a_number(std::string_view text) { throw InputError(quoted(text) + " is not a number"); }

}  // namespace

template <typename Scalar>
Scalar parse_number(std::string_view text) {
  std::string_view spelled = text;
  const bool negative = spelled.starts_with('-');
  if (negative || spelled.starts_with('+')) spelled.remove_prefix(1);
  const bool prefixed = spelled.starts_with("0x") || spelled.starts_with("0X");
  if (prefixed) spelled.remove_prefix(2);
  const Notation& notation = prefixed ? hex : decimal;

  // Else std::from_chars would take a second sign, "inf" and "nan".
  const std::string_view first = spelled.substr(0, 1);
  if (first != "." && (first.empty() || notation.digits.find(first) == std::string_view::npos))
    throw_not_a_number(text);

  Scalar value = 0;
  const char* const end = spelled.data() + spelled.size();
  const auto [rest, error] = std::from_chars(spelled.data(), end, value, notation.format);
  if (error == std::errc::invalid_argument || rest != end) throw_not_a_number(text);
  if (error == std::errc::result_out_of_range) {
    if (is_large(spelled, notation)) {
      throw InputError(quoted(text) + " is beyond the largest " + (std::is_same_v<Scalar, float> ? "float" : "double"));
    }
    value = 0;
  }
  return negative ? -value : value;
}

template <typename Scalar>
Scalar parse_number_or_non_finite(std::string_view text) {
  using Limits = std::numeric_limits<Scalar>;
  const bool is_signed = text.starts_with('-') || text.starts_with('+');
  const std::string_view unsigned_text = text.substr(is_signed ? 1 : 0);
  const std::string_view letter = unsigned_text.substr(0, 1);
  if (letter == "i" || letter == "I" || letter == "n" || letter == "N") {
    const std::string word = lower_case(unsigned_text);
    if (word == "nan" || (word.starts_with("nan(") && word.ends_with(')'))) return Limits::quiet_NaN();
    if (word == "inf" || word == "infinity") return text.starts_with('-') ? -Limits::infinity() : Limits::infinity();
  }
  return parse_number<Scalar>(text);
}

std::int64_t parse_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || rest != text.data() + text.size()) {
    throw InputError(quoted(text) + " is not an integer");
  }
  if (error == std::errc::result_out_of_range) throw InputError(quoted(text) + " is beyond 64 bits");
  return value;
}

template float parse_number<float>(std::string_view);
template double parse_number<double>(std::string_view);
template float parse_number_or_non_finite<float>(std::string_view);
template double parse_number_or_non_finite<double>(std::string_view);

}  // namespace surehit::example
