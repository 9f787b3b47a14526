#include "gpu/rounding_check.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace surehit::detail {
namespace {

constexpr float least_normal = std::numeric_limits<float>::min();

/// The two floats around x + rest, which are the same if it is a float. `rest` is less than an ulp of x.
struct Neighbours {
  explicit Neighbours(double x, double rest = 0) : below(static_cast<float>(x)), above(below) {
    const double from_below = x - double{below} + rest;
    if (from_below < 0) below = std::nextafter(below, -std::numeric_limits<float>::infinity());
    if (from_below > 0) above = std::nextafter(above, std::numeric_limits<float>::infinity());
  }
  [[nodiscard]] bool have(float x) const { return x == below || x == above; }
  float below, above;
};

/// Returns true if a device may return `result` for the exact value `exact` + `rest`. It may flush what is below the
/// least normal number, in its operands too.
bool may_be(float result, double exact, double rest = 0) {
  if (Neighbours(exact, rest).have(result)) return true;
  return std::fabs(exact) <= 2 * double{least_normal} && std::fabs(result) <= 2 * least_normal;
}

/// Returns true if a device may return this for a + b.
bool may_be_sum(float result, float a, float b) {
  const double sum = double{a} + double{b};
  const double part = sum - double{a};
  return may_be(result, sum, (double{a} - (sum - part)) + (double{b} - part));
}

/// Returns true if a device may return this for a / b: it is within 2.5 ulp. Both are normal, and so is a / b.
bool may_be_quotient(float result, float a, float b) {
  if (!std::isnormal(result)) return false;  // Zero and NaN have no ulp.
  const double ulp = std::ldexp(1.0, std::ilogb(result) - 23);
  const double rest = double{result} * double{b} - double{a};  // The product is exact.
  return std::fabs(rest) <= 2.5 * ulp * std::fabs(double{b}) * (1 + 0x1p-20);
}

/// Returns true if a device may return this for a b + c: it rounds twice.
bool may_be_product_and_sum(float result, float a, float b, float c) {
  const Neighbours product(double{a} * double{b});
  return may_be(result, double{product.below} + double{c}) || may_be(result, double{product.above} + double{c});
}

/// Returns true if nothing in the pairs of these numbers is flushed, and doubles have them exactly.
bool has_exact_pairs(float a, float b) {
  const auto is_moderate = [](float x) { return std::fabs(x) >= 0x1p-12F && std::fabs(x) <= 0x1p12F; };
  return is_moderate(a) && is_moderate(b);
}

/// Returns true if a device may return this pair for a + b (G10). It sums to the exact number nearly.
bool may_be_sum_pair(float high, float low, float a, float b) {
  const double sum = double{a} + double{b};  // It is exact for these numbers, and so is what is left.
  const double rest = sum - double{high};
  return may_be(high, sum) && std::fabs(double{low}) <= 0x1p-23 * std::fabs(sum) &&
         std::fabs(rest - double{low}) <= 0x1p-46 * std::fabs(sum);
}

/// Returns true if a device may return this pair for a b (G11). It is exact.
bool may_be_product_pair(float high, float low, float a, float b) {
  const double product = double{a} * double{b};
  return may_be(high, product) && double{low} == product - double{high};
}

std::string fault(const char* operation, const RoundingCase& numbers, float result) {
  char text[160];
  std::snprintf(text, sizeof text, "it computes %s of %a, %a and %a as %a", operation, double{numbers[0]},
                double{numbers[1]}, double{numbers[2]}, double{result});
  return text;
}

}  // namespace

std::vector<RoundingCase> rounding_cases() {
  std::vector<RoundingCase> cases;
  std::uint64_t bits = 1;
  const auto draw = [&](int exponents) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;
    const auto significand = static_cast<float>((bits >> 40 & 0x7fffff) | 0x800000);
    const int exponent = static_cast<int>(bits >> 33 & 0x7f) % exponents - exponents / 2;
    return std::ldexp((bits >> 63) != 0 ? -significand : significand, exponent - 23);
  };
  for (int i = 0; i < 2000; ++i) {
    const float a = draw(20);
    const float b = draw(20);
    // The product nearly cancels in half of the cases, so that it shows whether it was rounded.
    cases.push_back({a, b, i % 2 == 0 ? -static_cast<float>(double{a} * double{b}) : draw(20)});
  }
  // Products and sums that may be flushed.
  for (const float x : {least_normal, least_normal / 2, least_normal / 1024}) cases.push_back({x, 0.5F, x});
  cases.push_back({0x1p-70F, 0x1.8p-70F, 0x1p-130F});
  return cases;
}

std::optional<std::string> rounding_fault(std::span<const RoundingCase> cases,
                                          std::span<const RoundingResult> results) {
  if (results.size() != cases.size()) return "it computes too little";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto [a, b, c] = cases[i];
    const auto [sum, difference, product, quotient, product_and_sum, sum_high, sum_low, product_high, product_low] =
        results[i];
    if (!may_be_sum(sum, a, b)) return fault("the sum", cases[i], sum);
    if (!may_be_sum(difference, a, -b)) return fault("the difference", cases[i], difference);
    if (!may_be(product, double{a} * double{b})) return fault("the product", cases[i], product);
    const bool is_normal = std::fabs(a) > 0x1p-100F && std::fabs(b) > 0x1p-20F;
    if (is_normal && !may_be_quotient(quotient, a, b)) return fault("the quotient", cases[i], quotient);
    if (!may_be_product_and_sum(product_and_sum, a, b, c)) {
      return fault("the product and the sum", cases[i], product_and_sum);
    }
    if (!has_exact_pairs(a, b)) continue;
    if (!may_be_sum_pair(sum_high, sum_low, a, b)) return fault("the low part of the sum", cases[i], sum_low);
    if (!may_be_product_pair(product_high, product_low, a, b)) {
      return fault("the low part of the product", cases[i], product_low);
    }
  }
  return std::nullopt;
}

}  // namespace surehit::detail
