#include "support/exact_oracle.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

#include "support/random.hpp"

namespace surehit::test::exact_oracle_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

mpq_class power_of_two(long exponent) {
  mpq_class result = 1;
  if (exponent > 0) result <<= static_cast<mp_bitcnt_t>(exponent);
  if (exponent < 0) result >>= static_cast<mp_bitcnt_t>(-exponent);
  return result;
}

TEST(Nearest, breaks_ties_to_even) {
  EXPECT_EQ(nearest<float>(1 + power_of_two(-24)), 1.0f);
  EXPECT_EQ(nearest<float>(1 + 3 * power_of_two(-24)), 1.0f + 0x1p-22f);
  EXPECT_EQ(nearest<float>(1 + power_of_two(-24) + power_of_two(-200)), 1.0f + 0x1p-23f);
  EXPECT_EQ(nearest<double>(-1 - power_of_two(-53)), -1.0);
  EXPECT_EQ(nearest<double>(-1 - 3 * power_of_two(-53)), -1.0 - 0x1p-51);
}

TEST(Nearest, rounds_thirds) {
  EXPECT_EQ(nearest<float>(mpq_class(1, 3)), 1.0f / 3.0f);
  EXPECT_EQ(nearest<double>(mpq_class(-2, 3)), -2.0 / 3.0);
}

TEST(Nearest, goes_down_to_the_denormals_and_to_positive_zero) {
  EXPECT_EQ(nearest<float>(power_of_two(-149)), 0x1p-149f);
  EXPECT_EQ(nearest<float>(power_of_two(-150) + power_of_two(-500)), 0x1p-149f);
  EXPECT_EQ(nearest<double>(3 * power_of_two(-1075)), 0x1p-1073);
  for (const mpq_class& x : {mpq_class(0), power_of_two(-1075), mpq_class(-power_of_two(-1075))}) {
    EXPECT_EQ(nearest<double>(x), 0.0);
    EXPECT_FALSE(std::signbit(nearest<double>(x)));
  }
}

TEST(Nearest, carries_into_the_next_power_of_two) {
  EXPECT_EQ(nearest<float>(2 - power_of_two(-30)), 2.0f);
  EXPECT_EQ(nearest<float>(power_of_two(-126) - power_of_two(-160)), 0x1p-126f);
}

TEST(Nearest, overflows_from_half_an_ulp_beyond_the_largest) {
  EXPECT_EQ(nearest<float>(power_of_two(128) - power_of_two(103)), std::numeric_limits<float>::infinity());
  EXPECT_EQ(nearest<float>(power_of_two(128) - power_of_two(103) - 1), std::numeric_limits<float>::max());
  EXPECT_EQ(nearest<double>(-power_of_two(4000)), -infinity);
}

/// By the standard library: glibc 2.36's strtof rounds some long decimals of denormals down.
template <typename Scalar>
Scalar parsed(const std::string& decimal) {
  Scalar result = 0;
  const auto [end, error] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), result);
  // Below the denormals and above the largest number the result stays as it was.
  if (error == std::errc::result_out_of_range) return decimal.find("e-") == std::string::npos ? infinity : 0;
  return result;
}

TEST(Nearest, agrees_with_the_reading_of_decimals) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const mpz_class digits = static_cast<unsigned long>(random.bits() >> random.below(63));
    const auto power = random.between(-345, 310);
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(power)));
    mpq_class exact = power < 0 ? mpq_class(digits, scale) : mpq_class(digits * scale);
    exact.canonicalize();
    const std::string text = digits.get_str() + "e" + std::to_string(power);
    EXPECT_EQ(nearest<double>(exact), parsed<double>(text)) << text;
    EXPECT_EQ(nearest<float>(exact), parsed<float>(text)) << text;
  }
}

TEST(Nearest, agrees_with_the_reading_of_decimals_halfway_between_floats) {
  Random random(2);
  for (int i = 0; i < 5'000; ++i) {
    const auto halves = random.between(0, 1 << 24) * 2 + 1;
    const auto power = static_cast<unsigned long>(random.between(1, 151));
    mpz_class decimal;
    mpz_ui_pow_ui(decimal.get_mpz_t(), 5, power);
    decimal *= halves;
    const std::string text = decimal.get_str() + "e-" + std::to_string(power);
    const mpq_class exact = halves * power_of_two(-static_cast<long>(power));
    EXPECT_EQ(nearest<float>(exact), parsed<float>(text)) << text;
    EXPECT_EQ(nearest<double>(exact), parsed<double>(text)) << text;
  }
}

const Triangled floor_triangle = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};

void expect_contact(const Pathd& path, const Triangled& triangle, const QueryOptionsd& options, const mpq_class& t,
                    const mpq_class& u, const mpq_class& v, Side side) {
  const auto contact = exact_contact(path, triangle, options);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->t, t);
  EXPECT_EQ(contact->u, u);
  EXPECT_EQ(contact->v, v);
  EXPECT_EQ(contact->side, side);
}

TEST(ExactContact, is_where_a_segment_crosses_the_plane) {
  const Segmentd down = {{1, 1, 1}, {1, 1, -2}};
  expect_contact(down, floor_triangle, {}, mpq_class(1, 3), mpq_class(1, 3), mpq_class(1, 3), Side::front);
  const Segmentd up = {{1, 1, -2}, {1, 1, 1}};
  expect_contact(up, floor_triangle, {}, mpq_class(2, 3), mpq_class(1, 3), mpq_class(1, 3), Side::back);
}

TEST(ExactContact, counts_edges_corners_and_both_ends) {
  expect_contact(Segmentd{{1, 0, 1}, {1, 0, 0}}, floor_triangle, {}, 1, mpq_class(1, 3), 0, Side::front);
  expect_contact(Segmentd{{0, 3, 0}, {5, 5, 5}}, floor_triangle, {}, 0, 0, 1, Side::back);
  EXPECT_FALSE(exact_contact<double>(Segmentd{{1, 0, 1}, {1, 0, 0x1p-1074}}, floor_triangle));
  EXPECT_FALSE(exact_contact<double>(Segmentd{{1, -0x1p-1074, 1}, {1, -0x1p-1074, -1}}, floor_triangle));
}

TEST(ExactContact, reaches_as_far_as_the_kind_of_path) {
  const Vector3d origin = {1, 1, 4};
  expect_contact(Rayd{origin, {0, 0, -1}}, floor_triangle, {}, 4, mpq_class(1, 3), mpq_class(1, 3), Side::front);
  EXPECT_FALSE(exact_contact<double>(Rayd{origin, {0, 0, 1}}, floor_triangle));
  expect_contact(Lined{origin, {0, 0, 1}}, floor_triangle, {}, -4, mpq_class(1, 3), mpq_class(1, 3), Side::back);
  EXPECT_FALSE(exact_contact<double>(Segmentd{origin, {1, 1, 3}}, floor_triangle));
}

TEST(ExactContact, is_where_a_path_in_the_plane_enters) {
  expect_contact(Segmentd{{-1, 1, 0}, {3, 1, 0}}, floor_triangle, {}, mpq_class(1, 4), 0, mpq_class(1, 3),
                 Side::edge_on);
  expect_contact(Segmentd{{1, 1, 0}, {9, 1, 0}}, floor_triangle, {}, 0, mpq_class(1, 3), mpq_class(1, 3),
                 Side::edge_on);
  expect_contact(Lined{{1, 1, 0}, {0, 1, 0}}, floor_triangle, {}, -1, mpq_class(1, 3), 0, Side::edge_on);
  EXPECT_FALSE(exact_contact<double>(Segmentd{{2, 2, 0}, {9, 2, 0}}, floor_triangle));
  QueryOptionsd options;
  options.min_t = 0.5;
  expect_contact(Segmentd{{-1, 1, 0}, {3, 1, 0}}, floor_triangle, options, mpq_class(1, 2), mpq_class(1, 3),
                 mpq_class(1, 3), Side::edge_on);
}

TEST(ExactContact, of_a_path_without_length_is_at_zero) {
  const Lined point = {{1, 1, 0}, {0, 0, 0}};
  expect_contact(point, floor_triangle, {}, 0, mpq_class(1, 3), mpq_class(1, 3), Side::edge_on);
  EXPECT_FALSE(exact_contact<double>(Lined{{1, 1, 1}, {0, 0, 0}}, floor_triangle));
  QueryOptionsd options;
  options.min_t = 0x1p-1074;
  EXPECT_FALSE(exact_contact<double>(point, floor_triangle, options));
}

TEST(ExactContact, weighs_the_end_corners_of_a_degenerate_triangle) {
  const Segmentd across = {{1, 0, 1}, {1, 0, -1}};
  // The middle corner carries no weight, whichever it is.
  expect_contact(across, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, {}, mpq_class(1, 2), 0, mpq_class(1, 4), Side::edge_on);
  expect_contact(across, {{2, 0, 0}, {0, 0, 0}, {4, 0, 0}}, {}, mpq_class(1, 2), mpq_class(3, 4), mpq_class(1, 4),
                 Side::edge_on);
  // The one with the lowest index among equal corners carries it.
  expect_contact(across, {{0, 0, 0}, {4, 0, 0}, {4, 0, 0}}, {}, mpq_class(1, 2), mpq_class(1, 4), 0, Side::edge_on);
  expect_contact(across, {{4, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}, mpq_class(1, 2), mpq_class(3, 4), 0, Side::edge_on);
  expect_contact(across, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {}, mpq_class(1, 2), 0, 0, Side::edge_on);
  expect_contact(Segmentd{{-4, 0, 0}, {4, 0, 0}}, {{2, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {}, mpq_class(5, 8), 1, 0,
                 Side::edge_on);
}

TEST(ExactContact, keeps_to_closed_limits) {
  const Segmentd down = {{1, 1, 1}, {1, 1, -3}};
  QueryOptionsd options;
  options.min_t = options.max_t = 0.25;
  EXPECT_TRUE(exact_contact<double>(down, floor_triangle, options));
  options.min_t = 0.25 + 0x1p-54;
  options.max_t = 1;
  EXPECT_FALSE(exact_contact<double>(down, floor_triangle, options));
  options.min_t = -infinity;
  options.max_t = 0.25 - 0x1p-55;
  EXPECT_FALSE(exact_contact<double>(down, floor_triangle, options));
  options.max_t = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(exact_contact<double>(down, floor_triangle, options));
  options = {};
  options.min_t = infinity;
  EXPECT_FALSE(exact_contact<double>(down, floor_triangle, options));
}

TEST(ExactContact, is_culled_by_side) {
  const Segmentd down = {{1, 1, 1}, {1, 1, -1}};
  const Segmentd along = {{1, 1, 0}, {2, 1, 0}};
  QueryOptionsd options;
  options.culling = Culling::back;
  EXPECT_TRUE(exact_contact<double>(down, floor_triangle, options));
  EXPECT_FALSE(exact_contact<double>(along, floor_triangle, options));
  options.culling = Culling::front;
  EXPECT_FALSE(exact_contact<double>(down, floor_triangle, options));
  EXPECT_FALSE(exact_contact<double>(along, floor_triangle, options));
}

TEST(ExactContact, leaves_out_what_contains_an_ignored_end) {
  QueryOptionsd options;
  options.ignore_start_contact = true;
  EXPECT_FALSE(exact_contact<double>(Segmentd{{1, 1, 0}, {1, 1, -1}}, floor_triangle, options));
  EXPECT_FALSE(exact_contact<double>(Rayd{{1, 1, 0}, {1, 0, 0}}, floor_triangle, options));
  EXPECT_TRUE(exact_contact<double>(Lined{{1, 1, 0}, {1, 0, 0}}, floor_triangle, options));
  EXPECT_TRUE(exact_contact<double>(Segmentd{{1, 1, 1}, {1, 1, 0}}, floor_triangle, options));
  options = {};
  options.ignore_end_contact = true;
  EXPECT_FALSE(exact_contact<double>(Segmentd{{1, 1, 1}, {1, 1, 0}}, floor_triangle, options));
  EXPECT_TRUE(exact_contact<double>(Segmentd{{1, 1, 0}, {1, 1, 1}}, floor_triangle, options));
  EXPECT_TRUE(exact_contact<double>(Rayd{{1, 1, 1}, {0, 0, -1}}, floor_triangle, options));
}

TEST(ExactContact, misses_what_is_not_finite) {
  EXPECT_FALSE(exact_contact<double>(Rayd{{1, 1, 1}, {0, 0, -infinity}}, floor_triangle));
  EXPECT_FALSE(exact_contact<double>(Segmentd{{1, 1, 1}, {1, 1, -1}}, {{0, 0, 0}, {infinity, 0, 0}, {0, 3, 0}}));
}

TEST(ExactContact, at_a_parameter_beyond_the_largest_number_is_a_hit_at_infinity) {
  const Triangled far = {{0, 0, 1}, {3, 0, 1}, {0, 3, 1}};
  const auto contact = exact_contact<double>(Rayd{{1, 1, 0}, {0, 0, 0x1p-1074}}, far);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->t, power_of_two(1074));
  EXPECT_EQ(rounded_hit<double>(*contact, 7), (Hitd{infinity, 1.0 / 3, 1.0 / 3, 7, Side::back}));
}

}  // namespace
}  // namespace surehit::test::exact_oracle_test
