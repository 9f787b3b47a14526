#include "textbook_examples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "moeller_trumbore.hpp"
#include "support/exact_oracle.hpp"
#include "support/same_bits.hpp"
#include "surehit/intersect.hpp"
#include "textbook_variant.hpp"

namespace surehit::test::textbook_examples_test {
namespace {

TEST(TextbookExamples, are_wrong_in_each_variant_and_right_in_surehit) {
  for (const auto& variant : textbook_variants<float>()) {
    if (std::string(variant.letter) == "surehit") continue;
    std::size_t examples = 0;
    for (const auto& [letter, triangle, path] : textbook_examples()) {
      if (std::string(letter) != variant.letter) continue;
      ++examples;
      QueryOptionsf options;
      if (variant.asked == Asked::front) options.culling = Culling::back;
      const std::optional<ExactContact> exact = exact_contact(path, triangle, options);
      EXPECT_NE(variant.answer(path, triangle).has_value(), exact.has_value()) << letter;
      const std::optional<Hitf> hit = intersect(path, triangle, options);
      ASSERT_EQ(hit.has_value(), exact.has_value()) << letter;
      EXPECT_TRUE(!hit || same_bits(*hit, rounded_hit<float>(*exact))) << letter;
    }
    EXPECT_GT(examples, 0u) << variant.letter;
  }
}

const TextbookExample& first_example(const std::string& letter) {
  return *std::ranges::find_if(textbook_examples(), [&](const auto& example) { return example.letter == letter; });
}

// The page has these numbers, step by step.

TEST(TextbookExamples, of_the_plane_first_round_the_point_beyond_the_edge) {
  const float t = 2.0F / 3;
  EXPECT_EQ(t, 0.666666687F);
  EXPECT_EQ(2 * t, 1.33333337F);
  EXPECT_EQ(2 + t, 2.66666675F);
  EXPECT_GT(double{2 * t} + double{2 + t}, 4);
}

TEST(TextbookExamples, of_one_division_have_weights_that_sum_to_more_than_one) {
  const auto& [letter, triangle, path] = first_example("b");
  const Determinants<float> determinants(path, triangle);
  EXPECT_EQ(determinants.det, 14);
  EXPECT_EQ(determinants.u_det, 12);
  EXPECT_EQ(determinants.v_det, 2);
  EXPECT_EQ(1.0F / 14, 0.0714285746F);
  EXPECT_EQ(12 * (1.0F / 14), 0.857142925F);
  EXPECT_EQ(2 * (1.0F / 14), 0.142857149F);
  EXPECT_EQ(12 * (1.0F / 14) + 2 * (1.0F / 14), 1.00000012F);
  // Möller–Trumbore with two divisions instead gets this one right, and others wrong.
  EXPECT_EQ(12.0F / 14 + 2.0F / 14, 1);
}

TEST(TextbookExamples, without_a_test_of_det_divide_zero_by_zero) {
  const auto& [letter, triangle, path] = first_example("c");
  const Determinants<float> determinants(path, triangle);
  EXPECT_EQ(determinants.det, 0);
  EXPECT_EQ(determinants.u_det, 0);
  const TextbookAnswer<float> answer = without_test_of_det(path, triangle);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(std::isnan(answer->t) && std::isnan(answer->u) && std::isnan(answer->v));
}

TEST(TextbookExamples, with_an_epsilon_have_a_small_det) {
  const auto det = [](const char* letter) {
    const TextbookExample& example = first_example(letter);
    return Determinants<float>(example.path, example.triangle).det;
  };
  EXPECT_EQ(det("d8"), 0x1p-27F);
  EXPECT_EQ(det("d6"), 0x1p-21F);
  EXPECT_EQ(det("d3"), 0x1p-11F);
}

TEST(TextbookExamples, with_the_rest_of_one_have_a_rest_below_zero) {
  const float u = 2 * (1.0F / 6);
  const float v = 4 * (1.0F / 6);
  EXPECT_EQ(u, 0.333333343F);
  EXPECT_EQ(v, 0.666666687F);
  EXPECT_EQ(u + v, 1);
  EXPECT_EQ(1 - u, 0.666666627F);
  EXPECT_EQ(1 - u - v, -0x1p-24F);
}

TEST(TextbookExamples, of_a_line_also_hit_what_is_behind_a_segment) {
  const Segmentf away = {{1, 1, 1}, {1, 1, 2}};
  const Trianglef floor = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const TextbookAnswer<float> answer = of_line<float>(away, floor);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->t, -1);
}

TEST(TextbookExamples, of_culling_have_the_wrong_sign) {
  const TextbookExample& by_normal = first_example("g1");
  const auto& [a, b, c] = by_normal.triangle;
  const Vector3f n = cross(difference(b, a), difference(c, a));
  EXPECT_EQ(n, Vector3f(5, -350015, 416870));
  EXPECT_EQ(5.0 * 522 + 350015.0 * 873 - 416870.0 * 733, -5.0);
  EXPECT_EQ(dot(n, direction_of(by_normal.path)), 32);

  const TextbookExample& by_det = first_example("g2");
  EXPECT_EQ(cross(direction_of(by_det.path), difference(by_det.triangle.c, by_det.triangle.a)),
            Vector3f(-638054, -3, -570603));
  EXPECT_EQ(516.0 * 638054 + 688.0 * 3 - 577.0 * 570603, -3.0);
  EXPECT_EQ(Determinants<float>(by_det.path, by_det.triangle).det, 32);
}

TEST(TextbookExamples, of_the_watertight_test_round_the_shear) {
  const float third = 1.0F / 3;
  EXPECT_EQ(3 - 2 * (2.0F / 3), 1.66666663F);
  EXPECT_EQ(-1 - 2 * third, -1.66666675F);
  EXPECT_EQ(-1 - 2 * (2.0F / 3), -2.33333349F);
  EXPECT_EQ(3 - 2 * third, 2.33333325F);
}

}  // namespace
}  // namespace surehit::test::textbook_examples_test
